// The parts of a plan: files with the sums of some samples of a look, PARTS/LOOK/FIRST-LAST.exr, each beside a record of what it is.
#pragma once

#include "app/commands/plan/render_plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush {

struct Part {
    std::filesystem::path file;
    SampleSpan samples;
    double seconds = 0; // of rendering
};

// FOLDER/parts/LOOK, and the part's file in it.
std::filesystem::path parts_folder(const std::filesystem::path& folder, const PlanLook& look);
std::filesystem::path part_file(const std::filesystem::path& folder, const PlanLook& look, SampleSpan samples);
std::filesystem::path merged_file(const std::filesystem::path& folder, const PlanLook& look);
// The allocation of its adaptive sampling (allocation_file.h).
std::filesystem::path allocation_file(const std::filesystem::path& folder, const PlanLook& look);

// Creates a folder of the plan, into which files will be written. Errors: it cannot be created, a symbolic link leads out of the plan,
// or the folder holds one: writing would follow it.
Result<void> provide_folder(const std::filesystem::path& folder, const std::filesystem::path& inside);

// Reads the whole file and checks that it is this part. Errors: unreadable, damaged, of another scene, version or range.
Result<void> check_part(const std::filesystem::path& file, const RenderPlan& plan, const PlanLook& look, SampleSpan samples);

// Writes the record of a part that has just been written or checked: later readers need not read the part itself.
Result<void> record_part(const Part& part, const RenderPlan& plan, const PlanLook& look);

// The parts of a look that are valid, by first sample, then by last. A part without a record, or whose size is not the recorded
// one, is read and checked. Others are left out, whatever they are.
std::vector<Part> valid_parts(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look);

// The parts are sorted as valid_parts() returns them.

// Parts that follow each other without gap and overlap from `samples.first` on, as far as possible, at most to `samples.last`.
// Parts of two workers on one task may overlap.
std::vector<Part> chain_of(const std::vector<Part>& parts, SampleSpan samples);
// The smallest range whose samples complete a chain over all `samples`; empty (first == last) if none is missing.
SampleSpan missing_in(const std::vector<Part>& parts, SampleSpan samples);

} // namespace blush
