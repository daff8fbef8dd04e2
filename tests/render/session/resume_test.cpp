// Film states: a render continued from one is bit-identical to an uninterrupted render, in every plane.
#include "render/film/film_state.h"
#include "render/session/render_session.h"
#include "scene/reuse_setting.h"

#include "tests/render/session/recording_session.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace blush::TEST_FILE {
namespace {

using State = SessionStatus::State;
using test::Event;
using test::RecordingSession;

constexpr PlaneSet everything{true, true, true, true, 4, true, false, true};

Project small_project() {
    Project project = test::sample_project().project;
    project.render.width = 40;
    project.render.height = 24;
    project.render.spp = 20;
    return project;
}

// Properties of a film that same_pixels() does not compare.
void expect_same_planes(const Frame& a, const Frame& b) {
    EXPECT_TRUE(test::same_pixels(a, b));
    EXPECT_EQ(a.bounces, b.bounces);
    EXPECT_EQ(a.strategies, b.strategies);
    EXPECT_EQ(a.path_length, b.path_length);
    EXPECT_EQ(a.survival, b.survival);
    EXPECT_EQ(a.path_counts, b.path_counts);
    EXPECT_EQ(a.error.relmse, b.error.relmse);
    EXPECT_EQ(a.error.low, b.error.low);
    EXPECT_EQ(a.clamp.samples, b.clamp.samples);
    EXPECT_EQ(a.clamp.removed, b.clamp.removed);
    EXPECT_EQ(a.rays.total(), b.rays.total());
    EXPECT_EQ(a.health.fireflies, b.health.fireflies);
    EXPECT_EQ(a.health.first, b.health.first);
    EXPECT_EQ(a.health.truncated, b.health.truncated);
}

// Renders `before` samples with one renderer, the rest with another one.
void expect_seamless(const Project& p, int64_t before, int64_t all) {
    const RendererOptions options{.threads = 2, .planes = everything};
    Renderer whole(options), begun(options), continued(options);
    whole.update(p.scene, p.render);
    whole.render(0, before); // in the same steps, because fireflies of an adaptive film depend on them
    whole.render(before, all - before);
    begun.update(p.scene, p.render);
    begun.render(0, before);
    const Result<FilmState> state = begun.save_film(0);
    ASSERT_TRUE(state) << state.error().text();
    continued.update(p.scene, p.render);
    const Result<void> loaded = continued.load_film(*state);
    ASSERT_TRUE(loaded) << loaded.error().text();
    expect_same_planes(continued.resolve(), begun.resolve());
    continued.render(before, all - before);
    expect_same_planes(continued.resolve(), whole.resolve());
    EXPECT_EQ(continued.resolve_error(), whole.resolve_error());
}

TEST(FilmState, ContinuesLikeAnUninterruptedRender) {
    Project p = small_project();
    expect_seamless(p, 7, 20);
    p.render.clamp = {0.5f, false};
    expect_seamless(p, 8, 20);
    p.render.clamp = {};
    p.render.reuse = 4;
    expect_seamless(p, 5, 12);
    p.render.reuse = reuse_auto;
    for (const auto& [id, material] : p.scene.materials.entries()) {
        Material diffuse = material;
        diffuse.specular = 0;
        p.scene.materials.set(id, diffuse);
    }
    expect_seamless(p, 1, 12);
    expect_seamless(p, 5, 12);
}

TEST(FilmState, ContinuesWithCoverage) {
    Project p = small_project();
    p.scene.environment.kind = Environment::Kind::constant;
    p.scene.environment.visible_to_camera = false;
    expect_seamless(p, 3, 8);
}

TEST(FilmState, ContinuesWithThePlanOfAdaptiveSampling) {
    Project p = small_project();
    p.render.adaptive = true;
    expect_seamless(p, 4, 40);
    expect_seamless(p, 8, 40);
    expect_seamless(p, 13, 40);
    expect_seamless(p, 24, 40);
    p.scene.environment.kind = Environment::Kind::constant;
    p.scene.environment.visible_to_camera = false;
    expect_seamless(p, 16, 40);
}

TEST(FilmState, CannotBeSavedIfIncomplete) {
    Project p = small_project();
    p.render.adaptive = true;
    Renderer renderer({.threads = 2});
    renderer.update(p.scene, p.render);
    EXPECT_FALSE(renderer.save_film(0)) << "no samples are rendered";
    renderer.render(0, 20);
    EXPECT_TRUE(renderer.save_film(0));
    EXPECT_FALSE(renderer.render(20, 10, [] { return false; }));
    EXPECT_FALSE(renderer.save_film(0)) << "stopped in the middle";
    renderer.set_divider(2);
    renderer.render(0, 4);
    EXPECT_FALSE(renderer.save_film(0)) << "a coarse image";
}

TEST(FilmState, IsRejectedIfItDoesNotFit) {
    Project p = small_project();
    Renderer renderer({.threads = 2}), with_planes({.threads = 2, .planes = everything});
    renderer.update(p.scene, p.render);
    renderer.render(0, 4);
    const Result<FilmState> state = renderer.save_film(0);
    ASSERT_TRUE(state);
    with_planes.update(p.scene, p.render);
    const Result<void> lacking = with_planes.load_film(*state);
    ASSERT_FALSE(lacking);
    EXPECT_EQ(lacking.error().what, "the saved samples lack the plane \"albedo.R\"");
    EXPECT_EQ(with_planes.resolve().samples, 0);

    p.render.adaptive = true;
    Renderer adaptive({.threads = 2});
    adaptive.update(p.scene, p.render);
    FilmState twenty = *state;
    twenty.samples = 20;
    EXPECT_FALSE(adaptive.load_film(twenty)) << "no plan";
    twenty.shares = {std::vector<double>(6, 1.0), std::vector<double>(5, 1.0)};
    EXPECT_FALSE(adaptive.load_film(twenty)) << "a plan for different tiles";
    twenty.shares[1].push_back(std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(adaptive.load_film(twenty)) << "a plan with NaN";
    twenty.samples = 10;
    EXPECT_FALSE(adaptive.load_film(twenty)) << "no pilot";

    p = small_project();
    p.render.width += 1;
    renderer.update(p.scene, p.render);
    const Result<void> other_size = renderer.load_film(*state);
    ASSERT_FALSE(other_size);
    EXPECT_EQ(other_size.error().what, "saved samples of 40 x 24 pixels do not fit an image of 41 x 24");
}

// Material ids stay valid when table indices change.
TEST(FilmState, KeepsMaterialsByTheirIds) {
    const test::Sample sample = test::sample_project();
    const Project p = small_project();
    Renderer renderer({.threads = 2, .planes = everything});
    renderer.update(p.scene, p.render);
    renderer.render(0, 1);
    const Result<FilmState> state = renderer.save_film(0);
    ASSERT_TRUE(state);
    const Frame frame = renderer.resolve();
    const std::vector<uint32_t>& kept = state->find("material")->words;
    int found = 0;
    for (size_t i = 0; i < kept.size(); ++i) {
        found += frame.material_id[i] == sample.red.value;
        EXPECT_EQ(frame.material_id[i] == sample.red.value, kept[i] == sample.red.value);
    }
    EXPECT_GT(found, 0);
}

// Sums of doubles may round differently in another order: by less than single precision shows, except in the last place.
TEST(FilmState, RangesOfSamplesAddUpToTheWhole) {
    Project p = small_project();
    Renderer whole({.threads = 2, .planes = everything}), part({.threads = 2, .planes = everything});
    whole.update(p.scene, p.render);
    whole.render(0, 20);
    part.update(p.scene, p.render);
    part.render(0, 9);
    const Result<FilmState> first = part.save_film(0);
    part.clear();
    part.render(9, 11);
    const Result<FilmState> second = part.save_film(9);
    ASSERT_TRUE(first && second);

    const FilmSize size = film_size(*first);
    EXPECT_EQ(size.planes, everything);
    Film film;
    film.reset(size);
    ASSERT_TRUE(load_film(film, *first));
    ASSERT_TRUE(add_film(film, *second));
    Frame merged;
    film.resolve(merged, Workers(1));
    const Frame expected = whole.resolve();
    ASSERT_EQ(merged.rgba.size(), expected.rgba.size());
    for (size_t i = 0; i < merged.rgba.size(); ++i) {
        EXPECT_LE(merged.rgba[i], std::nextafter(expected.rgba[i], std::numeric_limits<float>::max()));
        EXPECT_GE(merged.rgba[i], std::nextafter(expected.rgba[i], 0.f));
    }
    EXPECT_EQ(merged.depth, expected.depth) << "first hits come from the first range";
}

TEST(FilmState, HealthAddsUp) {
    Health a, b;
    a.nan = 2;
    b.nan = 3;
    b.faults[1][2] = 4;
    a.first = {{.x = 1, .sample = 5}};
    b.first = {{.x = 2, .sample = 3}, {.x = 2, .sample = 9}};
    a.fireflies = {{.excess = 5}, {.excess = 3}};
    b.fireflies = {{.excess = 4}};
    b.dropped_map = {0, 3};
    const Health sum = HealthRecorder::merged(a, b);
    EXPECT_EQ(sum.dropped(), 5);
    EXPECT_EQ(sum.faults[1][2], 4);
    EXPECT_EQ(sum.dropped_map, (std::vector<uint32_t>{0, 3}));
    ASSERT_EQ(sum.first.size(), 3u);
    EXPECT_EQ(sum.first[0].sample, 3);
    EXPECT_EQ(sum.first[1].sample, 5);
    ASSERT_EQ(sum.fireflies.size(), 3u);
    EXPECT_EQ(sum.fireflies[1].excess, 4);
    EXPECT_EQ(HealthRecorder::merged(b, a).first, sum.first) << "in either order";
}

// ---- through the session

RequestedFilm kept_film(RecordingSession& session) {
    std::optional<RequestedFilm> kept;
    session.wait_for([&](const Event&) {
        if (!kept) kept = session->take_requested_film();
        return kept.has_value();
    });
    return kept.value_or(RequestedFilm{});
}

TEST(SessionFilm, IsThatOfTheFrameThatComesWithIt) {
    Project p = small_project();
    RecordingSession session;
    session->submit(1, p.scene, p.render);
    session.wait_for(1, State::complete);
    session->request_film(1);
    const RequestedFilm kept = kept_film(session);
    ASSERT_TRUE(kept.film) << kept.why_none;
    EXPECT_EQ(kept.revision, 1u);
    EXPECT_TRUE(test::same_pixels(*kept.frame, *session->latest()));
    EXPECT_EQ(kept.film->samples, 20);
    EXPECT_EQ(kept.error.size(), size_t(p.render.width * p.render.height));
}

TEST(SessionFilm, RestoredAndContinuedEqualsUninterrupted) {
    Project p = small_project();
    p.render.spp = 8;
    RecordingSession session;
    session->submit(1, p.scene, p.render);
    session.wait_for(1, State::complete);
    session->request_film(1);
    const RequestedFilm kept = kept_film(session);
    ASSERT_TRUE(kept.film) << kept.why_none;

    Project edited = p;
    edited.scene.environment.intensity = 3;
    edited.scene.environment.kind = Environment::Kind::constant;
    session->submit(2, edited.scene, edited.render);
    session.wait_for(2, State::complete);

    session->submit(3, p.scene, p.render, {}, kept.film);
    const FramePtr restored = session.wait_for(3, State::complete).frame;
    ASSERT_TRUE(restored);
    EXPECT_TRUE(test::same_pixels(*restored, *kept.frame));
    EXPECT_TRUE(test::same_pixels(*restored, test::fresh_image(p.scene, p.render, 8)));

    p.render.spp = 20;
    session->submit(4, p.scene, p.render);
    EXPECT_TRUE(test::same_pixels(*session.wait_for(4, State::complete).frame, test::fresh_image(p.scene, p.render, 20)));
    for (const FramePtr& frame : session.frames()) EXPECT_TRUE(frame->revision < 3 || frame->samples >= 8) << "it restarted";
}

TEST(SessionFilm, ReportsWhyItRestarts) {
    Project p = small_project();
    RecordingSession session;
    session->submit(1, p.scene, p.render);
    session.wait_for(1, State::complete);
    session->request_film(1);
    const RequestedFilm kept = kept_film(session);
    ASSERT_TRUE(kept.film);
    session->submit(2, p.scene, p.render, {.bounces = 4}, kept.film);
    const Event done = session.wait_for(2, State::complete);
    EXPECT_EQ(done.status.restart_reason, "the saved samples lack the plane \"bounce.0.R\"");
    EXPECT_EQ(done.frame->samples, 20);
    session->submit(3, p.scene, p.render, {}, kept.film);
    EXPECT_EQ(session.wait_for(3, State::complete).status.restart_reason, "");
}

TEST(SessionFilm, OfAReplacedImageIsUnavailable) {
    Project p = small_project();
    RecordingSession session;
    session->submit(1, p.scene, p.render);
    session.wait_for(1, State::complete);
    p.render.seed = 7;
    session->submit(2, p.scene, p.render);
    session.wait_for(2, State::complete);
    session->request_film(1);
    const RequestedFilm kept = kept_film(session);
    EXPECT_FALSE(kept.film);
    EXPECT_EQ(kept.why_none, "the image changed before its film was saved");
}

// A following change of the stop rules does not lose the samples.
TEST(SessionFilm, SurvivesASubmissionThatReplacesThePendingOne) {
    Project p = small_project();
    RecordingSession session;
    session->submit(1, p.scene, p.render);
    session.wait_for(1, State::complete);
    session->request_film(1);
    const RequestedFilm kept = kept_film(session);
    Project other = p;
    other.render.seed = 5;
    session->submit(2, other.scene, other.render);
    session->submit(3, p.scene, p.render, {}, kept.film);
    p.render.spp = 24;
    session->submit(4, p.scene, p.render);
    const FramePtr frame = session.wait_for(4, State::complete).frame;
    EXPECT_TRUE(test::same_pixels(*frame, test::fresh_image(p.scene, p.render, 24)));
    for (const FramePtr& f : session.frames()) EXPECT_TRUE(f->revision < 3 || f->samples >= 20) << "it restarted";
}

} // namespace
} // namespace blush::TEST_FILE
