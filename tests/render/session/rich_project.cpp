#include "tests/render/session/rich_project.h"

#include "tests/support/sample_project.h"

#include <cmath>

namespace blush::test {
namespace {

// A sphere with shading normals, both UV sets, tangents and vertex colours with varying alpha.
GeometryPtr octahedron() {
    Geometry g;
    g.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    g.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    g.normals = g.positions;
    g.uv.resize(2);
    for (const Vec3& p : g.positions) {
        g.uv[0].push_back({0.5f + 0.5f * p.x, 0.5f + 0.5f * p.y});
        g.uv[1].push_back({0.5f + 0.5f * p.z, 0.5f - 0.5f * p.x});
        g.tangents.push_back({p.y, p.z, p.x, 1}); // perpendicular, as the vertices are on the axes
        g.colors.push_back({0.5f + 0.5f * p.x, 0.7f, 0.5f - 0.5f * p.z, 0.75f + 0.25f * p.y});
    }
    return std::make_shared<const Geometry>(std::move(g));
}

ImagePtr gradient(int width, int height, int channels) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    for (int i = 0; i < width * height * channels; ++i) image.bytes.push_back(uint8_t(37 * i + 11 * (i / width)));
    return std::make_shared<const Image>(std::move(image));
}

ImagePtr sky() {
    Image image;
    image.width = 16;
    image.height = 8;
    image.channels = 3;
    for (int i = 0; i < 16 * 8 * 3; ++i) image.floats.push_back(0.1f + 0.4f * float(i % 7));
    image.floats[3 * 20] = 60; // a small sun
    return std::make_shared<const Image>(std::move(image));
}

class Builder {
public:
    Builder() : project_(sample_project().project) {}

