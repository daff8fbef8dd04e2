// The render settings as kernels read them.
#pragma once

#include "render/reuse_groups.h"
#include "scene/render_settings.h"

#include <cstdint>

namespace blush {

struct FilterTable;
struct EnergyTable;

// No path is longer than this whatever the settings say. Reaching it is counted and reported, not hidden: it takes
// a closed room of albedo 1 with roulette off.
constexpr int longest_path = 100000;

// Before this bounce roulette leaves paths alone that a smooth mirror or smooth glass sends on, whatever its rule: they have lost next to
// nothing there.
constexpr int first_asked_at_smooth = 17;

struct EstimatorSettings {
    int32_t max_bounces = longest_path; // scattering events
    Roulette roulette;
    Strategy strategy = Strategy::mis;
    SampleNumbers sampler = SampleNumbers::sobol;
    const FilterTable* filter = nullptr;
    const EnergyTable* energy = nullptr; // null: no multiple-scattering compensation
    ReuseGroups reuse;                   // of one pixel: none
    bool filter_textures = true;
    float width = 1, height = 1;         // of the film, pixels
};

} // namespace blush
