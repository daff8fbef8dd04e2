#include "app/common/open_on_desktop.h"

#include "app/common/run_program.h"

namespace blush {

Result<void> open_on_desktop(const std::string& what) {
    // The shell starts xdg-open in the background and ends, so that it can be waited for: no zombie is left, and the window does not
    // wait.
    const std::optional<int> code =
        run_program({"/bin/sh", "-c", "command -v xdg-open >/dev/null || exit 127; xdg-open \"$1\" >/dev/null 2>&1 &", "sh", what});
    if (code != 0) return Error{.file = what, .what = "cannot be opened: xdg-open is not installed"};
    return {};
}

} // namespace blush
