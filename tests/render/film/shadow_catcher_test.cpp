// Shadow catchers: the opacity of shadows against closed forms and an independent quadrature; everything else is unchanged.
#include "render/compile/render_scene.h"
#include "render/film/film_state.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

constexpr float plate_half = 0.25f, plate_height = 1, lamp_height = 2;

void make_shadow_catcher(Scene& scene, Id<Node> id) {
    Node node = *scene.nodes.find(id);
    node.shadow_catcher = true;
    scene.nodes.set(id, node);
}

// A shadow-catching floor, a square plate above it, and a camera between the two that looks down.
struct Stage {
    Scene scene;
    Id<Node> floor;

    explicit Stage(const Light& light) {
        floor = place(scene, floor_quad(5), lambert({0.8f, 0.8f, 0.8f}));
        place(scene, floor_quad(plate_half), lambert({0.5f, 0.5f, 0.5f}), at({0, plate_height, 0}));
        place_light(scene, light, aimed({0, lamp_height, 0}, {0, -1, 0}));
        scene.view = looking({0, 0.9f, 0.01f}, {0, 0, 0}, 1.6f);
        make_shadow_catcher(scene, floor);
    }
    // Floor point of the ray through an image position in pixels.
    Vec3d on_floor(double x, double y, int width, int height) const {
        const CameraRecord c = camera_record(scene.view, float(width) / float(height), {0, 0, 0});
        const Vec3d d = to_double(c.forward) + to_double(c.right) * (2 * x / width - 1) - to_double(c.up) * (2 * y / height - 1);
        return to_double(c.position) - d * (double(c.position.y) / d.y);
    }
};

Light bulb() {
    Light light;
    light.intensity = 10;
    return light;
}

Frame render(const Scene& scene, const RenderSettings& settings, unsigned threads = 2) {
    Renderer renderer({.threads = threads});
    renderer.update(scene, settings);
    EXPECT_TRUE(renderer.render(0, settings.spp));
    return renderer.resolve();
}

float alpha_at(const Frame& f, int x, int y) { return f.rgba[4 * (size_t(y) * size_t(f.width) + size_t(x)) + 3]; }

// The plate's shadow from a point light is a square of twice its size: opacity 1 inside, 0 outside.
void expect_sharp_shadow(const Stage& stage, const Frame& f, const PixelRect& rendered) {
    constexpr double edge = 2 * double(plate_half), margin = 0.12;
    int within = 0, without = 0;
    for (int y = rendered.y0; y < rendered.y1; ++y)
        for (int x = rendered.x0; x < rendered.x1; ++x) {
            const Vec3d p = stage.on_floor(x + 0.5, y + 0.5, f.width, f.height);
            const double reach = std::max(std::abs(p.x), std::abs(p.z));
            if (std::abs(reach - edge) < margin) continue;
            ASSERT_EQ(alpha_at(f, x, y), reach < edge ? 1 : 0) << x << ' ' << y << ", at " << p.x << ' ' << p.z;
            ++(reach < edge ? within : without);
        }
    EXPECT_GT(within, 50);
    EXPECT_GT(without, 50);
}

TEST(ShadowCatcher, HasTheSharpShadowOfAPoint) {
    const Stage stage(bulb());
    const Frame f = render(stage.scene, settings_for(48, 48, 4));
    EXPECT_TRUE(f.transparent);
    expect_sharp_shadow(stage, f, {0, 0, 48, 48});
    for (size_t i = 0; i < f.rgba.size() / 4; ++i)
        for (size_t c = 0; c < 3; ++c) ASSERT_EQ(f.rgba[4 * i + c], 0) << "a shadow is black, and the catcher is invisible";
}

// Without noise: one sample of each pixel has the plate's opacity.
TEST(ShadowCatcher, HasTheThinShadowOfABlendedPlate) {
    Stage stage(bulb());
    Material veil = lambert(0.5f);
    veil.alpha = Material::Alpha::blend;
    veil.opacity = 0.3f;
    place(stage.scene, floor_quad(4), veil, at({0, plate_height - 0.05f, 0}));
    place(stage.scene, floor_quad(4), veil, at({0, plate_height - 0.06f, 0}));
    // A catcher that the light passes as well is no shadow.
    make_shadow_catcher(stage.scene, place(stage.scene, floor_quad(4), veil, at({0, plate_height - 0.07f, 0})));
    const Frame f = render(stage.scene, settings_for(48, 48, 1));
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            const Vec3d p = stage.on_floor(x + 0.5, y + 0.5, 48, 48);
            const double reach = std::max(std::abs(p.x), std::abs(p.z));
            if (std::abs(reach - 2 * double(plate_half)) < 0.12) continue;
            ASSERT_NEAR(alpha_at(f, x, y), reach < 0.5 ? 1 : 1 - 0.7 * 0.7, 1e-5) << x << ' ' << y;
        }
}

