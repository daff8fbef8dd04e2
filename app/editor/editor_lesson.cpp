#include "app/editor/editor_lesson.h"

#include "app/commands/lesson/states.h"
#include "app/commands/progress.h"
#include "core/parallel.h"
#include "ui/panels/instruments.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

constexpr int64_t window_samples = 1024; // as without --spp

// Opens these instruments that a lesson may open, and closes the others.
void open_panels(PanelContext& c, const std::vector<std::string>& wanted, std::span<const char* const> all) {
    for (const char* id : all)
        if (const Instrument* i = find_instrument(instruments(), id)) {
            const bool open = std::ranges::find(wanted, id) != wanted.end();
            if (i->is_open(c) != open) i->set_open(c, open);
            if (open) c.ui.docks.to_front.insert(id);
        }
}

// Of the places that panels measure, which belong to a scene.
void forget_places(UiState& ui) {
    ui.select({});
    ui.bleed.point.reset();
    ui.bleed.rect.reset();
    ui.paths.request.reset();
    ui.pixel.reset();
    ui.light_camera.reset();
    ui.zoom = {};
}

ViewTool tool_of(const std::string& name) {
    if (name == "bleed") return ViewTool::bleed;
    if (name == "paths") return ViewTool::paths;
    return name == "measure" ? ViewTool::measure : ViewTool::none;
}

} // namespace

std::vector<LessonView::File> EditorLesson::shipped() const {
    std::vector<LessonView::File> files;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(assets_ / "lessons", code)) {
        const std::filesystem::path file = entry.path() / "lesson.md";
        if (!std::filesystem::exists(file, code)) continue;
        if (const Result<Lesson> lesson = read_lesson(file, assets_ / "scenes")) files.push_back({lesson->title, file});
    }
    std::ranges::sort(files, {}, &LessonView::File::title);
    // The one that covers all of light transport comes first.
    std::ranges::stable_partition(files,
                                  [](const LessonView::File& f) { return f.file.parent_path().filename() == "why-the-card-blushes"; });
    return files;
}

EditorLesson::Kept EditorLesson::kept(const PanelContext& c) {
    const UiState& ui = c.ui;
    return {open_instruments(instruments(), c),
            ui.settings.dock.front,
            ui.tool,
            ui.selected,
            ui.also_selected,
            ui.selected_material,
            ui.bleed.point,
            ui.bleed.rect,
            ui.paths.request,
            ui.light_camera,
            ui.home,
            ui.frame,
            ui.zoom,
            ui.snapshots.open,
            ui.opening_page,
            {}};
}

// Panels of a step that would lie behind the text of the lesson move to the other dock.
void EditorLesson::make_room(UiState& ui, const std::vector<std::string>& panels) {
    Dock& dock = ui.settings.dock;
    const DockTab lesson = place_of(dock, "lesson", DockSide::bottom);
    for (const std::string& id : panels) {
        const Instrument* instrument = find_instrument(instruments(), id);
        if (!instrument) continue;
        DockTab& tab = place_of(dock, id, instrument->side);
        if (lesson.floats || tab.floats || tab.side != lesson.side) continue;
        if (std::ranges::count(kept_->moved, id, &DockTab::id) == 0) kept_->moved.push_back(tab);
        tab.side = lesson.side == DockSide::bottom ? DockSide::right : DockSide::bottom;
    }
}

bool EditorLesson::poll(PanelContext c, const Project& user) {
    LessonView& view = c.ui.lesson;
    if (const auto file = std::exchange(view.to_open, std::nullopt))
        job_ = std::make_unique<BackgroundJob<Result<Loaded>>>(
            "Opening " + file->filename().string(),
            [file = *file, scenes = assets_ / "scenes"](JobProgress& job) -> Result<Loaded> {
                Result<Lesson> lesson = read_lesson(file, scenes);
                if (!lesson) return lesson.error();
                Progress progress(true);
                Result<std::vector<Project>> states = states_of(*lesson, progress, job.cancel);
                if (!states) return states.error();
                return Loaded{*std::move(lesson), *std::move(states)};
            },
            wake_);
    if (std::exchange(view.to_end, false)) return end(c);
    if (document_ && frames_to_front_ > 0) {
        c.ui.seconds_to_next_frame = 0;
        if (--frames_to_front_ == 0) c.ui.docks.to_front.insert("lesson");
    }
    if (document_) c.ui.snapshots.open = false; // they are of the user's scene, and would restore its state
    bool changed = false;
    if (auto loaded = job_ ? job_->take() : std::nullopt) {
        job_.reset();
        if (*loaded) {
            begin(c, **std::move(loaded));
            view.to_step = 0;
            changed = true;
        } else {
            c.ui.toasts.fail("The lesson cannot be opened", loaded->error().text());
        }
    }
    if (const auto step = std::exchange(view.to_step, std::nullopt); step && *step < loaded_.states.size()) {
        changed = changed || loaded_.lesson.steps[*step].file != loaded_.lesson.steps[view.step].file;
        go_to(c, *step, user);
    }
    return follow_document(c) || changed;
}

