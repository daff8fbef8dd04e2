// The options of `blush render` as words, {"size": "640x360", "camera": "Front"}: how looks are told apart and overridden.
#pragma once

#include "app/commands/render/render_options.h"

#include <filesystem>
#include <map>
#include <string>

namespace blush {

using Words = std::map<std::string, std::string>;

// The options given on the command line that may belong to a look: all of `blush render` but the stop rules, the sample range,
// adaptive sampling and the denoiser.
Words words_given(const CLI::App& command);
// True if a look may set this option.
bool is_look_option(const std::string& name);

// The parser of `blush render`, for words. `folder`: base of a relative environment file. `base`: the settings that no word overrides.
// Errors: an unknown option, its invalid value.
Result<RenderOptions> options_of(const Words& words, const std::filesystem::path& folder,
                                 const RenderSettings& base = recommended_settings());

} // namespace blush