TEST(ShadowCatcher, WorksInRegionsAndAdaptiveRenders) {
    const Stage stage(bulb());
    RenderSettings settings = settings_for(48, 48, 32);
    settings.adaptive = true;
    expect_sharp_shadow(stage, render(stage.scene, settings), {0, 0, 48, 48});
    settings.adaptive = false;
    settings.spp = 4;
    const Frame whole = render(stage.scene, settings);
    settings.region = {0.25f, 0.25f, 0.5f, 0.5f};
    const Frame part = render(stage.scene, settings);
    for (int y = 12; y < 36; ++y)
        for (int x = 12; x < 36; ++x) ASSERT_EQ(alpha_at(part, x, y), alpha_at(whole, x, y));
    EXPECT_EQ(alpha_at(part, 0, 0), 0);
}

// Share of a disk light's irradiance at a floor point that the plate blocks, by plain quadrature.
double hidden_share(const Vec3d& p, double radius) {
    constexpr int rings = 96, spokes = 192;
    double all = 0, hidden = 0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < spokes; ++k) {
            const double r = radius * std::sqrt((i + 0.5) / rings), a = 2 * std::numbers::pi * (k + 0.5) / spokes;
            const Vec3d to = Vec3d{r * std::cos(a), double(lamp_height), r * std::sin(a)} - p;
            const double d2 = dot(to, to), e = to.y * to.y / (d2 * d2); // both cosines are to.y / d
            const Vec3d crossing = p + to * (double(plate_height) / double(lamp_height));
            all += e;
            if (std::max(std::abs(crossing.x), std::abs(crossing.z)) < double(plate_half)) hidden += e;
        }
    return hidden / all;
}

TEST(ShadowCatcher, HasTheSoftShadowOfADisk) {
    Light light;
    light.kind = Light::Kind::disk;
    light.radius = 0.6f;
    light.intensity = 3;
    const Stage stage(light);
    constexpr int size = 24, block = 4, seeds = 12;
    std::vector<std::vector<double>> values(size_t(size / block) * size_t(size / block));
    for (int seed = 0; seed < seeds; ++seed) {
        RenderSettings settings = settings_for(size, size, 256);
        settings.seed = uint32_t(seed + 1);
        const Frame f = render(stage.scene, settings);
        for (size_t b = 0; b < values.size(); ++b) {
            const int left = int(b % size_t(size / block)) * block, top = int(b / size_t(size / block)) * block;
            double sum = 0;
            for (int y = top; y < top + block; ++y)
                for (int x = left; x < left + block; ++x) sum += double(alpha_at(f, x, y));
            values[b].push_back(sum / (block * block));
        }
    }
    int partial = 0;
    for (size_t b = 0; b < values.size(); ++b) {
        const int left = int(b % size_t(size / block)) * block, top = int(b / size_t(size / block)) * block;
        double expected = 0, mean = 0, square = 0;
        constexpr int points = 2 * block; // along each side
        for (int j = 0; j < points; ++j)
            for (int i = 0; i < points; ++i)
                expected += hidden_share(stage.on_floor(left + (i + 0.5) / 2, top + (j + 0.5) / 2, size, size), double(light.radius)) /
                            (points * points);
        for (const double v : values[b]) mean += v / seeds;
        for (const double v : values[b]) square += (v - mean) * (v - mean) / (seeds - 1);
        // Besides noise: the quadratures' own errors, and the bias of a ratio of 256 samples.
        constexpr double slack = 0.004, z = 4.5;
        EXPECT_NEAR(mean, expected, z * std::sqrt(square / seeds) + slack) << "block " << b;
        partial += expected > 0.05 && expected < 0.95;
    }
    EXPECT_GT(partial, 8) << "the test must cover the penumbra";
}

TEST(ShadowCatcher, DoesNotDependOnThreadsAndResumesFromAFile) {
    Light light = bulb();
    light.radius = 0.2f;
    const Stage stage(light);
    const RenderSettings settings = settings_for(40, 32, 8);
    const Frame one = render(stage.scene, settings, 1);
    EXPECT_EQ(render(stage.scene, settings, 3).rgba, one.rgba);

    Renderer first({.threads = 2}), second({.threads = 2});
    first.update(stage.scene, settings);
    first.render(0, 3);
    const Result<FilmState> film = first.save_film(0);
    ASSERT_TRUE(film);
    second.update(stage.scene, settings);
    ASSERT_TRUE(second.load_film(*film));
    second.render(3, 5);
    EXPECT_EQ(second.resolve().rgba, one.rgba);
    const Result<ResolvedFilm> read = resolve_film(*second.save_film(0), settings);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->frame.rgba, one.rgba) << "restored from the sums alone";
    EXPECT_TRUE(read->frame.transparent);
}

