#include "support/many_lights.h"

#include "core/math.h"
#include "shading/light.h"

#include <cmath>
#include <random>

namespace blush::test {
namespace {

constexpr int lamps_in_a_row = 5;
constexpr float side = 4, ceiling = 2.8f; // metres

class Random {
public:
    float operator()(float low = 0, float high = 1) { return low + (high - low) * float(bits_() >> 8) * 0x1p-24f; }

private:
    std::mt19937 bits_{17};
};

} // namespace

Scene house(int rooms) {
    Scene scene;
    auto floor = std::make_shared<Geometry>();
    const float end = float(rooms) * side;
    floor->positions = {{0, 0, 0}, {0, 0, end}, {end, 0, end}, {end, 0, 0}};
    floor->indices = {0, 1, 2, 0, 2, 3};
    Node ground;
    ground.mesh = scene.meshes.add({"", {{floor, scene.materials.add({})}}});
    scene.nodes.add(ground);
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

ChoiceVariance choice_variance(const SceneTables& tables, int rooms, int receivers) {
    const LightTables& t = tables.lights;
    const int32_t n = rooms * rooms * lamps_in_a_row * lamps_in_a_row;
    // What power sampling goes by: 4 pi I, of a downlight a quarter of it.
    const auto power = [&](int32_t i) { return double(t.lights[i].emission.y) * (t.lights[i].profile >= 0 ? 0.25 : 1); };
    double total_power = 0;
    for (int32_t i = 0; i < n; ++i) total_power += power(i);
    const Vec3 origin = t.lights[0].position - Vec3{side / (2 * lamps_in_a_row), ceiling, side / (2 * lamps_in_a_row)}; // in the tables

    ChoiceVariance variance;
    Random random;
    for (int k = 0; k < receivers; ++k) {
        const int rx = int(random(0, float(rooms))), rz = int(random(0, float(rooms)));
        Receiver<float> to{origin + Vec3{(float(rx) + random()) * side, 0.001f, (float(rz) + random()) * side}, {0, 1, 0}};
        if (k % 3 == 2) { // on a wall
            to.position.x = origin.x + (float(rx) + 0.001f) * side;
            to.position.y = random(0.2f, 2.5f);
            to.normal = {1, 0, 0};
        }
        double given = 0, sum = 0, by_tree = 0, by_power = 0;
        for (int32_t i = 0; i < n; ++i) {
            const LightRecord& light = t.lights[i];
            const Vec3 way = light.position - to.position;
            const float d2 = dot(way, way);
            const Vec3 wi = way / std::sqrt(d2);
            double c = std::max(0.0, double(dot(wi, to.normal))) * double(light.emission.y) / double(d2);
            if (light.profile >= 0 && c > 0) c *= double(profile_factor<float>(t.profiles, light.profile, -wi, true));
            if (c <= 0) continue;
            given += c;
            const Vec3 in_house = light.position - origin;
            if (int(in_house.x / side) != rx || int(in_house.z / side) != rz) continue;
            sum += c;
            by_tree += c * c / double(light_probability<all_features, float>(t, to, i, true));
            by_power += c * c / (power(i) / total_power);
        }
        variance.oracle += (given / sum - 1) / receivers;
        variance.tree += (by_tree / (sum * sum) - 1) / receivers;
        variance.power += (by_power / (sum * sum) - 1) / receivers;
    }
    return variance;
}

} // namespace blush::test
