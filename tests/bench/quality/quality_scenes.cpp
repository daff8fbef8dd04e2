#include "tests/bench/quality/quality_scenes.h"

#include "core/math.h"
#include "io/gltf/read/import.h"
#include "io/image/environment_image.h"
#include "measure/stability/scenes.h"
#include "scene/affine.h"
#include "tests/bench/net.h"

#include <cmath>
#include <numbers>

namespace blush::bench {
namespace {

// Without roll; `yfov_radians` is vertical.
View view_of(const Vec3& from, const Vec3& to, float yfov_radians) {
    const Vec3d direction = to_double(to - from);
    Affined frame;
    frame.z = -normalize(direction);
    frame.x = normalize(cross(Vec3d{0, 1, 0}, frame.z));
    frame.y = cross(frame.z, frame.x);
    View view;
    view.position = from;
    view.rotation = to_quat(frame);
    view.pivot_distance = float(length(direction));
    view.lens.yfov_radians = yfov_radians;
    return view;
}

void add_sun(Scene& scene, float lux, const Vec3& direction) {
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = lux;
    sun.angle_radians = 0.00925f;
    stability::place_light(scene, sun, stability::aimed({0, 0, 0}, stability::unit(direction)));
}

// 1,002,528 triangles.
Scene million_triangles() {
    Scene scene;
    stability::place(scene, std::make_shared<const Geometry>(net(708)), stability::plastic(0.5f));
    stability::constant_world(scene, 0.5f);
    scene.environment.color = {0.7f, 0.85f, 1};
    add_sun(scene, 3, {1, -1, -0.6f});
    scene.view = view_of({0.4f, 0.9f, 1.6f}, {0, 0, 0}, 0.7f);
    return scene;
}

// Lat-long: a sky, a ground, and a sun of four pixels.
ImagePtr generated_sky() {
    constexpr int width = 512, height = 256;
    std::vector<Vec3> texels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float up = std::cos(std::numbers::pi_v<float> * (float(y) + 0.5f) / height);
            const bool sun = (x == 180 || x == 181) && (y == 70 || y == 71);
            texels.push_back(sun ? Vec3{9000, 8000, 6500} : up > 0 ? Vec3{0.5f, 0.7f, 1} * (1.5f - up) : Vec3{0.2f, 0.18f, 0.15f});
        }
    return stability::float_image(width, height, texels);
}

ImagePtr generated_texture() {
    constexpr int side = 256;
    std::vector<Vec3> texels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            texels.push_back((x / 32 + y / 32) % 2 ? Vec3{0.8f, 0.6f, 0.4f} : Vec3{0.1f, 0.2f, 0.35f} * (0.5f + 0.5f * float(x % 32) / 32));
    return stability::float_image(side, side, texels);
}

Scene generated_model() {
    Scene scene;
    Material material = stability::plastic(0.3f);
    material.base_color_texture.texture = stability::add_texture(scene, generated_texture(), Texture::Filter::linear);
    stability::place(scene, stability::cube(false), material);
    scene.view = view_of({2.4f, 1.8f, 3.2f}, {0, 0, 0}, 0.7f);
    return scene;
}

// On a grey floor.
Result<Scene> textured_model(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "pmndrs.glb", map = folder / ".." / "hdri" / "venice.exr";
    const bool given = !folder.empty() && std::filesystem::exists(file) && std::filesystem::exists(map);
    Scene scene = generated_model();
    if (given) {
        Result<ImportedScene> model = import_gltf(file);
        if (!model) return model.error();
        scene = std::move(model->scene);
    }
    Result<ImagePtr> image = given ? read_environment_image(map) : generated_sky();
    if (!image) return image.error();
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = *std::move(image);
    const Bounds bounds = world_bounds(scene);
    const Vec3d middle = bounds.center();
    stability::place(scene, stability::floor_quad(20 * float(bounds.radius())), stability::lambert(0.4f),
                     stability::at({float(middle.x), float(bounds.low.y), float(middle.z)}));
    return scene;
}

// 6 x 3 x 5 m with a window in the wall on the right, through which sun and sky light it.
Scene window_room() {
    using stability::place, stability::quad;
    Scene scene;
    const Material white = stability::lambert(0.75f), wood = stability::lambert({0.45f, 0.28f, 0.15f});
    const float x = 3, y = 3, z = 2.5f, sill = 0.9f, head = 2.3f, left = -1.5f, right = 0.7f;
    place(scene, stability::cube(false), stability::plastic(0.3f), stability::at({0.8f, 0.45f, -0.6f}, 0.45f));
    place(scene, stability::sphere(false), stability::metal(0.25f), stability::at({-0.6f, 0.4f, -1.1f}, 0.4f));
    place(scene, quad({-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z}), wood);
    place(scene, quad({-x, y, -z}, {x, y, -z}, {x, y, z}, {-x, y, z}), white);
    place(scene, quad({-x, 0, -z}, {x, 0, -z}, {x, y, -z}, {-x, y, -z}), white);
    place(scene, quad({x, 0, z}, {-x, 0, z}, {-x, y, z}, {x, y, z}), white);
    place(scene, quad({-x, 0, z}, {-x, 0, -z}, {-x, y, -z}, {-x, y, z}), stability::lambert({0.5f, 0.6f, 0.7f}));
    // Around the window, seen from inside: below, above, beside.
    const auto wall = [&](float z0, float z1, float y0, float y1) {
        place(scene, quad({x, y0, z0}, {x, y0, z1}, {x, y1, z1}, {x, y1, z0}), white);
    };
    wall(-z, z, 0, sill);
    wall(-z, z, head, y);
    wall(-z, left, sill, head);
    wall(right, z, sill, head);
    stability::constant_world(scene, 1);
    scene.environment.color = {0.6f, 0.78f, 1};
    add_sun(scene, 15, {-1, -0.7f, 0.1f});
    scene.view = view_of({-2.6f, 1.6f, 2.2f}, {0.9f, 0.9f, -1}, 0.95f);
    return scene;
}

// The metal ring in the light of a point as glTF has it, without size: only light paths and manifold sampling find its caustic.
Result<Scene> ring_under_a_point() {
    Result<ImportedScene> ring = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/metal-ring.gltf");
    if (!ring) return ring.error();
    Scene scene = std::move(ring->scene);
    for (const auto& entry : Table<Node>(scene.nodes)) {
        if (entry.value.name != "lamp") continue;
        Node hidden = entry.value;
        hidden.visible = false;
        const Vec3 position = hidden.local.translation;
        scene.nodes.set(entry.id, std::move(hidden));
        Light point;
        point.intensity = 0.5f;
        stability::place_light(scene, point, stability::at(position));
    }
    return scene;
}

} // namespace

Result<std::vector<BenchScene>> quality_scenes(const std::filesystem::path& folder) {
    Result<Scene> model = textured_model(folder);
    if (!model) return model.error();
    Result<Scene> ring = ring_under_a_point();
    if (!ring) return ring.error();
    return std::vector<BenchScene>{{"textured-hdri", *std::move(model), false},
                                   {"million-triangles", million_triangles(), false},
                                   {"window-room", window_room(), false},
                                   {"ring-point", *std::move(ring), false}};
}

} // namespace blush::bench
