#include "render/diagnostics/path_record.h"

#include <algorithm>
#include <cmath>

namespace blush {

std::string_view to_string(Met met) {
    constexpr std::string_view names[] = {"surface", "sphere light", "background"};
    return names[size_t(met)];
}
std::string_view to_string(ScatterKind kind) {
    constexpr std::string_view names[] = {"none", "diffuse", "glossy", "transmission", "delta reflection", "delta transmission"};
    return names[size_t(kind)];
}
std::string_view to_string(PathEnd end) {
    constexpr std::string_view names[] = {"none", "escaped", "light", "absorbed", "roulette", "max length", "invalid"};
    return names[size_t(end)];
}

Vec3 PathVertex::received() const {
    const Vec3 connected = next_event ? next_event->arrived : Vec3{0, 0, 0};
    return emission + connected + panes + past + chains + light_vertices;
}

bool RecordedPath::is_valid() const {
    const auto good = [](const Vec3& c) { return is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0; };
    return good(radiance) && good(light_paths);
}

LightByStrategy by_strategy(const RecordedPath& path) {
    LightByStrategy sums{};
    const auto add = [&](FoundBy by, const Vec3d& light) { sums[size_t(by)] = sums[size_t(by)] + light; };
    for (const PathVertex& v : path.vertices) {
        const Vec3d hit = to_double(v.emission + v.panes + v.past);
        add(FoundBy::camera_hit, hit * (1.0 - double(v.guided)));
        add(FoundBy::guided, hit * double(v.guided));
        if (v.next_event) add(FoundBy::nee, to_double(v.next_event->arrived));
        add(FoundBy::manifold, to_double(v.chains));
        add(FoundBy::light_vertex, to_double(v.light_vertices));
    }
    add(FoundBy::light_path, to_double(path.light_paths));
    return sums;
}

std::vector<Vec3d> by_length(const RecordedPath& path, size_t lengths) {
    std::vector<Vec3d> sums(lengths, Vec3d{0, 0, 0});
    const auto add = [&](size_t scatterings, const Vec3& light) {
        Vec3d& sum = sums[std::min(scatterings, lengths - 1)];
        sum = sum + to_double(light);
    };
    for (const PathVertex& v : path.vertices) {
        add(size_t(v.bounce), v.emission + v.panes + v.past);
        add(size_t(v.bounce) + 2, v.chains + v.light_vertices); // over a mirror or glass
        if (v.next_event) add(size_t(v.bounce) + 1, v.next_event->arrived);
    }
    return sums;
}

} // namespace blush
