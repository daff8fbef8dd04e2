#include "app/files/editor_files.h"

#include "app/commands/common.h"
#include "io/gltf/read/camera_aspects.h"
#include "io/image/environment_image.h"
#include "io/image/ies.h"
#include "io/image/image_io.h"
#include "io/project/merge_edits.h"
#include "scene/lights/light_rig.h"
#include "ui/jobs/material_maps.h"
#include "ui/window/ui_persistence.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

// Shows the first warnings of the import report in a toast; the panel has all.
void report(UiState& ui, const std::filesystem::path& file, const ImportReport& r) {
    ui.import_report.file = file.filename().string();
    ui.import_report.report = std::make_shared<const ImportReport>(r);
    std::string details;
    int warnings = 0;
    for (const Diagnostic& d : r.diagnostics) {
        if (d.severity != Diagnostic::Severity::warning) continue;
        if (++warnings <= 4) details += (details.empty() ? "" : "\n") + d.what + (d.where.empty() ? "" : ", " + d.where);
    }
    if (warnings > 4) details += fmt::format("\nand {} more; File > Import report lists them all", warnings - 4);
    const std::string text = fmt::format("{}  ({:.2g} s)", file.filename().string(), r.seconds);
    if (warnings > 0)
        ui.toasts.warn(text, details);
    else
        ui.toasts.note(text);
}

// The camera of the home view, and its frame.
void begin_at_camera(UiState& ui, const Project& project, std::map<Id<Camera>, float> aspects) {
    ui.home = home_at_opening(project.scene);
    ui.frame = {.fit = ui.frame.fit, .from_file = std::move(aspects)};
    settle(ui.frame, project.view, project.scene, ui.home.camera);
}

// Inserted before the import's own warnings.
void list_conflicts(const std::vector<std::string>& conflicts, const std::string& heading, ImportReport& report) {
    std::vector<Diagnostic> all;
    if (!heading.empty()) all.push_back({Diagnostic::Severity::warning, heading, ""});
    for (const std::string& conflict : conflicts) all.push_back({Diagnostic::Severity::warning, conflict, ""});
    report.diagnostics.insert(report.diagnostics.begin(), all.begin(), all.end());
}

// Images may be there at an eighth of their size.
std::string note_of_preview(size_t textures, size_t shown) {
    if (shown == 0) return "Textures are loading: plain colours are shown instead";
    if (shown < textures) return fmt::format("Textures are loading: {} of {} are shown, plain colours for the others", shown, textures);
    return "Textures are loading: some are shown blurred";
}

bool has_our_settings(const ImportedScene& imported) { return imported.has_view || imported.render || imported.view; }

// A file not written by Blush that has no light gets studio lighting, instead of a black image; unless `--light` or
// `--environment` is given.
std::optional<Scene> lit_at_opening(const ImportedScene& imported, const Scene& scene, const SceneOverrides& overrides) {
    if (overrides.light || overrides.environment || has_our_settings(imported) || world_bounds(scene).empty || has_light(scene)) return {};
    Result<Scene> lit = with_light_rig(scene, LightRig::studio, studio_map());
    if (!lit) return {};
    return *std::move(lit);
}

// The node with the same name in another scene: ids do not survive a reload, names usually do.
Id<Node> same_node(const Scene& before, Id<Node> id, const Scene& after) {
    const Node* old = before.nodes.find(id);
    if (!old) return {};
    for (const auto& entry : after.nodes) {
        if (entry.value.name == old->name) return entry.id;
    }
    return {};
}

} // namespace

FileWatch::Time FileWatch::time_of(const std::filesystem::path& file) {
    std::error_code missing; // it may be in the middle of a rewrite: the next check decides
    const Time time = std::filesystem::last_write_time(file, missing);
    return missing ? Time{} : time;
}

void FileWatch::watch(const std::filesystem::path& file, Time known) {
    file_ = file;
    known_ = seen_ = known;
}

bool FileWatch::changed() {
    if (file_.empty()) return false;
    const auto now = time_of(file_);
    const bool settled = now == seen_ && now != known_ && now != Time{};
    seen_ = now;
    if (settled) known_ = now;
    return settled;
}

