// Every panel with every type of selection: drawing must not edit the document, for any values.
#include "io/gltf/read/import.h"
#include "render/lights/light_links.h"
#include "tests/support/eventually.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/instruments.h"
#include "ui/panels/panels.h"
#include "ui/widgets/guide_pages.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <imgui_internal.h>
#include <iterator>
#include <limits>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

class Panels : public test::ImGuiTest {
protected:
    // Draws a few frames of all panels with this selection.
    void draw_all(Document& document, Id<Node> selected) {
        ui.selected = selected;
        ui.show_shortcuts = true;
        ImportReport report;
        report.extensions_used = {"A", "B", "C"};
        report.extensions_honoured = {"A"};
        report.extensions_ignored = {"B", "C"};
        report.diagnostics = {{Diagnostic::Severity::warning, "ignored: B", "nodes[0]"}, {Diagnostic::Severity::note, "x", ""}};
        ui.import_report.report = std::make_shared<const ImportReport>(std::move(report));
        for (int tab = 0; tab <= int(InspectorTab::display); ++tab) {
            ui.tab = InspectorTab(tab);
            for (int i = 0; i < 3; ++i) {
                in_window([&] {
                    PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
                    draw_outliner(c);
                    draw_time(c);
                    draw_status_bar(c);
                    draw_inspector(c);
                    draw_history(c);
                    draw_bounces_panel(c);
                    draw_light_table(c);
                    draw_health_panel(c);
                    draw_import_report(c);
                    draw_region_panel(c);
                    draw_meters_panel(c);
                    draw_scopes_panel(c);
                    draw_convergence_panel(c);
                    draw_shortcut_sheet(c);
                    draw_cards(c, viewport, nullptr);
                });
            }
        }
    }

    static constexpr Region viewport{200, 20, 800, 1900};
    const ColorManagement color = test::our_colors();
    UiState ui;
    FramePtr frame;
};

// Draws several frames, until the sizes of all cards are known.
TEST_F(Panels, CardsAreStacked) {
    Document document;
    ui.toasts.fail(std::string(200, 'w'), std::string(400, 'd'));
    ui.toasts.note("short");
    const RunningJob job{.title = "Opening a scene", .what = std::string(40, 'x'), .fraction = 0.5, .can_cancel = true};
    for (int i = 0; i < 3; ++i)
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            EXPECT_FALSE(draw_cards(c, viewport, &job));
        });
    const ImGuiWindow* cards[] = {ImGui::FindWindowByName("##toast0"), ImGui::FindWindowByName("##toast1"),
                                  ImGui::FindWindowByName("##job")};
    for (const ImGuiWindow* card : cards) {
        ASSERT_TRUE(card);
        EXPECT_GT(card->Size.y, 10);
        EXPECT_GE(card->Pos.y, 0);
        EXPECT_FLOAT_EQ(card->Pos.x + card->Size.x, cards[2]->Pos.x + cards[2]->Size.x);
    }
    EXPECT_LE(cards[0]->Pos.y + cards[0]->Size.y, cards[1]->Pos.y);
    EXPECT_LE(cards[1]->Pos.y + cards[1]->Size.y, cards[2]->Pos.y);
}

// A scene with all types of records, twice: with defaults, and with values at and beyond the ends of the sliders.
Project with_odd_values(Project project) {
    Scene& scene = project.scene;
    for (const auto& [id, record] : Table<Light>(scene.lights)) {
        Light light = record;
        light.use_temperature = true;
        light.kelvin = 40000;
        light.intensity = 1e-20f;
        light.outer_cone_radians = std::numbers::pi_v<float> / 2;
        scene.lights.set(id, light);
    }
    for (const auto& [id, record] : Table<Material>(scene.materials)) {
        Material material = record;
        material.ior = 7;
        material.emissive_strength = 1e13f;
        material.thickness = 3;
        material.alpha = Material::Alpha::mask;
        scene.materials.set(id, material);
    }
    for (const auto& [id, record] : Table<Node>(scene.nodes)) {
        Node node = record;
        node.local.translation = {1.00000012f, -3e-9f, 123456.789f};
        node.local.scale = {-1, 1, 0};
        scene.nodes.set(id, node);
    }
    scene.environment.rotation_degrees = 725;
    scene.view.lens.yfov_radians = 3.1f;
    project.render.max_bounces = 0;
    project.render.roulette.rule = Roulette::Rule::biased_cut;
    project.view.exposure_ev = 25;
    project.view.auto_exposure = AutoExposure::highlights;
    project.view.false_color = {FalseColor::Of::lux, 1e-20f, 1e30f};
    project.view.meters = {{"far away", {4711}, {1e30f, 0, -1e30f}, {0, 1e-20f, 0}, 1e30f}};
    project.view.measured = ImageRegion{0.999f, 0, 0.001f, 1};
    return project;
}

