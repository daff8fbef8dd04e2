// Integrators for comparison with path tracing: direct light as the path tracer finds it, and a cheap stand-in for the indirect light that
// diffuse surfaces reflect; or a classical solver for all light: progressive photon mapping, bidirectional path tracing, Metropolis light
// transport. Never a default; images say "biased", "consistent" or "unbiased".
#pragma once

#include "core/result.h"
#include "core/vec.h"

#include <string>
#include <string_view>

namespace blush {

struct ComparisonIntegrator {
    enum class Kind {
        none,                   // path tracing
        ambient,                // the same light from all sides, times ambient occlusion
        irradiance_cache,       // Ward, Rubinstein and Clear 1988
        light_probes,           // a grid of spherical harmonics of 2nd order
        photon_map,             // Jensen 1996
        progressive_photon_map, // Hachisuka, Ogaki and Jensen 2008; Knaus and Zwicker 2011
        bidirectional,          // Lafortune and Willems 1993; Veach 1997
        metropolis,             // Veach and Guibas 1997; Kelemen et al. 2002
    };
    Kind kind = Kind::none;
    // ambient: its radiance in nits. Automatic: the mean over the picture of what the path tracer finds.
    bool automatic_color = true;
    Vec3 color{0, 0, 0};
    float distance = 1; // ambient: occluders count up to this many metres
    // irradiance_cache: largest error of a record, as Ward's a. 0 stores no record: then it is unbiased.
    float accuracy = 0.2f;
    int rays = 0;             // paths per record or probe; 0: 256 per record, 192 per probe
    int photons = 0;          // light paths; 0: a million for photon_map, 100,000 for each sample of progressive_photon_map
    float radius = 0;         // of the disk that counts photons, metres; 0: a fiftieth of the radius of the scene
    float alpha = 2.f / 3;    // progressive_photon_map: 1 keeps the radius, 0 keeps the number of photons in a disk
    int gather = 0;           // photon_map: rays of the final gather at each point; 0: the map itself is shown
    float large_steps = 0.3f; // metropolis: share of the mutations that are independent paths
    int chain = 4096;         // metropolis: mutations in a chain
    int grid = 12;            // light_probes: cells along each axis of the scene's bounds

    // What is prepared before the first sample, records, probes or photons, is kept when the scene changes, as baked light is.
    bool baked = false;

    static constexpr int max_rays = 1024, max_grid = 64, max_photons = 100000000,
                         max_chain = 1000000; // max_rays: of `rays` and of `gather`
    static constexpr float max_accuracy = 1;

    int default_photons() const { return kind == Kind::progressive_photon_map ? 100000 : 1000000; }
    int photons_per_pass() const { return photons > 0 ? photons : default_photons(); }
    // True for integrators that prepare something once.
    bool can_be_baked() const { return kind == Kind::irradiance_cache || kind == Kind::light_probes || kind == Kind::photon_map; }
    int default_rays() const { return kind == Kind::light_probes ? 192 : 256; }
    bool operator==(const ComparisonIntegrator&) const = default;
};

// "path", "ambient,color=R:G:B|auto,distance=M", "irradiance-cache,a=A,rays=N", "light-probes,grid=N,rays=N",
// "photon-map,photons=N,radius=M|auto,gather=N", "progressive-photon-map,photons=N,radius=M|auto,alpha=A", "bidirectional",
// "metropolis,large=P,chain=N"; ",baked" behind those that can be.
Result<ComparisonIntegrator> parse_integrator(std::string_view text);
std::string to_string(const ComparisonIntegrator& integrator);
// Why its images are biased, for people.
std::string_view bias_of(ComparisonIntegrator::Kind kind);
// "biased"; "consistent" if the bias vanishes with the number of samples; "unbiased".
std::string_view verdict_of(ComparisonIntegrator::Kind kind);

} // namespace blush
