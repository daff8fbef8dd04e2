// First hits alone, by which coarse images are enlarged.
#include "core/math.h"
#include "render/renderer.h"
#include "tests/render/session/recording_session.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr int width = 96, height = 64;

test::Sample sample() {
    test::Sample s = test::sample_project();
    s.project.render.width = width;
    s.project.render.height = height;
    return s;
}

Renderer renderer_with_planes() { return Renderer({.threads = 2, .planes = {.albedo = true, .normal = true, .depth = true}}); }

TEST(FirstHits, AreThoseOfTheFilm) {
    const test::Sample s = sample();
    Renderer renderer = renderer_with_planes();
    renderer.update(s.project.scene, s.project.render);
    const FirstHitPlanesPtr traced = renderer.trace_first_hits();
    ASSERT_EQ(traced->width, width);
    ASSERT_EQ(traced->height, height);
    EXPECT_EQ(renderer.first_hits(), traced);
    renderer.render(0, 4);
    const Frame frame = renderer.resolve();
    // Rays of the film pass all over a pixel, so they differ at edges.
    size_t alike = 0, hits = 0;
    for (size_t i = 0; i < traced->depth.size(); ++i) {
        hits += traced->depth[i] > 0;
        alike += length(traced->albedo[i] - frame.albedo[i]) < 0.02f && length(traced->normal[i] - frame.normal[i]) < 0.02f &&
                 std::abs(traced->depth[i] - frame.depth[i]) <= 0.02f * frame.depth[i];
    }
    EXPECT_GT(hits, traced->depth.size() / 10);
    EXPECT_GT(alike, traced->depth.size() * 9 / 10);
}

TEST(FirstHits, LeaveTheSamplesAsTheyAre) {
    const test::Sample s = sample();
    RenderSettings settings = s.project.render;
    settings.adaptive = true;
    Renderer renderer = renderer_with_planes();
    renderer.update(s.project.scene, settings);
    renderer.render(0, 2);
    renderer.trace_first_hits();
    renderer.render(2, 30);
    Renderer other = renderer_with_planes();
    other.update(s.project.scene, settings);
    other.render(0, 2);
    other.render(2, 30);
    const Frame a = renderer.resolve(), b = other.resolve();
    EXPECT_TRUE(test::same_pixels(a, b));
    EXPECT_EQ(a.rays.camera, b.rays.camera);
    EXPECT_EQ(a.rays.bounce, b.rays.bounce);
}

struct Edit {
    std::string name;
    bool keeps;
    std::function<void(test::Sample&)> apply;
};

template <class T> void change(Table<T>& table, Id<T> id, auto&& with) {
    T record = *table.find(id);
    with(record);
    table.set(id, record);
}

std::vector<Edit> edits() {
    return {
        {"intensity", true, [](auto& s) { change(s.project.scene.lights, s.lamp, [](Light& l) { l.intensity *= 2; }); }},
        {"light colour", true, [](auto& s) { change(s.project.scene.lights, s.lamp, [](Light& l) {
                                                 l.color = {1, 0, 0};
                                             }); }},
        {"emission", true, [](auto& s) { change(s.project.scene.materials, s.grey, [](Material& m) {
                                             m.emissive = {1, 2, 3};
                                         }); }},
        {"stop rules", true, [](auto& s) { s.project.render.spp = 99; }},
        {"radius", false, [](auto& s) { change(s.project.scene.lights, s.lamp, [](Light& l) { l.radius = 0.2f; }); }},
        {"albedo", false,
         [](auto& s) { change(s.project.scene.materials, s.grey, [](Material& m) {
                           m.base_color = {0.1f, 0.2f, 0.3f};
                       }); }},
        {"environment", true, [](auto& s) { s.project.scene.environment.intensity += 1; }},
        {"camera", false, [](auto& s) { s.project.scene.view.position.x += 0.1f; }},
        {"object", false, [](auto& s) { change(s.project.scene.nodes, s.table, [](Node& n) { n.local.translation.x += 0.1f; }); }},
        {"resolution", false, [](auto& s) { s.project.render.width = 100; }},
    };
}