TEST_F(Panels, DrawingEditsNothing) {
    const test::Sample sample = test::sample_project();
    for (const Project& project : {sample.project, with_odd_values(sample.project)}) {
        Document document(project);
        for (const auto& entry : project.scene.nodes) draw_all(document, entry.id);
        draw_all(document, {});
        for (const auto& entry : project.scene.nodes) ui.toggle(entry.id); // all at once
        draw_all(document, ui.selected);
        draw_all(document, {999}); // a deleted node
        EXPECT_TRUE(document.project() == project);
        EXPECT_FALSE(document.can_undo());
        EXPECT_TRUE(ui.commands.empty());
        EXPECT_TRUE(ui.files.empty());
    }
}

// More sets of shadow casters than the renderer supports.
TEST_F(Panels, WarnIfShadowLinkingIsIgnored) {
    Project project;
    std::vector<Id<Node>> objects, lamps;
    for (int i = 0; i <= max_caster_sets; ++i) {
        Node object;
        object.mesh = project.scene.meshes.add(Mesh());
        objects.push_back(project.scene.nodes.add(object));
    }
    const auto add_lamp = [&](Id<Node> casts_no_shadow) {
        Light light;
        light.shadow_casters.nodes = {casts_no_shadow};
        Node lamp;
        lamp.light = project.scene.lights.add(light);
        lamps.push_back(project.scene.nodes.add(lamp));
    };
    const auto widgets_with = [&](Id<Node> selected) {
        const auto file = std::filesystem::path(testing::TempDir()) / "links.json";
        Document document(project);
        ui.probe = Probe(file);
        ui.select(selected);
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            draw_light_links_panel(c, selected);
        });
        ui.probe.end_frame({});
        std::ifstream in(file);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (int i = 0; i < max_caster_sets; ++i) add_lamp(objects[size_t(i)]);
    EXPECT_EQ(widgets_with(lamps.back()).find("eft out\""), std::string::npos) << "this many are supported";
    add_lamp(objects.back());
    EXPECT_NE(widgets_with(lamps.back()).find("Linking/Left out\""), std::string::npos);
    EXPECT_NE(widgets_with(lamps.front()).find("Linking/Others left out\""), std::string::npos);
}

TEST_F(Panels, EveryEnvironmentAndLightType) {
    const test::Sample sample = test::sample_project();
    for (const auto kind :
         {Light::Kind::point, Light::Kind::spot, Light::Kind::sun, Light::Kind::rectangle, Light::Kind::disk, Light::Kind::sphere}) {
        Project project = sample.project;
        Light light = *project.scene.lights.find(sample.lamp);
        light.kind = kind;
        project.scene.lights.set(sample.lamp, light);
        Document document(project);
        draw_all(document, sample.lamp_node);
        EXPECT_FALSE(document.can_undo());
    }
    for (const auto kind : {Environment::Kind::none, Environment::Kind::constant, Environment::Kind::image}) {
        Project project = sample.project;
        project.scene.environment.kind = kind;
        Document document(project);
        draw_all(document, {});
        EXPECT_FALSE(document.can_undo());
    }
}

