#include "ui/viewport/two_piles.h"

#include "ui/snapshots/compare_view.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <array>

namespace blush {

void draw_two_piles(PanelContext& c, const ImageRect& image, const ImageRect& seen) {
    std::array<float, 2>& wipes = c.ui.two_piles;
    const auto on_screen = [&](float u) { return std::clamp(image.x + u * image.width, seen.x, seen.x + seen.width); };
    for (size_t i = 0; i < wipes.size(); ++i)
        if (drag_wipe(c.ui, i == 0 ? "Two piles/Direct" : "Two piles/Indirect", on_screen(wipes[i]), seen)) {
            const float u = float(image.u(ImGui::GetIO().MousePos.x));
            wipes[i] = i == 0 ? std::clamp(u, 0.f, wipes[1]) : std::clamp(u, wipes[0], 1.f);
        }
    const float em = ImGui::GetFontSize(), ends[] = {seen.x, on_screen(wipes[0]), on_screen(wipes[1]), seen.x + seen.width};
    constexpr const char* names[] = {"Direct", "Indirect", "Sum"};
    for (int i = 0; i < 3; ++i) {
        const float room = ends[i + 1] - ends[i] - em;
        const ImVec2 size = label_size(names[i], room);
        if (room > em * 4)
            draw_label(*ImGui::GetWindowDrawList(), names[i], {ends[i] + (ends[i + 1] - ends[i] - size.x) / 2, seen.y + em * 2.6f}, room,
                       tone::text);
    }
}

} // namespace blush
