#include "app/editor/guide.h"

#include "io/gltf/read/uri.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace blush {
std::string guide_address(const std::filesystem::path& folder, std::string_view page) {
    const size_t hash = page.find('#');
    const std::string_view file = page.substr(0, hash), anchor = hash == std::string_view::npos ? std::string_view() : page.substr(hash);
    return "file://" + percent_encoded((std::filesystem::absolute(folder) / file).string()) + std::string(anchor);
}

Result<void> open_guide(const std::filesystem::path& folder, std::string_view page) {
    const std::filesystem::path file = folder / page.substr(0, page.find('#'));
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return Error{file.string(), "this page of the guide is not installed", ""};
    // The shell starts the browser in the background and ends, so that it can be waited for: no zombie is left, and the window does not
    // wait.
    const std::string address = guide_address(folder, page);
    const std::array<const char*, 6> arguments{
        "sh", "-c", "command -v xdg-open >/dev/null || exit 127; xdg-open \"$1\" >/dev/null 2>&1 &", "sh", address.c_str(), nullptr};
    pid_t shell = 0;
    int status = 0;
    const int failed = posix_spawn(&shell, "/bin/sh", nullptr, nullptr, const_cast<char* const*>(arguments.data()), environ);
    if (failed != 0) return Error{"/bin/sh", "cannot be started to open the guide", std::string(strerror(failed))};
    while (waitpid(shell, &status, 0) < 0 && errno == EINTR) {}
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return Error{file.string(), "cannot be opened: xdg-open is not installed. Open the file in a browser", ""};
    return {};
}

void open_requested_page(UiState& ui, const std::filesystem::path& folder) {
    const std::optional<std::string> page = std::exchange(ui.guide_page, std::nullopt);
    if (!page) return;
    if (const Result<void> opened = open_guide(folder, *page); opened)
        ui.toasts.note("The guide opens in the browser");
    else
        ui.toasts.fail("The guide cannot be opened", opened.error().text());
}

} // namespace blush
