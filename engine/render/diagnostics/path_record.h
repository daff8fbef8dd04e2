// One sample of a pixel as plain data, vertex by vertex: for `blush paths` and the path tool of the window. Positions are in the world,
// metres; radiances are scene-linear RGB in nits. The formulas are those of docs/science/estimator.md.
#pragma once

#include "core/math.h"
#include "render/film/found_by.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// What a ray of the path met.
enum class Met : uint8_t { surface, sphere_light, background };
// How a vertex scattered. `glossy`: one density over several lobes, or over a lobe that is not Lambertian; delta lobes have no density.
enum class ScatterKind : uint8_t { none, diffuse, glossy, transmission, delta_reflection, delta_transmission };
// Why a path ended at a vertex, if it did.
enum class PathEnd : uint8_t {
    none,
    escaped,    // into the background
    light,      // at what only emits
    absorbed,   // no direction was sampled, or its throughput is 0
    roulette,   // by Russian roulette
    max_length, // by the limit of bounces
    invalid,    // its throughput is not finite: the film leaves the sample out
};
std::string_view to_string(Met met);
std::string_view to_string(ScatterKind kind);
std::string_view to_string(PathEnd end);

// Next event estimation at a vertex: beta f |cos| L_e w / p, times the share of it that arrives.
struct NextEvent {
    std::string light;      // name of its object
    Vec3d from{0, 0, 0};    // start of the shadow ray
    Vec3d to{0, 0, 0};      // its end: at the light, at what blocks it or, towards lights at infinity, some distance away
    bool infinite = false;  // the light is at infinity
    bool blocked = false;   // nothing arrives
    std::string blocker;    // name of the object that blocks it; empty: none, or blended surfaces that leave nothing
    Vec3 f_cos{0, 0, 0};    // BSDF times cosine, 1/sr
    Vec3 radiance{0, 0, 0}; // L_e towards the vertex; of lights without size candela per square metre or lux
    float light_pdf = 0;    // per solid angle; of lights without size a probability
    float bsdf_pdf = 0;     // of the direction, per solid angle
    float mis = 1;          // MIS weight
    Vec3 sent{0, 0, 0};     // contribution if nothing is in the way
    Vec3 arrived{0, 0, 0};  // contribution
};

struct PathVertex {
    int bounce = 0;
    Met met = Met::background;
    std::string object, material;
    Vec3d position{0, 0, 0};           // of the background: some distance along the ray
    Vec3 direction{0, 0, 0};           // of the ray that arrives, unit length
    float distance = 0;                // of it, metres; infinite in the background
    Vec3 normal{0, 0, 0}, ns{0, 0, 0}; // geometric and shading normal; 0 without a surface
    Vec3 color{0, 0, 0};               // directional albedo, of lights their emission
    Vec3 passed{1, 1, 1};              // transmittance of the segment before: panes, and absorption in a solid
    Vec3 arriving{1, 1, 1};            // throughput beta with which light of this vertex counts
    bool emits = false;
    Vec3 radiance{0, 0, 0};              // L_e towards the path
    float emission_mis = 1;              // MIS weight of the emission
    Vec3 emission{0, 0, 0};              // its contribution: arriving * radiance * emission_mis
    float guided = 0;                    // share of path guiding in the density with which the arriving ray was sampled
    std::optional<NextEvent> next_event; // empty: no light was sampled, or it cannot light this side
    Vec3 panes{0, 0, 0};                 // contribution of panes that the arriving ray passed
    Vec3 past{0, 0, 0};                  // of the background behind blended surfaces
    Vec3 chains{0, 0, 0};                // of manifold sampling
    Vec3 light_vertices{0, 0, 0};        // of connections to light vertices
    ScatterKind scatters = ScatterKind::none;
    Vec3 factor{0, 0, 0};  // f |cos| / pdf of the sampled direction; of a delta lobe its reflectance over its probability
    float pdf = 0;         // of that direction per solid angle; infinite for a delta lobe
    bool roulette = false; // Russian roulette decided here
    float survival = 1;    // its probability q: the throughput of survivors is divided by it
    Vec3 beta{0, 0, 0};    // throughput behind the vertex: arriving * factor / survival; of a path that ended here, what it would be
    PathEnd end = PathEnd::none;

    // All light that the path received at this vertex.
    Vec3 received() const;
};

struct RecordedPath {
    int x = 0, y = 0; // pixel, from the upper left corner
    int64_t sample = 0;
    Vec3d eye{0, 0, 0}; // start of the first ray: on the lens
    std::vector<PathVertex> vertices = {};
    bool shortened = false;    // more vertices follow than are recorded
    Vec3 radiance{0, 0, 0};    // what the film receives for the sample, of all vertices
    Vec3 light_paths{0, 0, 0}; // what light paths give the pixel in the same pass, if they were replayed

    Vec3 total() const { return radiance + light_paths; }
    // True if the film accepts the sample: it is finite and not negative.
    bool is_valid() const;
};

// Light of a path by the strategy that found it (found_by.h).
using LightByStrategy = std::array<Vec3d, size_t(found_by_count)>;
LightByStrategy by_strategy(const RecordedPath& path);
// Light of a path by its length: element k is light that was scattered k times; the last one contains all longer paths. Chains of
// manifold sampling and of light vertices count as one event on a mirror or glass. Light paths are not part of it: they do not say how
// often they were scattered.
std::vector<Vec3d> by_length(const RecordedPath& path, size_t lengths);

} // namespace blush
