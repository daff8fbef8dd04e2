// The variants of `blush converge`: named render settings, from the command line or a preset.
#pragma once

#include "app/commands/render/render_options.h"

#include <string>
#include <vector>

namespace blush {

struct Variant {
    std::string name;
    std::string options; // as typed, for the report
    RenderSettings settings;
    ComparisonIntegrator integrator = {};
};

// Parses "NAME: OPTIONS" with options of `render`, on top of `base`. Errors: no name, invalid options, or options that all
// variants must share (image and stop rules).
Result<Variant> parse_variant(const std::string& text, const RenderOptions& base);

// roulette, strategies, bounces, samplers, caustics, tricks. Errors: unknown preset.
Result<std::vector<Variant>> preset_variants(const std::string& preset, const RenderOptions& base);

} // namespace blush
