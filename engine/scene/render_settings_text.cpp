// Text form of render settings on the command line: parsing and printing.
#include "core/text.h"
#include "scene/enum_names.h"
#include "scene/render_settings.h"
#include "scene/reuse_setting.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace blush {
namespace {

constexpr std::array<EnumName<Roulette::Rule>, 10> roulette_words{{
    {Roulette::Rule::automatic, "auto"},
    {Roulette::Rule::off, "off"},
    {Roulette::Rule::max, "max"},
    {Roulette::Rule::luminance, "luminance"},
    {Roulette::Rule::sqrt, "sqrt"},
    {Roulette::Rule::constant, "constant"},
    {Roulette::Rule::adjoint, "adjoint"},
    {Roulette::Rule::efficiency, "efficiency"},
    {Roulette::Rule::splitting, "splitting"},
    {Roulette::Rule::biased_cut, "biased-cut"},
}};
constexpr std::array<EnumName<Strategy>, 3> strategy_words{{
    {Strategy::mis, "mis"},
    {Strategy::light, "light"},
    {Strategy::bsdf, "bsdf"},
}};
constexpr std::array<EnumName<CausticStrategy>, 5> caustic_words{{
    {CausticStrategy::automatic, "auto"},
    {CausticStrategy::off, "off"},
    {CausticStrategy::guiding, "guiding"},
    {CausticStrategy::light_paths, "light-paths"},
    {CausticStrategy::manifold, "manifold"},
}};
constexpr std::array<EnumName<PixelFilter>, 2> filter_words{{
    {PixelFilter::blackman_harris, "blackman-harris"},
    {PixelFilter::box, "box"},
}};
constexpr std::array<EnumName<SamplerType>, 2> sampler_words{{
    {SamplerType::sobol, "sobol"},
    {SamplerType::random, "random"},
}};
constexpr std::array<EnumName<int>, 5> reuse_words{{{reuse_auto, "auto"}, {1, "off"}, {4, "4"}, {8, "8"}, {16, "16"}}};

Result<float> parse_probability(std::string_view text, std::string_view name, bool zero_allowed) {
    float p = 0;
    if (parse_number(text, p) && p >= 0 && p <= 1 && (p > 0 || zero_allowed)) return p;
    const std::string_view range = zero_allowed ? "from 0 to 1" : "above 0 and at most 1";
    return Error{.what = fmt::format("roulette's {} must be a number {}, not \"{}\"", name, range, text)};
}

struct Item {
    std::string_view name, value;
    bool has_value = false;
};

Item split_item(std::string_view text) {
    const size_t equals = text.find('=');
    if (equals == text.npos) return {text, {}, false};
    return {text.substr(0, equals), text.substr(equals + 1), true};
}

// The part before the first comma: the rule, with its parameter if it has one.
Result<void> parse_rule(const Item& item, Roulette& roulette) {
    const Result<Roulette::Rule> rule = enum_from_string(roulette_words, item.name, "roulette rule");
    if (!rule) return rule.error();
    roulette.rule = *rule;
    const bool constant = *rule == Roulette::Rule::constant;
    const bool takes_number = constant || *rule == Roulette::Rule::biased_cut;
    if (takes_number && !item.has_value) return Error{.what = fmt::format("roulette rule {0} needs a number, as in {0}=0.5", item.name)};
    if (!takes_number && item.has_value) return Error{.what = fmt::format("roulette rule {} takes no number", item.name)};
    if (!takes_number) return {};
    const Result<float> number = parse_probability(item.value, item.name, !constant);
    if (!number) return number.error();
    (constant ? roulette.probability : roulette.threshold) = *number;
    return {};
}

Result<void> parse_limit(const Item& item, Roulette& roulette) {
    if (item.name == "start") {
        if (!parse_number(item.value, roulette.start) || roulette.start < 0)
            return Error{.what = fmt::format("roulette's start must be a whole number from 0, not \"{}\"", item.value)};
        return {};
    }
    if (item.name != "floor" && item.name != "cap")
        return Error{.what = fmt::format("unknown roulette parameter \"{}\" (known: start, floor, cap)", item.name)};
    const bool floor = item.name == "floor";
    const Result<float> number = parse_probability(item.value, item.name, floor);
    if (!number) return number.error();
    (floor ? roulette.floor : roulette.cap) = *number;
    return {};
}

} // namespace

Result<Roulette> parse_roulette(std::string_view text) {
    Roulette roulette;
    bool first = true;
    for (const std::string_view part : split(text, ',')) {
        const Item item = split_item(part);
        const Result<void> parsed = first ? parse_rule(item, roulette) : parse_limit(item, roulette);
        if (!parsed) return parsed.error();
        first = false;
    }
    if (roulette.floor > roulette.cap) return Error{.what = "roulette's floor is above its cap"};
    return roulette;
}