TEST_F(Panels, EveryModeOfTheDenoiseView) {
    Document document(test::sample_project().project);
    auto raw = std::make_shared<Frame>();
    raw->width = raw->height = 2;
    raw->rgba.assign(16, 0.5f);
    auto image = std::make_shared<DenoisedImage>();
    image->width = image->height = 1;
    image->denoised.rgb.assign(3, 0.25f);
    image->denoised.sanitised = 7;
    ui.tab = InspectorTab::display;
    for (const auto show : {DenoiseView::Show::raw, DenoiseView::Show::denoised, DenoiseView::Show::blend, DenoiseView::Show::difference})
        for (const DenoisedPtr& denoised : {DenoisedPtr(), DenoisedPtr(image)})
            for (const char* problem : {"", "the weights are not there"}) {
                ui.denoise = {show, 0.5f};
                ui.pixel = PixelProbe{0.9, 0.9};
                in_window([&] {
                    PanelContext c{document, ui, color, raw, SessionStatus(), 2, 2, denoised, problem};
                    draw_inspector(c);
                    draw_status_bar(c);
                    draw_pixel_panel(c);
                    draw_menu_bar(c);
                });
                EXPECT_EQ(ui.denoise, (DenoiseView{show, 0.5f})) << "drawing alone changes nothing";
            }
    EXPECT_FALSE(document.can_undo());
}

TEST_F(Panels, AnEmptySceneAndAFrameWithoutPlanes) {
    Document document;
    auto bare = std::make_shared<Frame>();
    bare->width = bare->height = 1;
    bare->rgba = {1, std::numeric_limits<float>::infinity(), std::nanf(""), 1};
    bare->health.nan = 3;
    bare->health.faults[0][3] = 3;
    bare->health.first = {{}, {}, {}};
    bare->health.fireflies = {{5, 2, 0, 0, 7, 1}};
    bare->bounces = {{{1, 1, 1}}, {{0, 0, 0}}, {{std::nanf(""), 1, 1}}};
    frame = bare;
    draw_all(document, {});
    ui.pixel = PixelProbe{0.5, 0.5};
    for (int i = 0; i < 3; ++i) {
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 1, 1};
            draw_pixel_panel(c);
        });
    }
    EXPECT_TRUE(ui.pixel) << "stays open";
    EXPECT_FALSE(document.can_undo());
}

TEST_F(Panels, TheShortcutSheetListsAllKeys) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "probe.json";
    Document document;
    ui.probe = Probe(file);
    ui.show_shortcuts = true;
    for (int i = 0; i < 3; ++i) {
        ui.probe.begin_frame();
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            draw_shortcut_sheet(c);
        });
    }
    ui.probe.end_frame({});
    std::ifstream in(file);
    const std::string written{std::istreambuf_iterator<char>(in), {}};
    for (const Shortcut& s : shortcuts())
        EXPECT_EQ(written.find(std::string("\"Shortcut/") + s.group + "/" + s.name + "\"") != std::string::npos, s.press.key != key::none)
            << s.name;
}

TEST_F(Panels, TheStatusBarSaysThatLightCannotBeFoundOrMayBeMissing) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "probe.json";
    ui.probe = Probe(file);
    Document document;
    for (const char* reason : {"", "some light cannot be found: that of point lights"}) {
        auto made = std::make_shared<Frame>();
        made->width = made->height = made->divider = 1;
        made->rgba.assign(4, 1);
        made->missing_light = reason;
        made->error.misses_highlights = *reason != 0;
        frame = made;
        ui.probe.begin_frame();
        ImGui::NewFrame();
        ImGui::SetNextWindowSize({1280, 30}); // room for all cells
        ImGui::Begin("status");
        PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
        draw_status_bar(c);
        ImGui::End();
        ImGui::EndFrame();
        ui.probe.end_frame({});
        std::ifstream in(file);
        const std::string written{std::istreambuf_iterator<char>(in), {}};
        for (const char* cell : {"some light cannot be found", "error: highlights missing?"})
            EXPECT_EQ(written.find(std::string("Status/") + cell) != std::string::npos, *reason != 0) << written;
    }
}

TEST_F(Panels, NewScopesNeedAFrameForTheirWaveforms) {
    Document document;
    auto image = std::make_shared<Frame>();
    image->width = image->height = 2;
    image->divider = 1;
    image->rgba.assign(16, 0.5f);
    frame = image;
    constexpr double idle = 1;
    const auto draw = [&] {
        ui.seconds_to_next_frame = idle;
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            draw_scopes_panel(c);
        });
        return ui.seconds_to_next_frame;
    };
    double next = idle;
    ASSERT_TRUE(test::eventually([&] {
        next = draw();
        return ui.scopes.scopes.number() == 1;
    }));
    EXPECT_LT(next, idle) << "the textures are made at the start of the next frame";
    EXPECT_EQ(draw(), idle) << "endless frames";
}

