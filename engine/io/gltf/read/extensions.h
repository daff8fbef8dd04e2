// Support table of glTF extensions.
#pragma once

#include <string_view>
#include <vector>

namespace blush {

struct ExtensionSupport {
    enum class Kind { honoured, approximated, ignored };
    Kind kind = Kind::ignored;
    std::string_view why; // what is approximated or missing
};

// Unknown extensions are `ignored`, with a generic reason.
ExtensionSupport extension_support(std::string_view name);

// Extensions with an entry in the table.
std::vector<std::string_view> known_extensions();

} // namespace blush
