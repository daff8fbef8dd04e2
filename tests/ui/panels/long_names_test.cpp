// No text is cut off: every panel and overlay with names of sixty letters and more, at scales 1 and 2.
#include "app/editor/editor_panels.h"
#include "io/gltf/read/import.h"
#include "render/light_mix/light_groups.h"
#include "render/light_mix/light_mix.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/clipped_text.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/instruments.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/aov_bar.h"
#include "ui/snapshots/compare_view.h"
#include "ui/snapshots/snapshot_strip.h"
#include "ui/viewport/camera_frame_overlay.h"
#include "ui/viewport/meter_marks.h"
#include "ui/viewport/regions.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"
#include "ui/window/window_settings.h"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <imgui_internal.h> // the stack of popups
#include <set>

namespace blush::TEST_FILE {
namespace {

std::string long_name(const char* what, size_t i = 0) {
    return fmt::format("{}_number_{}_in_the_second_bedroom_beside_the_mirrored_wardrobe_WWW", what, i);
}

template <class T> void rename_all(Table<T>& table, const char* what) {
    for (const auto& [id, record] : Table<T>(table)) {
        T renamed = record;
        renamed.name = long_name(what, id.value);
        table.set(id, renamed);
    }
}

Project with_long_names() {
    Project project = test::sample_project().project;
    Scene& s = project.scene;
    rename_all(s.nodes, "Object");
    rename_all(s.meshes, "Mesh");
    rename_all(s.lights, "Lamp");
    rename_all(s.materials, "Material");
    rename_all(s.textures, "Texture");
    rename_all(s.cameras, "Camera");
    rename_all(s.clips, "Clip");
    for (const auto& [id, record] : Table<Light>(s.lights)) {
        Light light = record;
        light.group = long_name("Group", id.value);
        s.lights.set(id, light);
    }
    for (size_t i = 0; i < s.variants.size(); ++i) s.variants[i] = long_name("Variant", i);
    s.scene_names = {long_name("Scene", 0), long_name("Scene", 1)};
    s.environment.file = "/home/somebody/" + long_name("Folder") + "/" + long_name("Panorama") + ".exr";
    s.mix.grouping = LightMix::Grouping::by_light;
    project.view.meters = {{long_name("Meter"), s.nodes.entries().front().id, {0, 0, 0}, {0, 1, 0}, 1}, {"m", {}, {}, {0, 0, 1}, 1}};
    project.view.measured = ImageRegion{0.1f, 0.1f, 0.5f, 0.5f};
    return project;
}

SnapshotPtr snapshot(uint64_t id, const Project& project) {
    auto s = std::make_shared<Snapshot>();
    s->id = id;
    s->name = long_name("Snapshot", id);
    s->note = long_name("Note", id);
    s->time = "14:32";
    auto frame = std::make_shared<Frame>();
    frame->width = frame->height = 1;
    frame->rgba.assign(4, 0.5f);
    s->images.frame = frame;
    s->thumbnail = thumbnail_of(*frame);
    s->project = project;
    s->file = "/home/somebody/" + long_name("Folder") + "/" + long_name("Snapshot", id) + ".exr";
    return s;
}

FramePtr long_frame(const Scene& scene) {
    auto f = std::make_shared<Frame>();
    f->width = f->height = 1;
    f->samples = 123456;
    f->samples_per_second = 1234.5;
    f->seconds = 98765;
    f->divider = 4;
    f->kernel = "x86-64-v4 / everything with coats and films";
    f->missing_light = "Points behind solid glass cannot be found";
    f->rgba.assign(4, 1e4f);
    f->albedo = {{0.5f, 0.5f, 0.5f}};
    f->normal = {{-0.577f, 0.577f, -0.577f}};
    f->depth = {12345.678f};
    f->object_id = {scene.nodes.entries().front().id.value};
    f->material_id = {scene.materials.entries().front().id.value};
    f->health.nan = 123456;
    f->health.faults[0][3] = 123456;
    f->health.first = {{}, {}, {}};
    f->health.fireflies = {{123456.7f, 1e12f, 1919, 1079, 1234567, 4294967295u}};
    f->bounces = {{{1, 1, 1}}, {{2, 2, 2}}, {{0, 0, 0}}};
    f->error.known = f->error.rmse_known = true;
    f->error.relmse = 12.3456;
    f->error_samples = 65536;
    f->light_groups = std::make_shared<const LightGroups>(make_light_groups(scene));
    f->groups.assign(f->light_groups->groups.size(), {{1, 1, 1}});
    for (const auto& group : f->light_groups->groups) f->group_names.push_back(group.name);
    f->gains.assign(f->light_groups->groups.size(), {1, 1, 1});
    f->group_shares.resize(f->light_groups->groups.size());
    return f;
}

struct Widget {
    std::string name;
    float x = 0, y = 0; // its middle
};

// The widgets of the last frame.
class ProbeFile {
public:
    explicit ProbeFile(UiState& ui) : ui_(ui) { ui_.probe = Probe(file_); }

