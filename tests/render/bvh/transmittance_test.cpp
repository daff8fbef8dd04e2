// The transmittance of a ray does not depend on the other rays of its packet, although these change the order of its hits.
#include "render/compile/render_scene.h"
#include "render/compile/update_plan.h"
#include "tests/render/scenes.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

struct Numbers {
    std::mt19937 bits{3};
    float operator()() { return 2 * float(bits() >> 8) * 0x1p-24f - 1; } // in [-1, 1)
};

// Leaves in all directions, of different opacities.
Scene leaves(Numbers& random) {
    auto g = std::make_shared<Geometry>();
    for (uint32_t i = 0; i < 6000; ++i) {
        const Vec3 at{random(), random(), random()};
        const float opacity = 0.02f + 0.1f * (1 + random());
        for (uint32_t k = 0; k < 3; ++k) {
            g->positions.push_back({at.x + 0.15f * random(), at.y + 0.15f * random(), at.z + 0.15f * random()});
            g->colors.push_back({1, 1, 1, opacity});
            g->indices.push_back(3 * i + k);
        }
    }
    Material veil = lambert(0.5f);
    veil.alpha = Material::Alpha::blend;
    veil.double_sided = true;
    Scene scene;
    place(scene, g, veil);
    return scene;
}

struct Rays {
    int count = 0;
    std::array<std::vector<float>, 6> columns; // origins and directions

    RayArrays arrays() const {
        const auto at = [&](size_t k) { return columns[k].data(); };
        return {at(0), at(1), at(2), at(3), at(4), at(5), nullptr, nullptr};
    }
    Rays in_order(const std::vector<int>& order) const {
        Rays rays{count, {}};
        for (size_t k = 0; k < 6; ++k) {
            for (const int i : order) rays.columns[k].push_back(columns[k][size_t(i)]);
            rays.columns[k].resize(size_t(count) + 16);
        }
        return rays;
    }
};

TEST(AccelTransmittance, DoesNotDependOnTheOtherRays) {
    Numbers random;
    const Workers workers(1);
    RenderScene compiled;
    compiled.update(leaves(random), RenderSettings{}, full_plan(), workers);
    Rays rays{20'000, {}};
    for (size_t k = 0; k < 6; ++k)
        for (int i = 0; i < rays.count; ++i) rays.columns[k].push_back(random());
    std::vector<int> order(size_t(rays.count));
    std::iota(order.begin(), order.end(), 0);
    rays = rays.in_order(order);
    std::vector<float> once(size_t(rays.count)), again = once;
    workers.run([&] { compiled.accel().transmittance(rays.arrays(), rays.count, false, once.data()); });
    EXPECT_GT(std::ranges::count_if(once, [](float t) { return t > 0 && t < 0.5f; }), rays.count / 10);
    std::shuffle(order.begin(), order.end(), random.bits);
    const Rays shuffled = rays.in_order(order);
    for (const bool coherent : {false, true}) {
        workers.run([&] { compiled.accel().transmittance(shuffled.arrays(), rays.count, coherent, again.data()); });
        int different = 0;
        for (int i = 0; i < rays.count; ++i) different += again[size_t(i)] != once[size_t(order[size_t(i)])];
        EXPECT_EQ(different, 0) << coherent;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