TEST(FirstHits, AreKeptByEditsOfLightAlone) {
    for (const Edit& edit : edits()) {
        test::Sample s = sample();
        Renderer renderer = renderer_with_planes();
        renderer.update(s.project.scene, s.project.render);
        const FirstHitPlanesPtr traced = renderer.trace_first_hits();
        edit.apply(s);
        renderer.update(s.project.scene, s.project.render);
        if (edit.keeps) {
            EXPECT_EQ(renderer.first_hits(), traced) << edit.name;
            const FirstHitPlanesPtr anew = renderer.trace_first_hits();
            for (size_t i = 0; i < traced->depth.size(); ++i) {
                ASSERT_EQ(anew->depth[i], traced->depth[i]) << edit.name;
                if (traced->depth[i] > 0) { ASSERT_EQ(anew->albedo[i], traced->albedo[i]) << edit.name; }
            }
        } else {
            EXPECT_EQ(renderer.first_hits(), nullptr) << edit.name;
        }
    }
}

TEST(FirstHits, AreNotSharpWithAnApertureOrATransparentImage) {
    test::Sample s = sample();
    Renderer renderer = renderer_with_planes();
    renderer.update(s.project.scene, s.project.render);
    EXPECT_TRUE(renderer.has_sharp_first_hits());
    s.project.scene.view.lens.aperture_radius = 0.1f;
    renderer.update(s.project.scene, s.project.render);
    EXPECT_FALSE(renderer.has_sharp_first_hits());
    s.project.scene.view.lens.aperture_radius = 0;
    s.project.scene.environment.kind = Environment::Kind::constant;
    s.project.scene.environment.visible_to_camera = false;
    renderer.update(s.project.scene, s.project.render);
    EXPECT_FALSE(renderer.has_sharp_first_hits());
}

// In place of the networks.
Result<std::optional<Denoised>> unchanged(const DenoiseInput& input, const DenoiseOptions&, const std::function<bool()>&) {
    Denoised denoised;
    for (size_t i = 0; i < size_t(input.width) * size_t(input.height); ++i)
        for (size_t k = 0; k < 3; ++k) denoised.rgb.push_back(input.color.values[i * size_t(input.color.stride) + k]);
    return std::optional(std::move(denoised));
}

Project large_project() {
    Project project = test::sample_project().project;
    project.render.width = project.render.height = 512;
    project.render.spp = 2;
    return project;
}

void brighten(Project& project, uint64_t revision) {
    const auto [id, light] = project.scene.lights.entries()[0];
    change(project.scene.lights, id, [&](Light& l) { l.intensity = float(revision); });
}
void orbit(Project& project, uint64_t revision) { project.scene.view.position.x += 0.05f * float(revision); }

// The first denoised images of a few edits, each of a coarse frame.
std::vector<test::Event> dragged(const Project& project, void (*edit)(Project&, uint64_t) = brighten) {
    test::RecordingSession session(2, {}, unchanged);
    session->want_denoised(true);
    constexpr uint64_t learnt = 3, last = 6; // before, the speed of denoising is not known
    for (uint64_t revision = 1; revision <= last; ++revision) {
        Project edited = project;
        edit(edited, revision);
        session->submit(revision, edited.scene, edited.render);
        session.wait_for([&](const test::Event& e) {
            return e.denoised && e.denoised->revision == revision && e.denoised->quality == DenoiseQuality::high;
        });
    }
    session.shut_down();
    std::map<uint64_t, test::Event> first;
    for (const test::Event& e : session.events())
        if (e.denoised && e.denoised->revision > learnt && e.denoised->divider > 1) first.try_emplace(e.denoised->revision, e);
    std::vector<test::Event> events;
    for (const auto& [revision, e] : first) events.push_back(e);
    return events;
}

TEST(FirstHits, EnlargeDenoisedCoarseImages) {
    const std::vector<test::Event> events = dragged(large_project());
    ASSERT_FALSE(events.empty()) << "no image was coarse";
    for (const test::Event& e : events) {
        const DenoisedImage& image = *e.denoised;
        EXPECT_TRUE(image.is_enlarged);
        // Edits of light keep the first hits of the full image before.
        EXPECT_EQ(image.width, 512);
        EXPECT_EQ(image.height, 512);
        EXPECT_EQ(image.denoised.rgb.size(), size_t(3 * 512 * 512));
    }
}

