// Named image sizes and render qualities.
#pragma once

#include "scene/render_settings.h"

#include <array>

namespace blush {

struct SizePreset {
    const char* name;
    int width, height; // pixels
};
constexpr std::array<SizePreset, 7> size_presets{{
    {"HD 720, 16:9", 1280, 720},
    {"HD 1080, 16:9", 1920, 1080},
    {"QHD, 16:9", 2560, 1440},
    {"UHD, 16:9", 3840, 2160},
    {"Scope, 2.39:1", 2048, 858},
    {"Square", 1080, 1080},
    {"Portrait, 4:5", 1080, 1350},
}};

struct QualityPreset {
    const char* name;
    int64_t spp;
    double error; // estimated relMSE of the stop rule; 0: none
};
constexpr std::array<QualityPreset, 4> quality_presets{{
    {"Draft", 32, 0},
    {"Preview", 256, 0},
    {"Good", 1024, 0},
    {"Final", 16384, 1e-4},
}};

// The index of the matching preset, or the size of the list for custom settings. The time limit is not part of a quality.
inline size_t preset_of_size(const RenderSettings& r) {
    size_t i = 0;
    while (i < size_presets.size() && (size_presets[i].width != r.width || size_presets[i].height != r.height)) ++i;
    return i;
}
inline size_t preset_of_quality(const RenderSettings& r) {
    size_t i = 0;
    while (i < quality_presets.size() && (quality_presets[i].spp != r.spp || quality_presets[i].error != r.error)) ++i;
    return i;
}

} // namespace blush
