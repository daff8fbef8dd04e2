// Many lights: variance of the light tree compared with an oracle and with power sampling, at single points and in an image, the
// latency of edits of lights, and the rate of MIS compared with BSDF sampling alone.
#include "tests/support/many_lights.h"
#include "tests/bench/bench.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/renderer.h"

#include <cmath>
#include <numbers>
#include <random>

namespace blush::bench {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

void add(Scene& scene, Geometry geometry, const Material& material, Vec3 place = {0, 0, 0}) {
    Node node;
    node.mesh = scene.meshes.add({"", {{std::make_shared<const Geometry>(std::move(geometry)), scene.materials.add(material)}}});
    node.local.translation = place;
    scene.nodes.add(node);
}

Geometry quad(Vec3 corner, Vec3 along, Vec3 up) {
    Geometry g;
    const auto sum = [](Vec3 a, Vec3 b) { return Vec3{a.x + b.x, a.y + b.y, a.z + b.z}; };
    g.positions = {corner, sum(corner, along), sum(sum(corner, along), up), sum(corner, up)};
    g.indices = {0, 1, 2, 0, 2, 3};
    return g;
}

Geometry ball(float radius, uint32_t rows, uint32_t columns) {
    Geometry g;
    for (uint32_t i = 0; i <= rows; ++i)
        for (uint32_t j = 0; j < columns; ++j) {
            const float theta = pi * float(i) / float(rows), phi = 2 * pi * float(j) / float(columns);
            g.positions.push_back(
                {radius * std::sin(theta) * std::sin(phi), radius * std::cos(theta), radius * std::sin(theta) * std::cos(phi)});
        }
    for (uint32_t i = 0; i < rows; ++i)
        for (uint32_t j = 0; j < columns; ++j) {
            const uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns, below = columns;
            if (i > 0) g.indices.insert(g.indices.end(), {a, a + below, b});
            if (i + 1 < rows) g.indices.insert(g.indices.end(), {b, a + below, b + below});
        }
    return g;
}

Material matte(float albedo) {
    Material m;
    m.base_color = {albedo, albedo, albedo};
    m.metallic = m.specular = 0;
    return m;
}
Material glow(float nits) {
    Material m = matte(0);
    m.emissive = {nits, nits, nits};
    return m;
}

// After figure 9.2 of Veach's thesis: five emissive spheres of 20,480 triangles together, four plates of growing roughness.
Scene veach_spheres() {
    Scene scene;
    add(scene, quad({-2, -0.42f, 2}, {4, 0, 0}, {0, 0, -2.35f}), matte(0.5f));
    add(scene, quad({-2, -0.42f, -0.35f}, {4, 0, 0}, {0, 2.02f, 0}), matte(0.5f));
    const Vec3 places[]{{-0.375f, 0, 0}, {-0.125f, 0, 0}, {0.125f, 0, 0}, {0.375f, 0, 0}, {0, 1.5f, 0.9f}};
    const float radii[]{0.0033f, 0.01f, 0.03f, 0.09f, 0.2f};
    for (int i = 0; i < 5; ++i) add(scene, ball(radii[i], 33, 64), glow(0.4f / (4 * pi * pi * radii[i] * radii[i])), places[i]);
    const Vec3 plates[]{{0, -0.24f, -0.02f}, {0, -0.305f, 0.09f}, {0, -0.357f, 0.22f}, {0, -0.39f, 0.36f}};
    for (int i = 0; i < 4; ++i) {
        Material metal;
        metal.base_color = {0.62f, 0.62f, 0.62f};
        metal.metallic = 1;
        metal.roughness = 0.06f + 0.09f * float(i);
        const float tilt = 0.75f - 0.22f * float(i); // towards the camera
        const Vec3 up{0, 0.104f * std::sin(tilt), -0.104f * std::cos(tilt)};
        add(scene, quad({-0.42f, plates[i].y - up.y / 2, plates[i].z - up.z / 2}, {0.84f, 0, 0}, up), metal);
    }
    scene.view.position = {0, 0.2f, 1.5f};
    scene.view.rotation = {-0.13413f, 0, 0, 0.99096f};
    scene.view.lens.yfov_radians = 0.49f;
    return scene;
}

// A room with 8000 small emissive triangles below the ceiling, and 300 points.
Scene sparks() {
    Scene scene;
    add(scene, quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), matte(0.6f));
    add(scene, quad({-5, 0, -5}, {10, 0, 0}, {0, 5, 0}), matte(0.6f));
    std::mt19937 bits(3);
    const auto random = [&](float low, float high) { return low + (high - low) * float(bits() >> 8) * 0x1p-24f; };
    Geometry g;
    for (int i = 0; i < 8000; ++i) {
        const Vec3 center{random(-4.5f, 4.5f), random(2.5f, 4.5f), random(-4.5f, 4.5f)};
        for (int k = 0; k < 3; ++k) {
            g.indices.push_back(uint32_t(g.positions.size()));
            g.positions.push_back({center.x + random(-0.03f, 0.03f), center.y + random(-0.03f, 0.03f), center.z + random(-0.03f, 0.03f)});
        }
    }
    add(scene, std::move(g), glow(35));
    for (int i = 0; i < 300; ++i) {
        Light light;
        light.kind = Light::Kind::point;
        light.intensity = random(0.05f, 0.5f);
        Node node;
        node.light = scene.lights.add(light);
        node.local.translation = {random(-4.5f, 4.5f), random(0.5f, 3), random(-4.5f, 4.5f)};
        scene.nodes.add(node);
    }
    scene.view.position = {0, 2.2f, 6.5f};
    scene.view.rotation = {-0.0797f, 0, 0, 0.9968f};
    scene.view.lens.yfov_radians = 0.87f;
    return scene;
}

