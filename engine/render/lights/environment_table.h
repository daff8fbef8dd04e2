// The scene's environment as the kernels read it, with the importance map for sampling directions.
#pragma once

#include "core/result.h"
#include "scene/scene.h"
#include "shading/environment.h"

#include <cstdint>
#include <vector>

namespace blush {

class Workers;

// Density of light sampling over directions.
// full: proportional to luminance.
// compensated: proportional to the luminance above the map's mean, because BSDF sampling covers the even part well. This is MIS
// compensation (Karlik et al. 2019, "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling", section 4.1).
// compensated_alone: for scenes without other lights, subtracts less than the mean. All samples of light sampling then go to the map.
// Maps that are nearly uniform are not sampled at all (sampled_share). Compensation requires MIS: where the density is 0, BSDF samples
// have weight 1.
enum class EnvironmentSampling { none, full, compensated, compensated_alone };

struct EnvironmentTable {
    // Size of the image; a constant environment is one white texel, no environment is one black texel.
    int32_t width = 0, height = 0, guide_bits = 1;
    ImagePtr image;            // its values are the texels; null if they had to be changed or copied
    std::vector<float> texels; // the changed copy, if `image` is null
    std::vector<uint32_t> row_thresholds, column_thresholds;
    std::vector<int32_t> column_guides;
    std::vector<EnvironmentRow> rows;
    Vec3d texel_integral{0, 0, 0}; // integral of the map over the sphere, sr; only with an importance map
    double sampled_share = 0;      // share of that integral's luminance that light sampling covers; 0: directions are not sampled
    EnvironmentSampling sampling = EnvironmentSampling::none;
    bool emits_light = false; // some texel is not black
    std::vector<Diagnostic> warnings;
    // From the parameters:
    Vec3 scale{0, 0, 0};
    float rotation = 0; // turns
    bool visible_to_camera = true, lights_scene = true;

    double seconds = 0; // build time

    // RGB radiance of the filtered map integrated over the sphere, nits x sr: its weight in light selection.
    Vec3d integral() const;
    // Three floats per texel.
    const float* texel_data() const { return image ? image->floats.data() : texels.data(); }
    // Valid until the table changes.
    EnvironmentTables tables() const;
};

// Size of the map that a sky is rendered into: 0.7 degrees per texel, finer
// than all features except the sun's disk, which is a separate light.
constexpr int sky_map_width = 512, sky_map_height = 256;

// Warns if texels are negative or not finite (they become 0) or if the image is unusable (no environment). Without sampling
// it has no importance map: it can be evaluated, but directions cannot be sampled and have no pdf. `workers` share the rows; the
// table is the same for any number of threads. Null: single-threaded.
EnvironmentTable build_environment_table(const Environment& environment, EnvironmentSampling sampling = EnvironmentSampling::full,
                                         const Workers* workers = nullptr);
// True if colour and intensity allow light; the image may still be black.
bool gives_light(const Environment& environment);
// Radiance in nits of a texel of 1.
Vec3 environment_scale(const Environment& environment);
// Memory of a map of that size: the texels and the importance map.
struct EnvironmentBytes {
    int64_t texels = 0, importance = 0;
};
EnvironmentBytes environment_bytes(int64_t width, int64_t height);
// Light of an environment, estimated by 256 sampled directions; luminance.
struct EnvironmentLight {
    double integral = 0;   // of the radiance over all directions
    bool has_suns = false; // a tenth of it comes from directions with a hundred times the mean radiance
};
// Requires an importance map (EnvironmentTable::sampled_share > 0).
EnvironmentLight measure_light(const EnvironmentTables& environment);
// Updates colour, intensity, rotation and visibility; keeps the map. The result is bit-identical to a new build.
void update_environment_parameters(EnvironmentTable& table, const Environment& environment);

} // namespace blush
