// URIs inside a scene file name only plain files in or below the scene's folder.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

// "%20" and the like decoded; a % that is not followed by two hexadecimal digits stays as it is.
std::string percent_decoded(std::string_view uri);

// What RFC 3986 lets stand in a path stays, slashes too; every other byte becomes %XX.
std::string percent_encoded(std::string_view path);

bool is_data_uri(std::string_view uri);

// The file that a decoded URI means. Errors: empty, absolute, has a scheme ("http:", "file:", "C:"), a backslash or a NUL,
// leaves `folder` by "..", or by a symbolic link. Whether the file exists is not asked.
Result<std::filesystem::path> resolve_uri(const std::filesystem::path& folder, const std::string& decoded_uri);

} // namespace blush