Result<EditorFiles::Opened> EditorFiles::import_file(const std::filesystem::path& file, const OpenOptions& open,
                                                     const std::optional<Sidecar>& sidecar, JobProgress& progress,
                                                     std::function<void(const ImportedScene&)> on_preview_scene) {
    ImportOptions options;
    options.on_preview_scene = std::move(on_preview_scene);
    options.cancel = &progress.cancel;
    options.on_progress = [&progress](double fraction, const std::string& what) { progress.report(fraction, what); };
    if (open.overrides.texture_mib) options.texture_bytes = *open.overrides.texture_mib << 20;
    Result<ImportedScene> imported = import_gltf(file, options);
    if (!imported) return in_file(imported.error(), file.string());
    Opened opened{*std::move(imported), {}, {}, {}, {}};
    opened.scene = opened.imported.scene;
    opened.camera_aspects = camera_aspects(opened.imported.origin);
    if (const auto applied = apply_overrides(open.overrides, opened.scene, open.aspect, opened.imported.has_view); !applied)
        return in_file(applied.error(), file.string());
    if (!sidecar) {
        opened.lit = lit_at_opening(opened.imported, opened.scene, open.overrides);
        return opened;
    }
    Result<RecoveredEdits> recovered = recover_edits(*sidecar, opened.imported.scene, *opened.imported.origin.json);
    if (!recovered) return in_file(recovered.error(), file.string());
    opened.recovered = std::move(recovered->project);
    if (recovered->file_changed)
        list_conflicts(recovered->conflicts, "The file has changed after these edits: they were reapplied by name", opened.imported.report);
    return opened;
}

void EditorFiles::start_import(const std::filesystem::path& file, Purpose purpose, const OpenOptions& options,
                               const std::optional<Sidecar>& sidecar) {
    if (file.empty()) return;
    purpose_ = purpose;
    keep_settings_ = options.keep_settings;
    keep_view_ = options.keep_view;
    std::error_code error;
    importing_ = std::filesystem::absolute(file, error); // the recent list must not depend on the working directory
    importing_since_ = FileWatch::time_of(importing_);
    preview_.reset();
    early_ = std::make_shared<EarlyScene>();
    // No preview for imports, reloads and recovery: the open scene stays visible.
    std::function<void(const ImportedScene&)> on_preview_scene;
    if (purpose == Purpose::open && !sidecar)
        on_preview_scene = [options, early = early_, wake = wake_](const ImportedScene& imported) {
            Opened opened{imported, imported.scene, {}, {}, {}};
            if (!apply_overrides(options.overrides, opened.scene, options.aspect, imported.has_view)) return;
            opened.lit = lit_at_opening(imported, opened.scene, options.overrides);
            early->put(std::move(opened));
            wake();
        };
    import_job_ = std::make_unique<BackgroundJob<Result<Opened>>>(
        "Loading " + file.filename().string(),
        [file, options, sidecar, on_preview_scene](JobProgress& progress) {
            return import_file(file, options, sidecar, progress, on_preview_scene);
        },
        wake_);
}

void EditorFiles::save(const std::filesystem::path& file, const Project& project) {
    saving_ = project;
    save_job_ = std::make_unique<BackgroundJob<Result<SavedGltf>>>(
        "Saving " + file.filename().string(),
        [file, project, origin = origin_](JobProgress&) { return save_gltf(origin, project, file, true); }, wake_);
}

void EditorFiles::load_environment(const std::filesystem::path& file) {
    environment_ = file;
    environment_job_ = std::make_unique<BackgroundJob<Result<ImagePtr>>>(
        "Loading " + file.filename().string(), [file](JobProgress&) { return read_environment_image(file); }, wake_);
}

void EditorFiles::load_map(const std::filesystem::path& file, UiState& ui) {
    map_ = ui.maps;
    map_file_ = file;
    map_job_ = std::make_unique<BackgroundJob<Result<ImagePtr>>>(
        "Loading " + file.filename().string(), [file](JobProgress&) { return read_image(file); }, wake_);
}

void EditorFiles::load_ies(const std::filesystem::path& file, Document& document, UiState& ui) const {
    const Scene& scene = document.project().scene;
    const Node* node = scene.nodes.find(ui.selected);
    const Light* selected = node ? scene.lights.find(node->light) : nullptr;
    if (!selected || (selected->kind != Light::Kind::point && selected->kind != Light::Kind::spot))
        return ui.toasts.fail(file.filename().string() + ": select a point or spot light first");
    Result<IesPtr> profile = read_ies(file);
    if (!profile) return ui.toasts.fail(profile.error().text());
    Light light = *selected;
    light.ies = *std::move(profile);
    // Files in the scene's folder get relative names, so that they can be moved with the scene.
    const std::filesystem::path beside = file.lexically_relative(scene_file_.parent_path());
    const bool is_below = !beside.empty() && *beside.begin() != "..";
    light.ies_file = (is_below ? beside : file).string();
    if (const auto done = document.apply(SetLight{node->light, light}); !done) ui.toasts.fail(done.error().text());
}

Project EditorFiles::opened_project(const Opened& opened, const Project& before) const {
    Project project{opened.scene, before.render, before.view};
    if (purpose_ != Purpose::open) return project;
    if (!keep_settings_) project.render = opened.imported.render.value_or(project.render);
    if (!keep_view_) project.view = opened.imported.view.value_or(project.view);
    return project;
}

