// Formats and parses values for the clipboard: numbers, and colours as hex, sRGB or linear triples. Pasted text is untrusted.
#pragma once

#include "core/vec.h"

#include <optional>
#include <string>
#include <string_view>

namespace blush {

// The shortest text that parses to the same number: "0.25".
std::string number_text(double value);
// "0.8, 0.2, 0.05"
std::string triple_text(const Vec3& value);
// "#rrggbb", display-encoded; clamped to 0 .. 1.
std::string hex_text(const Vec3& linear);
// "srgb(0.9, 0.5, 0.25)", display-encoded.
std::string srgb_text(const Vec3& linear);

// Four digits, and whole numbers up to ten million: "0.25", "100000", "1.5e+07".
std::string shown_number(double value);
// The same for printf.
const char* number_format(double value);
// "1/125" below 1, with four digits.
std::string fraction_text(double value);

// Parses a finite number or a fraction, "1/125", optionally followed by the unit; accepts a decimal comma. nullopt for other text.
std::optional<double> pasted_number(std::string_view text, std::string_view unit = {});
// Parses three finite numbers, separated by commas, semicolons or blanks, optionally in brackets.
std::optional<Vec3> pasted_triple(std::string_view text);
// Parses non-negative linear RGB: "#rgb", "#rrggbb", "srgb(r, g, b)" with 0 .. 1, "rgb(r, g, b)" with 0 .. 255, or a triple,
// which is linear.
std::optional<Vec3> pasted_color(std::string_view text);

// Pasted text for a message: one line, printable, at most 32 characters.
std::string shown_of(std::string_view text);

} // namespace blush
