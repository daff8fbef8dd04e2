// A path from the camera and a path from a light, and all connections between them (Veach 1997, chapter 10). The sampler of paths of
// bidirectional path tracing and Metropolis light transport. Surfaces are shaded as the path tracer does it, one path at a time.
#pragma once

#include "render/comparison/hit_shading.h"
#include "render/comparison/path_densities.h"
#include "render/comparison/random_pairs.h"
#include "render/film/splat.h"
#include "render/integrator/light_path_emission.h"

#include <cstdint>
#include <vector>

namespace blush {

// The camera's part of a path: its pixel, and the position in the pixel and on the lens as random numbers.
struct CameraSample {
    int x = 0, y = 0;
    Pair<float> in_pixel, on_lens;
};

class BidirectionalPaths {
public:
    // `context`: its scene has the tables of `emission`, and neither panes nor guides: panes are surfaces with a delta lobe here.
    BidirectionalPaths(const KernelContext& context, const LightPathEmission& emission) : context_(context), emission_(emission) {}

    // Traces both paths and adds what all strategies find to `out`, as splats that are scaled for one call for each pixel of the film:
    // without the emission that the camera sees directly. `path`: any number, the same for the same random numbers; chooses
    // wavelengths and the surfaces that stochastic opacity lets through.
    void trace(RandomPairs& random, const CameraSample& camera, const Sampler<float>& path, std::vector<Splat>& out);

private:
    struct Vertex {
        HitShading p;
        float cos_wo = 1;       // to the geometric normal, clamped
        double density = 1;     // of the direction that led here, over projected solid angle
        double geometry = 1;    // G of the edge that led here
        double reverse = 1;     // of the direction back, as the next vertex sees it
        bool delta = false;     // the path goes on by a delta lobe
        bool dispersed = false; // the path carries a single wavelength, whose colour is not in its throughput
    };
    // Where a path goes on.
    struct Direction {
        Path<float> path;
        double density = 0; // over projected solid angle; 1 for delta lobes
    };
    struct Lit {
        int32_t light;
        Vec3 radiance;
        Vec3 position, normal;
    };

    Hit<float> hit_by(const Path<float>& path, int salt, uint32_t mask);
    bool reaches(const Ray<float>& ray, float distance, int salt, uint32_t mask);
    Vertex vertex_at(const Path<float>& path, const Hit<float>& hit, float width) const;
    void trace_camera_path(RandomPairs& random, const CameraSample& camera);
    void trace_light_path(RandomPairs& random);
    bool extend_camera_path(RandomPairs& random, Vertex& v, int bounce, const Path<float>& arrived, float cone, Direction& next);
    bool extend_light_path(RandomPairs& random, Vertex& v, int bounce, const Path<float>& arrived, Direction& next);
    double reverse_density(const Vertex& v, const Vec3& wi) const;
    // Of NEE at `v`, of the point `at` on a light in direction `wi`, over projected solid angle.
    double nee_density(const Vertex& v, const Vec3& wi, const EmissionPoint<float>& at) const;
    // Densities of the path that `strategy` makes of the first `camera_vertices` surfaces of the camera path and the first strategy - 1
    // of the light path. Without those that depend on the connection: of its two ends, and of the light for strategies 0 and 1.
    PathDensities densities(int strategy, int camera_vertices) const;
    void find_light(const Direction& arrived, const Lit& lit, int bounce);
    void find_background(const Direction& arrived, int bounce);
    void find_emission(const Direction& arrived, const Hit<float>& hit, const Vertex& v, int bounce);
    void connect_light(RandomPairs& random, int j);
    void connect_vertices(int j, int i);
    void connect_camera_to(RandomPairs& random, int i);
    Vec3 colored(const Vec3& radiance, bool dispersed) const; // by the wavelength of the path
    void add(const Vec3& radiance, int scatterings, int32_t light);

    const KernelContext& context_;
    const LightPathEmission& emission_;
    CameraSample camera_;
    Sampler<float> sampler_{0, 0};
    std::vector<Vertex> from_camera_, from_light_; // without the camera and the light
    EmittedPath emitted_;
    double emitted_nee_ = 0; // density of NEE for the light path's first edge
    std::vector<Splat>* out_ = nullptr;
};

} // namespace blush