void EditorFiles::reset_document(Document& document, UiState& ui, Project project, std::optional<Scene> lit) const {
    document.reset(std::move(project));
    ui.studio_banner = lit.has_value();
    if (!lit) return;
    Project shown = document.project();
    shown.scene = *std::move(lit);
    document.replace(std::move(shown), "Studio lighting");
    document.mark_saved(); // not an edit of the user
}

// None if the document's scene is to be replaced.
std::optional<EditorFiles::KeptEdits> EditorFiles::edits_on(Opened& opened, const Document& document, const UiState& ui) const {
    if (purpose_ != Purpose::reload || !keep_edits_) return {};
    const bool modified = document.modified();
    if (ui.studio_banner && !modified) return {}; // the studio is set up again: the file may have lights by now
    const Scene& theirs = opened.imported.scene;
    const bool saved_edits_are_gone = written_by_blush_ && !has_our_settings(opened.imported);
    // Edits are relative to the scene as another program wrote it, or else to the scene as opened.
    Scene base = imported_;
    std::string heading;
    if (saved_edits_are_gone) {
        base = exported_ ? *exported_ : without_lighting_missing_in(theirs, imported_);
        heading = exported_ ? "Another program has written this file: the edits that Blush had saved in it are kept"
                            : "Another program has written this file: the lights and the environment that Blush had saved in it are "
                              "kept, other saved edits are not";
        heading += "; save the scene to write them again";
    }
    MergedEdits merged = merge_edits(base, document.project().scene, theirs);
    list_conflicts(merged.conflicts, heading, opened.imported.report);
    return KeptEdits{std::move(merged.scene), modified || saved_edits_are_gone};
}

EditorFiles::Finished EditorFiles::finish_import(Document& document, UiState& ui, Result<Opened> opened) {
    const bool cancelled = import_job_->cancelled();
    import_job_.reset();
    preview_.reset();
    if (cancelled) return {};
    if (!opened) {
        ui.toasts.fail(opened.error().text());
        return {};
    }
    std::optional<KeptEdits> kept = edits_on(*opened, document, ui);
    report(ui, importing_, opened->imported.report);
    if (purpose_ == Purpose::merge) {
        const auto done = document.apply(Import{opened->scene, importing_.stem().string()});
        if (!done) ui.toasts.fail(done.error().text());
        return {};
    }
    Project project = opened_project(*opened, document.project());
    imported_ = opened->imported.scene;
    origin_ = opened->imported.origin;
    origin_.file = importing_;
    written_by_blush_ = has_our_settings(opened->imported);
    if (!written_by_blush_)
        exported_ = imported_;
    else if (purpose_ == Purpose::open)
        exported_.reset();
    if (purpose_ == Purpose::open) opened_in_studio_ = opened->lit.has_value();
    if (purpose_ == Purpose::reload) {
        project.scene.view = document.project().scene.view;
        ui.selected = same_node(document.project().scene, ui.selected, kept ? kept->scene : project.scene);
    } else {
        save_scene_ui(ui, scene_file_.string(), ui.settings);
        scene_file_ = importing_;
        remember_recent(ui.settings.recent, importing_.string());
    }
    ui.also_selected.clear();
    ui.selected_material = {};
    ui.light_camera.reset(); // ids may refer to other objects now
    ui.placing_by = PlacingBy::hand;
    ui.light_table.renaming = {};
    watch_.watch(scene_file_, importing_since_);
    reset_document(document, ui, std::move(project), opened_in_studio_ && !kept ? std::move(opened->lit) : std::nullopt);
    if (purpose_ == Purpose::open) begin_at_camera(ui, document.project(), std::move(opened->camera_aspects));
    if (purpose_ == Purpose::open) restore_scene_ui(ui.settings, scene_file_.string(), document.project().scene, ui);
    if (kept) {
        // Undo returns to the unedited file.
        Project edited = document.project();
        edited.scene = std::move(kept->scene);
        document.replace(std::move(edited), "Reload with edits");
        if (!kept->unsaved) document.mark_saved();
    }
    if (opened->recovered) document.replace(*std::move(opened->recovered), "Recover unsaved edits");
    const bool stored = purpose_ != Purpose::open || (opened->imported.view && !keep_view_) || opened->recovered;
    return {.opened = true, .recovered = opened->recovered.has_value(), .stored_exposure = stored};
}

