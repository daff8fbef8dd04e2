// EditorConvergence with synthetic frames: recorded images, runs, denoised images, references and files.
#include "app/editor/editor_convergence.h"
#include "app/editor/run_name.h"
#include "core/files.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/imgui_test.h"

#include <cmath>
#include <cstdlib>
#include <thread>

namespace blush::TEST_FILE {
namespace {

using Kind = ConvergencePoint::Kind;

constexpr int width = 40, height = 30;

// An image of ones with a constant `error`, which is also its error estimate.
std::shared_ptr<Frame> frame_of(uint64_t revision, int64_t samples, double error) {
    auto f = std::make_shared<Frame>();
    f->revision = revision;
    f->width = width;
    f->height = height;
    f->samples = samples;
    f->seconds = f->error_at = 0.01 * double(samples);
    f->error_samples = samples;
    f->error_seconds = 1e-4 * f->seconds;
    f->rgba.assign(size_t(width * height * 4), 1 + float(error));
    f->error = {true, error * error, 0.9 * error * error, 1.1 * error * error, true, error, 0.9 * error, 1.1 * error};
    return f;
}

DenoisedPtr denoised_of(uint64_t revision, int64_t samples, float value) {
    auto d = std::make_shared<DenoisedImage>();
    d->revision = revision;
    d->width = width;
    d->height = height;
    d->samples = samples;
    d->rendered_seconds = 0.01 * double(samples);
    d->denoised.rgb.assign(size_t(width * height * 3), value);
    return d;
}

class Convergence : public test::ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        in_window([] {}); // later drawing uses the style of this frame
        ::setenv("XDG_CACHE_HOME", (folder.path() / "cache").c_str(), 1);
        project.render.width = width;
        project.render.height = height;
    }
    void TearDown() override {
        ::unsetenv("XDG_CACHE_HOME");
        ImGuiTest::TearDown();
    }

