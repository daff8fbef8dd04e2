#include "io/project/settings_json.h"

#include "io/project/json_fields.h"
#include "scene/validate.h"

#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <tuple>

namespace blush {
namespace {

// One reader per key: assigns its value, or returns an error.
using Readers = std::map<std::string, std::function<Result<void>(const Json&)>, std::less<>>;

// Assigns a value of a plain type.
template <class T> auto plain(T& target) {
    return [&target](const Json& json) {
        return read_json(json, target) ? Result<void>() : Result<void>(Error{"", "wrong type or out of range", ""});
    };
}

// Assigns the result of a command line parser.
template <class T, class Parse> auto word(T& target, Parse parse) {
    return [&target, parse](const Json& json) -> Result<void> {
        std::string text;
        if (!read_json(json, text)) return Error{"", "not a string", ""};
        Result<T> parsed = parse(text);
        if (!parsed) return parsed.error();
        target = *std::move(parsed);
        return {};
    };
}

// Passes on an array of a fixed number of numbers.
template <size_t n, class Take> auto numbers(Take take) {
    return [take](const Json& json) -> Result<void> {
        std::array<float, n> values{};
        bool good = json.is_array() && json.size() == n;
        for (size_t i = 0; good && i < n; ++i) good = read_json(json[i], values[i]);
        if (!good) return Error{"", fmt::format("not {} numbers", n), ""};
        take(values);
        return {};
    };
}

Result<void> read_meters(const Json& json, std::vector<LightMeter>& meters) {
    meters.clear();
    if (!json.is_array() || json.size() > max_light_meters)
        return Error{"", fmt::format("not a list of at most {} meters", max_light_meters), ""};
    for (const Json& item : json) {
        LightMeter m;
        const auto vector = [&](const char* key, Vec3& v) {
            return numbers<3>([&v](const auto& n) { v = {n[0], n[1], n[2]}; })(item.value(key, Json()));
        };
        const bool good = item.is_object() && read_json(item.value("name", Json()), m.name) &&
                          read_json(item.value("node", Json()), m.node.value) && vector("position", m.position) &&
                          vector("normal", m.normal) && read_json(item.value("clearance", Json()), m.clearance);
        if (!good) return Error{"", "a meter has a name, a node, a position, a normal and a clearance", ""};
        meters.push_back(std::move(m));
    }
    return {};
}

// "1280x720".
Result<std::pair<int, int>> parse_size(std::string_view text) {
    int width = 0, height = 0;
    const char* end = text.data() + text.size();
    const auto [x, first] = std::from_chars(text.data(), end, width);
    if (first != std::errc() || x == end || *x != 'x') return Error{"", "a size is written WxH", ""};
    const auto [rest, second] = std::from_chars(x + 1, end, height);
    if (second != std::errc() || rest != end) return Error{"", "a size is written WxH", ""};
    return std::pair(width, height);
}

Result<int> parse_bounces(const Json& json) {
    if (json.is_string()) return parse_max_bounces(json.get_ref<const std::string&>());
    int bounces = 0;
    if (read_json(json, bounces) && bounces >= 0) return bounces;
    return Error{"", "neither a number from 0 nor \"unlimited\"", ""};
}

template <class T> Result<ParsedSettings<T>> parse(std::string_view text, ParsedSettings<T>&& parsed, const Readers& readers) {
    const Result<Json> json = parse_json_object(text);
    if (!json) return json.error();
    for (const auto& [key, value] : json->items()) {
        const auto reader = readers.find(key);
        if (reader == readers.end()) {
            parsed.diagnostics.push_back({Diagnostic::Severity::warning, "unknown setting", key.substr(0, 100)});
        } else if (const auto ok = reader->second(value); !ok) {
            return Error{"", ok.error().what, key};
        }
    }
    if (const auto ok = validate(parsed.settings); !ok) return ok.error();
    return std::move(parsed);
}

} // namespace

std::string render_settings_json(const RenderSettings& s) {
    Json json;
    json["size"] = fmt::format("{}x{}", s.width, s.height);
    json["resolution_scale"] = s.resolution_scale;
    json["spp"] = s.spp;
    json["time"] = s.seconds;
    json["error"] = s.error;
    json["first_sample"] = s.first_sample;
    json["seed"] = s.seed;
    json["max_bounces"] = max_bounces_text(s.max_bounces);
    json["roulette"] = to_string(s.roulette);
    json["strategy"] = to_string(s.strategy);
    json["heuristic"] = to_string(s.heuristic);
    json["caustics"] = to_string(s.caustics);
    json["filter"] = to_string(s.filter);
    json["sampler"] = to_string(s.sampler);
    json["energy_compensation"] = s.energy_compensation;
    json["mis_compensation"] = s.mis_compensation;
    json["adaptive"] = s.adaptive;
    json["reuse"] = reuse_text(s.reuse);
    json["smooth_edges"] = s.smooth_edges;
    json["clamp"] = to_string(s.clamp);
    json["region"] = {s.region.x, s.region.y, s.region.width, s.region.height};
    return json_text(json);
}

std::string view_settings_json(const ViewSettings& s) {
    Json json;
    json["exposure"] = s.exposure_ev;
    json["gamma"] = s.gamma;
    json["display"] = s.display;
    json["view"] = s.view;
    json["look"] = s.look;
    json["auto_exposure"] = to_string(s.auto_exposure);
    json["white"] = {s.white.x, s.white.y, s.white.z};
    json["false_color"] = to_string(s.false_color);
    json["background_as_it_is"] = s.background_as_it_is;
    for (const LightMeter& m : s.meters)
        json["meters"].push_back({{"name", m.name},
                                  {"node", m.node.value},
                                  {"position", {m.position.x, m.position.y, m.position.z}},
                                  {"normal", {m.normal.x, m.normal.y, m.normal.z}},
                                  {"clearance", m.clearance}});
    if (s.frame_aspect) json["frame_aspect"] = *s.frame_aspect;
    if (s.lock_camera) json["lock_camera"] = true;
    if (s.measured) json["measured"] = {s.measured->x, s.measured->y, s.measured->width, s.measured->height};
    return json_text(json);
}

Result<ParsedSettings<RenderSettings>> parse_render_settings(std::string_view text, const RenderSettings& defaults) {
    ParsedSettings<RenderSettings> parsed{defaults, {}};
    RenderSettings& s = parsed.settings;
    std::pair<int, int> size(s.width, s.height);
    const Readers readers{
        {"size",
         [&](const Json& json) {
             const auto ok = word(size, parse_size)(json);
             std::tie(s.width, s.height) = size;
             return ok;
         }},
        {"resolution_scale", plain(s.resolution_scale)},
        {"spp", plain(s.spp)},
        {"time", plain(s.seconds)},
        {"error", plain(s.error)},
        {"first_sample", plain(s.first_sample)},
        {"seed", plain(s.seed)},
        {"max_bounces",
         [&](const Json& json) -> Result<void> {
             const Result<int> bounces = parse_bounces(json);
             if (!bounces) return bounces.error();
             s.max_bounces = *bounces;
             return {};
         }},
        {"roulette", word(s.roulette, parse_roulette)},
        {"strategy", word(s.strategy, parse_strategy)},
        {"heuristic", word(s.heuristic, parse_heuristic)},
        {"caustics", word(s.caustics, parse_caustics)},
        {"filter", word(s.filter, parse_filter)},
        {"sampler", word(s.sampler, parse_sampler)},
        {"energy_compensation", plain(s.energy_compensation)},
        {"mis_compensation", plain(s.mis_compensation)},
        {"adaptive", plain(s.adaptive)},
        {"reuse", word(s.reuse, parse_reuse)},
        {"smooth_edges", plain(s.smooth_edges)},
        {"clamp", word(s.clamp, parse_clamp)},
        {"region", numbers<4>([&s](const auto& n) {
             s.region = {n[0], n[1], n[2], n[3]};
         })},
    };
    return parse(text, std::move(parsed), readers);
}

Result<ParsedSettings<ViewSettings>> parse_view_settings(std::string_view text, const ViewSettings& defaults) {
    ParsedSettings<ViewSettings> parsed{defaults, {}};
    ViewSettings& s = parsed.settings;
    const Readers readers{
        {"exposure", plain(s.exposure_ev)},
        {"gamma", plain(s.gamma)},
        {"display", plain(s.display)},
        {"view", plain(s.view)},
        {"look", plain(s.look)},
        {"auto_exposure", word(s.auto_exposure, parse_auto_exposure)},
        {"white", numbers<3>([&s](const auto& n) {
             s.white = {n[0], n[1], n[2]};
         })},
        {"false_color", word(s.false_color, parse_false_color)},
        {"background_as_it_is", plain(s.background_as_it_is)},
        {"meters", [&s](const Json& json) { return read_meters(json, s.meters); }},
        {"frame_aspect",
         [&s](const Json& json) {
             float aspect = 0;
             const Result<void> ok = plain(aspect)(json);
             if (ok) s.frame_aspect = aspect;
             return ok;
         }},
        {"lock_camera", plain(s.lock_camera)},
        {"measured", numbers<4>([&s](const auto& n) {
             s.measured = {n[0], n[1], n[2], n[3]};
         })},
    };
    return parse(text, std::move(parsed), readers);
}

} // namespace blush