TEST(ShadowCatcher, DarkensTheEnvironmentThatTheCameraSees) {
    Stage stage(bulb());
    constant_world(stage.scene, 0.5f);
    stage.scene.environment.lights_scene = false; // a backdrop
    const Frame f = render(stage.scene, settings_for(48, 48, 4));
    EXPECT_FALSE(f.transparent);
    const auto red = [&](int x, int y) { return f.rgba[4 * (size_t(y) * 48 + size_t(x))]; };
    EXPECT_NEAR(double(red(24, 24)), 0, 1e-6);
    EXPECT_NEAR(double(red(2, 2)), 0.5, 1e-6);
    EXPECT_EQ(alpha_at(f, 24, 24), 1);

    stage.scene.environment.lights_scene = true;
    stage.scene.environment.visible_to_camera = false;
    const Frame hidden = render(stage.scene, settings_for(48, 48, 16));
    EXPECT_TRUE(hidden.transparent);
    EXPECT_GT(alpha_at(hidden, 24, 24), 0.3f) << "the plate blocks the light, but only a part of the environment";
    EXPECT_LT(alpha_at(hidden, 24, 24), 0.98f);
    EXPECT_LT(alpha_at(hidden, 1, 1), 0.2f);
}

// Light reflected by a catcher illuminates objects as with any floor, and a catcher occludes them as any floor does.
TEST(ShadowCatcher, IsAnOrdinarySurfaceForNonCameraRays) {
    Scene scene;
    const Id<Node> floor = place(scene, floor_quad(4), lambert({0.9f, 0.3f, 0.2f}));
    place(scene, sphere(false), lambert({0.7f, 0.7f, 0.7f}), at({0, 0.6f, 0}, 0.5f));
    place_light(scene, bulb(), at({1, 2, 1}));
    scene.view = looking({0, 1.2f, 3}, {0, 0.5f, 0}, 0.7f);
    RenderSettings settings = settings_for(32, 32, 1);
    const PlaneSet planes{.depth = true, .ids = true};
    const auto image = [&] {
        Renderer renderer({.threads = 1, .planes = planes});
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        return renderer.resolve();
    };
    const Frame plain = image();
    make_shadow_catcher(scene, floor);
    const Frame caught = image();
    int objects = 0;
    for (size_t i = 0; i < plain.object_id.size(); ++i) {
        if (plain.object_id[i] == floor.value) {
            EXPECT_EQ(caught.object_id[i], 0u) << "no object there";
            continue;
        }
        ASSERT_EQ(caught.object_id[i], plain.object_id[i]);
        if (plain.object_id[i] == 0) continue;
        ++objects;
        for (size_t c = 0; c < 4; ++c) ASSERT_EQ(caught.rgba[4 * i + c], plain.rgba[4 * i + c]);
    }
    EXPECT_GT(objects, 100);
}

TEST(ShadowCatcher, DoesNotCatchTheShadowsOfCatchers) {
    Scene scene;
    Node cove;
    cove.name = "Cove";
    const Id<Node> group = scene.nodes.add(cove);
    for (const Id<Node> id : {place(scene, floor_quad(5), lambert({0.8f, 0.8f, 0.8f})),
                              place(scene, floor_quad(plate_half), lambert({0.5f, 0.5f, 0.5f}), at({0, 1, 0}))}) {
        Node node = *scene.nodes.find(id);
        node.parent = group;
        scene.nodes.set(id, node);
    }
    place_light(scene, bulb(), aimed({0, lamp_height, 0}, {0, -1, 0}));
    scene.view = looking({0, 0.9f, 0.01f}, {0, 0, 0}, 1.6f);
    make_shadow_catcher(scene, group); // and with it all below
    for (const float v : render(scene, settings_for(32, 32, 2)).rgba) ASSERT_EQ(v, 0);
}

TEST(ShadowCatcher, SwitchedOnAndOffKeepsTheImage) {
    Stage stage(bulb());
    const RenderSettings settings = settings_for(24, 24, 2);
    const Frame caught = render(stage.scene, settings);
    Scene plain = stage.scene;
    Node node = *plain.nodes.find(stage.floor);
    node.shadow_catcher = false;
    plain.nodes.set(stage.floor, node);
    const Frame seen = render(plain, settings);
    Renderer renderer({.threads = 2});
    for (const auto& [scene, expected] : {std::pair{&plain, &seen}, {&stage.scene, &caught}, {&plain, &seen}}) {
        EXPECT_TRUE(renderer.update(*scene, settings));
        renderer.render(0, settings.spp);
        EXPECT_EQ(renderer.resolve().rgba, expected->rgba);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
