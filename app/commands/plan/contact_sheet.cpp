#include "app/commands/plan/contact_sheet.h"

#include "app/commands/common.h"
#include "app/commands/render/write_image.h"
#include "core/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr size_t most_tiles = 400;
constexpr int tile_width = 320, gap = 8; // pixels
constexpr float background = 0.12f;
constexpr uint64_t max_png_bytes = uint64_t(1) << 31;

std::string html_text(const std::string& text) {
    std::string safe;
    for (const char c : text) switch (c) {
        case '<': safe += "&lt;"; break;
        case '>': safe += "&gt;"; break;
        case '&': safe += "&amp;"; break;
        case '"': safe += "&quot;"; break;
        default: safe += c;
        }
    return safe;
}

// Display-encoded, at most as wide as a tile.
Result<ImagePtr> small_image(const std::filesystem::path& file) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_png_bytes);
    if (!bytes) return bytes.error();
    const Result<ImageInfo> info = read_image_info(*bytes, file.string());
    if (!info) return info.error();
    int halvings = 0;
    while ((info->width >> halvings) > tile_width) ++halvings;
    return read_smaller_image(*bytes, file.string(), halvings, /*is_srgb*/ true);
}

struct Sheet {
    int width = 0, height = 0;
    std::vector<float> rgb;

    Sheet(int w, int h) : width(w), height(h), rgb(size_t(w) * size_t(h) * 3, background) {}
    void place(const Image& image, int left, int top) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const size_t from =
                        (size_t(y) * size_t(image.width) + size_t(x)) * size_t(image.channels) + size_t(std::min(c, image.channels - 1));
                    rgb[(size_t(top + y) * size_t(width) + size_t(left + x)) * 3 + size_t(c)] = float(image.bytes[from]) / 255;
                }
    }
};

Result<void> write_png_sheet(const std::filesystem::path& file, const std::vector<ImagePtr>& tiles) {
    int cell_width = 1, cell_height = 1;
    for (const ImagePtr& tile : tiles) {
        cell_width = std::max(cell_width, tile->width);
        cell_height = std::max(cell_height, tile->height);
    }
    const int columns = std::max(1, int(std::ceil(std::sqrt(double(tiles.size()))))), rows = (int(tiles.size()) + columns - 1) / columns;
    Sheet sheet(columns * (cell_width + gap) + gap, rows * (cell_height + gap) + gap);
    for (size_t i = 0; i < tiles.size(); ++i)
        sheet.place(*tiles[i], gap + int(i) % columns * (cell_width + gap), gap + int(i) / columns * (cell_height + gap));
    return write_display_image(file, sheet.width, sheet.height, sheet.rgb);
}

// Not if the look has been merged again since, by a round.
bool has_display(const std::filesystem::path& folder, const PlanLook& look) {
    std::error_code code;
    return std::filesystem::exists(display_file(folder, look), code);
}

std::string html_sheet(const std::filesystem::path& folder, const RenderPlan& plan, const std::vector<LookProgress>& progress) {
    std::string html = "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<title>Contact sheet</title>\n"
                       "<style>body{background:#1f1f1f;color:#ddd;font:14px sans-serif}figure{display:inline-block;width:320px;margin:8px;"
                       "vertical-align:top}img{width:320px}figcaption{overflow-wrap:anywhere}small{color:#999}</style>\n";
    for (size_t i = 0; i < plan.looks.size(); ++i) {
        const PlanLook& look = plan.looks[i];
        if (!has_display(folder, look)) continue;
        std::string words;
        for (const auto& [name, value] : look.words) words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name, value);
        html += fmt::format("<figure><a href=\"merged/{0}.exr\"><img src=\"merged/{0}.png\" alt=\"{0}\"></a><figcaption>{0}<br><small>{1} "
                            "of {2} samples, error {3}<br>{4}</small></figcaption></figure>\n",
                            look.name, progress[i].merged_samples, progress[i].planned,
                            progress[i].error.empty() ? "not known" : html_text(progress[i].error), html_text(words));
    }
    return html;
}

} // namespace

Result<void> write_display(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look,
                           const ColorManagement& color) {
    const std::filesystem::path file = merged_file(folder, look);
    const Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    const auto channels = image->find_color();
    if (!channels[0]) return Error{.file = file.string(), .what = "has no colours"};
    std::vector<float> rgb(image->channels.front().values.size() * 3);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < channels[c]->values.size(); ++i) rgb[3 * i + c] = channels[c]->values[i];
    const LayeredImage::Channel* alpha = image->find("A");
    const bool opaque = !alpha || std::ranges::all_of(alpha->values, [](float a) { return a >= 1; });
    const std::span<const float> opacity = opaque ? std::span<const float>() : alpha->values;
    const Result<void> written =
        write_through_view(display_file(folder, look), image->width, image->height, std::move(rgb), color, plan.view, {}, {}, opacity);
    return written ? written : in_file(written.error(), display_file(folder, look).string());
}

Result<void> write_contact_sheet(const std::filesystem::path& folder, const RenderPlan& plan, const std::vector<LookProgress>& progress) {
    std::vector<ImagePtr> tiles;
    for (size_t i = 0; i < plan.looks.size() && tiles.size() < most_tiles; ++i) {
        if (!has_display(folder, plan.looks[i])) continue;
        Result<ImagePtr> tile = small_image(display_file(folder, plan.looks[i]));
        if (!tile) return tile.error();
        tiles.push_back(*std::move(tile));
    }
    if (tiles.empty()) return {};
    if (const Result<void> written = write_png_sheet(folder / "contact-sheet.png", tiles); !written) return written;
    return write_file(folder / "contact-sheet.html", html_sheet(folder, plan, progress));
}

} // namespace blush
