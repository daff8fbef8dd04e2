#include "app/commands/lesson/lesson_file.h"

#include "core/files.h"
#include "core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace blush {
namespace {

constexpr std::string_view fence = "---";

// These choose files or what is saved; `size` is that of claims and exports.
constexpr const char* refused_settings[] = {"camera", "groups", "region"};

std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <size_t n> bool contains(const std::array<const char*, n>& known, std::string_view word) {
    return std::ranges::any_of(known, [&](const char* k) { return word == k; });
}

template <size_t n> std::string list_of(const std::array<const char*, n>& known) {
    std::string list;
    for (const char* word : known) list += (list.empty() ? "" : ", ") + std::string(word);
    return list;
}

// Takes `word` from the beginning of `text`.
bool take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

// "Lesson/Next", "Roulette/Rule/max": parts with a name each. Only the window knows which widgets there are.
bool is_widget(std::string_view name) {
    if (name.size() > max_highlight || std::ranges::any_of(name, [](unsigned char c) { return c < 0x20 || c == 0x7f; })) return false;
    const std::vector<std::string_view> parts = split(name, '/');
    return parts.size() >= 2 && std::ranges::none_of(parts, [](std::string_view p) { return p.empty() || trimmed(p) != p; });
}

std::optional<std::array<int, 4>> parse_rect(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    std::array<int, 4> rect{};
    if (parts.size() != rect.size()) return {};
    for (size_t i = 0; i < rect.size(); ++i)
        if (!parse_number(trimmed(parts[i]), rect[i])) return {};
    constexpr int most = 65536;
    const auto& [x, y, w, h] = rect;
    if (x < 0 || y < 0 || w < 1 || h < 1 || x > most || y > most || w > most || h > most) return {};
    return rect;
}

constexpr const char* claim_form = "a claim must be \"WORDS\": share of NAME at X,Y,W,H is LOW to HIGH; or luminance at X,Y,W,H, noise "
                                   "with SETTING=VALUE, mean with SETTING=VALUE in place of the share";

std::optional<LessonClaim> parse_claim(std::string_view text) {
    using Quantity = LessonClaim::Quantity;
    LessonClaim claim;
    if (!take(text, "\"")) return {};
    const size_t quote = text.find("\":");
    if (quote == text.npos || quote == 0) return {};
    claim.says = text.substr(0, quote);
    text = trimmed(text.substr(quote + 2));
    const size_t is = text.rfind(" is ");
    if (is == text.npos) return {};
    std::string_view range = trimmed(text.substr(is + 4)), what = trimmed(text.substr(0, is));
    const size_t to = range.find(" to ");
    if (to == range.npos || !parse_number(trimmed(range.substr(0, to)), claim.low) ||
        !parse_number(trimmed(range.substr(to + 4)), claim.high))
        return {};
    if (!std::isfinite(claim.low) || !std::isfinite(claim.high) || !(claim.low < claim.high)) return {};
    const bool noise = take(what, "noise with ");
    if (noise || take(what, "mean with ")) {
        claim.quantity = noise ? Quantity::noise : Quantity::mean;
        const size_t equals = what.find('=');
        if (equals == what.npos) return {};
        claim.setting = trimmed(what.substr(0, equals));
        claim.value = trimmed(what.substr(equals + 1));
        return claim;
    }
    const size_t at = what.rfind("at ");
    const std::optional<std::array<int, 4>> rect = at == what.npos ? std::nullopt : parse_rect(what.substr(at + 3));
    if (!rect) return {};
    claim.rect = *rect;
    what = trimmed(what.substr(0, at));
    if (what == "luminance") {
        claim.quantity = Quantity::luminance;
        return claim;
    }
    if (!take(what, "share of ")) return {};
    claim.name = trimmed(what);
    return claim.name.empty() ? std::nullopt : std::optional(claim);
}

// What of the text does not depend on how its lines are broken.
std::string one_spaced(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool space = c == ' ' || c == '\n' || c == '\t';
        if (!space)
            out += c;
        else if (!out.empty() && out.back() != ' ')
            out += ' ';
    }
    return out;
}

class Parser {
public:
    Parser(std::string_view text, std::string name) : lines_(split(text, '\n')), name_(std::move(name)) {
        for (std::string_view& line : lines_)
            if (line.ends_with('\r')) line.remove_suffix(1);
    }

    Result<Lesson> lesson() {
        while (at_ < lines_.size() && trimmed(lines_[at_]).empty()) ++at_;
        if (at_ == lines_.size() || lines_[at_] != fence) return wrong("a lesson begins with a line ---, then lesson: TITLE");
        Lesson lesson;
        while (at_ < lines_.size())
            if (const Result<void> read = block(lesson); !read) return read.error();
        if (lesson.steps.empty()) return Error{.file = name_, .what = "the lesson has no step"};
        return lesson;
    }

private:
    Error wrong_at(size_t line, const std::string& what) const { return {.file = fmt::format("{}:{}", name_, line + 1), .what = what}; }
    Error wrong(const std::string& what) const { return wrong_at(std::min(at_, lines_.size() - 1), what); }

