#include "app/editor/editor_snapshots.h"

#include "app/commands/common.h"
#include "app/common/catch_as_result.h"
#include "app/common/output_folder.h"

#include <algorithm>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>

namespace blush {
namespace {

std::string time_of_day() {
    const std::time_t now = std::time(nullptr);
    return fmt::format("{:%H:%M}", fmt::localtime(now));
}

Snapshot snapshot_of(EditorSnapshots::Shown shown) {
    Snapshot s;
    s.time = time_of_day();
    s.images = std::move(shown.images);
    // A denoised image at reduced resolution is not saved as a layer.
    if (s.images.denoised && s.images.denoised->divider != 1) s.images.denoised = nullptr;
    // Nor are earlier views.
    if (s.images.denoised && s.images.denoised->has_history()) s.images.denoised = without_history(*s.images.denoised);
    s.project = std::move(shown.project);
    s.settings = shown.settings;
    s.imported = std::move(shown.imported);
    s.scene_file = std::move(shown.scene_file);
    s.frame = shown.frame;
    return s;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    return !a.empty() && !b.empty() && std::filesystem::equivalent(a, b, error);
}

} // namespace

bool worth_restoring(const FilmState& film, const SubmissionPtr& submitted, const SubmissionContent& wanted, const Images& shown) {
    const bool same = submitted && !changes_since(submitted.get(), wanted).affects_image();
    return !same || !shown.frame || shown.frame->revision != submitted->revision || shown.frame->samples < film.samples;
}

// ---- taking snapshots

void EditorSnapshots::keep(Shown shown, RenderSession& session) {
    session.request_film(shown.revision);
    keeping_ = std::move(shown);
}

void EditorSnapshots::finish_capture(UiState& ui, RenderSession& session) {
    if (!keeping_) return;
    std::optional<RequestedFilm> kept = session.take_requested_film();
    if (!kept || kept->revision != keeping_->revision) return;
    Snapshot s = snapshot_of(*std::exchange(keeping_, std::nullopt));
    if (kept->frame) {
        s.images.frame = kept->frame;
        s.error = std::move(kept->error);
        s.film = std::move(kept->film);
    }
    s.thumbnail = thumbnail_of(*s.images.frame);
    const uint64_t id = ui.snapshots.add(std::move(s));
    const SnapshotPtr snapshot = ui.snapshots.find(id);
    if (ui.settings.snapshot_files)
        write(snapshot, ui, Why::asked);
    else
        ui.toasts.note("Took snapshot " + snapshot->name, snapshot->film ? "" : "Without samples: " + kept->why_none);
}

// ---- files

void EditorSnapshots::write(const SnapshotPtr& snapshot, const UiState& ui, Why why) {
    const WindowSettings& w = ui.settings;
    SnapshotJob job{*snapshot,      {}, output_folder(w.snapshot_folder, snapshot->scene_file, assets_), {}, {}, w.snapshot_half,
                    w.snapshot_film};
    if (why == Why::renamed) {
        job.file = snapshot->file;
        job.film = snapshot->film_in_file;
    }
    job.film |= why == Why::room;
    if (const auto known = stateless_.find(snapshot->id); known != stateless_.end()) job.metadata = known->second;
    to_write_.push_back({snapshot->id, job.film && snapshot->film, [job] { return write_snapshot_exr(job); }});
}

void EditorSnapshots::save_png(const Shown& shown, const ColorManagement& color, const UiState& ui) {
    const SnapshotJob job{snapshot_of(shown), shown.view, output_folder(ui.settings.snapshot_folder, shown.scene_file, assets_)};
    to_write_.push_back({0, false, [job, &color] { return write_snapshot_png(job, color); }});
}

bool EditorSnapshots::will_be_written(uint64_t id) const {
    return (writing_ && writing_id_ == id) || std::ranges::count(to_write_, id, &Writing::id) > 0;
}

void EditorSnapshots::free_memory(UiState& ui) {
    for (const SnapshotPtr& snapshot : store_.free_memory(ui))
        if (!will_be_written(snapshot->id)) write(snapshot, ui, Why::room);
}

void EditorSnapshots::finish_all() {
    writing_.reset(); // waits for the running job
    for (const Writing& left : std::exchange(to_write_, {}))
        if (const auto written = catch_as_result<SavedSnapshot>(left.write); !written)
            fmt::print(stderr, "blush: warning: {}\n", written.error().text());
}

void EditorSnapshots::finish_writing(UiState& ui) {
    if (writing_) {
        const auto result = writing_->take();
        if (!result) return;
        writing_.reset();
        const SnapshotPtr snapshot = ui.snapshots.find(writing_id_);
        if (!*result) {
            ui.toasts.fail(result->error().text());
            if (snapshot) snapshot->pinned = true; // not unloaded, because it is not saved
        } else {
            const SavedSnapshot& saved = **result;
            if (snapshot) {
                snapshot->file = saved.file;
                snapshot->film_in_file = writing_film_;
            }
            const std::string text = "Saved " + saved.file.filename().string();
            if (saved.count_beyond_half > 0)
                ui.toasts.warn(
                    text, fmt::format("{} values are too bright for 16 bits and became {:.0f} nits.", saved.count_beyond_half, max_half));
            else
                ui.toasts.note(text, saved.file.parent_path().string());
        }
    }
    if (to_write_.empty()) return;
    Writing next = std::move(to_write_.front());
    to_write_.pop_front();
    writing_id_ = next.id;
    writing_film_ = next.film;
    writing_ = std::make_unique<BackgroundJob<Result<SavedSnapshot>>>(
        "Saving the snapshot", [write = std::move(next.write)](JobProgress&) { return catch_as_result<SavedSnapshot>(write); }, wake_);
}

void EditorSnapshots::open(const std::filesystem::path& file, const std::filesystem::path& open_scene, bool panoramas_light) {
    to_read_.push_front({file, true, panoramas_light});
    read_next(open_scene);
}

void EditorSnapshots::load_strip(const UiState& ui, const std::filesystem::path& scene_file) {
    const auto known = std::ranges::find(ui.settings.scenes, scene_file.string(), &SceneMemory::file);
    const bool listed = std::ranges::any_of(ui.snapshots.list, [&](const SnapshotPtr& s) { return s->scene_file == scene_file; });
    if (known == ui.settings.scenes.end() || listed) return;
    for (const std::string& file : known->snapshots) to_read_.push_back({file, false});
}

void EditorSnapshots::read_next(const std::filesystem::path& open_scene) {
    if (opening_ || to_read_.empty()) return;
    const ToRead next = std::move(to_read_.front());
    to_read_.pop_front();
    const std::filesystem::path& file = opening_file_ = next.file;
    restores_opened_ = next.to_restore;
    opens_merged_ = next.merged;
    opening_ = std::make_unique<BackgroundJob<Result<OpenAnswer>>>(
        "Opening " + file.filename().string(),
        [next, open_scene](JobProgress&) {
            return catch_as_result<OpenAnswer>([&]() -> Result<OpenAnswer> {
                const auto metadata = read_metadata(next.file);
                if (!metadata) return metadata.error();
                if (!is_snapshot(*metadata)) {
                    Result<std::shared_ptr<ImageLayers>> image = open_image_layers(next.file);
                    if (!image) return image.error();
                    return next.panoramas_light && is_panorama(**image) ? OpenAnswer() : OpenAnswer{{}, *std::move(image)};
                }
                Result<OpenedSnapshot> opened = open_snapshot(next.file, open_scene);
                if (!opened) return opened.error();
                return OpenAnswer{*std::move(opened)};
            });
        },
        wake_);
}

void EditorSnapshots::finish_opening(Document& document, UiState& ui, EditorFiles& files) {
    read_next(files.scene_file());
    if (!opening_) return;
    auto result = opening_->take();
    if (!result) return;
    opening_.reset();
    if (!restores_opened_) {
        if (*result && (**result).snapshot && opens_merged_)
            add_merged(*std::move((**result).snapshot), ui);
        else if (*result && (**result).snapshot)
            add_to_strip(*std::move((**result).snapshot), ui)->unload();
        return;
    }
    if (!*result) return ui.toasts.fail(result->error().text());
    if ((**result).image) return show_image(std::move((**result).image), ui);
    if (!(**result).snapshot) return files.load_environment(opening_file_);
    const SnapshotPtr snapshot = add_to_strip(*std::move((**result).snapshot), ui);
    ui.snapshots.open = true;
    if (!snapshot->no_state.empty())
        return ui.toasts.warn(snapshot->name + " was added to the strip without its state", snapshot->no_state);
    restore(snapshot, document, ui, files);
}

// Adds it to the strip and shows it in the comparison view.
void EditorSnapshots::show_image(std::shared_ptr<ImageLayers> layers, UiState& ui) {
    Snapshot s;
    s.name = layers->file.filename().string();
    s.time = time_of_day();
    s.no_state = "It is an image from another program: it has no scene to restore.";
    s.pinned = true;
    const size_t count = layers->layers.size();
    s.layers = std::move(layers);
    s.choose_layer(0);
    ui.toasts.note(s.name, fmt::format("{} layer{}: choose one in the Comparison panel. J switches to the live image and back.", count,
                                       count == 1 ? "" : "s"));
    ui.snapshots.open = true;
    Comparison& compare = ui.snapshots.compare;
    compare = {.mode = Comparison::Mode::flicker, .a = ui.snapshots.add(std::move(s)), .b = live_image, .kind = compare.kind};
}

void EditorSnapshots::show_merged(const std::filesystem::path& file) {
    if (std::ranges::count(to_read_, file, &ToRead::file) == 0) to_read_.push_back({.file = file, .merged = true});
}

void EditorSnapshots::add_merged(OpenedSnapshot opened, UiState& ui) {
    const auto older = std::ranges::find(ui.snapshots.list, opened.snapshot.file, &Snapshot::file);
    if (!merged_.insert(opened.snapshot.file).second && older == ui.snapshots.list.end()) return; // the user has removed it
    const SnapshotPtr replaced = older == ui.snapshots.list.end() ? nullptr : *older;
    const SnapshotPtr newer = add_to_strip(std::move(opened), ui);
    newer->unload();
    if (replaced) ui.snapshots.replace(replaced->id, newer->id);
}

SnapshotPtr EditorSnapshots::add_to_strip(OpenedSnapshot opened, UiState& ui) {
    Snapshot& s = opened.snapshot;
    s.time = time_of_day();
    s.thumbnail = thumbnail_of(*s.images.frame);
    s.film_in_file = s.film != nullptr;
    const uint64_t id = ui.snapshots.add(std::move(s));
    stateless_[id] = std::move(opened.metadata);
    return ui.snapshots.find(id);
}

// ---- restoring states

void EditorSnapshots::restore(const SnapshotPtr& snapshot, Document& document, UiState& ui, EditorFiles& files) {
    if (!snapshot->no_state.empty()) return ui.toasts.warn(snapshot->name + " has no state to restore", snapshot->no_state);
    if (!same_file(snapshot->scene_file, files.scene_file())) {
        return before_leaving_([this, snapshot, &files] {
            waiting_ = snapshot;
            files.open(snapshot->scene_file); // continues when the scene is loaded
        });
    }
    waiting_ = snapshot;
    continue_restore(document, ui, files);
}

// Continues a restore: its scene is open.
void EditorSnapshots::continue_restore(Document& document, UiState& ui, const EditorFiles& files) {
    if (stateless_.contains(waiting_->id)) return compute_state(files);
    go_back(*std::exchange(waiting_, nullptr), document, ui);
}

void EditorSnapshots::compute_state(const EditorFiles& files) {
    waiting_->imported = files.imported();
    state_job_ = std::make_unique<BackgroundJob<Result<SnapshotState>>>(
        "Restoring " + waiting_->name,
        [metadata = stateless_.at(waiting_->id), imported = files.imported(), file = files.scene_file()](JobProgress&) {
            return catch_as_result<SnapshotState>([&] { return state_of(metadata, imported, file); });
        },
        wake_);
}

void EditorSnapshots::finish_state(Document& document, UiState& ui) {
    if (!state_job_) return;
    auto result = state_job_->take();
    if (!result) return;
    state_job_.reset();
    const SnapshotPtr snapshot = std::exchange(waiting_, nullptr);
    if (!*result) {
        snapshot->no_state = "Its edits do not fit the current scene file: " + result->error().text();
        return ui.toasts.warn(snapshot->name + " was added to the strip without its state", snapshot->no_state);
    }
    stateless_.erase(snapshot->id);
    snapshot->project = std::move((**result).project);
    if (!(**result).warning.empty()) {
        snapshot->film = nullptr;
        ui.toasts.warn(snapshot->name, (**result).warning);
    }
    go_back(*snapshot, document, ui);
}

void EditorSnapshots::go_back(const Snapshot& snapshot, Document& document, UiState& ui) {
    Project project = snapshot.project;
    // Keeps the snapshot's size, even if the window had another size.
    project.render.width = snapshot.settings.width;
    project.render.height = snapshot.settings.height;
    if (const auto done = document.apply(Restore{std::move(project), snapshot.name}); !done) return ui.toasts.fail(done.error().text());
    if (!document.project().scene.nodes.contains(ui.selected)) ui.select({});
    restored_ = Restored{snapshot.film, snapshot.settings};
}

void EditorSnapshots::handle_requests(Document& document, UiState& ui, EditorFiles& files) {
    SnapshotsView& view = ui.snapshots;
    if (view.compare.mode != Comparison::Mode::off)
        for (const uint64_t id : {view.compare.a, view.compare.b})
            if (const SnapshotPtr snapshot = view.find(id); snapshot && store_.has(snapshot)) view.use(*snapshot);
    for (const SnapshotRequest& request : std::exchange(view.requests, {})) {
        const SnapshotPtr snapshot = view.find(request.id);
        if (!snapshot) continue;
        if (!store_.has(snapshot)) {
            view.requests.push_back(request); // retry when it is read
            continue;
        }
        view.use(*snapshot);
        const bool there = snapshot->images.frame != nullptr;
        switch (request.what) {
        case SnapshotRequest::What::save:
            if (there) write(snapshot, ui, Why::asked);
            break;
        case SnapshotRequest::What::renamed:
            if (there && !snapshot->file.empty()) write(snapshot, ui, Why::renamed);
            break;
        case SnapshotRequest::What::restore:
            if (!waiting_ && !(opening_ && restores_opened_)) restore(snapshot, document, ui, files);
            break;
        }
    }
}

void EditorSnapshots::poll(bool opened, Document& document, UiState& ui, EditorFiles& files, RenderSession& session) {
    finish_capture(ui, session);
    finish_writing(ui);
    finish_opening(document, ui, files);
    finish_state(document, ui);
    store_.poll(ui);
    free_memory(ui);
    if (!waiting_ || state_job_) return;
    if (opened && same_file(waiting_->scene_file, files.scene_file()))
        continue_restore(document, ui, files);
    else if (!files.running())
        waiting_.reset(); // its scene could not be read; a toast has reported it
}

std::optional<RunningJob> EditorSnapshots::running() const {
    const auto show = [](const auto& job) {
        const auto [fraction, what] = job->progress().read();
        return RunningJob{job->title(), what, fraction, false};
    };
    if (opening_ && restores_opened_) return show(opening_);
    if (const auto* reading = store_.reading()) return show(reading);
    if (state_job_) return show(state_job_);
    if (writing_) return show(writing_);
    return {};
}

} // namespace blush
