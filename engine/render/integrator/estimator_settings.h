// The render settings as kernels read them.
#pragma once

#include "render/integrator/reuse_groups.h"
#include "scene/render_settings.h"

#include <cstdint>

namespace blush {

struct FilterTable;
struct EnergyTable;

// Absolute limit of path length, whatever the settings. Paths that reach it are counted and reported; this takes a closed room of
// albedo 1 with roulette off.
constexpr int max_path_length = 100000;

// Russian roulette skips delta lobes before this bounce, whatever its rule: they lose almost no energy there.
constexpr int first_rr_bounce_at_delta = 17;

// How NEE and BSDF sampling are combined.
struct MisSettings {
    Strategy strategy = Strategy::mis;
    bool default_heuristic = true; // heuristic == MisHeuristic{}
    MisHeuristic heuristic;
};

struct EstimatorSettings {
    int32_t max_bounces = max_path_length; // scattering events
    Roulette roulette;
    MisSettings mis;
    SamplerType sampler = SamplerType::sobol;
    const FilterTable* filter = nullptr;
    const EnergyTable* energy = nullptr; // null: no multiple-scattering compensation
    ReuseGroups reuse;                   // group of one pixel: off
    bool filter_textures = true;
    bool emission_only = false;  // no NEE, and only delta lobes continue paths: emission that is seen, in mirrors and glass, too
    float width = 1, height = 1; // of the film, pixels
};

} // namespace blush
