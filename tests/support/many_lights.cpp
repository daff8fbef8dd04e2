#include "tests/support/many_lights.h"

#include "core/math.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/renderer.h"
#include "shading/light.h"

#include <cmath>
#include <numbers>
#include <random>

namespace blush::test {
namespace {

constexpr int lamps_in_a_row = 5;
constexpr float side = 4, ceiling = 2.8f, wall = 3; // metres
constexpr float albedo = 0.5f;

class Random {
public:
    float operator()(float low = 0, float high = 1) { return low + (high - low) * float(bits_() >> 8) * 0x1p-24f; }

private:
    std::mt19937 bits_{17};
};

void add_quad(Geometry& g, const Vec3& corner, const Vec3& along, const Vec3& up) {
    const auto first = uint32_t(g.positions.size());
    for (const Vec3& p : {corner, corner + along, corner + along + up, corner + up}) g.positions.push_back(p);
    for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) g.indices.push_back(first + i);
}

// Contribution of the lights at a receiver, and the second moments of one sample of it.
struct Given {
    double by_all = 0, seen = 0; // without walls, and with occlusion
    double by_tree = 0, by_power = 0;
    SelectionVariance relative() const { return {by_all / seen - 1, by_tree / (seen * seen) - 1, by_power / (seen * seen) - 1}; }
};

// The receiver is in room (rx, rz).
Given given_by(const LightTables& t, int rooms, const Vec3& origin, const Receiver<float>& to, int rx, int rz) {
    const int32_t n = rooms * rooms * lamps_in_a_row * lamps_in_a_row;
    // Power for selection: 4 pi I, for a downlight a quarter of it.
    const auto power = [&](int32_t i) { return double(t.lights[i].emission.y) * (t.lights[i].profile >= 0 ? 0.25 : 1); };
    double total_power = 0;
    for (int32_t i = 0; i < n; ++i) total_power += power(i);
    Given given;
    for (int32_t i = 0; i < n; ++i) {
        const LightRecord& light = t.lights[i];
        const Vec3 way = light.position - to.position;
        const float d2 = dot(way, way);
        const Vec3 wi = way / std::sqrt(d2);
        double c = std::max(0.0, double(dot(wi, to.normal))) * double(light.emission.y) / double(d2);
        if (light.profile >= 0 && c > 0) c *= double(profile_factor<float>(t.profiles, light.profile, -wi, true));
        if (c <= 0) continue;
        given.by_all += c;
        const Vec3 in_house = light.position - origin;
        if (int(in_house.x / side) != rx || int(in_house.z / side) != rz) continue;
        given.seen += c;
        given.by_tree += c * c / double(light_probability<all_features, float>(t, to, i, true));
        given.by_power += c * c / (power(i) / total_power);
    }
    return given;
}

// In the tables, whose origin differs.
Vec3 corner_of_house(const LightTables& t) {
    return t.lights[0].position - Vec3{side / (2 * lamps_in_a_row), ceiling, side / (2 * lamps_in_a_row)};
}

} // namespace

Scene house(int rooms) {
    Scene scene;
    auto building = std::make_shared<Geometry>();
    const float end = float(rooms) * side;
    add_quad(*building, {0, 0, 0}, {0, 0, end}, {end, 0, 0});
    for (int k = 0; k <= rooms; ++k) {
        add_quad(*building, {float(k) * side, 0, 0}, {0, 0, end}, {0, wall, 0});
        add_quad(*building, {0, 0, float(k) * side}, {end, 0, 0}, {0, wall, 0});
    }
    Material diffuse;
    diffuse.base_color = {albedo, albedo, albedo};
    diffuse.metallic = diffuse.specular = 0;
    Node walls;
    walls.mesh = scene.meshes.add({"", {{building, scene.materials.add(diffuse)}}});
    scene.nodes.add(walls);
    Random random;
    for (int room = 0; room < rooms * rooms; ++room)
        for (int i = 0; i < lamps_in_a_row * lamps_in_a_row; ++i) {
            Light light;
            light.kind = i % 2 ? Light::Kind::spot : Light::Kind::point;
            light.outer_cone_radians = 1.2f;
            light.intensity = std::exp(random(-1, 1));
            const auto along = [&](int room_index, int lamp) { return (float(room_index) + (float(lamp) + 0.5f) / lamps_in_a_row) * side; };
            Node node;
            node.light = scene.lights.add(light);
            node.local.translation = {along(room % rooms, i % lamps_in_a_row), ceiling, along(room / rooms, i / lamps_in_a_row)};
            node.local.rotation = {-0.70710678f, 0, 0, 0.70710678f}; // -Z down
            scene.nodes.add(node);
        }
    return scene;
}

SelectionVariance choice_variance(const SceneTables& tables, int rooms, int receivers) {
    const Vec3 origin = corner_of_house(tables.lights);
    SelectionVariance variance;
    Random random;
    for (int k = 0; k < receivers; ++k) {
        const int rx = int(random(0, float(rooms))), rz = int(random(0, float(rooms)));
        Receiver<float> to{origin + Vec3{(float(rx) + random()) * side, 0.001f, (float(rz) + random()) * side}, {0, 1, 0}};
        if (k % 3 == 2) { // on a wall
            to.position.x = origin.x + (float(rx) + 0.001f) * side;
            to.position.y = random(0.2f, 2.5f);
            to.normal = {1, 0, 0};
        }
        const SelectionVariance one = given_by(tables.lights, rooms, origin, to, rx, rz).relative();
        variance.oracle += one.oracle / receivers;
        variance.tree += one.tree / receivers;
        variance.power += one.power / receivers;
    }
    return variance;
}

ImageVariance image_variance(int rooms, int64_t spp) {
    constexpr int shown = 3, pixels = 36; // rooms of the middle, and as many texels along each of their floors together
    Scene scene = house(rooms);
    const float first = float((rooms - shown) / 2) * side, middle = first + shown * side / 2;
    scene.view.position = {middle, 10, middle};
    scene.view.rotation = {-0.70710678f, 0, 0, 0.70710678f}; // -Z down
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = shown * side / 2;
    RenderSettings settings;
    settings.width = settings.height = pixels;
    settings.spp = spp;
    settings.max_bounces = 1;
    settings.filter = PixelFilter::box;
    settings.sampler = SamplerType::random;
    settings.adaptive = false;
    settings.reuse = 1;

    ImageVariance variance;
    std::vector<float> images[2];
    for (uint32_t seed = 0; seed < 2; ++seed) {
        settings.seed = seed;
        Renderer renderer({.threads = 2, .planes = {}});
        renderer.update(scene, settings);
        renderer.render(0, spp);
        images[seed] = renderer.resolve().rgba;
    }
    constexpr double all = double(pixels) * pixels;
    for (size_t i = 0; i < images[0].size(); i += 4) variance.rendered += std::pow(double(images[0][i] - images[1][i]), 2) / 2 / all;

    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(1));
    const Vec3 origin = corner_of_house(compiled.tables().lights);
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            const auto place = [&](int pixel) { return first + (float(pixel) + 0.5f) * shown * side / pixels; };
            const Receiver<float> to{origin + Vec3{place(x), 0.001f, place(y)}, {0, 1, 0}};
            const Given given = given_by(compiled.tables().lights, rooms, origin, to, int(place(x) / side), int(place(y) / side));
            const SelectionVariance relative = given.relative();
            const double radiance = double(albedo) / std::numbers::pi * given.seen, weight = radiance * radiance / double(spp) / all;
            variance.oracle += weight * relative.oracle;
            variance.power += weight * relative.power;
        }
    return variance;
}

} // namespace blush::test
