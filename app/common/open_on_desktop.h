// Opens files and pages with the desktop's programs.
#pragma once

#include "core/result.h"

#include <string>

namespace blush {

// Opens an address or the name of a file or folder by xdg-open, and does not wait for it. Errors: xdg-open is not installed.
Result<void> open_on_desktop(const std::string& what);

} // namespace blush
