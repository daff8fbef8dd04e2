#include "ui/views/bleed_view.h"

#include "scene/node_name.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {

BleedTarget target_of(const BleedView& view, const Scene& scene, int width, int height) {
    BleedTarget target;
    if (view.rect) {
        target.pixels = pixels_of(*view.rect, width, height);
        return target;
    }
    if (!view.point) return target;
    const PlacedMeter at = placed(scene, *view.point);
    target.kind = view.quantity == BleedView::Quantity::arriving ? BleedTarget::Kind::incoming : BleedTarget::Kind::outgoing;
    target.position = at.position;
    target.normal = at.normal;
    target.clearance = double(view.point->clearance);
    return target;
}

std::string place_of(const BleedView& view, const Scene& scene, int width, int height) {
    if (view.rect) {
        const PixelRect p = pixels_of(*view.rect, width, height);
        return fmt::format("{} x {} pixels from {}, {}", p.x1 - p.x0, p.y1 - p.y0, p.x0, p.y0);
    }
    if (!view.point) return {};
    const Vec3d at = placed(scene, *view.point).position;
    const Node* node = scene.nodes.find(view.point->node);
    return fmt::format("{}at {:.3g}, {:.3g}, {:.3g} m", node ? node_name(scene, view.point->node, *node) + " " : "", at.x, at.y, at.z);
}

const BleedShare* sender_of(const BleedView& view, const BleedReport& report) {
    const auto found = std::ranges::find_if(report.senders, [&](const BleedShare& row) {
        return row.by == SentBy::object && row.object != 0 && (view.chosen == 0 || row.object == view.chosen);
    });
    return found == report.senders.end() ? nullptr : &*found;
}

const std::vector<BleedShare>& rows_of(const BleedView& view, const BleedReport& report) {
    switch (view.list) {
    case BleedView::List::lights: return report.lights;
    case BleedView::List::bounces: return report.bounces;
    case BleedView::List::senders: break;
    }
    return report.senders;
}

} // namespace blush