    std::vector<Widget> widgets() const {
        ui_.probe.end_frame({});
        std::vector<Widget> found;
        std::ifstream in(file_);
        for (std::string line; std::getline(in, line);) {
            const size_t end = line.find("\": {\"height\"");
            float height = 0, width = 0, x = 0, y = 0;
            if (line.rfind("  \"", 0) != 0 || end == std::string::npos) continue;
            constexpr const char* format = "{\"height\":%f,\"width\":%f,\"x\":%f,\"y\":%f}";
            if (std::sscanf(line.c_str() + end + 3, format, &height, &width, &x, &y) == 4)
                found.push_back({line.substr(3, end - 3), x + std::min(width / 2, 20.f), y + height / 2});
        }
        return found;
    }

private:
    UiState& ui_;
    const test::TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "probe.json";
};

class LongNames : public testing::Test {
protected:
    void TearDown() override {
        if (ImGui::GetCurrentContext()) ImGui::DestroyContext();
    }

    void begin(float width, float height, float scale) {
        if (ImGui::GetCurrentContext()) ImGui::DestroyContext();
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {width, height};
        io.DeltaTime = 1.f / 60;
        load_fonts(BLUSH_ASSETS, scale);
        apply_theme(scale);
        unsigned char* pixels = nullptr;
        int w = 0, h = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
        ui.docks = {};
    }

    void draw_frames(int count) {
        const std::optional<Mixing> mixing = compared_mixing(*frame->light_groups, document.project().scene);
        for (int i = 0; i < count; ++i) {
            ui.probe.begin_frame();
            ImGui::NewFrame();
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            c.mixing = mixing ? &*mixing : nullptr;
            draw(c);
            ImGui::Render();
        }
    }

    // Draws some frames of the window; the texts of the last one must be readable.
    void expect_readable(const std::string& what) {
        draw_frames(4);
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        for (const std::string& problem : test::unreadable_text(*ImGui::GetDrawData(), {"log"}))
            ADD_FAILURE() << what << " at " << size.x << " x " << size.y << ", " << ImGui::GetFontSize() << " pixels: " << problem;
    }

    void draw(PanelContext& c) {
        if (ImGui::BeginMainMenuBar()) {
            draw_menu_bar(c);
            ImGui::EndMainMenuBar();
        }
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        const Layout l = window_layout(c, size.x, size.y);
        draw_side_panels(c, l);
        begin_region("Status", l.status, {.padded = false});
        draw_status_bar(c);
        end_region();
        draw_snapshot_strip(c, l.strip, [](size_t) { return ThumbnailPart{}; });
        if (extra) extra(c, l);
    }

    // Presses and releases a mouse button; the mouse stays there.
    void click(const Widget& widget, int button) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = {widget.x, widget.y};
        draw_frames(1);
        io.MouseDown[button] = true;
        draw_frames(1);
        io.MouseDown[button] = false;
        draw_frames(2);
    }
    void close_popups() {
        if (GImGui->OpenPopupStack.Size > 0) ImGui::ClosePopupToLevel(0, false);
        ImGui::ClearActiveID();
        ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
        draw_frames(1);
    }

    template <class Body> void at_all_sizes(const Body& body) {
        struct Size {
            float width, height, scale;
        };
        for (const Size& s : {Size{1280, 720, 1}, Size{1720, 960, 1}, Size{2560, 1440, 2}, Size{1720, 960, 1.5f}, Size{1280, 720, 2},
                              Size{2560, 1440, 1}, Size{1720, 960, 2}}) {
            begin(s.width, s.height, s.scale);
            body();
        }
    }