// The Specialisation section has a line per unused feature; used features are below a collapsed heading.
TEST_F(Panels, EachUnusedFeatureHasALine) {
    Document document;
    ui.settings.panels["section.Specialisation"] = 1;
    const auto height_of = [&](const FeatureReport& feature_report) {
        auto made = std::make_shared<Frame>();
        made->feature_report = std::make_shared<const FeatureReport>(feature_report);
        frame = made;
        float height = 0;
        for (int i = 0; i < 2; ++i) {
            in_window([&] {
                const float top = ImGui::GetCursorPosY();
                PanelContext c{document, ui, color, frame, {}, 640, 480};
                draw_specialisation_section(c);
                height = ImGui::GetCursorPosY() - top;
            });
        }
        return height;
    };
    const FeatureUse depth{"film", "depth", false, "not read", 4096}, ids{"film", "ids", false, "not read", 8192};
    const FeatureUse beauty{"film", "beauty", true, "always", 65536};
    const float none = height_of({}), one = height_of({depth}), two = height_of({depth, ids}), in_use = height_of({depth, ids, beauty});
    EXPECT_GT(one, none);
    EXPECT_GT(two, one);
    EXPECT_EQ(in_use, two);
    EXPECT_FALSE(document.can_undo());
}

// All modes, without a render.
TEST_F(Panels, EveryModeOfTheBouncesPanel) {
    auto three = std::make_shared<Frame>();
    three->width = three->height = 1;
    three->rgba = {1, 1, 1, 1};
    three->bounces = {{{1, 1, 1}}, {{2, 2, 2}}, {{0, 0, 0}}};
    frame = three;
    Document document;
    for (int mode = 0; mode < int(std::size(BouncesView::names)); ++mode) {
        ui.bounces.mode = BouncesView::Mode(mode);
        ui.bounces.playing = true;
        draw_all(document, {});
    }
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(ui.bounces.gains, std::vector<float>(3, 1.f));
}

// With any data and any state of the reference.
TEST_F(Panels, EveryStateOfTheConvergencePanel) {
    Document document(test::sample_project().project);
    ConvergenceView& view = ui.convergence;
    const double inf = std::numeric_limits<double>::infinity();
    const auto all_settings = [&] {
        for (const ErrorMetric metric : {ErrorMetric::rmse, ErrorMetric::relmse})
            for (const ProgressAxis axis : {ProgressAxis::seconds, ProgressAxis::spp})
                for (const float target : {0.f, 1e-3f, 1e6f}) {
                    view.metric = metric;
                    view.axis = axis;
                    view.targets = {target, target};
                    draw_all(document, {});
                }
    };
    all_settings();
    view.runs.begin("first");
    for (const double error : {inf, 0.0, double(std::nanf("")), 1e-300, 0.5}) {
        ConvergenceRecord& record = view.runs.live()->record;
        record.set({ConvergencePoint::Kind::estimated, error, int64_t(record.points().size()), {true, error, 0, inf}, {}});
        draw_all(document, {});
    }
    view.runs.begin("a run with a name that is far too long for the column that it has, %s and ##");
    view.runs.live()->record.set({ConvergencePoint::Kind::denoised, 1, 1, {true, 1, 0.5, 2}, {true, 1, 0.5, 2}});
    view.runs.mark("edit");
    view.runs.add_stored({});
    view.denoised = view.reference = true;
    view.waiting = 3;
    view.cost = {1, 2, 3, 4};
    view.renaming = view.runs.live()->id;
    all_settings();
    for (int state = 0; state <= int(ReferenceStatus::State::there); ++state) {
        view.reference_status = {ReferenceStatus::State(state), 0.999, 64, 1e-3, "It could not be stored."};
        draw_all(document, {});
    }
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(view.runs.all().size(), 3u);
    EXPECT_FALSE(view.wanted_export);
    EXPECT_EQ(view.wanted_reference, ConvergenceView::ReferenceRequest::none);
}

