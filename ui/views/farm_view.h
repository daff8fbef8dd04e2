// The Farm panel (ui/panels/farm): which images of the scene to render as a plan, where, and how the plans of the scene stand.
#pragma once

#include "ui/snapshots/snapshots_view.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace blush {

// What a new plan renders, and where.
struct FarmChoices {
    enum class What { view, snapshots, turntable, animation, cameras, variants, looks };
    enum class Where { here, slurm };
    static constexpr const char* what_names[] = {"This view",   "Snapshots in the strip", "Turntable",        "Animation",
                                                 "All cameras", "All material variants",  "Looks from a file"};
    What what = What::view;
    std::filesystem::path looks_file;        // of What::looks
    int64_t steps = 48;                      // of a turntable
    int64_t first_frame = 0, last_frame = 0; // of the animation, both included
    float frames_per_second = 24;
    int64_t width = 1920;  // pixels; the height follows the aspect ratio of each image
    bool by_error = false; // stop at `error`, at most at `spp`
    int64_t spp = 1024;
    float error_per_cent = 0.01f; // relMSE
    bool adaptive = true;
    Where where = Where::here;
    int64_t processes = 0;     // on this machine; they share the processors. 0: one for each socket
    std::string slurm_options; // of sbatch, separated by spaces
    bool operator==(const FarmChoices&) const = default;
};

// An image of a plan.
struct FarmLook {
    std::string name;
    int64_t samples = 0, planned = 0, merged = 0; // per pixel: rendered without gap, planned, in the merged image
    std::string error;                            // of the merged image; empty: not known
    bool operator==(const FarmLook&) const = default;
};

// A plan of the open scene, as it stood when it was last read.
struct FarmPlan {
    static constexpr size_t most_in_strip = 16; // images of it that the strip shows
    enum class State { unread, making, stopped, running, finished, unreadable };
    std::filesystem::path folder;
    State state = State::unread;
    std::string problem = {}; // why it is unreadable, or cannot be made
    int64_t tasks = 0, done = 0, running = 0;
    double fraction = 0;     // of all samples
    double seconds_left = 0; // with the processes that run now, or with one
    std::vector<FarmLook> looks = {};
    std::vector<std::string> failures = {}; // of tasks: number, look, last line of the log
    // By the pilot, for all of the plan.
    double seconds_here = 0; // one process on the machine that made the plan
    int64_t knee = 1;        // more workers hardly help
    double seconds_knee = 0;
    double disk_mib = 0; // parts and images
    bool operator==(const FarmPlan&) const = default;

    int64_t merged_samples() const; // of all looks
};

// Executed by the editor after the panels are drawn.
struct FarmRequest {
    enum class What { make, start, stop, open, forget };
    What what = What::make;
    std::filesystem::path folder; // of the plan; unused by make
};

struct FarmView {
    bool open = false;
    FarmChoices choices;
    std::filesystem::path scene_file; // the open scene, to which the plans belong
    std::filesystem::path parent;     // folder for new plans
    bool has_slurm = false;           // sbatch is installed
    std::vector<FarmPlan> plans;      // newest last
    // Samples of the merged images in the strip, of all looks of a plan, by its folder.
    std::map<std::filesystem::path, int64_t> in_strip;
    std::vector<FarmRequest> requests;

    // The plan that runs and has the least left; null: none.
    const FarmPlan* running() const;
    bool is_making() const;
};

// Files of the snapshots of the open scene that are saved, without images of plans.
std::vector<std::string> saved_snapshots(const SnapshotsView& snapshots, const FarmView& farm);

// "34 %, 3 min left".
std::string progress_text(const FarmPlan& plan);

} // namespace blush
