#include "ui/views/bounces_view.h"

#include <algorithm>

namespace blush {

std::vector<float> gains_of(const BouncesView& view, int planes) {
    using Mode = BouncesView::Mode;
    std::vector<float> gains(size_t(planes), 1.f);
    for (int k = 0; k < planes; ++k) {
        float& g = gains[size_t(k)];
        switch (view.mode) {
        case Mode::image: break;
        case Mode::single: g = k == view.bounce; break;
        case Mode::cumulative: g = k <= view.bounce; break;
        case Mode::direct: g = k <= 1; break;
        case Mode::indirect: g = k > 1; break;
        case Mode::gains:
            if (size_t(k) < view.gains.size()) g = view.gains[size_t(k)];
            break;
        }
    }
    return gains;
}

ImageView image_view(const BouncesView& view, int planes) {
    if (!view.open || view.mode == BouncesView::Mode::image) return {};
    return {ImageView::Show::bounces, gains_of(view, planes)};
}

double play(BouncesView& view, double now, int planes) {
    if (now >= view.step_due) {
        view.bounce = (view.bounce + 1) % std::max(planes, 1);
        view.step_due = now + BouncesView::seconds_each;
    }
    return view.step_due - now;
}

} // namespace blush
