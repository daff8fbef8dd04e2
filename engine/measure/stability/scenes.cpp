#include "measure/stability/scenes.h"

#include "core/math.h"
#include "scene/affine.h"

#include <cmath>
#include <numbers>

namespace blush::stability {
namespace {

void add_quad(Geometry& g, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const uint32_t first = uint32_t(g.positions.size());
    g.positions.insert(g.positions.end(), {a, b, c, d});
    g.uv.resize(1);
    g.uv[0].insert(g.uv[0].end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) g.indices.push_back(first + i);
}

GeometryPtr finished(Geometry g, bool inward) {
    if (inward)
        for (size_t i = 0; i < g.indices.size(); i += 3) std::swap(g.indices[i + 1], g.indices[i + 2]);
    return std::make_shared<const Geometry>(std::move(g));
}

Quat rotation_towards(const Vec3& direction) {
    Affined frame;
    frame.z = -normalize(to_double(direction));
    frame.x = any_perpendicular(frame.z);
    frame.y = cross(frame.z, frame.x);
    return to_quat(frame);
}

} // namespace

GeometryPtr quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Geometry g;
    add_quad(g, a, b, c, d);
    return finished(std::move(g), false);
}
GeometryPtr floor_quad(float h, float y) { return quad({-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}); }
GeometryPtr ceiling_quad(float h, float y) { return quad({-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}); }

GeometryPtr cube(bool inward) {
    Geometry g;
    add_quad(g, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1});
    add_quad(g, {-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1});
    add_quad(g, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
    add_quad(g, {1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}, {1, 1, -1});
    add_quad(g, {1, -1, 1}, {1, -1, -1}, {1, 1, -1}, {1, 1, 1});
    add_quad(g, {-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1});
    return finished(std::move(g), inward);
}

GeometryPtr sphere(bool inward) {
    constexpr int rows = 16, columns = 16;
    constexpr double pi = std::numbers::pi;
    // Latitude and longitude around a tilted axis.
    const Vec3d axis = normalize(Vec3d{0.3, 0.8, 0.5}), x = any_perpendicular(axis), y = cross(axis, x);
    Geometry g;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double theta = pi * i / rows, phi = 2 * pi * (j + 0.5 * (i & 1)) / columns;
            g.positions.push_back(to_float(axis * std::cos(theta) + (x * std::cos(phi) + y * std::sin(phi)) * std::sin(theta)));
        }
    const auto triangle = [&](int a, int b, int c) {
        const Vec3 &p = g.positions[size_t(a)], &q = g.positions[size_t(b)], &r = g.positions[size_t(c)];
        if (!(length(cross(q - p, r - p)) > 1e-6f)) return; // at the poles
        const bool outward = dot(cross(q - p, r - p), p + q + r) > 0;
        for (const int k : {a, outward ? b : c, outward ? c : b}) g.indices.push_back(uint32_t(k));
    };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const int right = (j + 1) % columns, above = i * columns, below = above + columns;
            if (i & 1) {
                triangle(above + j, below + right, above + right);
                triangle(above + j, below + j, below + right);
            } else {
                triangle(above + j, below + j, above + right);
                triangle(above + right, below + j, below + right);
            }
        }
    return finished(std::move(g), inward);
}

Material lambert(const Vec3& albedo) {
    Material m;
    m.base_color = albedo;
    m.metallic = 0;
    m.specular = 0;
    return m;
}
Material lambert(float albedo) { return lambert(Vec3{albedo, albedo, albedo}); }
Material metal(float roughness) {
    Material m;
    m.roughness = roughness;
    return m;
}
Material plastic(float roughness) {
    Material m;
    m.metallic = 0;
    m.roughness = roughness;
    return m;
}
Material glass(float roughness, float ior) {
    Material m = plastic(roughness);
    m.ior = ior;
    m.transmission = 1;
    m.thickness = 1;
    return m;
}
Material gel(const Vec3& color) {
    Material m = lambert(color);
    m.roughness = 0;
    m.transmission = 1;
    return m;
}
Material emitter(float nits, float albedo) {
    Material m = lambert(albedo);
    m.emissive = {1, 1, 1};
    m.emissive_strength = nits;
    return m;
}
Material unlit(const Vec3& color) {
    Material m = lambert(color);
    m.unlit = true;
    return m;
}

Id<Node> place(Scene& scene, const GeometryPtr& geometry, const Material& material, const Transform& transform) {
    Node node;
    node.local = transform;
    node.mesh = scene.meshes.add({"", {{geometry, scene.materials.add(material)}}});
    return scene.nodes.add(node);
}
Id<Node> place_light(Scene& scene, const Light& light, const Transform& transform) {
    Node node;
    node.local = transform;
    node.light = scene.lights.add(light);
    return scene.nodes.add(node);
}
Id<Texture> add_texture(Scene& scene, const ImagePtr& image, Texture::Filter filter) {
    Texture texture;
    texture.image = image;
    texture.filter = filter;
    return scene.textures.add(texture);
}
void constant_world(Scene& scene, float nits) {
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.intensity = nits;
}
ImagePtr float_image(int width, int height, std::span<const Vec3> texels) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = 3;
    for (const Vec3& t : texels) image.floats.insert(image.floats.end(), {t.x, t.y, t.z});
    return std::make_shared<const Image>(std::move(image));
}

Transform at(const Vec3& position, float scale) {
    Transform t;
    t.translation = position;
    t.scale = {scale, scale, scale};
    return t;
}
Transform aimed(const Vec3& position, const Vec3& direction) {
    Transform t = at(position);
    t.rotation = rotation_towards(direction);
    return t;
}
Vec3 unit(const Vec3& v) { return to_float(normalize(to_double(v))); }

View looking(const Vec3& from, const Vec3& to, float yfov_radians) {
    View view;
    view.position = from;
    view.rotation = rotation_towards(to - from);
    view.lens.yfov_radians = yfov_radians;
    return view;
}
View looking_down(float half, float y) {
    View view;
    view.position = {0, y, 0};
    view.rotation = {-std::numbers::sqrt2_v<float> / 2, 0, 0, std::numbers::sqrt2_v<float> / 2};
    view.lens.orthographic = true;
    view.lens.ymag = half;
    return view;
}

Scene sunlit_floor_in_a_mirror() {
    constexpr float mirror = -3, middle = -1.1f;
    Scene scene;
    place(scene, floor_quad(50), lambert(0.01f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = float(std::numbers::pi * std::numbers::sqrt2);
    place_light(scene, sun, aimed({0, 5, 0}, {1, -1, 0}));
    place(scene, quad({mirror, 0.1f, 1}, {mirror, 0.1f, -1}, {mirror, 0.7f, -1}, {mirror, 0.7f, 1}), metal(0));
    scene.view = looking({-2, 0.8f, 0}, {2 * mirror - middle, 0, 0}, 0.025f);
    return scene;
}

} // namespace blush::stability
