#include "app/editor/editor_farm.h"

#include "app/common/catch_as_result.h"
#include "app/common/open_on_desktop.h"
#include "app/common/unique_filename.h"
#include "app/farm/plan_state.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

// Between two readings of how plans stand.
constexpr std::chrono::seconds while_running{2}, while_idle{10};

FarmPlan* find(FarmView& view, const std::filesystem::path& folder) {
    const auto found = std::ranges::find(view.plans, folder, &FarmPlan::folder);
    return found == view.plans.end() ? nullptr : &*found;
}

// The name of a plan in messages.
std::string name_of(const std::filesystem::path& folder) { return folder.filename().string(); }

std::optional<size_t> chosen_clip(const Scene& scene) {
    size_t index = 0;
    for (const auto& [id, clip] : scene.clips) {
        if (id == scene.scene_selection.clip) return index;
        ++index;
    }
    return {};
}

SnapshotJob job_of(EditorSnapshots::Shown shown) {
    SnapshotJob job;
    Snapshot& s = job.snapshot;
    s.name = shown.scene_file.stem().string();
    s.images.frame = std::move(shown.images.frame);
    s.project = std::move(shown.project);
    s.settings = shown.settings;
    s.settings.resolution_scale = 1; // the size is chosen in the panel
    s.imported = std::move(shown.imported);
    s.scene_file = std::move(shown.scene_file);
    s.frame = shown.frame;
    return job;
}

} // namespace

// Those of the scene, from the session before.
void EditorFarm::remember_plans(UiState& ui, const std::filesystem::path& scene_file) {
    FarmView& view = ui.farm;
    view.scene_file = scene_file;
    view.has_slurm = has_slurm();
    view.plans.clear();
    view.in_strip.clear();
    read_at_once_ = true;
    const auto known = std::ranges::find(ui.settings.scenes, scene_file.string(), &SceneMemory::file);
    if (known == ui.settings.scenes.end()) return;
    for (const PlanMemory& plan : known->plans) {
        view.plans.push_back({.folder = plan.folder});
        view.in_strip[plan.folder] = plan.in_strip;
    }
}

bool EditorFarm::handle_requests(PanelContext& c, const std::filesystem::path& parent) {
    FarmView& view = c.ui.farm;
    view.parent = parent;
    bool wants_view = false;
    for (const FarmRequest& request : std::exchange(view.requests, {})) {
        const std::filesystem::path& folder = request.folder;
        switch (request.what) {
        case FarmRequest::What::make:
            if (c.ui.lesson.is_on())
                c.ui.toasts.note(LessonView::refusal, LessonView::refusal_details);
            else if (view.choices.what == FarmChoices::What::snapshots)
                begin_making(c, {});
            else
                wants_view = true;
            break;
        case FarmRequest::What::start:
            actions_.push_back({folder, [folder, choices = view.choices] { return start_farm_plan(folder, choices); }});
            break;
        case FarmRequest::What::stop: stop(view, folder); break;
        case FarmRequest::What::open: {
            std::error_code code;
            const std::filesystem::path sheet = folder / "contact-sheet.html";
            const Result<void> opened = open_on_desktop((std::filesystem::exists(sheet, code) ? sheet : folder).string());
            if (!opened) c.ui.toasts.fail(opened.error().text());
            break;
        }
        case FarmRequest::What::forget:
            std::erase_if(view.plans, [&](const FarmPlan& plan) { return plan.folder == folder; });
            view.in_strip.erase(folder);
            break;
        }
    }
    return wants_view;
}

void EditorFarm::stop(FarmView& view, const std::filesystem::path& folder) {
    if (making_ && folder == making_folder_)
        making_->cancel();
    else if (find(view, folder))
        actions_.push_back({folder, [folder] { return stop_farm_plan(folder); }});
}

// ---- making

void EditorFarm::make(PanelContext c, EditorSnapshots::Shown shown) { begin_making(c, job_of(std::move(shown))); }

void EditorFarm::begin_making(PanelContext& c, std::optional<SnapshotJob> view) {
    FarmView& farm = c.ui.farm;
    if (making_) return;
    const Result<std::filesystem::path> folder = unique_filename(farm.parent, farm.scene_file.stem().string() + "-plan", "");
    if (!folder) return c.ui.toasts.fail("The plan cannot be made", folder.error().text());
    FarmSource source{.folder = *folder, .snapshots = {}, .view = c.shown_view(), .animation = chosen_clip(c.scene()), .threads = threads_};
    if (!view) source.snapshots = saved_snapshots(c.ui.snapshots, farm);
    farm.plans.push_back({.folder = *folder, .state = FarmPlan::State::making});
    making_folder_ = *folder;
    making_scene_ = farm.scene_file;
    making_ = std::make_unique<BackgroundJob<Result<void>>>(
        "Making the plan",
        [choices = farm.choices, source = std::move(source), view = std::move(view)](JobProgress& job) {
            return make_farm_plan(choices, source, view, job.cancel);
        },
        wake_);
}

