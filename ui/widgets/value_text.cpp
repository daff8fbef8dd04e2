#include "ui/widgets/value_text.h"

#include "core/srgb.h"
#include "core/text.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <fmt/format.h>
#include <fmt/printf.h>

namespace blush {
namespace {

constexpr size_t max_value_length = 128; // characters
constexpr double max_color_value = 1e6;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const size_t first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// Parses the whole text as one number.
std::optional<double> number_of(std::string_view text) {
    if (!text.empty() && text[0] == '+') text.remove_prefix(1);
    double value = 0;
    if (!parse_number(text, value) || !std::isfinite(value)) return {};
    return value;
}

std::optional<int> hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return {};
}

// Hex digits without the #.
std::optional<Vec3> hex_color(std::string_view digits) {
    if (digits.size() != 3 && digits.size() != 6) return {};
    std::array<float, 3> channels{};
    const size_t each = digits.size() / 3;
    for (size_t i = 0; i < 3; ++i) {
        const auto high = hex_digit(digits[i * each]), low = hex_digit(digits[i * each + each - 1]);
        if (!high || !low) return {};
        channels[i] = linear_from_srgb(float(*high * 16 + *low) / 255);
    }
    return Vec3{channels[0], channels[1], channels[2]};
}

bool is_color(const Vec3& c) {
    const auto fits = [](float x) { return x >= 0 && x <= max_color_value; };
    return fits(c.x) && fits(c.y) && fits(c.z);
}

// The bracketed arguments after a function name.
std::optional<std::string_view> after(std::string_view text, std::string_view name) {
    if (!text.starts_with(name)) return {};
    return trimmed(text.substr(name.size()));
}

uint8_t byte_of(float linear) { return uint8_t(std::lround(std::clamp(srgb_from_linear(std::clamp(linear, 0.f, 1.f)), 0.f, 1.f) * 255)); }

} // namespace

std::string number_text(double value) { return fmt::format("{}", float(value) + 0.f); }

const char* number_format(double value) { return std::abs(value) >= 9999.5 && std::abs(value) < 1e7 ? "%.0f" : "%.4g"; }

std::string shown_number(double value) { return fmt::sprintf(number_format(value), value); }

std::string fraction_text(double value) { return value > 0 && value < 1 ? fmt::format("1/{:.4g}", 1 / value) : shown_number(value); }

std::string triple_text(const Vec3& v) { return number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z); }

std::string hex_text(const Vec3& c) { return fmt::format("#{:02x}{:02x}{:02x}", byte_of(c.x), byte_of(c.y), byte_of(c.z)); }

std::string srgb_text(const Vec3& c) {
    return "srgb(" + triple_text({srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)}) + ")";
}

std::optional<double> pasted_number(std::string_view text, std::string_view unit) {
    if (text.size() > max_value_length) return {};
    text = trimmed(text);
    if (!unit.empty() && text.ends_with(unit)) text = trimmed(text.substr(0, text.size() - unit.size()));
    if (const auto value = number_of(text)) return value;
    if (const size_t slash = text.find('/'); slash != std::string_view::npos) {
        const auto above = number_of(trimmed(text.substr(0, slash))), below = number_of(trimmed(text.substr(slash + 1)));
        if (!above || !below || !std::isfinite(*above / *below)) return {};
        return *above / *below;
    }
    std::string pointed(text);
    if (std::ranges::count(pointed, ',') != 1) return {};
    std::ranges::replace(pointed, ',', '.');
    return number_of(pointed);
}

std::optional<Vec3> pasted_triple(std::string_view text) {
    if (text.size() > max_value_length) return {};
    text = trimmed(text);
    for (const std::string_view brackets : {"()", "[]", "{}"})
        if (text.size() > 1 && text.front() == brackets[0] && text.back() == brackets[1]) text = trimmed(text.substr(1, text.size() - 2));
    std::array<float, 3> values{};
    size_t count = 0;
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of(",; \t\r\n"), text.size());
        const auto value = number_of(text.substr(0, end));
        if (!value || count == 3 || std::abs(*value) > FLT_MAX) return {};
        values[count++] = float(*value);
        text = trimmed(text.substr(end));
        const bool separated = !text.empty() && (text[0] == ',' || text[0] == ';');
        if (separated) text = trimmed(text.substr(1));
        if (separated && text.empty()) return {};
    }
    if (count != 3) return {};
    return Vec3{values[0], values[1], values[2]};
}

std::optional<Vec3> pasted_color(std::string_view text) {
    if (text.size() > max_value_length) return {};
    text = trimmed(text);
    if (text.starts_with('#')) return hex_color(text.substr(1));
    std::optional<Vec3> color;
    if (const auto encoded = after(text, "srgb")) {
        color = pasted_triple(*encoded);
        if (color) color = Vec3{linear_from_srgb(color->x), linear_from_srgb(color->y), linear_from_srgb(color->z)};
    } else if (const auto bytes = after(text, "rgb")) {
        color = pasted_triple(*bytes);
        if (color) color = Vec3{linear_from_srgb(color->x / 255), linear_from_srgb(color->y / 255), linear_from_srgb(color->z / 255)};
    } else {
        color = pasted_triple(text);
    }
    return color && is_color(*color) ? color : std::nullopt;
}

std::string shown_of(std::string_view text) {
    constexpr size_t max_shown = 32;
    std::string shown;
    for (const char c : trimmed(text).substr(0, max_shown)) shown += c >= ' ' && c < 127 ? c : '?';
    return text.size() > max_shown ? shown + "..." : shown;
}

} // namespace blush
