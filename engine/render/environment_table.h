// The scene's environment as rays see it, with the importance map that directions are drawn from.
#pragma once

#include "core/result.h"
#include "scene/scene.h"
#include "shading/environment.h"

#include <cstdint>
#include <vector>

namespace blush {

struct EnvironmentTable {
    // Of the image; a uniform environment is one white texel, none a black one.
    int32_t width = 0, height = 0, guide_bits = 1;
    std::vector<float> texels;
    std::vector<uint32_t> row_thresholds, column_thresholds;
    std::vector<int32_t> column_guides;
    std::vector<EnvironmentRow> rows;
    Vec3d texel_integral{0, 0, 0}; // of the map over the sphere, sr; only with an importance map
    bool shines = false;           // some texel is not black
    std::vector<Diagnostic> warnings;
    // Of the parameters:
    Vec3 scale{0, 0, 0};
    float rotation = 0; // turns
    bool visible_to_camera = true, lights_scene = true;

    double seconds = 0; // that building it took

    // RGB radiance of the filtered map integrated over the sphere, nits x sr: what light selection weighs it by.
    Vec3d integral() const;
    // Valid until the table changes.
    EnvironmentTables tables() const;
};

// Of the map that a sky is computed into: 0.7 degrees a texel, finer than anything in it but the sun's disk, which is a light of its own.
constexpr int sky_map_width = 512, sky_map_height = 256;

// With a warning: texels that are negative or not finite become 0, an image that cannot be used becomes no environment. Without an
// importance map it can be looked at, but no directions can be drawn from it, and they have no density.
EnvironmentTable build_environment_table(const Environment& environment, bool importance = true);
// Can it give light at all? Colour and intensity say so; the image may still be black.
bool gives_light(const Environment& environment);
// Radiance in nits of a texel of 1.
Vec3 environment_scale(const Environment& environment);
// Memory of a map of that size: the texels, and what directions are drawn from.
struct EnvironmentBytes {
    int64_t texels = 0, importance = 0;
};
EnvironmentBytes environment_bytes(int64_t width, int64_t height);
// Colour, intensity, rotation and visibility; the map stays. Same bits as a build.
void update_environment_parameters(EnvironmentTable& table, const Environment& environment);

} // namespace blush
