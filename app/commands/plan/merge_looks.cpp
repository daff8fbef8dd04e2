#include "app/commands/plan/merge_looks.h"

#include "app/commands/common.h"
#include "app/commands/json_output.h"
#include "app/commands/merge.h"
#include "core/files.h"
#include "io/image/snapshot.h"
#include "io/project/json_fields.h"
#include "render/film/sample_allocation.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace blush {
namespace {

// Beside the merged image, so that its state is known without reading it.
std::filesystem::path merged_record(const std::filesystem::path& folder, const PlanLook& look) {
    return merged_file(folder, look).replace_extension(".json");
}

struct MergedRecord {
    int64_t samples = 0;
    std::string error;
};

MergedRecord read_merged_record(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look) {
    constexpr uint64_t max_bytes = 1 << 16;
    std::error_code code;
    const uintmax_t size = std::filesystem::file_size(merged_file(folder, look), code);
    const Result<std::vector<uint8_t>> text = read_file(merged_record(folder, look), max_bytes);
    if (code || !text) return {};
    const Result<Json> json = parse_json_object(std::string_view(reinterpret_cast<const char*>(text->data()), text->size()));
    MergedRecord record;
    std::string of;
    uintmax_t bytes = 0;
    const bool read = json && read_json(json->value("recipe", Json()), of) && read_json(json->value("bytes", Json()), bytes) &&
                      read_json(json->value("samples", Json()), record.samples) && read_json(json->value("error", Json()), record.error);
    return read && of == plan.recipe(look) && bytes == size && record.samples > 0 ? record : MergedRecord{};
}

Result<void> write_merged_record(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look,
                                 const MergedRecord& record) {
    std::error_code code;
    return write_json(merged_record(folder, look).string(), {{"recipe", plan.recipe(look)},
                                                             {"samples", record.samples},
                                                             {"error", record.error},
                                                             {"bytes", std::filesystem::file_size(merged_file(folder, look), code)}});
}

// `blush merge`, as if typed: it knows how to add sums.
bool run_merge_of(const std::vector<Part>& chain, const std::filesystem::path& output, const std::filesystem::path& allocation,
                  unsigned threads) {
    CLI::App app;
    std::function<int()> merge;
    add_merge_command(app, merge);
    std::vector<std::string> arguments{"merge", "-o", output.string(), "--quiet"};
    if (!allocation.empty()) arguments.insert(arguments.end(), {"--allocation", allocation.string()});
    if (threads > 0) arguments.insert(arguments.end(), {"--threads", std::to_string(threads)});
    for (const Part& part : chain) arguments.push_back(part.file.string());
    std::ranges::reverse(arguments); // CLI11 takes them from the end
    app.parse(arguments);
    return merge() == exit_done;
}

// A part alone is the image.
Result<void> copy_part(const Part& part, const std::filesystem::path& output) {
    constexpr uint64_t max_bytes = uint64_t(4) << 30;
    const Result<std::vector<uint8_t>> bytes = read_file(part.file, max_bytes);
    if (!bytes) return bytes.error();
    return write_file(output, *bytes);
}

// Removes parts of the chain that are not what their records say. Returns how many.
size_t remove_damaged(const RenderPlan& plan, const PlanLook& look, const std::vector<Part>& chain) {
    size_t removed = 0;
    std::error_code code;
    for (const Part& part : chain)
        if (!check_part(part.file, plan, look, part.samples) && std::filesystem::remove(part.file, code)) ++removed;
    return removed;
}

} // namespace

std::filesystem::path display_file(const std::filesystem::path& folder, const PlanLook& look) {
    return merged_file(folder, look).replace_extension(".png");
}

std::vector<int64_t> planned_samples(const RenderPlan& plan) {
    std::vector<int64_t> planned(plan.looks.size());
    for (const PlanTask& task : plan.tasks) planned[task.look] = std::max(planned[task.look], task.samples.last);
    return planned;
}

LookProgress look_progress(const std::filesystem::path& folder, const RenderPlan& plan, size_t index, int64_t planned) {
    const PlanLook& look = plan.looks[index];
    LookProgress progress;
    progress.planned = planned;
    progress.parts = valid_parts(folder, plan, look);
    progress.chain = chain_of(progress.parts, {0, progress.planned});
    progress.last = progress.chain.empty() ? 0 : progress.chain.back().samples.last;
    const MergedRecord record = read_merged_record(folder, plan, look);
    progress.error = record.error;
    progress.merged_samples = record.samples;
    progress.merged = progress.last > 0 && record.samples == progress.last;
    return progress;
}

Result<LookProgress> merge_look(const std::filesystem::path& folder, const RenderPlan& plan, size_t index, int64_t planned,
                                unsigned threads) {
    const PlanLook& look = plan.looks[index];
    LookProgress progress = look_progress(folder, plan, index, planned);
    // The pilot of adaptive sampling, all of it: its merge decides the allocation.
    std::error_code code;
    const bool decides = look.settings.adaptive && look.allocation.empty() && progress.last == SampleAllocation::pilot_samples;
    const std::filesystem::path allocation = decides ? allocation_file(folder, look) : std::filesystem::path();
    if (progress.merged && (!decides || std::filesystem::exists(allocation, code))) return progress;
    if (progress.chain.empty()) return Error{.file = look.name, .what = "has no samples yet from the first on"};
    const std::filesystem::path output = merged_file(folder, look);
    if (const Result<void> ready = provide_folder(folder, output.parent_path()); !ready) return ready.error();
    if (decides)
        if (const Result<void> ready = provide_folder(folder, allocation.parent_path()); !ready) return ready.error();
    std::filesystem::remove(display_file(folder, look), code);
    const Part& first = progress.chain.front();
    const bool done = progress.chain.size() > 1 ? run_merge_of(progress.chain, output, allocation, threads)
                                                : check_part(first.file, plan, look, first.samples) && copy_part(first, output);
    if (!done) {
        const size_t removed = remove_damaged(plan, look, progress.chain);
        return Error{.file = look.name,
                     .what = removed > 0
                                 ? fmt::format("damaged parts were removed ({}); blush plan resume lists their tasks again", removed)
                                 : "cannot be merged"};
    }
    const Result<std::map<std::string, std::string>> texts = read_metadata(output);
    if (!texts) return texts.error();
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(*texts);
    if (!metadata) return in_file(metadata.error(), output.string());
    progress.error = metadata->error;
    progress.merged_samples = progress.last;
    progress.merged = true;
    if (const Result<void> recorded = write_merged_record(folder, plan, look, {progress.last, metadata->error}); !recorded)
        return recorded.error();
    return progress;
}

} // namespace blush