TEST(ViewHistory, BeginsTheImagesOfAMovedCamera) {
    const std::vector<test::Event> events = dragged(large_project(), orbit);
    ASSERT_FALSE(events.empty()) << "no image was coarse";
    for (const test::Event& e : events) {
        const DenoisedImage& image = *e.denoised;
        ASSERT_TRUE(image.has_history());
        const WithHistory& mixed = image.with_history;
        EXPECT_EQ(mixed.width, image.is_enlarged ? 512 : 256);
        EXPECT_EQ(mixed.rgb.size(), size_t(3 * mixed.width * mixed.height));
        EXPECT_GT(mixed.share, 0.2f);
        EXPECT_LE(mixed.share, 1.f);
        // Those that are measured and saved have none.
        EXPECT_EQ(image.denoised.rgb.size(), size_t(3 * image.width * image.height));
        if (image.is_enlarged) continue;
        for (size_t i = 0; i < e.frame->rgba.size() / 4; ++i) ASSERT_EQ(image.denoised.rgb[3 * i], e.frame->rgba[4 * i]);
        const DenoisedPtr plain = without_history(image);
        EXPECT_FALSE(plain->has_history());
        EXPECT_EQ(plain->denoised.rgb, image.denoised.rgb);
    }
}

// As after N in the window.
TEST(ViewHistory, BeginsWithAnImageThatWasDenoisedLater) {
    test::RecordingSession session(2, {}, unchanged);
    Project project = large_project();
    session->submit(1, project.scene, project.render);
    session.wait_for(1, SessionStatus::State::complete);
    session->want_denoised(true);
    const test::Event denoised = session.wait_for([](const test::Event& e) { return e.denoised != nullptr; });
    EXPECT_EQ(denoised.denoised->divider, 1);
    ASSERT_TRUE(denoised.frame->camera);
    orbit(project, 2);
    session->submit(2, project.scene, project.render);
    const test::Event moved = session.wait_for([](const test::Event& e) { return e.denoised && e.denoised->revision == 2; });
    EXPECT_TRUE(moved.denoised->has_history());
}

TEST(ViewHistory, EndsWithEditsOfTheScene) {
    for (const test::Event& e : dragged(large_project())) EXPECT_FALSE(e.denoised->has_history());
    Project mixed = large_project();
    mixed.scene.mix.grouping = LightMix::Grouping::by_light;
    for (const test::Event& e : dragged(mixed, orbit)) EXPECT_FALSE(e.denoised->has_history()) << "groups are remixed";
    Project blurred = large_project();
    blurred.scene.view.lens.aperture_radius = 0.1f;
    for (const test::Event& e : dragged(blurred, orbit)) EXPECT_FALSE(e.denoised->has_history()) << "out of focus";
}

// Then history would only hold back what depends on the view.
TEST(ViewHistory, EndsWhenSamplesHaveQuadrupled) {
    test::RecordingSession session(2, {}, unchanged);
    session->want_denoised(true);
    for (uint64_t revision = 1; revision <= 3; ++revision) {
        Project project = large_project();
        project.render.spp = 8;
        orbit(project, revision);
        session->submit(revision, project.scene, project.render);
        const test::Event last = session.wait_for([&](const test::Event& e) {
            return e.denoised && e.denoised->revision == revision && e.denoised->quality == DenoiseQuality::high;
        });
        EXPECT_EQ(last.denoised->samples, 8);
        EXPECT_FALSE(last.denoised->has_history());
    }
}

TEST(FirstHits, DoNotEnlargeImagesOfACameraWithAnAperture) {
    Project project = large_project();
    project.scene.view.lens.aperture_radius = 0.1f;
    const std::vector<test::Event> events = dragged(project);
    ASSERT_FALSE(events.empty()) << "no image was coarse";
    for (const test::Event& e : events) {
        EXPECT_FALSE(e.denoised->is_enlarged);
        EXPECT_EQ(e.denoised->width, e.frame->width);
    }
}

} // namespace
} // namespace blush::TEST_FILE
