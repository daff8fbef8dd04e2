// Plans of the open scene: makes, starts and stops them, follows how they stand, and brings merged images into the strip.
#pragma once

#include "app/editor/editor_snapshots.h"
#include "app/farm/farm_jobs.h"
#include "ui/jobs/background_job.h"
#include "ui/panel_context.h"

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

class EditorFarm {
public:
    // `threads`: of the measurement of a plan; 0: one per core.
    EditorFarm(std::function<void()> wake, unsigned threads) : wake_(std::move(wake)), threads_(threads) {}

    // Executes requests of the panel. Returns true if a plan is to be made that begins with the scene as it is now: then the caller
    // calls make() with the next full image of it. `parent`: folder for new plans.
    bool handle_requests(PanelContext& c, const std::filesystem::path& parent);
    void make(PanelContext c, EditorSnapshots::Shown shown);
    // Applies finished jobs, and reads again how plans stand. When another scene is open, finds the plans that are remembered for it.
    void poll(UiState& ui, const std::filesystem::path& scene_file, EditorSnapshots& snapshots);
    // While a plan is made, the machine is left to its measurement.
    bool is_measuring() const { return making_ != nullptr; }

private:
    void remember_plans(UiState& ui, const std::filesystem::path& scene_file);
    void begin_making(PanelContext& c, std::optional<SnapshotJob> view);
    void finish_making(UiState& ui);
    void finish_action(UiState& ui);
    void read_plans(UiState& ui);
    void finish_reading(UiState& ui, EditorSnapshots& snapshots);
    void update(FarmPlan& plan, FarmPlan read, UiState& ui, EditorSnapshots& snapshots);
    void show_merged(const FarmPlan& before, const FarmPlan& plan, UiState& ui, EditorSnapshots& snapshots);
    void stop(FarmView& view, const std::filesystem::path& folder);

    using Clock = std::chrono::steady_clock;
    std::function<void()> wake_;
    unsigned threads_;
    std::filesystem::path making_folder_, making_scene_;
    std::unique_ptr<BackgroundJob<Result<void>>> making_;
    struct Action {
        std::filesystem::path folder;
        std::function<Result<void>()> run;
    };
    std::deque<Action> actions_; // starts and stops, one after the other
    std::unique_ptr<BackgroundJob<Result<void>>> action_;
    std::unique_ptr<BackgroundJob<std::vector<FarmPlan>>> reading_;
    Clock::time_point next_reading_{};
    bool read_at_once_ = true; // something has changed
};

} // namespace blush