void EditorFarm::finish_making(UiState& ui) {
    if (!making_) return;
    const std::optional<Result<void>> made = making_->take();
    if (!made) return;
    const bool cancelled = making_->cancelled();
    making_.reset();
    FarmPlan* plan = find(ui.farm, making_folder_);
    if (*made && plan) {
        plan->state = FarmPlan::State::unread;
        read_at_once_ = true;
    } else if (*made) {
        // Its scene is not open any more.
        const auto scene = std::ranges::find(ui.settings.scenes, making_scene_.string(), &SceneMemory::file);
        if (scene != ui.settings.scenes.end()) scene->plans.push_back({making_folder_.string(), 0});
    } else {
        std::erase_if(ui.farm.plans, [&](const FarmPlan& p) { return p.folder == making_folder_; });
        if (!cancelled) ui.toasts.fail("The plan cannot be made", made->error().text());
    }
}

// ---- starting and stopping

void EditorFarm::finish_action(UiState& ui) {
    if (action_) {
        const std::optional<Result<void>> done = action_->take();
        if (!done) return;
        if (!*done) ui.toasts.fail(done->error().text());
        action_.reset();
        read_at_once_ = true;
    }
    if (actions_.empty()) return;
    const Action next = std::move(actions_.front());
    actions_.pop_front();
    action_ = std::make_unique<BackgroundJob<Result<void>>>(
        name_of(next.folder), [run = next.run](JobProgress&) { return catch_as_result<void>(run); }, wake_);
}

// ---- following

void EditorFarm::read_plans(UiState& ui) {
    const bool due = Clock::now() >= next_reading_ && (ui.farm.open || ui.farm.running());
    if (reading_ || (!due && !read_at_once_)) return;
    read_at_once_ = false;
    std::vector<std::filesystem::path> folders;
    for (const FarmPlan& plan : ui.farm.plans)
        if (plan.state != FarmPlan::State::making) folders.push_back(plan.folder);
    reading_ = std::make_unique<BackgroundJob<std::vector<FarmPlan>>>(
        "Reading plans",
        [folders](JobProgress&) {
            std::vector<FarmPlan> plans;
            for (const std::filesystem::path& folder : folders) {
                Result<FarmPlan> plan = catch_as_result<FarmPlan>([&]() -> Result<FarmPlan> { return read_farm_plan(folder); });
                plans.push_back(plan ? *std::move(plan)
                                     : FarmPlan{.folder = folder, .state = FarmPlan::State::unreadable, .problem = plan.error().text()});
            }
            return plans;
        },
        wake_);
}

void EditorFarm::finish_reading(UiState& ui, EditorSnapshots& snapshots) {
    if (!reading_) return;
    std::optional<std::vector<FarmPlan>> read = reading_->take();
    if (!read) return;
    reading_.reset();
    for (FarmPlan& plan : *read)
        if (FarmPlan* known = find(ui.farm, plan.folder)) update(*known, std::move(plan), ui, snapshots);
    next_reading_ = Clock::now() + (ui.farm.running() ? while_running : while_idle);
}

void EditorFarm::update(FarmPlan& plan, FarmPlan read, UiState& ui, EditorSnapshots& snapshots) {
    const FarmPlan before = std::exchange(plan, std::move(read));
    show_merged(before, plan, ui, snapshots);
    if (before.state != FarmPlan::State::running) return;
    if (plan.state == FarmPlan::State::finished)
        ui.toasts.note(name_of(plan.folder) + " is finished", plan.folder.string());
    else if (plan.state == FarmPlan::State::stopped && !plan.problem.empty())
        ui.toasts.warn(name_of(plan.folder) + " has stopped", plan.problem);
}

// Images that have more samples than those in the strip.
void EditorFarm::show_merged(const FarmPlan& before, const FarmPlan& plan, UiState& ui, EditorSnapshots& snapshots) {
    int64_t& in_strip = ui.farm.in_strip[plan.folder];
    const int64_t merged = plan.merged_samples();
    if (merged <= in_strip) return;
    in_strip = merged;
    for (size_t i = 0; i < std::min(plan.looks.size(), FarmPlan::most_in_strip); ++i) {
        const FarmLook& look = plan.looks[i];
        const bool same = i < before.looks.size() && before.looks[i].merged == look.merged;
        if (look.merged > 0 && !same) snapshots.show_merged(merged_image(plan, look));
    }
}

void EditorFarm::poll(UiState& ui, const std::filesystem::path& scene_file, EditorSnapshots& snapshots) {
    if (ui.farm.scene_file != scene_file) remember_plans(ui, scene_file);
    finish_making(ui);
    finish_action(ui);
    finish_reading(ui, snapshots);
    read_plans(ui);
}

} // namespace blush