// A frame with groups and the panel: drawing does not edit.
TEST_F(Panels, TheLightMixShowsItsGroups) {
    test::Sample sample = test::sample_project();
    sample.project.scene.mix.grouping = LightMix::Grouping::by_light;
    sample.project.scene.mix.channels.push_back({.group = "Lamp", .intensity = 2, .use_temperature = true});
    Document document(sample.project);
    auto image = std::make_shared<Frame>();
    image->width = image->height = 1;
    image->rgba = {1, 1, 1, 1};
    image->light_groups = std::make_shared<const LightGroups>(make_light_groups(sample.project.scene));
    image->groups = {{{1, 1, 1}}, {{2, 2, 2}}};
    image->gains = {{1, 1, 1}, {2, 2, 2}};
    image->group_shares.resize(2);
    frame = image;
    const std::optional<Mixing> mixing = compared_mixing(*image->light_groups, sample.project.scene);
    ASSERT_TRUE(mixing);
    for (const char* unfolded : {"", "Lamp"})
        for (const Mixing* shown : {&*mixing, static_cast<const Mixing*>(nullptr)}) {
            ui.light_mix.unfolded = unfolded;
            in_window([&] {
                PanelContext c{document, ui, color, frame, {}, 64, 48};
                c.mixing = shown;
                draw_light_mix_panel(c);
            });
        }
    EXPECT_FALSE(document.can_undo());
}

TEST_F(Panels, TheRouletteLabMeasuresWhileItIsOpen) {
    Document document(test::sample_project().project);
    const auto draw = [&] {
        in_window([&] {
            PanelContext c{document, ui, color, frame, {}, 64, 48};
            draw_roulette_panel(c);
        });
    };
    EXPECT_FALSE(ui.roulette.runner);
    draw();
    ASSERT_TRUE(ui.roulette.runner);
    while (ui.roulette.runner->state().output.rounds < 20) draw();
    draw();
    EXPECT_FALSE(document.can_undo()) << "drawing edits nothing";
    PanelContext c{document, ui, color, frame, {}, 64, 48};
    find_instrument(instruments(), "roulette")->set_open(c, false);
    EXPECT_FALSE(ui.roulette.runner);
}

// Anchors of a page of the guide: its headings, lower case, with hyphens for spaces.
bool guide_has(const std::string& page) {
    const size_t hash = page.find('#'), end = page.find(".html");
    std::ifstream in(std::filesystem::path(BLUSH_DOCS) / (page.substr(0, end) + ".md"));
    if (hash == std::string::npos) return in.good();
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] != '#') continue;
        std::string anchor = line.substr(line.find_first_not_of("# "));
        std::ranges::transform(anchor, anchor.begin(), [](unsigned char c) { return c == ' ' ? '-' : char(std::tolower(c)); });
        if (anchor == page.substr(hash + 1)) return true;
    }
    return false;
}

TEST_F(Panels, EachHasAPageInTheGuide) {
    EXPECT_FALSE(guide_has("guide/lighting.html#none"));
    EXPECT_FALSE(guide_has("guide/none.html"));
    for (const char* page : guide_page::all) EXPECT_TRUE(guide_has(page)) << page;
    for (const Instrument& i : instruments()) EXPECT_TRUE(guide_has(i.guide)) << i.id << ": " << i.guide;
    Document document(test::sample_project().project);
    PanelContext c{document, ui, color, frame, {}, 64, 48};
    for (const auto& [id, node] : document.project().scene.nodes)
        for (int tab = 0; tab <= int(InspectorTab::display); ++tab) {
            ui.selected = id;
            ui.tab = InspectorTab(tab);
            EXPECT_TRUE(guide_has(inspector_guide_page(c))) << inspector_guide_page(c);
        }
}

TEST(GuidePages, AddressesAreInOnePlace) {
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(BLUSH_DOCS).parent_path() / "ui")) {
        if (!entry.is_regular_file() || entry.path().filename() == "guide_pages.h") continue;
        std::ifstream in(entry.path());
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        EXPECT_EQ(text.find("\"guide/"), std::string::npos) << entry.path() << " has an address that belongs into guide_pages.h";
        ++files;
    }
    EXPECT_GT(files, 100);
}

} // namespace
} // namespace blush::TEST_FILE
