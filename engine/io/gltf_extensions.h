// What this version makes of each glTF extension.
#pragma once

#include <string_view>
#include <vector>

namespace blush {

struct ExtensionSupport {
    enum class Kind { honoured, approximated, ignored };
    Kind kind = Kind::ignored;
    std::string_view why; // what is approximate, or what the picture lacks
};

// Unknown names are ignored, with a general reason.
ExtensionSupport extension_support(std::string_view name);

// Those that this version has something to say about.
std::vector<std::string_view> known_extensions();

} // namespace blush
