// Which images a plan renders: every combination of looks.json, cameras, variants, frames or turntable steps, for each scene.
#pragma once

#include "app/commands/plan/look_words.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace blush {

// One value of one axis of the combinations, a camera for example.
struct Variation {
    std::string label; // part of the look's name
    Words words = {};
    std::string edits = {};          // scene_edits_json.h; empty: none
    std::optional<double> turn = {}; // of the camera about the scene's centre, degrees
    bool is_frame = false;           // the label numbers a frame of a sequence
};
using Axis = std::vector<Variation>;

// looks.json: {"looks": [{"name": "warm", "set": {"env": "warm.hdr"}, "edits": {...}}], "matrix": {"light": ["studio", "sky"]}}. Both
// parts may be missing. `looks` is one axis, each entry of `matrix` is another. Relative files are based on the file's folder.
// Errors: unreadable, an unknown key or setting, a value that is no text, number or switch.
Result<std::vector<Axis>> read_looks(const std::filesystem::path& file);

// "all", or names or indices from 0, separated by commas. Errors: none such; the scene has none.
Result<Axis> camera_axis(const Scene& scene, std::string_view text);
Result<Axis> variant_axis(const Scene& scene, std::string_view text);
// "A:B" or "A:B:STEP": frames from A to B, both included, of the animation `words` choose, or of the first. Errors: not like that,
// more than 100,000 frames.
Result<Axis> frame_axis(std::string_view text, double frames_per_second, const Words& words);
// Views from a full circle in `steps` steps.
Axis turntable_axis(int64_t steps);

// A look before its scene is edited.
struct LookRequest {
    std::string name, sequence;
    Words words;
    std::vector<std::string> edits;
    std::optional<double> turn;
};
// One value of each axis after the other; later words override earlier ones, and all override `base`. Names begin with `stem`.
// Errors: more than 100,000 looks.
Result<std::vector<LookRequest>> combinations(const std::string& stem, const Words& base, const std::vector<Axis>& axes);

// Letters, digits, '.', '_' and '-'; others become '-'. Never empty.
std::string name_of_look(const std::string& text);

// The view turned by `degrees` about the vertical through the centre of the scene.
View turned(const View& view, const Bounds& scene, double degrees);

} // namespace blush