bool EditorFiles::finish_save(Document& document, UiState& ui, Result<SavedGltf> saved) {
    save_job_.reset();
    if (!saved) {
        ui.toasts.fail(saved.error().text());
        return false;
    }
    std::error_code error;
    origin_ = std::move(saved->origin);
    imported_ = std::move(saved->scene);
    written_by_blush_ = true;
    scene_file_ = std::filesystem::absolute(origin_.file, error);
    remember_recent(ui.settings.recent, scene_file_.string());
    watch_.watch(scene_file_, FileWatch::time_of(scene_file_));
    document.mark_saved(saving_);
    std::string details = scene_file_.parent_path().string();
    for (const Diagnostic& d : saved->diagnostics) details += "\n" + d.what;
    const bool warn = std::any_of(saved->diagnostics.begin(), saved->diagnostics.end(),
                                  [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::warning; });
    const std::string text = "Saved " + scene_file_.filename().string();
    if (warn)
        ui.toasts.warn(text, details);
    else
        ui.toasts.note(text, details);
    return true;
}

void EditorFiles::finish_environment(Document& document, UiState& ui, Result<ImagePtr> image) {
    const bool cancelled = environment_job_->cancelled();
    environment_job_.reset();
    if (cancelled) return;
    if (!image) return ui.toasts.fail(image.error().text());
    Environment e = document.project().scene.environment;
    if (e.kind != Environment::Kind::image) e.intensity = 1; // the intensity of a constant environment is not meaningful for an image
    e.kind = Environment::Kind::image;
    e.color = {1, 1, 1};
    e.file = environment_.string();
    e.image = *image;
    const auto done = document.apply(SetEnvironment{e});
    if (!done) return ui.toasts.fail(done.error().text());
    ui.meter_exposure = true;
    ui.tab = InspectorTab::environment;
}

void EditorFiles::finish_map(Document& document, UiState& ui, Result<ImagePtr> image) {
    const bool cancelled = map_job_->cancelled();
    map_job_.reset();
    if (cancelled) return;
    if (!image) return ui.toasts.fail(image.error().text());
    const Result<void> done = set_map(document, map_.material, map_.slot, map_.label,
                                      {.name = map_file_.stem().string(), .source = "embedded", .image = *image}, ui.gestures.begin());
    ui.gestures.end();
    if (!done) return ui.toasts.fail(done.error().text());
    if (!has_texture_coordinates(document.project().scene, map_.material))
        ui.toasts.warn("The image shows as one colour",
                       "No mesh with this material has texture coordinates (UV): all of it takes the colour at (0, 0). "
                       "Unwrap the mesh in a modelling program.");
}

void EditorFiles::look_at_scene_file(const Document& document, UiState& ui) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_look_) return;
    next_look_ = now + std::chrono::seconds(1);
    if (import_job_ || save_job_ || !watch_.changed()) return;
    if (!document.modified()) return reload(true);
    ui.toasts.add({Toast::Kind::warning, scene_file_.filename().string() + " has changed on disk",
                   "Reload it to see the changes. Your edits can be kept.", Command::reload});
}

EditorFiles::Finished EditorFiles::poll(Document& document, UiState& ui) {
    Finished finished;
    if (import_job_ && !import_job_->cancelled()) {
        if (const auto early = early_->take()) {
            // Limited, so that the preview does not slow down the loading of the textures.
            constexpr int64_t enough_samples = 8;
            Project project = opened_project(*early, document.project());
            if (early->lit) project.scene = *early->lit;
            project.render.spp = std::min(project.render.spp, project.render.first_sample + enough_samples);
            preview_note_ = note_of_preview(early->imported.origin.indices.textures.size(), project.scene.textures.size());
            preview_.emplace(std::move(project));
        }
    }
    if (import_job_) {
        if (auto result = import_job_->take()) finished = finish_import(document, ui, *std::move(result));
    }
    if (save_job_) {
        if (auto result = save_job_->take()) finished.saved = finish_save(document, ui, *std::move(result));
    }
    if (environment_job_) {
        if (auto result = environment_job_->take()) finish_environment(document, ui, *std::move(result));
    }
    if (map_job_) {
        if (auto result = map_job_->take()) finish_map(document, ui, *std::move(result));
    }
    look_at_scene_file(document, ui);
    return finished;
}

std::optional<RunningJob> EditorFiles::running() const {
    const auto show = [](const auto& job, bool can_cancel) {
        const auto [fraction, what] = job->progress().read();
        return RunningJob{job->title(), what, fraction, can_cancel};
    };
    if (import_job_) {
        RunningJob job = show(import_job_, true);
        if (preview_) job.what += "; the scene is shown meanwhile";
        return job;
    }
    if (environment_job_) return show(environment_job_, true);
    if (map_job_) return show(map_job_, true);
    if (save_job_) return show(save_job_, false);
    return {};
}

void EditorFiles::cancel() {
    if (import_job_) import_job_->cancel();
    preview_.reset();
    if (environment_job_) environment_job_->cancel();
    if (map_job_) map_job_->cancel();
}

} // namespace blush
