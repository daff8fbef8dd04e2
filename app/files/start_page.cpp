#include "app/files/start_page.h"

#include "app/common/output_folder.h"
#include "ui/window/file_listing.h"

#include <algorithm>
#include <array>

namespace blush {
namespace {

// Shown first: global illumination in its plainest form. The others follow by name.
constexpr std::array<std::string_view, 3> first_demos = {"card-and-mug", "cornell", "corridor"};

ptrdiff_t rank(const std::string& file) {
    return std::ranges::find(first_demos, std::filesystem::path(file).stem().string()) - first_demos.begin();
}

} // namespace

std::vector<std::string> StartPage::demos() const {
    std::vector<std::string> files;
    const std::filesystem::path folder = assets_ / "scenes";
    if (const auto listing = list_folder(folder, scene_files))
        for (const FileEntry& entry : listing->entries)
            if (!entry.folder) files.push_back(std::filesystem::absolute(folder / entry.name).string());
    std::ranges::stable_sort(files, {}, rank);
    return files;
}

void StartPage::save_thumbnail(const std::filesystem::path& scene, const FramePtr& frame, const ViewSettings& view,
                               const ColorManagement& color, bool leaving) {
    constexpr int64_t enough_samples = 16;
    if (!frame || frame->width <= 0 || frame->divider != 1 || scene.empty() || is_below(scene, assets_)) return;
    if (!leaving && (kept_ == scene || (frame->samples < enough_samples && !frame->complete))) return;
    kept_ = scene;
    const std::filesystem::path file = thumbnail_file(scene, assets_);
    if (!file.empty() && write_thumbnail(file, *frame, view, color)) thumbnails_.forget(scene.string());
}

} // namespace blush
