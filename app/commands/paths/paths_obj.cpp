#include "app/commands/paths/paths_obj.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

struct Writer {
    std::string text;
    int64_t count = 0;

    int64_t vertex(const Vec3d& p, const Vec3& color) {
        const auto shown = [](float x) { return std::clamp(x, 0.f, 1.f); };
        text += fmt::format("v {:.9g} {:.9g} {:.9g} {:.4f} {:.4f} {:.4f}\n", p.x, p.y, p.z, shown(color.x), shown(color.y), shown(color.z));
        return ++count;
    }
    void line(const std::string& name, const std::vector<std::pair<Vec3d, Vec3>>& points) {
        text += fmt::format("o {}\n", name);
        std::string indices = "l";
        for (const auto& [position, color] : points) indices += fmt::format(" {}", vertex(position, color));
        text += indices + "\n";
    }
};

} // namespace

std::string paths_obj(const PixelPaths& p) {
    Writer w{fmt::format("# blush paths: pixel {},{} samples {}:{}\n", p.x, p.y, p.settings.first_sample, p.settings.spp)};
    for (const RecordedPath& path : p.paths) {
        const std::string name = fmt::format("sample_{}", path.sample);
        std::vector<std::pair<Vec3d, Vec3>> points{{path.eye, {1, 1, 1}}};
        for (const PathVertex& v : path.vertices) points.emplace_back(v.position, v.end == PathEnd::none ? v.beta : v.arriving);
        w.line(name, points);
        for (const PathVertex& v : path.vertices) {
            if (!v.next_event) continue;
            const NextEvent& e = *v.next_event;
            const Vec3 color = e.blocked ? Vec3{1, 0, 0} : e.arrived;
            w.line(name + (e.blocked ? "_blocked" : "_light"), {{v.position, color}, {e.to, color}});
        }
    }
    return std::move(w.text);
}

} // namespace blush
