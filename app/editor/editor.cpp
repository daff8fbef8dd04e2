#include "app/editor/editor.h"

#include "app/commands/common.h"
#include "app/common/assets_dir.h"
#include "app/common/output_folder.h"
#include "app/editor/editor_commands.h"
#include "app/editor/editor_convergence.h"
#include "app/editor/editor_display.h"
#include "app/editor/editor_farm.h"
#include "app/editor/editor_lesson.h"
#include "app/editor/editor_messages.h"
#include "app/editor/editor_panels.h"
#include "app/editor/editor_presentation.h"
#include "app/editor/editor_probe.h"
#include "app/editor/editor_snapshots.h"
#include "app/editor/guide.h"
#include "app/editor/live_mix.h"
#include "app/editor/one_shot_metering.h"
#include "app/editor/write_at_end.h"
#include "app/files/desktop_file_dialog.h"
#include "app/files/editor_files.h"
#include "app/files/editor_saving.h"
#include "app/files/file_router.h"
#include "app/files/start_page.h"
#include "ui/jobs/map_thumbnails.h"
#include "ui/panels/instruments.h"
#include "ui/snapshots/snapshot_strip.h"
#include "ui/viewport/camera_frame_overlay.h"
#include "ui/viewport/regions.h"
#include "ui/viewport/viewport.h"
#include "ui/window/automation.h"
#include "ui/window/frame_stats.h"
#include "ui/window/imgui_state.h"
#include "ui/window/ui_persistence.h"
#include "ui/window/window.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

using Clock = FrameStats::Clock;

constexpr double max_sleep = 1; // seconds: interval of checks whether the scene file has changed

class Editor {
public:
    Editor(const EditorOptions& options, std::unique_ptr<Window> window, ColorManagement color, const Automation& automation,
           WindowSettings settings);
    void run();

private:
    void poll();
    void panels();
    void submit();
    void latest();
    void draw();

    PanelContext context();
    void draw_regions(PanelContext& c);
    void draw_on_top(PanelContext& c);
    void handle_requests(PanelContext& c);
    void run_own_command(Command command);
    FileRouter takers() { return {files_, saving_, snapshots_, convergence_, document_, ui_}; }
    void save_due_snapshot();
    void remember();
    Document& document_shown();
    RenderSettings render_settings();
    void keep_size(const RenderSettings& kept);
    // The revision that the window expects; 0: none yet.
    uint64_t submitted_revision() const { return submitted_ ? submitted_->revision : 0; }
    void submit_preview(const Scene& scene);
    bool shows_preview() const { return images_.frame && images_.frame->revision <= last_preview_; }

    Automation automation_;
    std::unique_ptr<Window> window_; // constructed first, destroyed last: the session calls wake()
    ColorManagement color_;
    EditorOptions options_;
    Document document_;
    UiState ui_;
    Viewport viewport_;
    EditorDisplay display_;
    EditorFiles files_{&Window::wake};
    EditorSaving saving_;
    DesktopFileDialog desktop_file_dialog_{&Window::wake};
    bool leaving_ = false;
    EditorFarm farm_{&Window::wake, options_.threads};
    EditorSnapshots snapshots_{&Window::wake, options_.assets, [this](std::function<void()> then) {
                                   saving_.before_losing_edits("opening another scene", std::move(then));
                               }};
    ThumbnailSheet thumbnails_;
    WaveformSheet waveforms_;
    FrameStats stats_;
    FrameBudget pace_;
    Images images_;
    ImageMix wanted_mix_;
    EditorConvergence convergence_;
    LiveMix mix_;
    OneShotMetering metering_;
    EditorMessages messages_;
    StartPage opening_page_{options_.assets, &Window::wake};
    EditorLesson lesson_{options_.assets, &Window::wake};
    EditorPresentation presentation_;
    std::string weights_problem_; // why the denoiser's weights cannot be used; empty: they can
    RenderSession session_;
    SubmissionPtr submitted_; // null: the open scene is not submitted yet
    uint64_t last_revision_ = 0;
    uint64_t last_preview_ = 0; // revision of the last scene shown while textures load; 0: none
    bool session_paused_ = false, session_denoises_ = false, session_yields_ = false;
    bool remembered_follow_viewport_ = true; // the saved setting, before the command line
    Layout layout_;                          // of the last UI frame
    bool instruments_restored_ = false;
    ImageRect image_;
    enum class SnapshotDue { none, keep, png, plan } snapshot_due_ = SnapshotDue::none; // pending until an image in full resolution exists
    Clock::time_point frame_begin_{};
};

