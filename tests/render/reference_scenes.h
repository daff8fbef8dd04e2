// Scenes of the stored references, shared by the tool that renders them and the test that compares with them.
#pragma once

#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test {

// A reference is the mean of many renders of the test's own size, stored with their scatter, so that the test knows its variance
// far better than from its own samples.
constexpr int64_t reference_spp = 16; // of one render

inline RenderSettings reference_settings(const std::string& scene) {
    const bool square = scene == "cornell" || scene == "furnace";
    return square ? settings_for(64, 64, reference_spp) : settings_for(96, 56, reference_spp);
}
inline std::string reference_file(const std::string& scene) { return std::string(BLUSH_REFERENCES) + "/" + scene + ".exr"; }

// Small images with default settings and their converged versions, to validate error estimates.
inline RenderSettings coverage_settings() {
    RenderSettings settings;
    settings.width = 64;
    settings.height = 40;
    settings.spp = 64;
    return settings;
}
inline std::string coverage_reference_file(const std::string& scene) {
    return std::string(BLUSH_REFERENCES) + "/coverage/" + scene + ".exr";
}

struct Reference {
    RenderedImage mean; // with the standard errors of its pixels
    double renders = 0; // number of renders in the mean
};
// Throws if the file cannot be read.
Reference read_reference(const std::string& file);

} // namespace blush::test
