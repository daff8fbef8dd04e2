// Photometric data files: ANSI/IES LM-63 of 1986, 1991, 1995 and 2002, types B and C.
#pragma once

#include "core/result.h"
#include "scene/ies_profile.h"

#include <filesystem>
#include <string_view>

namespace blush {

// Candela are those of the luminaire: as written, times the multiplier, the ballast factor and, before 1995, the ballast-lamp photometric
// factor (later files keep another use for that number), and the lamp's factor for no tilt. Symmetries are unfolded. The lamp's tilt, its
// size and what it draws are read and not used.
//
// Errors, with the line: no such file, not LM-63, type A, tilt in another file, a number missing or not finite, negative candela or factors,
// counts or angles that make no sense, more than 2^20 values, a luminaire that is dark all over.
Result<IesPtr> parse_ies(std::string_view text);
// The same of a file; also what read_file refuses.
Result<IesPtr> read_ies(const std::filesystem::path& file);

} // namespace blush