std::string to_string(const Roulette& roulette) {
    std::string text(enum_to_string(roulette_words, roulette.rule));
    if (roulette.rule == Roulette::Rule::constant) text += fmt::format("={}", roulette.probability);
    if (roulette.rule == Roulette::Rule::biased_cut) text += fmt::format("={}", roulette.threshold);
    if (roulette.rule != Roulette::Rule::off || roulette.start != Roulette{}.start) text += fmt::format(",start={}", roulette.start);
    if (roulette.floor != Roulette{}.floor) text += fmt::format(",floor={}", roulette.floor);
    if (roulette.cap != Roulette{}.cap) text += fmt::format(",cap={}", roulette.cap);
    return text;
}

Result<MisHeuristic> parse_heuristic(std::string_view text) {
    using Rule = MisHeuristic::Rule;
    const Item item = split_item(text);
    MisHeuristic h;
    if (text == "balance") {
        h.exponent = 1;
        return h;
    }
    if (text == "maximum") {
        h.rule = Rule::maximum;
        return h;
    }
    if (item.name == "power") {
        if (!item.has_value || (parse_number(item.value, h.exponent) && h.exponent >= 1 && h.exponent <= MisHeuristic::max_exponent))
            return h;
        return Error{.what = fmt::format("the exponent of the power heuristic must be a whole number from 1 to {}, not \"{}\"",
                                         MisHeuristic::max_exponent, item.value)};
    }
    if (item.name == "cutoff") {
        h.rule = Rule::cutoff;
        if (!item.has_value || (parse_number(item.value, h.threshold) && h.threshold >= 0 && h.threshold <= 1)) return h;
        return Error{.what = fmt::format("the threshold of the cutoff heuristic must be a number from 0 to 1, not \"{}\"", item.value)};
    }
    return Error{.what = fmt::format("unknown MIS heuristic \"{}\" (known: power=2, balance, cutoff=0.1, maximum)", text)};
}

std::string to_string(const MisHeuristic& heuristic) {
    switch (heuristic.rule) {
    case MisHeuristic::Rule::power: return heuristic.exponent == 1 ? "balance" : fmt::format("power={}", heuristic.exponent);
    case MisHeuristic::Rule::cutoff: return fmt::format("cutoff={}", heuristic.threshold);
    case MisHeuristic::Rule::maximum: return "maximum";
    }
    return {};
}

Result<Clamp> parse_clamp(std::string_view text) {
    if (text == "off") return Clamp{};
    const std::vector<std::string_view> parts = split(text, ',');
    Clamp clamp;
    const bool number = parse_number(parts[0], clamp.limit) && clamp.limit > 0 && std::isfinite(clamp.limit);
    clamp.all = parts.size() == 2 && parts[1] == "all";
    if (!number || parts.size() != (clamp.all ? 2u : 1u))
        return Error{.what = fmt::format("a clamp is written \"off\", X or X,all with X above 0, not \"{}\"", text)};
    return clamp;
}

std::string to_string(const Clamp& clamp) {
    if (clamp.limit <= 0) return "off";
    return fmt::format("{}{}", clamp.limit, clamp.all ? ",all" : "");
}

Result<int> parse_max_bounces(std::string_view text) {
    if (text == "unlimited") return unlimited_bounces;
    int n = 0;
    if (!parse_number(text, n) || n < 0)
        return Error{.what = fmt::format("the number of bounces must be a whole number from 0 or \"unlimited\", not \"{}\"", text)};
    return n;
}

std::string max_bounces_text(int max_bounces) { return max_bounces == unlimited_bounces ? "unlimited" : std::to_string(max_bounces); }

Result<int> parse_reuse(std::string_view text) { return enum_from_string(reuse_words, text, "number of pixels that reuse paths"); }
std::string_view reuse_text(int reuse) { return enum_to_string(reuse_words, reuse); }
Result<Strategy> parse_strategy(std::string_view text) { return enum_from_string(strategy_words, text, "strategy"); }
std::string_view to_string(Strategy strategy) { return enum_to_string(strategy_words, strategy); }
Result<CausticStrategy> parse_caustics(std::string_view text) { return enum_from_string(caustic_words, text, "strategy for caustics"); }
std::string_view to_string(CausticStrategy caustics) { return enum_to_string(caustic_words, caustics); }
Result<PixelFilter> parse_filter(std::string_view text) { return enum_from_string(filter_words, text, "filter"); }
std::string_view to_string(PixelFilter filter) { return enum_to_string(filter_words, filter); }
Result<SamplerType> parse_sampler(std::string_view text) { return enum_from_string(sampler_words, text, "sampler"); }
std::string_view to_string(SamplerType sampler) { return enum_to_string(sampler_words, sampler); }

} // namespace blush
