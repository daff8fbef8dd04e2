// What this version makes of each glTF extension.
#pragma once

#include <string_view>

namespace blush {

struct ExtensionSupport {
    enum class Kind { honoured, approximated, ignored };
    Kind kind = Kind::ignored;
    std::string_view why; // what is approximate, or what the picture lacks
};

// Unknown names are ignored, with a general reason.
ExtensionSupport extension_support(std::string_view name);

} // namespace blush
