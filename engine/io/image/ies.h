// Parser of IES photometric files: ANSI/IES LM-63 of 1986, 1991, 1995 and 2002, types B and C.
#pragma once

#include "core/result.h"
#include "scene/lights/ies_profile.h"

#include <filesystem>
#include <string_view>

namespace blush {

// Candela values are those of the file times the multiplier, the ballast factor, the ballast-lamp photometric factor (before
// 1995; later standards use the number differently), and the tilt factor at angle 0. Symmetries are unfolded. Tilt, dimensions
// and input watts are read but not used.
// Errors, with the line: not LM-63, type A, tilt in another file, a missing or non-finite number, negative candela or factors,
// invalid counts or angles, more than 2^20 values, all candela zero.
Result<IesPtr> parse_ies(std::string_view text);
// Reads a file. Errors: also those of read_file.
Result<IesPtr> read_ies(const std::filesystem::path& file);

} // namespace blush
