// Render and view settings as JSON, with the names and values of the command line. Used in EXR metadata and by `blush converge`.
#pragma once

#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace blush {

// {"size": "1280x720", "resolution_scale": 1.0, "spp": 64, "time": 0.0, "error": 0.0, "first_sample": 0, "seed": 0,
//  "max_bounces": "unlimited", "roulette": "sqrt,start=3", "strategy": "mis", "heuristic": "power=2", "caustics": "auto",
//  "filter": "blackman-harris", "sampler": "sobol", "energy_compensation": false, "mis_compensation": true, "adaptive": false, "reuse":
//  "off", "smooth_edges": true, "clamp": "off", "region": [0.0, 0.0, 1.0, 1.0]}
std::string render_settings_json(const RenderSettings& settings);
// {"exposure": 0.0, "gamma": 1.0, "display": "", "view": "", "look": "", "auto_exposure": "off", "white": [1.0, 1.0, 1.0],
//  "false_color": "nits=1:1000", "background_as_it_is": false,
//  "meters": [{"name": "", "node": 7, "position": [x, y, z], "normal": [x, y, z], "clearance": 0.001}], "measured": [x, y, width, height]},
// the last two if there are any
std::string view_settings_json(const ViewSettings& settings);

template <class T> struct ParsedSettings {
    T settings;
    std::vector<Diagnostic> diagnostics; // unknown keys
};

// Absent keys keep their value in `defaults`. max_bounces may also be a number.
// Errors: not a JSON object, a value of the wrong type or out of range (validate.h).
Result<ParsedSettings<RenderSettings>> parse_render_settings(std::string_view json, const RenderSettings& defaults = {});
Result<ParsedSettings<ViewSettings>> parse_view_settings(std::string_view json, const ViewSettings& defaults = {});

} // namespace blush
