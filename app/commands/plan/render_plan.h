// A plan: what many machines render together, as stored in plan.json. The file is untrusted.
#pragma once

#include "app/commands/plan/scaling.h"
#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// Sample indices [first, last).
struct SampleSpan {
    int64_t first = 0, last = 0;
    bool operator==(const SampleSpan&) const = default;
};

struct PlanScene {
    std::string file; // absolute, or relative to the folder of the plan
    std::string hash; // scene_hash.h
};

// An image of the plan, as a recipe: scene, edits and settings say everything about its pixels.
struct PlanLook {
    std::string name; // of its files: letters, digits, '.', '_' and '-'
    size_t scene = 0;
    std::map<std::string, std::string> words = {}; // the options it was made from, for readers
    std::string edits = {};                        // scene_edits_json.h; empty: none
    std::string lights_hash = {};                  // lights_hash() of the edited scene
    RenderSettings settings = {};                  // without stop rules; spp is 0
    std::string allocation = {};                   // hash of its allocation file once the pilot has decided it; else empty
    std::string sequence = {};                     // name of its frame sequence; empty: none
    bool finished = false;                         // no further round is needed
    // Identifies the recipe in records of parts.
    std::string recipe(const std::string& scene_hash, const std::string& layers) const;
};

// One command of commands.txt; its number is its index plus 1.
struct PlanTask {
    size_t look = 0;
    SampleSpan samples;
};

struct RenderPlan {
    std::string version; // of the program
    std::vector<PlanScene> scenes;
    std::vector<PlanLook> looks;
    std::vector<PlanTask> tasks;
    std::string layers = "film";             // as in `blush render --layers`
    std::optional<int64_t> texture_mib = {}; // as in SceneOverrides: part of the scene's hash
    int64_t chunk = 0;                       // samples of a task
    int64_t spp = 0;                         // samples of a look; its limit if there is an error to reach
    double error = 0;                        // relMSE to reach, by rounds; 0: render spp samples
    bool adaptive = false;                   // adaptive sampling: the first round is its pilot. Looks with a region are without
    double frames_per_second = 24;           // of sequences
    ViewSettings view = {};                  // of contact sheet and film
    std::string program;                     // how its commands call Blush
    MeasuredCosts costs = {};                // by a pilot
    bool samples_adaptively(const RenderSettings& look) const { return adaptive && look.region == ImageRegion(); }
    // More tasks may follow when those of a round are done.
    bool in_rounds() const { return error > 0 || adaptive; }
    std::string recipe(const PlanLook& look) const { return look.recipe(scenes[look.scene].hash, layers); }
};

// Where a task of a look ends that begins with this sample and would end at `last`: adaptive sampling measures its pilot at the half
// and at the end (sample_allocation.h), and parts must end there.
int64_t end_of_task(const PlanLook& look, int64_t first, int64_t last);

// Hash of lights and environment, including pixels and profiles of files that edits name.
std::string lights_hash(const Scene& scene);

// True for a name of a look that is safe as a name of files: no path, no hidden file.
bool is_safe_name(const std::string& name);

// Reads FOLDER/plan.json. Errors: missing, not a plan, a number out of range, an unsafe name, another version of the program.
Result<RenderPlan> read_plan(const std::filesystem::path& folder);
Result<void> write_plan(const std::filesystem::path& folder, const RenderPlan& plan);

} // namespace blush