    // Keys between two fences, and the text up to the next fence.
    Result<void> block(Lesson& lesson) {
        const size_t begun = at_++;
        const bool first = lesson.title.empty();
        if (lesson.steps.size() == max_lesson_steps) return wrong(fmt::format("a lesson has at most {} steps", max_lesson_steps));
        LessonStep step;
        if (!lesson.steps.empty()) carry_over(lesson.steps.back(), step);
        for (; at_ < lines_.size() && lines_[at_] != fence; ++at_) {
            const std::string_view line = lines_[at_];
            if (trimmed(line).empty()) continue;
            const size_t colon = line.find(':');
            if (colon == line.npos) return wrong("a line between --- and --- must be KEY: VALUE");
            const std::string key(trimmed(line.substr(0, colon))), value(trimmed(line.substr(colon + 1)));
            if (value.empty()) return wrong(fmt::format("{} has no value", key));
            const Result<void> read = first ? head(lesson, key, value) : entry(step, key, value);
            if (!read) return read.error();
        }
        if (at_ == lines_.size()) return wrong_at(begun, "a second line --- is missing after these keys");
        ++at_;
        std::string text;
        for (; at_ < lines_.size() && lines_[at_] != fence; ++at_) text += std::string(lines_[at_]) + "\n";
        if (first) {
            if (lesson.title.empty()) return wrong_at(begun, "the lesson has no title: the first key is lesson: TITLE");
            lesson.about = text;
            return {};
        }
        step.text = text;
        lesson.steps.push_back(std::move(step));
        return checked(lesson.steps.back(), begun);
    }

    static void carry_over(const LessonStep& before, LessonStep& step) {
        step.scene = before.scene;
        step.camera = before.camera;
        step.settings = before.settings;
        step.lines = before.lines;
    }

    Result<void> head(Lesson& lesson, const std::string& key, const std::string& value) const {
        if (key != "lesson") return wrong(fmt::format("unknown key \"{}\": the first block has lesson: TITLE alone", key));
        lesson.title = value;
        return {};
    }

    Result<void> entry(LessonStep& step, const std::string& key, const std::string& value) {
        std::string* const texts[] = {&step.title, &step.question, &step.expect, &step.camera, &step.scene};
        constexpr const char* names[] = {"step", "question", "expect", "camera", "scene"};
        for (size_t i = 0; i < std::size(names); ++i) {
            if (key != names[i]) continue;
            *texts[i] = value;
            step.lines[key] = at_;
            if (key == "scene") step.camera.clear(); // a camera of the scene before
            if (key == "scene") step.lines.erase("camera");
            return {};
        }
        if (key == "reset" && value == "settings") return step.settings.clear(), Result<void>();
        if (key == "reset") return wrong("reset can only be settings");
        if (key == "set") return setting(step, value);
        if (key == "open") return panel(step, value);
        if (key == "tool") {
            if (!contains(lesson_tools, value)) return wrong(fmt::format("unknown tool \"{}\": {}", value, list_of(lesson_tools)));
            step.tool = value;
            return {};
        }
        if (key == "highlight") {
            if (!is_widget(value)) return wrong("highlight must be highlight: PANEL/WIDGET, such as Lesson/Next");
            step.highlight = value;
            return {};
        }
        if (key == "claim") return claim(step, value);
        return wrong(
            fmt::format("unknown key \"{}\": step, scene, camera, set, reset, open, tool, highlight, question, expect or claim", key));
    }

    Result<void> setting(LessonStep& step, const std::string& text) {
        const size_t equals = text.find('=');
        if (equals == text.npos) return wrong("set must be set: SETTING=VALUE, as in `blush render --help`");
        const std::string name(trimmed(std::string_view(text).substr(0, equals)));
        step.settings[name] = trimmed(std::string_view(text).substr(equals + 1));
        step.lines[name] = at_;
        if (const Result<RenderOptions> options = options_of_step(step); !options) return wrong(options.error().text());
        return {};
    }

    Result<void> panel(LessonStep& step, const std::string& text) const {
        for (const std::string_view part : split(text, ',')) {
            const std::string name(trimmed(part));
            if (!contains(lesson_panels, name)) return wrong(fmt::format("unknown panel \"{}\": {}", name, list_of(lesson_panels)));
            if (std::ranges::find(step.panels, name) == step.panels.end()) step.panels.push_back(name);
        }
        return {};
    }

