#include "app/commands/plan/looks.h"

#include "app/commands/common.h"
#include "core/files.h"
#include "core/text.h"
#include "io/project/json_fields.h"
#include "scene/affine.h"
#include "scene/animation/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr uint64_t max_looks_bytes = uint64_t(64) << 20;
constexpr int64_t max_looks = 100000;

Error wrong_look(const std::string& where, const std::string& what) { return Error{.what = what, .where = where}; }

// A setting in the words of the command line.
std::optional<std::string> word_of(const Json& json) {
    if (json.is_string()) return json.get<std::string>();
    if (json.is_boolean()) return json.get<bool>() ? "on" : "off";
    if (json.is_number()) return json.dump();
    return {};
}

// Files become absolute here: the folder of looks.json is their base, that of the shell that of the command line.
Result<void> add_word(const std::string& name, const Json& json, const std::filesystem::path& folder, const std::string& where,
                      Words& words) {
    const std::optional<std::string> word = word_of(json);
    if (!word) return wrong_look(where, "neither a text nor a number nor true or false");
    const Result<RenderOptions> options = options_of({{name, *word}}, folder);
    if (!options) return wrong_look(where, options.error().text());
    words[name] = *word;
    const auto& environment = options->overrides.environment;
    if (environment && !environment->file.empty() && !word->starts_with('/')) words[name] = (folder / *word).string();
    return {};
}

Result<Axis> looks_in(const Json& json, const std::filesystem::path& folder) {
    Axis axis;
    if (!json.is_array() || json.empty() || json.size() > size_t(max_looks)) return wrong_look("looks", "not a list of looks");
    for (const Json& item : json) {
        const std::string where = fmt::format("looks[{}]", axis.size());
        if (!item.is_object()) return wrong_look(where, "not an object");
        Variation look{.label = fmt::format("look{}", axis.size())};
        for (const auto& [key, value] : item.items()) {
            if (key == "name") {
                if (!read_json(value, look.label) || look.label.empty()) return wrong_look(where + ".name", "not a name");
            } else if (key == "set" && value.is_object()) {
                for (const auto& [name, word] : value.items())
                    if (const Result<void> added = add_word(name, word, folder, where + ".set." + name, look.words); !added)
                        return added.error();
            } else if (key == "edits" && value.is_object()) {
                look.edits = json_text(value);
            } else {
                return wrong_look(where + "." + key, "must be name, set or edits");
            }
        }
        axis.push_back(std::move(look));
    }
    return axis;
}

Result<std::vector<Axis>> matrix_in(const Json& json, const std::filesystem::path& folder) {
    std::vector<Axis> axes;
    if (!json.is_object()) return wrong_look("matrix", "not an object");
    for (const auto& [name, values] : json.items()) {
        Axis axis;
        if (!values.is_array() || values.empty() || values.size() > size_t(max_looks))
            return wrong_look("matrix." + name, "not a list of values");
        for (const Json& value : values) {
            Variation variation;
            const std::string where = fmt::format("matrix.{}[{}]", name, axis.size());
            if (const Result<void> added = add_word(name, value, folder, where, variation.words); !added) return added.error();
            variation.label = *word_of(value);
            axis.push_back(std::move(variation));
        }
        axes.push_back(std::move(axis));
    }
    return axes;
}

std::vector<std::string> camera_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const auto& [id, node] : scene.nodes) {
        if (!node.camera || !is_in_chosen_scene(scene, id)) continue;
        const Camera* camera = scene.cameras.find(node.camera);
        names.push_back(node.name.empty() && camera ? camera->name : node.name);
    }
    return names;
}

// `text` chooses among these by name or index; the option's value is the index.
Result<Axis> chosen_axis(const std::vector<std::string>& names, std::string_view text, const char* option, const char* kind) {
    Axis axis;
    const auto add = [&](size_t index) {
        const std::string label = names[index].empty() ? fmt::format("{}{}", kind, index) : names[index];
        axis.push_back({.label = label, .words = {{option, std::to_string(index)}}});
    };
    if (names.empty()) return Error{.what = fmt::format("the scene has no {}", kind)};
    if (text == "all") {
        for (size_t i = 0; i < names.size(); ++i) add(i);
        return axis;
    }
    for (const std::string_view wanted : split(text, ',')) {
        size_t index = size_t(std::ranges::find(names, wanted) - names.begin());
        if (index == names.size() && !parse_number(wanted, index)) index = names.size();
        if (index >= names.size()) return Error{.what = fmt::format("there is no {} \"{}\"", kind, wanted)};
        add(index);
    }
    return axis;
}

} // namespace

