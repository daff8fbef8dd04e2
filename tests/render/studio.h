// A scene with one light of each kind, for tests of the light mix.
#pragma once

#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <algorithm>
#include <string>

namespace blush::test {

inline Light lamp(const char* name, Light::Kind kind, float intensity, const Vec3& color) {
    Light light;
    light.name = name;
    light.kind = kind;
    light.intensity = intensity;
    light.color = color;
    light.radius = 0.2f;
    return light;
}

// A floor and a box under one light of each kind, with an emissive sphere and a sky.
struct Studio {
    Scene scene;
    Id<Node> bulb, panel, ball;

    Studio() {
        place(scene, floor_quad(4), lambert({0.7f, 0.6f, 0.5f}));
        place(scene, cube(false), plastic(0.3f), at({0, 0.3f, 0}, 0.3f));
        bulb = place_light(scene, lamp("Bulb", Light::Kind::point, 3, {1, 0.8f, 0.6f}), at({-1, 2, 0}));
        scene.lights.set(light_of(bulb), [&] {
            Light l = light(bulb);
            l.radius = 0;
            return l;
        }());
        panel = place_light(scene, lamp("Panel", Light::Kind::rectangle, 2, {0.5f, 0.7f, 1}), aimed({1, 2, 0.5f}, {0, -1, 0}));
        Light sun = lamp("Sun", Light::Kind::sun, 1, {1, 1, 1});
        sun.angle_radians = 0.1f;
        place_light(scene, sun, aimed({0, 0, 0}, {0.3f, -1, 0.2f}));
        ball = place(scene, sphere(false), emitter(1.5f, 0.5f), at({1, 0.3f, -1}, 0.3f));
        constant_world(scene, 0.2f);
        scene.view = looking({0, 3, 4}, {0, 0.2f, 0}, 0.8f);
        scene.mix.grouping = LightMix::Grouping::by_light;
    }
    Id<Light> light_of(Id<Node> node) const { return scene.nodes.find(node)->light; }
    const Light& light(Id<Node> node) const { return *scene.lights.find(light_of(node)); }
    template <class With> void change(Id<Node> node, With&& with) {
        Light changed = light(node);
        with(changed);
        scene.lights.set(light_of(node), changed);
    }
    MixChannel& channel(const char* group) { return scene.mix.channels.emplace_back(MixChannel{.group = group}); }
};

inline Frame render_frame(const Scene& scene, const RenderSettings& settings, unsigned threads = 1) {
    Renderer renderer({.threads = threads, .planes = {}});
    renderer.update(scene, settings);
    renderer.render(settings.first_sample, settings.spp - settings.first_sample);
    return renderer.resolve();
}

inline double channel_of(const Vec3& v, int c) { return double(c == 0 ? v.x : c == 1 ? v.y : v.z); }

// Equal contributions summed in another order: in double precision, except for path reuse, whose sums are single.
inline void expect_planes_sum_to_beauty(const Frame& frame, double rounding, const std::string& what) {
    ASSERT_GT(frame.groups.size(), 0u) << what;
    for (size_t i = 0; i < frame.rgba.size() / 4; ++i)
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (size_t k = 0; k < frame.groups.size(); ++k) {
                EXPECT_GE(channel_of(frame.groups[k][i], c), 0);
                sum += channel_of(frame.groups[k][i], c) * channel_of(frame.gains[k], c);
            }
            const double whole = double(frame.rgba[4 * i + size_t(c)]);
            ASSERT_NEAR(sum, whole, std::max(sum, whole) * rounding) << what << " pixel " << i;
        }
}

} // namespace blush::test
