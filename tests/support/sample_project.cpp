#include "tests/support/sample_project.h"

namespace blush::test {

GeometryPtr quad_geometry() {
    Geometry g;
    g.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    g.normals.assign(4, {0, 0, 1});
    g.uv = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    g.indices = {0, 1, 2, 0, 2, 3};
    return std::make_shared<const Geometry>(std::move(g));
}

ImagePtr byte_image(int width, int height, int channels, uint8_t value) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.bytes.assign(size_t(width) * size_t(height) * size_t(channels), value);
    return std::make_shared<const Image>(std::move(image));
}

ImagePtr uniform_image(int width, int height, int channels, float value) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.floats.assign(size_t(width) * size_t(height) * size_t(channels), value);
    return std::make_shared<const Image>(std::move(image));
}

Sample sample_project() {
    Sample s;
    Scene& scene = s.project.scene;

    Texture checker;
    checker.name = "Checker";
    checker.image = byte_image(2, 2, 3, 128);
    s.checker = scene.textures.add(checker);

    Material red;
    red.name = "Red";
    red.base_color = {0.8f, 0.1f, 0.1f};
    red.metallic = 0;
    red.base_color_texture.texture = s.checker;
    s.red = scene.materials.add(red);
    Material grey;
    grey.name = "Grey";
    grey.base_color = {0.4f, 0.4f, 0.4f};
    grey.metallic = 0;
    s.grey = scene.materials.add(grey);

    scene.variants = {"As it is", "All grey"};
    s.quad = scene.meshes.add({"Quad", {{quad_geometry(), s.red, {s.red, {}, s.grey}}, {quad_geometry(), s.grey, {}}}, {}});

    Light lamp;
    lamp.name = "Lamp";
    lamp.intensity = 100;
    s.lamp = scene.lights.add(lamp);
    s.camera = scene.cameras.add({"Camera", {}});

    const auto add_node = [&](const char* name, Id<Node> parent, Vec3 translation) {
        Node node;
        node.name = name;
        node.parent = parent;
        node.local.translation = translation;
        return scene.nodes.add(node);
    };
    const auto change = [&](Id<Node> id, auto&& with) {
        Node node = *scene.nodes.find(id);
        with(node);
        scene.nodes.set(id, node);
    };
    s.root = add_node("Root", {}, {0, 0, 0});
    s.mug = add_node("Mug", s.root, {0.2f, 0, 0.5f});
    s.lamp_node = add_node("Lamp", s.root, {0, 0, 3});
    s.table = add_node("Table", {}, {0, 0, -0.5f});
    s.camera_node = add_node("Camera", {}, {0, 0, 4});
    change(s.mug, [&](Node& n) { n.mesh = s.quad; });
    change(s.table, [&](Node& n) { n.mesh = s.quad, n.local.scale = {4, 4, 4}; });
    change(s.lamp_node, [&](Node& n) { n.light = s.lamp; });
    change(s.camera_node, [&](Node& n) { n.camera = s.camera; });

    const auto keys = [](std::vector<float> values) {
        return std::make_shared<const Keyframes>(Keyframes{Keyframes::Interpolation::linear, {0, 2}, std::move(values)});
    };
    s.swing = scene.clips.add({"Swing",
                               2,
                               {{s.mug, Channel::Property::rotation, keys({0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f})},
                                {s.lamp_node, Channel::Property::translation, keys({0, 0, 3, 2, 0, 3})}}});

    scene.environment.kind = Environment::Kind::constant;
    scene.environment.color = {0.1f, 0.1f, 0.2f};
    return s;
}

} // namespace blush::test
