// Text form of view settings on the command line: parsing and printing.
#include "scene/view_settings.h"

#include "core/text.h"
#include "scene/enum_names.h"

#include <cmath>

namespace blush {
namespace {

constexpr std::array<EnumName<AutoExposure>, 3> auto_exposure_words{{
    {AutoExposure::off, "off"},
    {AutoExposure::average, "average"},
    {AutoExposure::highlights, "highlights"},
}};
constexpr std::array<EnumName<FalseColor::Of>, 4> false_color_words{{
    {FalseColor::Of::off, "off"},
    {FalseColor::Of::stops, "stops"},
    {FalseColor::Of::nits, "nits"},
    {FalseColor::Of::lux, "lux"},
}};

bool has_range(FalseColor::Of of) { return of == FalseColor::Of::nits || of == FalseColor::Of::lux; }

bool parse_component(std::string_view text, float& x) { return parse_number(text, x) && x >= 0 && std::isfinite(x); }

} // namespace

Result<AutoExposure> parse_auto_exposure(std::string_view text) { return enum_from_string(auto_exposure_words, text, "auto exposure"); }
std::string_view to_string(AutoExposure rule) { return enum_to_string(auto_exposure_words, rule); }

Result<FalseColor> parse_false_color(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, '=');
    const Result<FalseColor::Of> of = enum_from_string(false_color_words, parts[0], "false colour");
    if (!of) return of.error();
    FalseColor scale{.of = *of};
    if (parts.size() == 1) return scale;
    const std::vector<std::string_view> ends = split(parts[1], ':');
    const bool numbers = parts.size() == 2 && ends.size() == 2 && parse_number(ends[0], scale.low) && parse_number(ends[1], scale.high);
    if (!has_range(*of) || !numbers || !(scale.low > 0 && scale.low < scale.high && std::isfinite(scale.high)))
        return Error{.what = fmt::format("a range is written nits=LOW:HIGH or lux=LOW:HIGH with 0 < LOW < HIGH, not \"{}\"", text)};
    return scale;
}

std::string to_string(const FalseColor& scale) {
    const std::string_view word = enum_to_string(false_color_words, scale.of);
    return has_range(scale.of) ? fmt::format("{}={}:{}", word, scale.low, scale.high) : std::string(word);
}

Result<Vec3> parse_white(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    Vec3 white{0, 0, 0};
    if (parts.size() == 3 && parse_component(parts[0], white.x) && parse_component(parts[1], white.y) &&
        parse_component(parts[2], white.z) && white != Vec3{0, 0, 0})
        return white;
    return Error{.what = fmt::format("a white is written R,G,B with numbers from 0, not all 0, not \"{}\"", text)};
}

} // namespace blush
