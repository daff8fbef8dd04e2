#include "ui/viewport/false_color_legend.h"

#include "core/text.h"
#include "io/image/display_image.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

const char* title_of(FalseColor::Of of) {
    switch (of) {
    case FalseColor::Of::off: return "";
    case FalseColor::Of::stops: return "EV from grey";
    case FalseColor::Of::nits: return "nits";
    case FalseColor::Of::lux: return "lux, if diffuse";
    }
    return "";
}

std::string edge_text(const FalseColor& f, const FalseColorScale& scale, int band) {
    const float edge = false_color_edge(band, scale);
    if (f.of == FalseColor::Of::stops) return signed_number(edge - std::log2(0.18f), 1);
    const float value = std::exp2(edge);
    return value >= 999.5f ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

} // namespace

void draw_false_color_legend(ImDrawList& draw, const ImageRect& image, const ViewSettings& view) {
    const FalseColorScale scale = display_parameters_of(view).false_color;
    if (scale.of == FalseColorScale::Of::off) return;
    const float em = ImGui::GetFontSize();
    const int count = int(false_colors.size());
    const float step = std::floor(std::min(em * 1.3f, (image.height - 4 * em) / float(count)));
    if (step < 2) return;
    const ImVec2 at{image.x + em, image.y + std::floor((image.height - step * float(count)) / 2)};
    const float swatch = em * 1.1f, width = em * 7;
    draw.AddRectFilled({at.x - em * 0.5f, at.y - em * 1.8f}, {at.x + width, at.y + step * float(count) + em * 0.5f},
                       IM_COL32(20, 20, 20, 220), em * 0.2f);
    draw.AddText({at.x, at.y - em * 1.4f}, tone::text, title_of(view.false_color.of));
    const int every = std::max(1, int(std::ceil(em * 1.05f / step))); // labels that would overlap are skipped
    for (int band = 0; band < count; ++band) {
        const Vec3& c = false_colors[size_t(band)];
        const float top = at.y + step * float(count - 1 - band);
        draw.AddRectFilled({at.x, top}, {at.x + swatch, top + step}, ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1}));
        if (band == 0 || (band - 1) % every != 0) continue;
        const float edge = top + step;
        draw.AddLine({at.x + swatch, edge}, {at.x + swatch + em * 0.35f, edge}, tone::dim_text);
        draw.AddText({at.x + swatch + em * 0.6f, edge - em * 0.55f}, tone::text, edge_text(view.false_color, scale, band).c_str());
    }
    draw.AddRect({at.x, at.y}, {at.x + swatch, at.y + step * float(count)}, tone::field_filled);
}

} // namespace blush
