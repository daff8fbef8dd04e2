// Values as text, for the clipboard: numbers, and colours as hex, sRGB or linear triples. Pasted text may be anything.
#pragma once

#include "core/vec.h"

#include <optional>
#include <string>
#include <string_view>

namespace blush {

// The sRGB transfer functions: display-encoded from linear, and back.
float srgb_from_linear(float x);
float linear_from_srgb(float x);

// As short as reads back the same: "0.25".
std::string number_text(double value);
// "0.8, 0.2, 0.05"
std::string triple_text(const Vec3& value);
// "#rrggbb", display-encoded; what lies outside 0 .. 1 is cut.
std::string hex_text(const Vec3& linear);
// "srgb(0.9, 0.5, 0.25)", display-encoded.
std::string srgb_text(const Vec3& linear);

// A finite number, with or without the unit after it; a comma counts as the point. Nothing for any other text.
std::optional<double> pasted_number(std::string_view text, std::string_view unit = {});
// Three finite numbers between commas, semicolons or blanks, in brackets or not.
std::optional<Vec3> pasted_triple(std::string_view text);
// Linear RGB, not negative: "#rgb", "#rrggbb", "srgb(r, g, b)" of 0 .. 1, "rgb(r, g, b)" of 0 .. 255, or a triple, which is linear.
std::optional<Vec3> pasted_color(std::string_view text);

// Of pasted text what a message can show: one line, printable, 32 characters at most.
std::string shown_of(std::string_view text);

} // namespace blush
