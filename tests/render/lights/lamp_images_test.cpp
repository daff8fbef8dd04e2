// Shadow rays that end before lamps (lamp_clearance.h) see the light of those that end at them.
#include "tests/render/lights/lamp_rooms.h"

#include "core/math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

struct LampCase {
    const char* name;
    std::function<void(Scene&)> add;
    bool clear;                        // some lamp stands clear
    double max_different = 1.0 / 5000; // of the values
};
const LampCase lamp_cases[]{
    {"Ball",
     [](Scene& s) {
         place(s, sphere(false), glow(), at({0, 0, 0}, 0.6f));
     },
     true},
    {"Tube",
     [](Scene& s) {
         place(s, capsule(12, 24, 8), glow(), at({0, 0.5f, 0}, 0.1f));
     },
     true},
    {"Mirrored",
     [](Scene& s) {
         place(s, sphere(false), glow(), stretched({0, 0, 0}, {-0.6f, 0.6f, 0.6f}));
     },
     true},
    {"Stretched",
     [](Scene& s) {
         place(s, capsule(12, 24, 1), glow(), stretched({0, 0, 0}, {0.9f, 0.3f, 0.1f}));
     },
     true},
    {"Copies",
     [](Scene& s) {
         const Id<Mesh> shared = s.meshes.add({"", {{sphere(false), s.materials.add(glow())}}});
         for (const float x : {-1.2f, 0.8f, 2.4f}) {
             Node node;
             node.mesh = shared;
             node.local = stretched({x, 0, -0.5f}, {x > 2 ? -0.4f : 0.4f, 0.3f, 0.5f});
             s.nodes.add(node);
         }
     },
     true},
    {"TwoSided",
     [](Scene& s) {
         place(s, sphere(false), glow(true), at({0, 0, 0}, 0.6f));
     },
     true},
    {"TwoSidedDome",
     [](Scene& s) {
         place(s, hemisphere(8, 24, false), glow(true), at({0, 0, 0}, 0.8f));
     },
     true},
    {"TwoSidedTorus",
     [](Scene& s) {
         place(s, torus(24, 12, 1, 0.3f), glow(true), at({0, 0, 0}, 0.8f));
     },
     true},
    {"InvertedTwoSided",
     [](Scene& s) {
         place(s, sphere(true), glow(true), at({0, 0, 0}, 0.6f));
     },
     false},
    {"Bowl",
     [](Scene& s) {
         Transform upside = at({0, 0, 0}, 0.8f);
         upside.scale.y = -0.8f;
         place(s, hemisphere(8, 24, true), glow(), upside);
     },
     false},
    {"Torus",
     [](Scene& s) {
         place(s, torus(24, 12, 1, 0.3f), glow(), at({0, 0, 0}, 0.8f));
     },
     true},
    {"TwoCubes",
     [](Scene& s) {
         place(s, joined({grid_cube(3), moved(grid_cube(3), {3, 0, 0})}), glow(), at({-0.5f, 0, 0}, 0.4f));
     },
     true},
    {"Star", // a spike hides its neighbourhood
     [](Scene& s) {
         Geometry g = *ball(8, 16);
         g.serial = next_payload_serial();
         g.positions[4 * 16 + 3] = g.positions[4 * 16 + 3] * 2;
         place(s, std::make_shared<const Geometry>(g), glow(), at({0, 0, 0}, 0.5f));
     },
     true},
    {"Veiled", // stochastic opacity
     [](Scene& s) {
         place(s, sphere(false), glow(), at({0, 0.5f, 0}, 0.4f));
         Material veil = lambert(0.8f);
         veil.alpha = Material::Alpha::blend;
         veil.opacity = 0.5f;
         place(s, floor_quad(1, -0.5f), veil);
     },
     true},
    {"BehindAPane",
     [](Scene& s) {
         place(s, sphere(false), glow(), at({0, 0.5f, 0}, 0.4f));
         place(s, quad({-2, -2, 1.2f}, {0, -2, 1.2f}, {0, 2, 1.2f}, {-2, 2, 1.2f}), gel({0.5f, 0.9f, 0.5f}));
     },
     true, 1.0 / 200}, // behind a pane a ray is off its line by rounding, and may meet the lamp beside the point
};

class LampImages : public testing::TestWithParam<LampCase> {};

// Bit by bit but for single rays that rounding lets graze the lamp.
TEST_P(LampImages, AreThoseOfWholeShadowRays) {
    Scene scene = room();
    GetParam().add(scene);
    const CompiledLamps compiled(scene);
    const std::vector<bool> clear = compiled.clear();
    EXPECT_EQ(std::ranges::count(clear, true) > 0, GetParam().clear);
    const std::vector<double> early = compiled.render(false), whole = compiled.render(true);
    int64_t lit = 0, different = 0;
    for (size_t i = 0; i < early.size(); ++i) {
        lit += whole[i] > 0;
        different += early[i] != whole[i];
        EXPECT_GE(early[i], whole[i]) << "only the lamp itself is not hit any more";
    }
    EXPECT_GT(lit, int64_t(early.size()) / 10);
    EXPECT_LE(double(different), GetParam().max_different * double(early.size()));
}

INSTANTIATE_TEST_SUITE_P(Shapes, LampImages, testing::ValuesIn(lamp_cases), [](const auto& test) { return test.param.name; });

// Sheets, balls and lights of all sizes around three lamps: some lamps are hemmed in, some not.
TEST(LampClearance, ImagesAreTheSameAmongRandomBlockers) {
    std::mt19937 bits(11);
    const auto random = [&](float low, float high) { return low + (high - low) * float(bits() >> 8) * 0x1p-24f; };
    int64_t clear = 0, hemmed_in = 0, different = 0, values = 0;
    for (int round = 0; round < 30; ++round) {
        Scene scene = room();
        for (const float x : {-1.5f, 0.f, 1.5f})
            place(scene, ball(8, 16), glow(), at({x, random(-1, 1), random(-1, 1)}, random(0.1f, 0.5f)));
        for (int i = 0; i < 6; ++i) {
            const Transform where = stretched({random(-3, 3), random(-1.5f, 2), random(-2, 2)},
                                              {random(0.05f, 0.6f), random(0.05f, 0.6f), random(-0.6f, -0.05f)});
            if (i == 0) {
                Light light;
                light.kind = Light::Kind(3 + bits() % 3);
                light.radius = 0.3f;
                place_light(scene, light, where);
            } else
                place(scene, i % 2 ? floor_quad(1) : sphere(false), i % 3 ? lambert(0.5f) : metal(0.3f), where);
        }
        const CompiledLamps compiled(scene);
        for (const bool one : compiled.clear()) ++(one ? clear : hemmed_in);
        const std::vector<double> early = compiled.render(false), whole = compiled.render(true);
        for (size_t i = 0; i < early.size(); ++i) different += early[i] != whole[i];
        values += int64_t(early.size());
    }
    EXPECT_GT(clear, 20);
    EXPECT_GT(hemmed_in, 10);
    EXPECT_LE(different, values / 5000);
}

} // namespace
} // namespace blush::test::TEST_FILE
