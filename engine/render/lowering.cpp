#include "render/lowering.h"

#include "core/math.h"
#include "scene/color_temperature.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace blush {
namespace {

// Unit square in the XY plane, facing -Z, as lights do.
GeometryPtr unit_rectangle() {
    static const GeometryPtr shared = [] {
        auto g = std::make_shared<Geometry>();
        g->positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
        g->indices = {0, 2, 1, 0, 3, 2};
        return g;
    }();
    return shared;
}

// A regular polygon in the XY plane, facing -Z, with the area of the unit disk.
GeometryPtr unit_disk() {
    static const GeometryPtr shared = [] {
        constexpr uint32_t corners = 96;
        constexpr double step = 2 * std::numbers::pi / corners;
        const double radius = std::sqrt(step / std::sin(step));
        auto g = std::make_shared<Geometry>();
        g->positions.push_back({0, 0, 0});
        for (uint32_t i = 0; i < corners; ++i) {
            g->positions.push_back({float(radius * std::cos(i * step)), float(radius * std::sin(i * step)), 0});
            g->indices.insert(g->indices.end(), {0, 1 + (i + 1) % corners, 1 + i});
        }
        return g;
    }();
    return shared;
}

// Octahedron subdivided four times: 2048 triangles, within 0.3 % of a ball's area.
GeometryPtr unit_sphere() {
    static const GeometryPtr shared = [] {
        auto g = std::make_shared<Geometry>();
        g->positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        g->indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
        for (int level = 0; level < 4; ++level) {
            std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
            const auto middle = [&](uint32_t a, uint32_t b) {
                const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), uint32_t(g->positions.size()));
                if (is_new) g->positions.push_back(normalize(g->positions[a] + g->positions[b]));
                return it->second;
            };
            std::vector<uint32_t> finer;
            for (size_t i = 0; i < g->indices.size(); i += 3) {
                const uint32_t a = g->indices[i], b = g->indices[i + 1], c = g->indices[i + 2];
                const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
                finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
            }
            g->indices = std::move(finer);
        }
        return g;
    }();
    return shared;
}

// By Cauchy's formula the mean projected area of a convex body is a quarter of its surface.
float mean_projected_area(const Geometry& g) {
    double area = 0;
    for (size_t i = 0; i < g.indices.size(); i += 3) {
        const Vec3 a = g.positions[g.indices[i]], b = g.positions[g.indices[i + 1]], c = g.positions[g.indices[i + 2]];
        area += 0.5 * double(length(cross(b - a, c - a)));
    }
    return float(area / 4);
}

Material emitter(const Light& light, const Vec3& nits) {
    Material m;
    m.name = light.name;
    m.base_color = {0, 0, 0};
    m.metallic = 0;
    m.specular = 0;
    m.emissive = nits;
    m.double_sided = (light.kind == Light::Kind::rectangle || light.kind == Light::Kind::disk) && light.two_sided;
    return m;
}

struct AreaShape {
    GeometryPtr geometry;
    Vec3 scale;
    Vec3 nits;
};

AreaShape shape_of(const Light& light) {
    const Vec3 emission = light_emission(light);
    const float r = light.radius;
    if (light.kind == Light::Kind::rectangle) return {unit_rectangle(), {light.width, light.height, 1}, emission};
    if (light.kind == Light::Kind::disk) return {unit_disk(), {r, r, 1}, emission};
    static const float unit_area = mean_projected_area(*unit_sphere());
    const Vec3 candela = light.kind == Light::Kind::sphere ? emission * (std::numbers::pi_v<float> * r * r) : emission;
    return {unit_sphere(), {r, r, r}, candela / (unit_area * r * r)};
}

} // namespace

bool is_area_light(const Light& light) {
    switch (light.kind) {
    case Light::Kind::rectangle:
    case Light::Kind::disk:
    case Light::Kind::sphere: return true;
    case Light::Kind::point: return light.radius > 0;
    case Light::Kind::spot:
    case Light::Kind::sun: return false;
    }
    return false;
}

Vec3 light_emission(const Light& light) {
    const Vec3 tint = light.use_temperature ? light.color * black_body_color(light.kelvin) : light.color;
    return tint * light.intensity;
}

Scene lower_area_lights(const Scene& scene) {
    Scene lowered = scene;
    for (const auto& [id, node] : scene.nodes) {
        const Light* light = node.light ? scene.lights.find(node.light) : nullptr;
        if (!light || !light->enabled || !is_area_light(*light)) continue;
        const AreaShape shape = shape_of(*light);
        const uint32_t key = lowered_bit | node.light.value;
        lowered.materials.insert(Id<Material>{key}, emitter(*light, shape.nits));
        lowered.meshes.insert(Id<Mesh>{key}, {light->name, {{shape.geometry, Id<Material>{key}}}});
        Node body;
        body.parent = id;
        body.local.scale = shape.scale;
        body.mesh = Id<Mesh>{key};
        lowered.nodes.insert(Id<Node>{lowered_bit | id.value}, std::move(body));
    }
    return lowered;
}

} // namespace blush
