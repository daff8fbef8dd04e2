// What an import reports besides the scene.
#pragma once

#include "core/result.h"

#include <string>
#include <vector>

namespace blush {

struct ImportReport {
    std::vector<std::string> extensions_used, extensions_honoured, extensions_approximated, extensions_ignored;
    // Everything in the file that the image will not show, and everything suspicious.
    std::vector<Diagnostic> diagnostics;
    double seconds = 0;
};

} // namespace blush
