// Resolves URIs in a scene file. Only files in or below the scene's folder are allowed.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

// Decodes %XX; a % without two hexadecimal digits is kept.
std::string percent_decoded(std::string_view uri);

// Keeps the characters that RFC 3986 allows in a path, including slashes; encodes other bytes as %XX.
std::string percent_encoded(std::string_view path);

bool is_data_uri(std::string_view uri);

// The file of a decoded URI, which need not exist. Errors: empty, absolute, has a scheme ("http:", "file:", "C:"), a backslash or
// a NUL, leaves `folder` by ".." or by a symbolic link.
Result<std::filesystem::path> resolve_uri(const std::filesystem::path& folder, const std::string& decoded_uri);

} // namespace blush