    Result<void> claim(LessonStep& step, const std::string& text) const {
        std::optional<LessonClaim> claim = parse_claim(text);
        if (!claim) return wrong(claim_form);
        if (step.claims.size() == max_step_claims) return wrong(fmt::format("a step has at most {} claims", max_step_claims));
        claim->line = at_;
        step.claims.push_back(*std::move(claim));
        return {};
    }

    // What can only be seen when the whole step is read.
    Result<void> checked(const LessonStep& step, size_t begun) const {
        if (step.title.empty()) return wrong_at(begun, "the step has no title: step: TITLE");
        if (step.scene.empty()) return wrong_at(begun, "the first step needs a scene: scene: FILE");
        const std::string text = one_spaced(step.text);
        for (const LessonClaim& claim : step.claims) {
            if (text.find(claim.says) == text.npos)
                return wrong_at(claim.line, fmt::format("the text of the step does not say \"{}\"", claim.says));
            if (claim.setting.empty()) continue;
            if (const auto changed = options_with(step, claim.setting, claim.value); !changed)
                return wrong_at(claim.line, changed.error().text());
        }
        return {};
    }

    std::vector<std::string_view> lines_;
    std::string name_;
    size_t at_ = 0;
};

bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const auto [end, rest] = std::ranges::mismatch(folder, file);
    return end == folder.end();
}

// The file in the folder, symbolic links followed; empty if there is none, or it lies outside.
std::filesystem::path file_in(const std::filesystem::path& folder, const std::filesystem::path& name) {
    std::error_code code;
    const std::filesystem::path base = std::filesystem::canonical(folder, code);
    if (code) return {};
    const std::filesystem::path file = std::filesystem::canonical(folder / name, code);
    if (code || !is_inside(file, base) || !std::filesystem::is_regular_file(file, code)) return {};
    return file;
}

Result<void> find_scene(const std::filesystem::path& lesson, const std::filesystem::path& scenes, LessonStep& step) {
    const std::filesystem::path name = step.scene;
    const Error missing{.file = fmt::format("{}:{}", lesson.string(), step.lines["scene"] + 1),
                        .what = fmt::format("there is no scene \"{}\" in the folder of the lesson or among the shipped ones", step.scene)};
    const bool leads_out = name.is_absolute() || std::ranges::find(name, "..") != name.end();
    if (leads_out || step.scene.find('\0') != std::string::npos) return missing;
    const std::filesystem::path folder = std::filesystem::absolute(lesson).parent_path();
    step.file = file_in(folder, name);
    if (step.file.empty()) step.file = file_in(scenes, name);
    return step.file.empty() ? Result<void>(missing) : Result<void>();
}

} // namespace

Result<RenderOptions> options_of_step(const LessonStep& step) {
    Words words = step.settings;
    int64_t spp = 0;
    const auto given = words.find("spp");
    const bool has_spp = given != words.end();
    if (has_spp) {
        if (!parse_number(given->second, spp) || spp < 1 || spp > (1 << 20))
            return Error{.what = fmt::format("spp must be from 1 to 1048576, not \"{}\"", given->second)};
        words.erase(given);
    }
    for (const char* refused : refused_settings)
        if (words.contains(refused)) return Error{.what = fmt::format("a step cannot set {}", refused)};
    if (const auto env = words.find("env"); env != words.end() && env->second != "none" && !env->second.starts_with("constant="))
        return Error{.what = "env must be none or constant=R,G,B in a lesson"};
    Result<RenderOptions> options = options_of(words, {});
    if (!options) return options.error();
    options->overrides.camera = step.camera;
    options->spp_given = has_spp;
    if (has_spp) options->settings.spp = spp;
    if (const Result<RenderSettings> settings = settings_of(*options); !settings) return settings.error();
    return options;
}

Result<RenderOptions> options_with(const LessonStep& step, const std::string& setting, const std::string& value) {
    // The image of a step is path traced; a claim may compare it with another integrator.
    if (setting == "integrator") {
        const Result<ComparisonIntegrator> integrator = parse_integrator(value);
        if (!integrator) return integrator.error();
        Result<RenderOptions> options = options_of_step(step);
        if (options) options->integrator = *integrator;
        return options;
    }
    LessonStep changed = step;
    changed.settings[setting] = value;
    return options_of_step(changed);
}

Result<Lesson> parse_lesson(std::string_view text, const std::string& name) { return Parser(text, name).lesson(); }

Result<Lesson> read_lesson(const std::filesystem::path& file, const std::filesystem::path& scenes) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_lesson_bytes);
    if (!bytes) return bytes.error();
    Result<Lesson> lesson = parse_lesson({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
    if (!lesson) return lesson;
    lesson->file = file;
    for (LessonStep& step : lesson->steps)
        if (const Result<void> found = find_scene(file, scenes, step); !found) return found.error();
    return lesson;
}

} // namespace blush
