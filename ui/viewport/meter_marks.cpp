#include "ui/viewport/meter_marks.h"

#include "ui/viewport/viewport_marks.h"
#include "ui/widgets/elided_text.h"
#include "ui/window/theme.h"

#include <algorithm>

namespace blush {

void draw_meters(ImDrawList& draw, const ImageRect& image, const Projection& projection, const Scene& scene, const ViewSettings& view,
                 const MetersView& meters) {
    const float em = ImGui::GetFontSize();
    const std::vector<MeterPlace> places = places_of(scene, view.meters);
    for (size_t i = 0; i < view.meters.size(); ++i) {
        const auto at = projection.project(places[i].position);
        if (!at) continue;
        const ScreenPoint p = image.at(*at);
        draw.AddCircle({p.x, p.y}, em * 0.42f, IM_COL32(0, 0, 0, 200), 0, em * 0.25f);
        draw.AddCircle({p.x, p.y}, em * 0.42f, tone::text, 0, em * 0.12f);
        draw.AddCircleFilled({p.x, p.y}, em * 0.12f, tone::text);
        const bool read = i < meters.state.output.size();
        const std::string text =
            elided(view.meters[i].name, max_name_width()) + "  " + (read ? reading_text(meters.state.output[i]) : "...");
        // On the side where it has room.
        const float gap = em * 0.6f, right = draw.GetClipRectMax().x - p.x - gap, left = p.x - gap - draw.GetClipRectMin().x;
        const bool on_the_right = right >= left || label_size(text, em * 30).x <= right;
        const float room = std::min(em * 30, on_the_right ? right : left);
        const ImVec2 size = label_size(text, room);
        draw_label(draw, text, {on_the_right ? p.x + gap : p.x - gap - size.x, p.y - size.y / 2}, room, tone::text);
    }
}

} // namespace blush