void EditorLesson::begin(PanelContext& c, Loaded loaded) {
    if (!kept_) kept_ = kept(c);
    loaded_ = std::move(loaded);
    document_.emplace();
    reached_.clear();
    LessonView& view = c.ui.lesson;
    view.title = loaded_.lesson.title;
    view.step = 0;
    view.steps.clear();
    for (const LessonStep& s : loaded_.lesson.steps) view.steps.push_back({s.title, s.text, s.question, s.expect, s.highlight});
    c.ui.snapshots.open = c.ui.opening_page = false;
    c.ui.docks.to_front.insert("lesson");
}

void EditorLesson::go_to(PanelContext& c, size_t step, const Project& user) {
    const LessonStep& s = loaded_.lesson.steps[step];
    Project state = loaded_.states[step];
    state.render.width = user.render.width;
    state.render.height = user.render.height;
    if (!s.settings.contains("spp")) state.render.spp = window_samples;
    state.view = view_in_window(s, state.view);
    const bool first = document_->project().scene.nodes.empty();
    first ? document_->reset(std::move(state)) : document_->replace(std::move(state), fmt::format("Step {}: {}", step + 1, s.title));
    // A step with the state of the one before makes no undo step: it takes its place.
    const std::vector<std::string> labels = document_->undo_labels();
    std::erase_if(reached_, [&](const Reached& r) { return r.undo_steps >= labels.size(); });
    reached_.push_back({labels.size(), labels.empty() ? "" : labels.back(), step});
    show(c, step);
}

void EditorLesson::show(PanelContext& c, size_t step) {
    const LessonStep& s = loaded_.lesson.steps[step];
    shown_revision_ = document_->revision();
    c.ui.lesson.step = step;
    c.ui.lesson.answer = false;
    c.ui.probe.watch(s.highlight);
    forget_places(c.ui);
    c.ui.home = home_at_opening(document_->project().scene);
    const bool fit = c.ui.frame.fit;
    c.ui.frame = CameraFrame();
    c.ui.frame.fit = fit;
    make_room(c.ui, s.panels);
    open_panels(c, s.panels, lesson_panels);
    c.ui.tool = tool_of(s.tool);
    frames_to_front_ = 3;
}

// The step whose state the document has, with later edits.
size_t EditorLesson::step_of_document(size_t shown) const {
    const std::vector<std::string> labels = document_->undo_labels();
    for (auto r = reached_.rbegin(); r != reached_.rend(); ++r)
        if (r->undo_steps <= labels.size() && (r->undo_steps == 0 || labels[r->undo_steps - 1] == r->label)) return r->step;
    return shown;
}

// Undo and redo lead to another step.
bool EditorLesson::follow_document(PanelContext& c) {
    if (!document_ || document_->revision() == shown_revision_) return false;
    shown_revision_ = document_->revision();
    const size_t before = c.ui.lesson.step, now = step_of_document(before);
    if (now == before) return false;
    show(c, now);
    return loaded_.lesson.steps[now].file != loaded_.lesson.steps[before].file;
}

bool EditorLesson::end(PanelContext c) {
    if (!document_) return false;
    UiState& ui = c.ui;
    forget_places(ui);
    open_panels(c, kept_->panels, lesson_panels);
    for (const DockTab& tab : kept_->moved) place_of(ui.settings.dock, tab.id, tab.side).side = tab.side;
    // Those that come back do not come to the front of their dock; those that were there do.
    ui.docks.open = open_instruments(instruments(), c);
    ui.docks.to_front = std::set<std::string>(kept_->front.begin(), kept_->front.end());
    ui.tool = kept_->tool;
    ui.selected = kept_->selected;
    ui.also_selected = kept_->also_selected;
    ui.selected_material = kept_->selected_material;
    ui.bleed.point = kept_->bleed_point;
    ui.bleed.rect = kept_->bleed_rect;
    ui.paths.request = kept_->paths_request;
    ui.light_camera = kept_->light_camera;
    ui.home = kept_->home;
    ui.frame = kept_->frame;
    ui.zoom = kept_->zoom;
    ui.snapshots.open = kept_->strip;
    ui.opening_page = kept_->opening_page;
    kept_.reset();
    ui.lesson.steps.clear();
    ui.probe.watch("");
    loaded_ = {};
    document_.reset();
    return true;
}

bool EditorLesson::refuses(Command command, UiState& ui) const {
    if (!document_ || command == Command::quit || command == Command::full_screen) return false;
    ui.toasts.note(LessonView::refusal, LessonView::refusal_details);
    return true;
}

} // namespace blush
