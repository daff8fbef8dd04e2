// What `blush converge` compares: render settings under a name, given one by one or as a preset.
#pragma once

#include "app/commands/render_options.h"

#include <string>
#include <vector>

namespace blush {

struct Variant {
    std::string name;
    std::string options; // as typed, for the report
    RenderSettings settings;
};

// "NAME: OPTIONS", the options being those of `render` on top of `base`. Errors: no name, options that are wrong or that change what
// picture is rendered or for how long, which all variants share.
Result<Variant> parse_variant(const std::string& text, const RenderOptions& base);

// roulette, strategies, bounces, samplers. Errors: an unknown one.
Result<std::vector<Variant>> preset_variants(const std::string& preset, const RenderOptions& base);

} // namespace blush