// Core seconds of both strategies in turns, and the variance of MIS from two seeds.
Json compare_strategies(const Scene& scene, const Options& options) {
    constexpr int samples = 8;
    std::vector<double> ratios, mis_rates, bsdf_rates;
    const auto renderer_for = [&](Strategy strategy, uint32_t seed) {
        RenderSettings settings = rate_settings();
        settings.strategy = strategy;
        settings.seed = seed;
        settings.adaptive = false;
        settings.reuse = 1;
        auto renderer = std::make_unique<Renderer>(RendererOptions{.threads = options.threads, .planes = {}});
        renderer->update(scene, settings);
        renderer->render(0, 1); // warms up
        return renderer;
    };
    const auto mis = renderer_for(Strategy::mis, 0), other = renderer_for(Strategy::mis, 1), bsdf = renderer_for(Strategy::bsdf, 0);
    const auto seconds = [&](Renderer& renderer) {
        renderer.clear();
        return cost_of([&] { renderer.render(0, samples); }).core_seconds;
    };
    const double paths = double(rate_settings().width) * rate_settings().height * samples;
    for (int round = 0; round < options.rounds; ++round) {
        const double with_lights = seconds(*mis), without = seconds(*bsdf);
        ratios.push_back(without / with_lights);
        mis_rates.push_back(paths / with_lights / 1e6);
        bsdf_rates.push_back(paths / without / 1e6);
    }
    seconds(*other);
    const std::vector<float> a = mis->resolve().rgba, b = other->resolve().rgba;
    double squares = 0, sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        if (i % 4 == 3) continue;
        squares += std::pow(double(a[i] - b[i]), 2) / 2;
        sum += double(a[i] + b[i]) / 2;
    }
    const double values = double(a.size()) * 3 / 4, mean = sum / values;
    return {{"mis_million_paths_per_core_second", rounded(median(mis_rates))},
            {"bsdf_million_paths_per_core_second", rounded(median(bsdf_rates))},
            {"mis_over_bsdf_rate", rounded(median(ratios))},
            {"mis_relative_variance", rounded(squares / values / (mean * mean))}};
}

} // namespace

Json run_many_lights(const Options& options) {
    Json result = Json::array();
    for (const auto& [name, scene] : {std::pair("veach_spheres", veach_spheres()), {"sparks", sparks()}}) {
        Json figures = compare_strategies(scene, options);
        figures["scene"] = name;
        result.push_back(figures);
    }
    for (const int rooms : {3, 6, 20}) {
        const RenderSettings settings;
        Scene scene = expand_area_lights(test::house(rooms));
        RenderScene compiled;
        compiled.update(scene, settings, full_plan(), Workers(1));
        UpdatePlan relight;
        relight.lights = true;
        std::vector<double> seconds;
        for (int round = 0; round < options.rounds; ++round)
            seconds.push_back(cost_of([&] { compiled.update(scene, settings, relight, Workers(1)); }).core_seconds);
        const test::SelectionVariance v = test::choice_variance(compiled.tables(), rooms, 200);
        const test::ImageVariance image = test::image_variance(rooms, 64);
        result.push_back({{"lights", rooms * rooms * 25},
                          {"relative_variance", {{"oracle", rounded(v.oracle)}, {"tree", rounded(v.tree)}, {"power", rounded(v.power)}}},
                          {"tree_over_oracle", rounded(v.tree / v.oracle)},
                          {"power_over_tree", rounded(v.power / v.tree)},
                          {"image_rendered_over_oracle", rounded(image.rendered / image.oracle)},
                          {"image_power_over_rendered", rounded(image.power / image.rendered)},
                          {"relight_ms", rounded(median(seconds) * 1e3)}});
    }
    return result;
}

} // namespace blush::bench