Editor::Editor(const EditorOptions& options, std::unique_ptr<Window> window, ColorManagement color, const Automation& automation,
               WindowSettings settings)
    : automation_(automation), window_(std::move(window)), color_(std::move(color)), options_(options), display_(color_, options.weights),
      saving_(files_, document_, ui_, options.assets, automation.autosave_interval), convergence_(&Window::wake, options.threads),
      session_({.threads = options.threads,
                .low_priority = true,
                .first_hit_planes = true,
                .denoiser = denoiser_maker(options.weights, options.threads, true)},
               &Window::wake) {
    ui_.settings = std::move(settings);
    ui_.maps.thumbnails = std::make_shared<MapThumbnails>();
    restore_panels(ui_.settings, ui_);
    ImGui::LoadIniSettingsFromMemory(ui_.settings.floating.c_str(), ui_.settings.floating.size());
    if (const auto found = find_denoiser_weights(options.weights); !found)
        weights_problem_ = found.error().text() + ": run packaging/setup to download them";
    else if (options.denoise)
        ui_.denoise.show = DenoiseView::Show::denoised;
    if (!weights_problem_.empty()) ui_.denoise.show = DenoiseView::Show::raw;
    remembered_follow_viewport_ = ui_.settings.follow_viewport;
    if (!options.follow_viewport) ui_.settings.follow_viewport = false;
    ui_.probe = Probe(automation.probe_file);
    if (!color_.warning().empty())
        ui_.toasts.warn("The OCIO configuration cannot be used: the default one is used instead", color_.warning());
    document_.reset(Project{{}, options.render, options.view});
    if (const auto loaded = viewport_.load(); !loaded) ui_.toasts.fail(loaded.error().text());
    files_.open(
        options.scene.empty() ? options.assets / "scenes" / "card-and-mug.gltf" : options.scene,
        {options.overrides, float(options.render.width) / float(options.render.height), options.settings_given, options.view_given});
    ui_.demos = opening_page_.demos();
    ui_.lesson.shipped = lesson_.shipped();
    ui_.opening_page = options.scene.empty();
    saving_.offer_recovery(options.scene);
}

void Editor::run() {
    while (!leaving_) {
        const auto sleeps_since = Clock::now();
        const bool frame_is_due = ui_.seconds_to_next_frame <= max_sleep;
        const bool asked = window_->wait(std::clamp(ui_.seconds_to_next_frame, 0.0, max_sleep));
        pace_.begin(frame_begin_ = Clock::now());
        ui_.seconds_to_next_frame -= std::chrono::duration<double>(frame_begin_ - sleeps_since).count();
        const uint64_t toasts = ui_.toasts.added();
        poll();
        if (ui_.toasts.added() != toasts) window_->request_frames(2);
        if (!asked && !frame_is_due && !window_->wait(0)) continue;
        latest();
        panels();
        submit();
        draw();
    }
    presentation_.end(context(), *window_);
    if (!lesson_.end(context()) && !shows_preview())
        opening_page_.save_thumbnail(files_.scene_file(), images_.frame, document_.project().view, color_, true);
    saving_.end();
    snapshots_.finish_all();
    remember();
}