    Document document{with_long_names()};
    const ColorManagement color = test::our_colors();
    UiState ui;
    FramePtr frame = long_frame(document.project().scene);
    std::function<void(PanelContext&, const Layout&)> extra;
};

TEST_F(LongNames, InspectorAndOutliner) {
    at_all_sizes([&] {
        for (const auto& entry : document.project().scene.nodes)
            for (int tab = 0; tab <= int(InspectorTab::display); ++tab) {
                ui.select(entry.id);
                ui.tab = InspectorTab(tab);
                expect_readable(fmt::format("tab {}, node {}", tab, entry.id.value));
            }
        ui.select({}, document.project().scene.materials.entries().front().id);
        expect_readable("a material");
    });
}

TEST_F(LongNames, EveryInstrumentInEitherDock) {
    ui.snapshots.list = {snapshot(1, document.project())}; // only one: the strip scrolls horizontally
    ImportReport report;
    report.extensions_used = {"KHR_" + long_name("extension")};
    report.extensions_honoured = report.extensions_used;
    report.diagnostics = {
        {Diagnostic::Severity::warning, "ignored: " + long_name("what"), "nodes[0].mesh.primitives[0]." + long_name("where")}};
    ui.import_report.report = std::make_shared<const ImportReport>(std::move(report));
    ui.import_report.file = long_name("Import") + ".gltf";
    ui.convergence.runs.begin(long_name("Run"));
    ui.convergence.denoised = ui.convergence.reference = true;
    ui.settings.recent = {"/home/" + long_name("Recent") + ".gltf"};
    ui.demos = {"/home/" + long_name("Demo") + ".gltf"};
    for (int i = 0; i < 3; ++i) {
        Node node = *document.project().scene.nodes.find(document.project().scene.nodes.entries().front().id);
        node.name = long_name("Renamed", size_t(i));
        ASSERT_TRUE(document.apply(SetNode{document.project().scene.nodes.entries().front().id, node}));
    }
    at_all_sizes([&] {
        for (const Instrument& i : instruments()) {
            // They render while they are open: see RouletteLab, StrategiesPanel and IntegratorsPanel.
            if (std::string(i.id) == "roulette" || std::string(i.id) == "strategies" || std::string(i.id) == "integrators") continue;
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            const bool was_open = i.is_open(c);
            if (std::string(i.id) == "comparison") ui.snapshots.compare = {Comparison::Mode::difference, 1, live_image};
            if (std::string(i.id) == "snapshot") ui.snapshots.details = 1;
            if (std::string(i.id) == "pixel") ui.pixel = PixelProbe{0.5, 0.5};
            i.set_open(c, true);
            ui.light_mix.unfolded = frame->light_groups->groups.front().name;
            for (const DockSide side : {DockSide::right, DockSide::bottom}) {
                place_of(ui.settings.dock, i.id, side) = {i.id, side, false};
                ui.docks.to_front.insert(i.id);
                expect_readable(fmt::format("{} {}", i.title, side == DockSide::right ? "on the right" : "at the bottom"));
            }
            if (!was_open) i.set_open(c, false);
        }
    });
}

TEST_F(LongNames, PopupsAndDialogs) {
    const RunningJob job{.title = "Opening " + long_name("File") + ".gltf", .what = long_name("what"), .fraction = 0.5, .can_cancel = true};
    extra = [&](PanelContext& c, const Layout& l) {
        draw_cards(c, l.viewport, &job);
        draw_no_light_banner(c, l.viewport);
    };
    at_all_sizes([&] {
        ui.toasts.fail("Cannot open " + long_name("File"), "/home/somebody/" + long_name("Folder") + "/" + long_name("File"));
        expect_readable("cards");
        ui.show_shortcuts = true;
        extra = [](PanelContext& c, const Layout&) { draw_shortcut_sheet(c); };
        expect_readable("shortcuts");
        ui.show_shortcuts = false;
        ui.dialog = ModalDialog{.text = "Save " + long_name("File") + " before it is closed?", .details = long_name("Details")};
        extra = [](PanelContext& c, const Layout&) { draw_modal_dialog(c); };
        for (const std::string& file : {long_name("File"), std::string("table")}) {
            ui.dialog->choices = {"Save as " + file + ".blush.gltf", "Overwrite " + file + ".gltf", "Cancel"};
            expect_readable("modal dialog about " + file);
        }
        ui.dialog.reset();
    });
}

// Text over the image, in the viewport beside open docks and in a narrow one.
TEST_F(LongNames, ViewportOverlays) {
    ui.home = home_at_opening(document.project().scene);
    ASSERT_TRUE(ui.home.camera);
    View away = document.project().scene.view;
    away.position.x += 1;
    document.navigate(away);
    std::function<void(PanelContext&, ImDrawList&, const ImageRect&)> overlay;
    float share = 1;
    extra = [&](PanelContext& c, const Layout& l) {
        begin_region("Viewport", {l.viewport.x, l.viewport.y, l.viewport.width * share, l.viewport.height}, {.padded = false});
        const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
        overlay(c, *ImGui::GetWindowDrawList(), {at.x, at.y, size.x, size.y});
        end_region();
    };
    const auto expect_all_readable = [&](const std::string& what) {
        for (const float s : {1.f, 0.4f}) {
            share = s;
            expect_readable(fmt::format("{}, {} of the viewport", what, s));
        }
    };
    ui.aov = {ImageView::Show::group, 0};
    at_all_sizes([&] {
        overlay = [&](PanelContext& c, ImDrawList& draw, const ImageRect& seen) {
            draw_camera_frame(c, draw, seen, seen, true);
            draw_aov_bar(c, seen);
            draw_map_scale(draw, seen, *frame, {ImageView::Show::depth});
        };
        expect_all_readable("AOVs, map scale and free view");
        overlay = [&](PanelContext& c, ImDrawList& draw, const ImageRect& seen) {
            const Projection towards_meter({.position = {0, 0, 4}}, double(seen.width) / seen.height);
            draw_meters(draw, seen, towards_meter, c.scene(), {.meters = {{long_name("Meter"), {}, {}, {0, 0, 1}, 1}}}, c.ui.meters);
        };
        expect_all_readable("a meter");
        overlay = [&](PanelContext&, ImDrawList&, const ImageRect& seen) { name_sides(long_name("A"), long_name("B"), seen); };
        expect_all_readable("both sides of a wipe");
        overlay = [&](PanelContext&, ImDrawList&, const ImageRect& seen) { name_image("A   " + long_name("A"), seen); };
        expect_all_readable("one side");
        overlay = [&](PanelContext&, ImDrawList& draw, const ImageRect&) {
            draw_hint(draw, "Scale along the local axis X: 12345.678   Enter or click: confirm.  Esc: cancel");
        };
        expect_all_readable("a transform");
    });
}

// The longest figures that the lab can show.
TEST_F(LongNames, RouletteLab) {
    RouletteReport report;
    report.rounds = 123456;
    report.width = report.height = 96;
    report.rule = {12345.67, 123456.78, 0.012345678, 1.2345e-12, 1.2345e-12, {}, {}};
    report.none = {12345.67, 123456.78, 0.012345678, 1.2345e+12, 1.2345e+12, {}, {}};
    report.rule.alive.assign(14, 1);
    report.rule.survival.assign(14, 1);
    report.efficiency_gain = 12345.67;
    report.gain_error = 1234.56;
    report.bias.push_back({"whole image", 1, -0.987654, 0.012345, true});
    for (int k = 0; k < 12; ++k) report.bias.push_back({fmt::format("bounce {}+", k), 1, -0.987654, 0.987654, true});
    extra = [&](PanelContext& c, const Layout& l) {
        begin_region("Lab", l.right_dock.width > 0 ? l.right_dock : l.inspector);
        draw_roulette_report(c, report);
        end_region();
    };
    at_all_sizes([&] { expect_readable("roulette lab"); });
}

// A folder with long names, in the middle of a long path.
struct LongFolder {
    test::TemporaryFolder temporary;
    std::filesystem::path root = temporary.path();
    std::filesystem::path folder = root / long_name("Outer") / long_name("Inner");
    LongFolder() {
        std::filesystem::create_directories(folder / long_name("Folder"));
        for (const char* name : {"scene.gltf", "map.exr", "lamp.ies", "chart.csv"})
            std::ofstream(folder / (long_name("File") + "_" + name)) << "x";
    }
};

TEST_F(LongNames, FileBrowser) {
    const LongFolder files;
    extra = [](PanelContext& c, const Layout&) { draw_file_browser(c); };
    ui.settings.bookmarks = {files.folder.string()};
    ui.settings.recent = {(files.folder / "scene.gltf").string()};
    using Use = FileRequest::Use;
    at_all_sizes([&] {
        for (const Use use : {Use::open, Use::environment, Use::ies, Use::snapshot_folder, Use::convergence, Use::save_scene}) {
            ui.browser = FileBrowser{.use = use, .folder = files.folder, .typed = {}, .chosen = {}, .scene_folder = files.root};
            draw_frames(3);
            ImGui::ClearActiveID(); // the field for the path scrolls while it is edited
            expect_readable(title_of(use));
            ui.browser.reset();
            close_popups();
        }
    });
}

TEST_F(LongNames, OpenMenus) {
    for (int i = 0; i < 3; ++i) ui.settings.recent.push_back("/home/somebody/" + long_name("Folder") + "/" + long_name("Recent") + ".gltf");
    ui.demos = {"/home/" + long_name("Demo") + ".gltf"};
    Node node = *document.project().scene.nodes.find(document.project().scene.nodes.entries().front().id);
    node.name = long_name("Renamed");
    ASSERT_TRUE(document.apply(SetNode{document.project().scene.nodes.entries().front().id, node}));
    const ProbeFile probe(ui);
    std::set<std::string> submenus;
    at_all_sizes([&] {
        draw_frames(2);
        for (const Widget& title : probe.widgets()) {
            if (title.name.rfind("Menu bar/", 0) != 0) continue;
            click(title, 0);
            ASSERT_EQ(GImGui->OpenPopupStack.Size, 1) << title.name;
            expect_readable(title.name);
            const ImRect rows = GImGui->OpenPopupStack[0].Window->Rect();
            for (float y = rows.Min.y; y < rows.Max.y; y += ImGui::GetTextLineHeight()) {
                ImGui::GetIO().MousePos = {rows.Min.x + ImGui::GetFontSize() * 2, y};
                draw_frames(3);
                if (GImGui->OpenPopupStack.Size < 2) continue;
                submenus.insert(fmt::format("{} {}", title.name, GImGui->OpenPopupStack[1].PopupId));
                expect_readable("submenu of " + title.name);
            }
            close_popups();
        }
    });
    EXPECT_EQ(submenus.size(), 4u) << "recent files, demos, new lights, text size";
}

TEST_F(LongNames, MenusTallerThanTheWindowScroll) {
    const ProbeFile probe(ui);
    begin(1720, 960, 2);
    draw_frames(2);
    const auto find = [&](const std::string& name) {
        const std::vector<Widget> widgets = probe.widgets();
        const auto found = std::ranges::find(widgets, name, &Widget::name);
        return found == widgets.end() ? std::optional<Widget>() : *found;
    };
    const std::optional<Widget> view = find("Menu bar/View");
    ASSERT_TRUE(view);
    click(*view, 0);
    ASSERT_EQ(GImGui->OpenPopupStack.Size, 1);
    const ImGuiWindow& menu = *GImGui->OpenPopupStack[0].Window;
    EXPECT_GE(menu.Rect().Min.y, ImGui::GetFrameHeight()) << "the menu bar stays visible";
    EXPECT_LE(menu.Rect().Max.y, 960);
    const std::string last = std::string("Menu/") + shortcut(Command::health).name;
    EXPECT_FALSE(find(last));
    ImGui::GetIO().MousePos = menu.Rect().GetCenter();
    for (int i = 0; i < 40; ++i) {
        ImGui::GetIO().MouseWheel = -1;
        draw_frames(1);
    }
    draw_frames(1);
    ASSERT_TRUE(find(last));
    EXPECT_LT(find(last)->y, 960);
}

// Combo boxes, context menus, colour pickers: every popup that a click on a widget opens.
TEST_F(LongNames, EveryPopupThatAClickOpens) {
    const ProbeFile probe(ui);
    ui.snapshots.list = {snapshot(1, document.project())};
    std::set<std::string> popups;
    const auto expect_readable_popup = [&](const Widget& widget, int button) {
        const UiState state = ui;
        const Document before = document;
        click(widget, button);
        if (GImGui->OpenPopupStack.Size > 0) {
            popups.insert(widget.name);
            expect_readable((button ? "right click on " : "click on ") + widget.name);
        }
        ui = state;
        document = before;
        close_popups();
    };
    at_all_sizes([&] {
        std::set<std::string> clicked;
        for (const auto& entry : document.project().scene.nodes)
            for (int tab = 0; tab <= int(InspectorTab::display); ++tab) {
                ui.select(entry.id);
                ui.tab = InspectorTab(tab);
                draw_frames(2);
                for (const Widget& widget : probe.widgets())
                    for (const int button : {0, 1})
                        if (clicked.insert(fmt::format("{} {}", widget.name, button)).second) expect_readable_popup(widget, button);
            }
    });
    for (const char* name : {"Outliner/Add light", "Outliner/Scene", "Snapshot/1"}) EXPECT_TRUE(popups.contains(name)) << name;
    EXPECT_GT(popups.size(), 30u);
}

} // namespace
} // namespace blush::TEST_FILE