    void begin(const char* name, uint64_t revision) {
        const SubmissionContent content{project.scene, project.render};
        editor.begin(view, name, next_submission(nullptr, revision, content, {}, false));
    }
    // Submits as the editor does; returns the revision.
    uint64_t submit(const Document& document, const RenderSettings& settings, const PlaneSet& planes, const std::string& opened) {
        const SubmissionContent content{document.project().scene, settings, planes};
        const Submission* last = submitted.get();
        submitted = next_submission(last, last ? last->revision + 1 : 1, content, changes_since(last, content), false);
        editor.submit(view, document, submitted, opened);
        return submitted->revision;
    }
    // A run whose error falls like 1/sqrt(N).
    void converge(uint64_t revision, int64_t up_to) {
        for (int64_t n = 1; n <= up_to; n *= 2) editor.update(view, {frame_of(revision, n, 0.5 / std::sqrt(double(n))), nullptr});
    }
    // Repeats with the same images until the condition is true.
    template <class Done> bool look_until(const Images& images, Done done) {
        for (int i = 0; i < 3000 && !done(); ++i) {
            editor.update(view, images);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return done();
    }
    std::filesystem::path saved(ConvergenceView::Export format) {
        view.wanted_export = format;
        const size_t before = ui.toasts.all().size();
        for (int i = 0; i < 3000 && ui.toasts.all().size() == before; ++i) {
            editor.handle_requests(ui, folder.path() / "out", "scenes/cornell.gltf");
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        const std::string text = ui.toasts.all().back().text;
        return text.starts_with("Saved ") ? folder.path() / "out" / text.substr(6) : std::filesystem::path();
    }

    test::TemporaryFolder folder;
    Project project = test::sample_project().project;
    UiState ui;
    ConvergenceView& view = ui.convergence;
    EditorConvergence editor{[] {}, 1};
    SubmissionPtr submitted;
};

TEST_F(Convergence, MarksWherePilotsHaveDecided) {
    const FeatureUse paths{.part = "kernel", .name = "light paths", .used = true, .why = "", .pilot = PilotFigures{}};
    FeatureUse reuse = paths, textures = paths;
    reuse.name = "path reuse";
    reuse.used = false;
    textures.name = "textures";
    textures.pilot.reset();
    const auto frame = [&](int64_t samples, const FeatureReport& report) {
        auto f = frame_of(1, samples, 0.5);
        f->feature_report = std::make_shared<const FeatureReport>(report);
        return f;
    };
    begin("Opened", 1);
    editor.update(view, {frame(1, {paths}), nullptr}); // samples before the second are rendered without
    editor.update(view, {frame(2, {textures, reuse}), nullptr});
    EXPECT_TRUE(view.runs.live()->record.marks().empty());
    editor.update(view, {frame(4, {textures, paths, reuse}), nullptr});
    editor.update(view, {frame(8, {textures, paths, reuse}), nullptr});
    ASSERT_EQ(view.runs.live()->record.marks().size(), 1u);
    const ConvergenceMark& mark = view.runs.live()->record.marks()[0];
    EXPECT_EQ(mark.label, "Pilots: light paths");
    EXPECT_EQ(mark.spp, 4);
    EXPECT_EQ(mark.seconds, 0.04);
    EXPECT_FALSE(mark.other_mix);
    // That of roulette runs later.
    FeatureUse roulette = paths;
    roulette.name = "learned roulette";
    editor.update(view, {frame(16, {textures, paths, reuse, roulette}), nullptr});
    editor.update(view, {frame(32, {textures, paths, reuse, roulette}), nullptr});
    ASSERT_EQ(view.runs.live()->record.marks().size(), 2u);
    EXPECT_EQ(view.runs.live()->record.marks()[1].label, "Pilots: learned roulette");
    EXPECT_EQ(view.runs.live()->record.marks()[1].spp, 16);
}

TEST_F(Convergence, RecordsOnlyFullResolutionImagesOfTheRun) {
    editor.update(view, {frame_of(1, 4, 1), nullptr});
    EXPECT_FALSE(view.runs.live());
    begin("Opened", 2);
    editor.update(view, {frame_of(1, 512, 0.1), nullptr}); // the image before it
    auto coarse = frame_of(2, 1, 1);
    coarse->divider = 4;
    editor.update(view, {coarse, nullptr});
    auto unknown = frame_of(2, 1, 1);
    unknown->error = {};
    editor.update(view, {unknown, nullptr});
    EXPECT_TRUE(view.runs.live()->record.points().empty());
    converge(3, 64); // a later revision continues the image
    EXPECT_EQ(view.runs.live()->record.points().size(), 7u);
    EXPECT_NEAR(fit(view.runs.live()->record, Kind::estimated, ErrorMetric::rmse, ProgressAxis::spp).slope.value, -0.5, 1e-6);
    EXPECT_NEAR(view.cost.estimate_fraction(), 1e-4, 1e-9) << "as the frames say";
    EXPECT_GT(view.cost.recorder_fraction(), 0);
    begin("Change light", 4);
    ASSERT_EQ(view.runs.all().size(), 2u);
    EXPECT_EQ(view.runs.all()[0].record.marks().size(), 1u);
    EXPECT_EQ(view.cost.recorder_fraction(), 0);
}

TEST_F(Convergence, NewImageStartsARunAndNewStopRulesAddAMark) {
    Document document(project);
    RenderSettings settings = project.render;
    PlaneSet planes;
    const auto submit = [&](const std::string& opened = "") { converge(Convergence::submit(document, settings, planes, opened), 64); };
    submit("cornell.gltf");
    settings.spp = 7;
    submit();
    EXPECT_EQ(view.runs.all().size(), 1u);
    EXPECT_EQ(view.runs.live()->record.marks().size(), 1u);
    settings.seed = 9;
    submit();
    planes.bounces = 4;
    submit();
    planes.bounces = 0;
    submit();
    ASSERT_TRUE(document.apply(SetLens{{.yfov_radians = 1}}));
    submit();
    document.undo();
    submit();
    std::vector<std::string> names;
    for (const ConvergenceRun& r : view.runs.all()) names.push_back(r.record.name);
    EXPECT_EQ(names, (std::vector<std::string>{"cornell.gltf", "Seed 9", "Other layers", "Change lens", "Undo: Change lens"}));
    submit("furnace.gltf");
    EXPECT_EQ(view.runs.all().size(), 1u) << "another scene has other errors";
}

TEST_F(Convergence, NewMixOfTheSameSamplesAddsAMark) {
    project.scene.mix.grouping = LightMix::Grouping::by_light;
    Document document(project);
    uint64_t revision = 0;
    const auto submit = [&](const std::string& opened = "") { revision = Convergence::submit(document, project.render, {}, opened); };
    submit("cornell.gltf");
    converge(revision, 64);
    const size_t points = view.runs.live()->record.points().size();
    for (const float intensity : {2.f, 3.f}) { // a drag
        ASSERT_TRUE(document.apply(SetMix{{LightMix::Grouping::by_light, {{.group = "Lamp", .intensity = intensity}}}}));
        submit();
        editor.update(view, {frame_of(revision - 1, 64, 0.1), nullptr}); // not mixed yet
        editor.update(view, {frame_of(revision, 64, 0.1 * double(intensity)), nullptr});
    }
    ASSERT_EQ(view.runs.all().size(), 1u) << "no new run";
    const ConvergenceRecord& record = view.runs.live()->record;
    EXPECT_EQ(record.points().size(), points);
    EXPECT_DOUBLE_EQ(record.points().back().rmse.value, 0.1 * 3.0) << "the error of the displayed mix";
    ASSERT_EQ(record.marks().size(), 1u) << "one for the whole drag";
    EXPECT_TRUE(record.marks()[0].other_mix);
    EXPECT_EQ(record.marks()[0].spp, 64);
    EXPECT_FALSE(fit(record, Kind::estimated, ErrorMetric::rmse, ProgressAxis::spp).slope.known) << "no slope across it";
    ASSERT_TRUE(document.apply(SetMix{}));
    submit();
    EXPECT_EQ(view.runs.all().size(), 2u) << "other groups are another image";
}

TEST_F(Convergence, DenoisedImagesAreMeasuredAgainstABetterRawOne) {
    view.open = view.denoised = true;
    begin("Opened", 1);
    converge(1, 4);
    const DenoisedPtr denoised = denoised_of(1, 4, 1.1f);
    editor.update(view, {frame_of(1, 8, 0.2), denoised});
    EXPECT_EQ(view.waiting, 1u);
    const auto points = [&] { return view.runs.live()->record.points(Kind::denoised); };
    ASSERT_TRUE(look_until({frame_of(1, 16, 0.1), denoised}, [&] { return view.cost.measuring > 0; }));
    EXPECT_TRUE(points().empty()) << "a raw image that is not better is not used";
    ASSERT_TRUE(look_until({frame_of(1, 4096, 0.001), denoised}, [&] { return !points().empty(); }));
    EXPECT_EQ(points()[0].spp, 4);
    EXPECT_LE(points()[0].rmse.low, 0.1);
    EXPECT_GE(points()[0].rmse.high, 0.1);
}

TEST_F(Convergence, ReferenceIsRenderedStoredFoundAndUsed) {
    view.open = view.reference = true;
    begin("Opened", 1);
    converge(1, 16);
    const FramePtr frame = frame_of(1, 32, 0.1);
    using State = ReferenceStatus::State;
    ASSERT_TRUE(look_until({frame, nullptr}, [&] { return view.reference_status.state == State::absent; }));
    view.wanted_reference = ConvergenceView::ReferenceRequest::render;
    editor.handle_requests(ui, {}, {});
    EXPECT_TRUE(editor.is_rendering_reference());
    ASSERT_TRUE(look_until({frame, nullptr}, [&] { return view.reference_status.state == State::there; }));
    EXPECT_EQ(view.reference_status.spp, 64);
    EXPECT_EQ(view.reference_status.problem, "");
    EXPECT_FALSE(editor.is_rendering_reference());
    ASSERT_TRUE(look_until({frame, nullptr}, [&] { return !view.runs.live()->record.points(Kind::measured).empty(); }));
    EXPECT_EQ(view.runs.live()->record.points(Kind::measured)[0].spp, 32);

    // The same image again, after another one.
    begin("edit", 2);
    editor.update(view, {frame_of(2, 1, 1), nullptr});
    EXPECT_EQ(view.reference_status.state, State::none) << "no search before the image has settled";
    converge(2, 16);
    EXPECT_TRUE(look_until({frame_of(2, 32, 0.1), nullptr}, [&] { return view.reference_status.state == State::there; }));
}

TEST_F(Convergence, SavesVisibleRunsAndLoadsThem) {
    begin("Opened", 1);
    EXPECT_EQ(saved(ConvergenceView::Export::csv), "") << "nothing to save yet";
    converge(1, 64);
    begin("hidden", 2);
    converge(2, 64);
    view.runs.live()->shown = false;
    const auto csv = saved(ConvergenceView::Export::csv);
    EXPECT_EQ(csv.filename(), "cornell-convergence-0001.csv");
    EXPECT_EQ(saved(ConvergenceView::Export::csv).filename(), "cornell-convergence-0002.csv") << "none is overwritten";
    const auto svg = read_file(saved(ConvergenceView::Export::svg), 1 << 20), png = read_file(saved(ConvergenceView::Export::png), 1 << 24);
    ASSERT_TRUE(svg && png);
    EXPECT_EQ(std::string(svg->begin(), svg->begin() + 4), "<svg");
    EXPECT_EQ(std::string(png->begin() + 1, png->begin() + 4), "PNG");

    editor.load(ui, csv);
    ASSERT_EQ(view.runs.all().size(), 3u);
    const ConvergenceRun& stored = view.runs.all().back();
    EXPECT_EQ(stored.origin, ConvergenceRun::Origin::stored);
    EXPECT_EQ(stored.record.name, "Opened 2") << "the name is in use";
    EXPECT_EQ(stored.record.points().size(), 7u);
    EXPECT_EQ(stored.record.marks().size(), 1u);
    EXPECT_TRUE(view.open);
    editor.load(ui, folder.path() / "out" / "cornell-convergence-0001.svg");
    EXPECT_EQ(view.runs.all().size(), 3u) << "no table";
    EXPECT_EQ(ui.toasts.all().back().kind, Toast::Kind::failure);
}

TEST(RunName, NamesTheEdit) {
    const test::Sample sample = test::sample_project();
    Document document(sample.project);
    const RenderSettings before = sample.project.render;
    const auto name = [&](const Scene& scene, const RenderSettings& after, bool undone = false) {
        return run_name({sample.project.scene, before}, {scene, after}, diff(sample.project.scene, before, scene, after), document, undone);
    };
    RenderSettings after = before;
    after.reuse = 8;
    after.strategy = Strategy::light;
    after.width = 99;
    EXPECT_EQ(name(sample.project.scene, after), "Strategy light, Path reuse 8");
    after = before;
    after.width = 99;
    EXPECT_EQ(name(sample.project.scene, after), "Size 99 × 720");
    Scene scene = sample.project.scene;
    scene.view.position.x += 1;
    EXPECT_EQ(name(scene, before), "Camera moved");
    ASSERT_TRUE(document.apply(SetLens{{.yfov_radians = 1}}));
    EXPECT_EQ(name(document.project().scene, before), "Change lens");
    document.undo();
    Light light = *sample.project.scene.lights.find(sample.lamp);
    light.intensity *= 2;
    light.name = "lamp";
    ASSERT_TRUE(document.apply(SetLight{sample.lamp, light}));
    EXPECT_EQ(name(document.project().scene, before), "Change light lamp");
    const Scene changed = document.project().scene;
    document.undo();
    EXPECT_EQ(name(changed, before, true), "Undo: Change light lamp");
}

} // namespace
} // namespace blush::TEST_FILE