    Id<Texture> texture(const char* name, const ImagePtr& image) {
        Texture t;
        t.name = name;
        t.image = image;
        return project_.scene.textures.add(t);
    }
    Id<Material> material(const char* name, auto&& with) {
        Material m;
        m.name = name;
        m.metallic = 0;
        with(m);
        return project_.scene.materials.add(m);
    }
    Id<Mesh> mesh(const char* name, const GeometryPtr& geometry, Id<Material> material) {
        return project_.scene.meshes.add({name, {{geometry, material}}});
    }
    Id<Node> place(const char* name, Id<Mesh> mesh, Vec3 at, float scale = 1) {
        Node node;
        node.name = name;
        node.mesh = mesh;
        node.local.translation = at;
        node.local.scale = {scale, scale, scale};
        return project_.scene.nodes.add(node);
    }
    void place_copies(const char* name, Id<Mesh> mesh, const std::vector<Vec3>& places, float scale) {
        Instances instances;
        for (const Vec3& at : places) instances.node_from_copy.push_back({{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, at});
        const Id<Node> id = place(name, mesh, {0, 0, 0});
        Node node = *project_.scene.nodes.find(id);
        node.instances = std::make_shared<const Instances>(std::move(instances));
        project_.scene.nodes.set(id, std::move(node));
    }
    void light(const char* name, Vec3 at, Quat rotation, auto&& with) {
        Light l;
        l.name = name;
        with(l);
        Node node;
        node.name = name;
        node.light = project_.scene.lights.add(l);
        node.local.translation = at;
        node.local.rotation = rotation;
        project_.scene.nodes.add(node);
    }
    Project& project() { return project_; }

private:
    Project project_;
};

void add_things(Builder& b) {
    const Id<Texture> leaf = b.texture("Leaf", gradient(8, 8, 4)), bumps = b.texture("Bumps", gradient(4, 4, 3));
    const GeometryPtr ball = octahedron(), quad = quad_geometry();
    const Id<Material> leaves = b.material("Leaves", [&](Material& m) {
        m.alpha = Material::Alpha::blend;
        m.base_color_texture.texture = leaf;
        m.double_sided = true;
    });
    const Id<Material> glass = b.material("Glass", [](Material& m) {
        m.transmission = 1;
        m.thickness = 1;
        m.roughness = 0.1f;
        m.attenuation_color = {0.9f, 0.5f, 0.5f};
        m.attenuation_distance = 0.3f;
    });
    const Id<Material> bumpy = b.material("Bumpy", [&](Material& m) {
        m.normal_texture.texture = bumps;
        m.base_color_texture = {leaf, 1};
        m.metallic = 0.5f;
        m.roughness = 0.4f;
    });
    const Id<Material> screen = b.material("Screen", [&](Material& m) {
        m.emissive = {2, 2, 2};
        m.emissive_texture.texture = leaf;
    });
    const Id<Material> ground = b.material("Ground", [](Material& m) { m.base_color = {0.3f, 0.4f, 0.2f}; });

    b.place("Hill", b.mesh("Hill", hill_geometry(), ground), {0, -0.8f, 0.5f}, 2);
    b.place("Glass ball", b.mesh("Glass ball", ball, glass), {-1, 0.3f, 1}, 0.4f);
    b.place("Bumpy ball", b.mesh("Bumpy ball", ball, bumpy), {1, 0.4f, 1}, 0.5f);
    b.place("Screen", b.mesh("Screen", quad, screen), {-0.5f, 0.8f, 0.5f}, 0.6f);
    b.place("Single leaf", b.mesh("Single leaf", quad, leaves), {0.6f, -0.2f, 2}, 0.5f);
    const Id<Mesh> twig = b.mesh("Twig", quad, leaves);
    b.place("Twig 1", twig, {-0.6f, -0.2f, 1.5f}, 0.7f);
    b.place("Twig 2", twig, {-0.4f, -0.1f, 1.8f}, 0.7f);
    b.place_copies("Lanterns", b.mesh("Lantern", ball, screen), {{-0.9f, 0.9f, 1.4f}, {0.2f, 1, 1.6f}, {0.7f, 0.8f, 1.2f}}, 0.08f);
}

void add_lights(Builder& b) {
    const Quat down{-0.5f, 0, 0, 0.8660254f};
    b.light("Bulb", {1.5f, 1, 2}, {}, [](Light& l) { l.radius = 0.2f, l.intensity = 5; });
    b.light("Spot", {0, 1, 3}, {}, [](Light& l) { l.kind = Light::Kind::spot, l.intensity = 20, l.inner_cone_radians = 0.2f; });
    b.light("Sun", {0, 0, 0}, down, [](Light& l) { l.kind = Light::Kind::sun, l.intensity = 3, l.angle_radians = 0.05f; });
    b.light("Parallel sun", {0, 0, 0}, {}, [](Light& l) { l.kind = Light::Kind::sun, l.intensity = 0.5f; });
    b.light("Panel", {-1, 1.5f, 2}, down, [](Light& l) { l.kind = Light::Kind::rectangle, l.intensity = 4, l.use_temperature = true; });
    b.light("Disk", {1, 1.2f, 2.5f}, down, [](Light& l) { l.kind = Light::Kind::disk, l.radius = 0.3f, l.spread_radians = 1.5f; });
    b.light("Hidden ball", {-0.2f, 0.6f, 1.8f}, {},
            [](Light& l) { l.kind = Light::Kind::sphere, l.radius = 0.15f, l.visible_to_camera = false; });
}

// A flag skinned to two joints, with a morph target for its tip: the clip rotates the upper joint and raises the weight. And a
// leaf that only the other one of two scenes has.
void add_motion(Builder& b) {
    Scene& scene = b.project().scene;
    auto g = std::make_shared<Geometry>();
    auto lifted = std::make_shared<MorphTarget>();
    for (int i = 0; i < 5; ++i)
        for (int side = 0; side < 2; ++side) {
            const float along = float(i) / 4;
            g->positions.push_back({along, float(side) * 0.5f, 0});
            g->normals.push_back({0, 0, 1});
            g->influences.insert(g->influences.end(), {{0, 1 - along}, {1, along}});
            lifted->positions.push_back({0, 0.4f * along, 0});
        }
    for (uint32_t i = 0; i < 8; i += 2) g->indices.insert(g->indices.end(), {i, i + 2, i + 3, i, i + 3, i + 1});
    g->targets.push_back(std::move(lifted));
    Material cloth;
    cloth.metallic = 0;
    cloth.base_color = {0.7f, 0.2f, 0.1f};
    cloth.double_sided = true;
    const Id<Material> material = scene.materials.add(cloth);

    Node joint;
    joint.name = "Pole";
    joint.local.translation = {-1.4f, 0.9f, 0.5f};
    const Id<Node> pole = scene.nodes.add(joint);
    joint.name = "Tip";
    joint.parent = pole;
    joint.local.translation = {0.8f, 0, 0};
    const Id<Node> tip = scene.nodes.add(joint);
    Affine back;
    back.t = {-0.8f, 0, 0};
    const Id<Node> flag = b.place("Flag", scene.meshes.add({"Flag", {{std::move(g), material}}}), {5, 5, 5});
    Node hung = *scene.nodes.find(flag);
    hung.skin = scene.skins.add({"Pole and tip", {pole, tip}, {Affine{}, back}});
    hung.morph_weights = {0.3f};
    scene.nodes.set(flag, hung);
    const auto keys = [](std::vector<float> values) {
        return std::make_shared<const Keyframes>(Keyframes{Keyframes::Interpolation::linear, {0, 1, 2}, std::move(values)});
    };
    scene.clips.add({"Wave",
                     2,
                     {{tip, Channel::Property::rotation, keys({0, 0, 0, 1, 0, 0.6f, 0, 0.8f, 0, -0.6f, 0, 0.8f})},
                      {flag, Channel::Property::morph_weights, keys({0, 1, 0.5f})}}});

    scene.scene_names = {"Summer", "Winter"};
    Node evergreen = *scene.nodes.find(flag);
    evergreen.name = "Evergreen";
    evergreen.skin = {};
    evergreen.local.translation = {0.2f, 0.7f, 1};
    evergreen.only_in_scenes = {1};
    scene.nodes.add(evergreen);
}

} // namespace

GeometryPtr hill_geometry() {
    constexpr uint32_t n = 130;
    Geometry g;
    g.uv.resize(1);
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float u = float(i) / n, v = float(j) / n;
            g.positions.push_back({u - 0.5f, v - 0.5f, 0.1f * std::sin(9 * u) * std::cos(7 * v)});
            g.uv[0].push_back({u, v});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            g.indices.insert(g.indices.end(), {a, b, d, a, d, c});
        }
    return std::make_shared<const Geometry>(std::move(g));
}

Project rich_project() {
    Builder b;
    add_things(b);
    add_lights(b);
    add_motion(b);
    b.project().scene.environment.kind = Environment::Kind::image;
    b.project().scene.environment.image = sky();
    b.project().render.width = 48;
    b.project().render.height = 32;
    return b.project();
}

} // namespace blush::test
