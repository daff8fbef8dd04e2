// Photons: flux of light paths that arrives at surfaces (Jensen 1996), in a grid that finds those near a point.
#pragma once

#include "core/vec.h"
#include "render/comparison/cells.h"
#include "render/comparison/comparison_integrator.h"
#include "render/comparison/indirect_light.h"
#include "render/integrator/light_path_emission.h"
#include "scene/affine.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace blush {

struct Photon {
    Vec3 position, towards; // towards: unit, against the flight
    Vec3 flux;              // lm, RGB
    int bounces = 0;        // scatterings before this surface
};

// Which light paths are traced, and where they leave photons.
struct PhotonSelection {
    enum class At { diffuse, scattering };
    int64_t paths = 0;
    uint32_t pass = 0;   // each has random numbers of its own
    int min_bounces = 0; // photons with fewer scatterings are left out
    At at = At::diffuse; // surfaces with a diffuse part, or all that do more than reflect and refract in single directions
    double radius = 1;   // metres: largest distance that for_each_near() is asked for
};

class PhotonGrid {
public:
    // Before the first trace() of an image: prepares the emission of all lights.
    void begin(const PreparationContext& context);
    // Light paths of all lights, with the bounces of `context`. False if stopped.
    bool trace(const PreparationContext& context, const PhotonSelection& selection);
    // Calls visit(photon) for photons within `radius` of a point and at most `flatness` times that off its plane: what lies higher is
    // another surface. `normal`: unit.
    template <class Visit> void for_each_near(const Vec3d& at, const Vec3d& normal, double radius, const Visit& visit) const;
    size_t size() const { return photons_.size(); }
    size_t memory_bytes() const { return photons_.capacity() * sizeof(Photon); }

private:
    static constexpr double flatness = 0.2;
    struct Range {
        size_t begin = 0, end = 0;
    };
    void sort_by_cells();

    LightPathEmission emission_;
    double radius_ = 1;
    std::vector<Photon> photons_; // by cell
    std::unordered_map<uint64_t, Range> cells_;
};

template <class Visit> void PhotonGrid::for_each_near(const Vec3d& at, const Vec3d& normal, double radius, const Visit& visit) const {
    for_each_cell_near(at, 2 * radius_, [&](uint64_t key) {
        const auto found = cells_.find(key);
        if (found == cells_.end()) return;
        for (size_t k = found->second.begin; k < found->second.end; ++k) {
            const Vec3d to = to_double(photons_[k].position) - at;
            if (length_squared(to) < radius * radius && std::abs(dot(to, normal)) < flatness * radius) visit(photons_[k]);
        }
    });
}

// Radius of disks unless it is chosen: a fiftieth of that of the scene.
double photon_radius(const ComparisonIntegrator& options, const CasterSphere& scene);

} // namespace blush