// Handles input and results of background jobs.
void Editor::poll() {
    open_requested_page(ui_, guide_dir());
    const EditorFiles::Finished finished = files_.poll(document_, ui_);
    saving_.poll(finished);
    if (finished.opened || finished.saved) {
        window_->set_title(files_.scene_file().filename().string() + " - Blush");
        if (finished.opened) {
            lesson_.end(context());
            submitted_ = nullptr; // a new scene is always submitted
            messages_.opened();
            metering_.opened(finished.stored_exposure || std::exchange(options_.exposure_given, false), document_.project());
            snapshots_.load_strip(ui_, files_.scene_file());
            if (!std::exchange(instruments_restored_, true)) restore_instruments(context(), files_.scene_file().string());
        }
        window_->request_frames(2);
    }
    snapshots_.poll(finished.opened, document_, ui_, files_, session_);
    farm_.poll(ui_, files_.scene_file(), snapshots_);
    if (window_->close_requested()) {
        window_->cancel_close();
        window_->request_frames(2);
        if (!ui_.dialog) saving_.before_losing_edits("closing the window", [this] { leaving_ = true; });
    }
    for (const auto& file : window_->take_dropped_files()) takers().dispatch_dropped(file);
    if (!files_.preview() && lesson_.poll(context(), document_.project())) submitted_ = nullptr;
    // While text is edited or a popup is open, it receives the keys. Esc closes menus and combo boxes; dialogs handle it
    // themselves.
    const bool taken = ImGui::GetIO().WantTextInput || ui_.browser || ui_.dialog, menu = any_popup_open();
    const bool flying = ImGui::IsMouseDown(ImGuiMouseButton_Right); // letters are then navigation keys instead of commands
    for (const KeyPress& press : window_->take_key_presses()) {
        if (ui_.transform.takes_keys()) {
            ui_.transform.keys.push_back(press);
            continue;
        }
        if (!taken && !menu && EditorPresentation::takes(press, ui_)) continue;
        const Shortcut* s = find_shortcut(press);
        if (!s || taken || flying || (menu && s->command != Command::clear_selection)) continue;
        if (files_.preview() || ui_.tool != ViewTool::none || !ui_.transform.begin(s->command)) ui_.commands.push_back(s->command);
    }
    save_due_snapshot();
}

// The displayed document, or the preview of a scene that is loading, or that of a lesson.
Document& Editor::document_shown() {
    if (Document* lesson = lesson_.document()) return *lesson;
    Document* preview = files_.preview();
    return preview ? *preview : document_;
}

PanelContext Editor::context() {
    const RenderSettings r = render_settings();
    const SessionStatus status = session_.status();
    return {document_shown(),
            ui_,
            color_,
            images_.frame,
            status,
            std::max(1, int(float(r.width) * r.resolution_scale)),
            std::max(1, int(float(r.height) * r.resolution_scale)),
            images_.denoised,
            status.denoiser_failure.empty() ? weights_problem_ : status.denoiser_failure,
            &display_.feature_report(),
            mix_.mixing(),
            display_.metered_ev()};
}

void Editor::panels() {
    const ViewSettings view = document_shown().project().view;
    settle(ui_.frame, view, document_shown().project().scene, ui_.home.camera);
    display_.update_shader(view, images_.frame, viewport_, thumbnails_, ui_.toasts);
    display_.update_feature_report(session_.status());
    display_.meter(view.auto_exposure, images_.frame);
    window_->set_text_size(text_size_shown(ui_));
    window_->begin_frame();
    ui_.seconds_to_next_frame = 1e9;
    ui_.probe.begin_frame();
    ui_.wraps_cursor = false;
    mix_.follow(images_.frame, document_shown());
    PanelContext c = context();
    draw_regions(c);
    draw_on_top(c);
    window_->wrap_cursor(ui_.wraps_cursor);
    handle_requests(c);
}

