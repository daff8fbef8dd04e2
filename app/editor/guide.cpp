#include "app/editor/guide.h"

#include "app/common/open_on_desktop.h"
#include "io/gltf/read/uri.h"

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
    if (!open_on_desktop(guide_address(folder, page)))
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