Result<std::vector<Axis>> read_looks(const std::filesystem::path& file) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_looks_bytes);
    if (!bytes) return bytes.error();
    const Result<Json> json = parse_json_object(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    if (!json) return in_file(json.error(), file.string());
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    std::vector<Axis> axes;
    for (const auto& [key, value] : json->items()) {
        if (key == "looks") {
            Result<Axis> axis = looks_in(value, folder);
            if (!axis) return in_file(axis.error(), file.string());
            axes.insert(axes.begin(), *std::move(axis));
        } else if (key == "matrix") {
            Result<std::vector<Axis>> more = matrix_in(value, folder);
            if (!more) return in_file(more.error(), file.string());
            axes.insert(axes.end(), more->begin(), more->end());
        } else {
            return Error{.file = file.string(), .what = "must be looks or matrix", .where = key};
        }
    }
    return axes;
}

Result<Axis> camera_axis(const Scene& scene, std::string_view text) { return chosen_axis(camera_names(scene), text, "camera", "camera"); }

Result<Axis> variant_axis(const Scene& scene, std::string_view text) {
    return chosen_axis(scene.variants, text, "material-variant", "variant");
}

Result<Axis> frame_axis(std::string_view text, double frames_per_second, const Words& words) {
    const std::vector<std::string_view> parts = split(text, ':');
    int64_t first = 0, last = 0, step = 1;
    const bool numbers = (parts.size() == 2 || parts.size() == 3) && parse_number(parts[0], first) && parse_number(parts[1], last) &&
                         (parts.size() == 2 || parse_number(parts[2], step));
    if (!numbers || first < 0 || last < first || step < 1)
        return Error{.what = fmt::format("frames must be A:B or A:B:STEP with 0 <= A <= B, not \"{}\"", text)};
    if ((last - first) / step >= max_looks) return Error{.what = fmt::format("\"{}\" are more than {} frames", text, max_looks)};
    Axis axis;
    for (int64_t frame = first; frame <= last; frame += step) {
        Variation variation{.label = fmt::format("{:04}", frame), .is_frame = true};
        variation.words["animation-time"] = fmt::format("{}", float(double(frame) / frames_per_second));
        if (!words.contains("animation")) variation.words["animation"] = "0";
        axis.push_back(std::move(variation));
        if (last - frame < step) break; // the next one might not be a number any more
    }
    return axis;
}

Axis turntable_axis(int64_t steps) {
    Axis axis;
    for (int64_t i = 0; i < steps; ++i)
        axis.push_back({.label = fmt::format("{:04}", i), .turn = 360.0 * double(i) / double(steps), .is_frame = true});
    return axis;
}

Result<std::vector<LookRequest>> combinations(const std::string& stem, const Words& base, const std::vector<Axis>& axes) {
    int64_t count = 1;
    for (const Axis& axis : axes)
        if (count *= int64_t(axis.size()); count > max_looks) return Error{.what = fmt::format("these are more than {} looks", max_looks)};
    std::vector<LookRequest> looks{{.name = stem, .sequence = {}, .words = base, .edits = {}, .turn = {}}};
    for (const Axis& axis : axes) {
        std::vector<LookRequest> more;
        for (const LookRequest& before : looks)
            for (const Variation& variation : axis) {
                LookRequest look = before;
                if (variation.is_frame) look.sequence = look.name;
                look.name += (variation.is_frame ? "." : "-") + variation.label;
                for (const auto& [name, value] : variation.words) look.words[name] = value;
                if (!variation.edits.empty()) look.edits.push_back(variation.edits);
                if (variation.turn) look.turn = variation.turn;
                more.push_back(std::move(look));
            }
        looks = std::move(more);
    }
    return looks;
}

std::string name_of_look(const std::string& text) {
    constexpr size_t longest = 150; // leaves room for a number that makes it unique
    std::string name = text.substr(0, longest);
    for (char& c : name)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_')) c = '-';
    if (name.empty() || name.front() == '.' || name.front() == '-') name.insert(0, "look");
    return name;
}

View turned(const View& view, const Bounds& scene, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    const Affined turn = to_affine(Quat{0, float(std::sin(half)), 0, float(std::cos(half))});
    const Vec3d center = scene.empty ? Vec3d{0, 0, 0} : scene.center();
    const Affined rotation = turn * to_affine(view.rotation);
    View result = view;
    result.position = to_float(center + transform_vector(turn, to_double(view.position) - center));
    result.rotation = to_quat(rotation);
    return result;
}

} // namespace blush