void Editor::draw_regions(PanelContext& c) {
    if (ImGui::BeginMainMenuBar()) {
        draw_menu_bar(c);
        ImGui::EndMainMenuBar();
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const bool panels = !ui_.panels_hidden;
    follow_meters(c);
    waveforms_.update(ui_.scopes);
    c.waveforms = waveforms_.textures();
    c.strategies = display_.strategies(ui_, c.shown_view());
    c.integrators = display_.integrators(ui_, c.shown_view());
    c.file_thumbnail = [this](const std::string& file) { return opening_page_.thumbnail(file); };
    const Layout l = layout_ = window_layout(c, screen.x, screen.y);
    ImGui::BeginDisabled(files_.preview() != nullptr); // edits would be lost when the scene replaces the document
    if (panels) draw_side_panels(c, l);
    // after all code that changes lights: the image of this frame shows their edits
    mix_.follow(images_.frame, document_shown());
    c.mixing = mix_.mixing();
    begin_region("Viewport", l.viewport, {.padded = false, .background = false});
    pace_.begin_image(Clock::now());
    image_ = files_.preview() ? viewport_.draw_alone(c, pace_, files_.preview_note().c_str()) : viewport_.draw(c, pace_);
    pace_.end_image(Clock::now());
    end_region();
    begin_region("Status", l.status, {.padded = false});
    draw_status_bar(c);
    end_region();
    thumbnails_.update(ui_.snapshots.list, display_parameters_of(c.shown_view()));
    if (panels) draw_snapshot_strip(c, l.strip, [this](size_t i) { return thumbnails_.part(i); });
    ImGui::EndDisabled();
}

void Editor::draw_on_top(PanelContext& c) {
    if (ui_.panels_hidden) draw_pixel_popup(c);
    draw_gizmo_bar(c, {image_.x, image_.y, image_.width, image_.height});
    draw_no_light_banner(c, layout_.viewport);
    draw_shortcut_sheet(c);
    draw_file_browser(c);
    const auto opening = files_.running(), other = snapshots_.running();
    const RunningJob* const job = opening ? &*opening : other ? &*other : nullptr;
    if (job) ui_.seconds_to_next_frame = std::min(ui_.seconds_to_next_frame, 0.1);
    if (draw_cards(c, layout_.viewport, job) && opening) files_.cancel();
    draw_modal_dialog(c);
    draw_marks(ui_);
}

// Executes requests of panels, menus and keys.
void Editor::handle_requests(PanelContext& c) {
    for (const Command command : std::exchange(ui_.commands, {})) {
        const bool needs_document =
            command != Command::open && command != Command::quit && command != Command::shortcuts && command != Command::guide;
        if (needs_document && files_.preview())
            ui_.toasts.note("Not available until the textures are loaded");
        else if (!run_command(command, c) && !lesson_.refuses(command, ui_))
            run_own_command(command);
    }
    presentation_.poll(c, *window_);
    desktop_file_dialog_.poll(ui_);
    for (const FileRequest& request : std::exchange(ui_.files, {})) takers().take(request);
    if (std::exchange(ui_.meter_exposure, false) && !lesson_.document()) metering_.want(document_.project(), false);
    saving_.poll_dialog();
    const std::filesystem::path output = output_folder(ui_.settings.snapshot_folder, files_.scene_file(), options_.assets);
    convergence_.handle_requests(ui_, output, files_.scene_file());
    if (farm_.handle_requests(c, output)) snapshot_due_ = SnapshotDue::plan;
    snapshots_.handle_requests(document_, ui_, files_);
    const bool paused = ui_.paused || convergence_.is_rendering_reference() || farm_.is_measuring();
    if (session_paused_ != paused) session_.pause(session_paused_ = paused);
    // While a mix is edited, only its drawing matters.
    if (session_yields_ != viewport_.is_subsampled()) session_.yield_to_ui(session_yields_ = viewport_.is_subsampled());
    const bool denoises = ui_.denoise.wants_denoised() || ui_.convergence.wants_denoised();
    if (session_denoises_ != denoises) session_.want_denoised(session_denoises_ = denoises);
    const ImageMix mix = mix_of(ui_.denoise, images_.denoised != nullptr);
    if (mix != wanted_mix_) stats_.view_changed(frame_begin_);
    wanted_mix_ = mix;
}

void Editor::run_own_command(Command command) {
    if (takers().browse_for(command)) return;
    switch (command) {
    case Command::reload: return saving_.before_reloading([this](bool keep_edits) { files_.reload(keep_edits); });
    case Command::save_scene: return saving_.save();
    case Command::save_scene_as: return saving_.ask_for_file();
    case Command::snapshot_exr: snapshot_due_ = SnapshotDue::keep; return save_due_snapshot();
    case Command::snapshot_png: snapshot_due_ = SnapshotDue::png; return save_due_snapshot();
    case Command::quit: return window_->request_close();
    case Command::full_screen: return window_->toggle_full_screen();
    default: return;
    }
}

void Editor::save_due_snapshot() {
    const FramePtr& frame = images_.frame;
    if (shows_preview()) return;
    if (snapshot_due_ == SnapshotDue::none || !frame || frame->revision != submitted_revision() || frame->divider != 1) return;
    EditorSnapshots::Shown shown{
        submitted_revision(), images_,           ui_.denoise,         document_.project(),
        submitted_->settings, files_.imported(), files_.scene_file(), camera_frame_of(ui_, document_.project().scene, *frame)};
    if (snapshot_due_ == SnapshotDue::keep)
        snapshots_.keep(std::move(shown), session_);
    else if (snapshot_due_ == SnapshotDue::plan)
        farm_.make(context(), std::move(shown));
    else
        snapshots_.save_png(shown, color_, ui_);
    snapshot_due_ = SnapshotDue::none;
}

RenderSettings Editor::render_settings() {
    RenderSettings r = document_shown().project().render;
    if (ui_.settings.follow_viewport && layout_.room.width > 0) {
        const ImageSize size = image_size(ui_.frame, int(layout_.room.width), int(layout_.room.height));
        r.width = size.width;
        r.height = size.height;
    }
    return effective_settings(r);
}

// A restored snapshot keeps its size, even if the window would give another one.
void Editor::keep_size(const RenderSettings& kept) {
    const RenderSettings r = render_settings();
    if (!ui_.settings.follow_viewport || (r.width == kept.width && r.height == kept.height)) return;
    ui_.settings.follow_viewport = false;
    ui_.toasts.note(fmt::format("The image keeps the snapshot's {} × {} pixels", kept.width, kept.height),
                    "To render at the window's size again, switch on Fit viewport in the Render tab.");
}

// Submits the project if something that affects the image has changed.
void Editor::submit() {
    const Document& shown = document_shown();
    if (files_.preview() && !lesson_.document()) return submit_preview(shown.project().scene);
    if (files_.scene_file().empty() && !lesson_.document()) return; // nothing is open yet
    const std::optional<EditorSnapshots::Restored> restored = snapshots_.take_restored();
    if (restored) keep_size(restored->settings);
    const RenderSettings r = render_settings();
    const Scene& scene = shown.project().scene;
    const PlaneSet planes = ui_.wanted_planes();
    const bool restores = restored && restored->film && worth_restoring(*restored->film, submitted_, {scene, r}, images_);
    const FilmStatePtr film = restores ? restored->film : nullptr;
    const uint64_t revision = last_revision_ + 1;
    const SubmissionPtr next =
        film || !submitted_ ? session_.submit(revision, scene, r, planes, film) : session_.submit_changes(revision, scene, r, planes);
    if (!next) return;
    last_revision_ = revision;
    const std::string opened = submitted_ ? "" : ui_.lesson.is_on() ? ui_.lesson.title : files_.scene_file().filename().string();
    const bool goes_back = submitted_ && submitted_->revision == last_preview_; // no other scene has replaced the document
    submitted_ = next;
    goes_back ? convergence_.begin(ui_.convergence, "Textures loaded", next) : convergence_.submit(ui_.convergence, shown, next, opened);
    stats_.submitted(revision, frame_begin_);
}

void Editor::submit_preview(const Scene& scene) {
    const uint64_t revision = last_revision_ + 1;
    const SubmissionPtr next = session_.submit_changes(revision, scene, render_settings());
    if (!next) return;
    submitted_ = next;
    last_preview_ = last_revision_ = revision;
}

void Editor::latest() {
    images_ = session_.images();
    if (shows_preview() && !files_.preview() && files_.scene_file().empty()) images_ = {}; // there is no document to return to
    if (!shows_preview()) convergence_.update(ui_.convergence, images_);
    if (images_.frame && images_.frame->revision == submitted_revision() && !files_.preview() && !lesson_.document()) {
        metering_.update(document_, images_.frame, ui_, color_);
        messages_.update(*images_.frame, document_.project().scene, ui_.toasts);
        opening_page_.save_thumbnail(files_.scene_file(), images_.frame, document_.project().view, color_);
    }
    messages_.update(session_.status(), ui_);
}

void Editor::draw() {
    const FramePtr& shown = viewport_.shown();
    ProbeState state = probe_state(image_, submitted_revision(), ui_.toasts, shown);
    if (shown) {
        state.up_to_date = shown->revision == submitted_revision() && !viewport_.is_subsampled();
        state.shown = shown->revision <= last_preview_ ? "while textures load" : shown_text(ui_.denoise, *shown, images_.denoised.get());
    }
    const bool drawn = window_->end_frame();
    state.inputs = window_->settled_inputs();
    state.settled = !window_->frames_due() && ui_.seconds_to_next_frame > 0;
    const auto now = Clock::now();
    const FrameTimes took = pace_.end(now, drawn);
    // Without swapping buffers, nothing else limits the rate of frames that come by themselves.
    if (!drawn && !viewport_.draws_image()) ui_.seconds_to_next_frame = std::max(ui_.seconds_to_next_frame, FrameBudget::unchanged_pause);
    // Loading and shader compilation before the first image are not part of the statistics.
    if (shown) drawn ? stats_.add_frame(took, now) : stats_.add_unchanged_frame();
    mix_.follow(images_.frame, document_shown());
    const bool mixed = shown && mix_.is_shown_by(*shown, viewport_.shown_gains());
    if (shown) stats_.shown(mixed ? submitted_revision() : shown->revision, now);
    if (viewport_.shows(wanted_mix_)) stats_.view_change_shown(now);
    stats_.end_frame();
    ui_.probe.end_frame(state);
}

void Editor::remember() {
    WindowSettings& s = ui_.settings;
    save_panels(ui_, s);
    save_scene_ui(ui_, files_.scene_file().string(), s);
    s.floating = ImGui::SaveIniSettingsToMemory();
    // `--size` is not saved.
    if (!options_.follow_viewport && !s.follow_viewport) s.follow_viewport = remembered_follow_viewport_;
    s.maximized = window_->maximized();
    if (!s.maximized && !window_->full_screen()) {
        s.width = window_->size().width;
        s.height = window_->size().height;
    }
    write_at_end(s, stats_, automation_.stats_file);
}

} // namespace

int run_editor(const EditorOptions& options) {
    const Automation automation = automation_from_environment();
    WindowSettings settings = read_window_settings(window_settings_file());
    if (automation.width > 0) {
        settings.width = automation.width;
        settings.height = automation.height;
        settings.maximized = false;
    }
    auto window = Window::open({.title = "Blush",
                                .width = settings.width,
                                .height = settings.height,
                                .maximized = settings.maximized,
                                .scale = automation.scale,
                                .assets = options.assets});
    if (!window) return failed({"", window.error().what + "; without one, use `blush render SCENE -o OUT.exr`", ""});
    auto color = ColorManagement::load(options.assets, options.ocio_config);
    if (!color) return failed(color.error());
    Editor(options, *std::move(window), *std::move(color), automation, std::move(settings)).run();
    return 0;
}

} // namespace blush
