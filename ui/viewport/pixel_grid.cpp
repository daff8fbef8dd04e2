#include "ui/viewport/pixel_grid.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr float room_for_lines = 8; // screen pixels per image pixel
constexpr ImU32 line_tone = IM_COL32(128, 128, 128, 70);
constexpr ImU32 text_tones[] = {IM_COL32(255, 130, 120, 255), IM_COL32(140, 230, 120, 255), IM_COL32(140, 180, 255, 255)};

// The pixels first .. last - 1 of `count`, each `size` wide from `origin`, that are visible in a range of the screen.
struct Span {
    int first, last;
};
Span seen(float origin, float size, int count, float from, float length) {
    return {std::clamp(int(std::floor((from - origin) / size)), 0, count),
            std::clamp(int(std::ceil((from + length - origin) / size)), 0, count)};
}

void draw_values(ImDrawList& draw, const ImVec2& at, float height, const float* rgb) {
    for (int k = 0; k < 3; ++k) {
        const std::string text = fmt::format("{:.3g}", rgb[k]);
        const ImVec2 place{at.x, at.y + float(k) * height};
        draw.AddText({place.x + 1, place.y + 1}, IM_COL32(0, 0, 0, 200), text.c_str());
        draw.AddText(place, text_tones[k], text.c_str());
    }
}

} // namespace

void draw_pixel_grid(ImDrawList& draw, const ImageRect& image, const Region& region, const Frame& frame) {
    const float width = image.width / float(frame.width), height = image.height / float(frame.height);
    if (width < room_for_lines || frame.divider > 1) return; // the pixels of a coarse preview are not those of the full image
    const Span columns = seen(image.x, width, frame.width, region.x, region.width),
               rows = seen(image.y, height, frame.height, region.y, region.height);
    const float top = std::max(image.y, region.y), bottom = std::min(image.y + image.height, region.y + region.height);
    const float left = std::max(image.x, region.x), right = std::min(image.x + image.width, region.x + region.width);
    for (int x = columns.first; x <= columns.last; ++x) {
        const float at = std::round(image.x + float(x) * width);
        draw.AddLine({at, top}, {at, bottom}, line_tone);
    }
    for (int y = rows.first; y <= rows.last; ++y) {
        const float at = std::round(image.y + float(y) * height);
        draw.AddLine({left, at}, {right, at}, line_tone);
    }
    const float em = ImGui::GetFontSize();
    if (width < 4.2f * em || height < 3.4f * em) return;
    for (int y = rows.first; y < rows.last; ++y)
        for (int x = columns.first; x < columns.last; ++x) {
            const ImVec2 at{image.x + float(x) * width + em * 0.3f, image.y + float(y) * height + (height - 3.1f * em) / 2};
            draw_values(draw, at, em, &frame.rgba[4 * (size_t(y) * size_t(frame.width) + size_t(x))]);
        }
}

} // namespace blush
