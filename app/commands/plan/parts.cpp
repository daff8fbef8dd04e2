#include "app/commands/plan/parts.h"

#include "app/commands/common.h"
#include "app/commands/json_output.h"
#include "app/commands/render/resume_image.h"
#include "app/common/output_folder.h"
#include "core/files.h"
#include "core/text.h"
#include "io/project/json_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

namespace blush {
namespace {

constexpr uint64_t max_record_bytes = 1 << 16;

// FIRST-LAST.exr, as part_file() makes it.
std::optional<SampleSpan> samples_of(const std::filesystem::path& file) {
    SampleSpan samples;
    if (file.extension() != ".exr") return {};
    const std::string stem = file.stem().string();
    const std::vector<std::string_view> ends = split(stem, '-');
    if (ends.size() != 2 || !parse_number(ends[0], samples.first) || !parse_number(ends[1], samples.last)) return {};
    if (samples.first < 0 || samples.first >= samples.last) return {};
    return samples;
}

std::filesystem::path record_of(std::filesystem::path file) { return file.replace_extension(".json"); }

// Seconds of rendering, if there is a record of this part.
std::optional<double> recorded_seconds(const std::filesystem::path& file, const std::string& recipe) {
    std::error_code code;
    const uintmax_t bytes = std::filesystem::file_size(file, code);
    if (code) return {};
    const Result<std::vector<uint8_t>> text = read_file(record_of(file), max_record_bytes);
    if (!text) return {};
    const Result<Json> json = parse_json_object(std::string_view(reinterpret_cast<const char*>(text->data()), text->size()));
    if (!json) return {};
    std::string made_by, of;
    uintmax_t size = 0;
    double seconds = 0;
    const bool read = read_json(json->value("version", Json()), made_by) && read_json(json->value("recipe", Json()), of) &&
                      read_json(json->value("bytes", Json()), size) && read_json(json->value("seconds", Json()), seconds);
    if (!read || made_by != BLUSH_VERSION || of != recipe || size != bytes || seconds < 0) return {};
    return seconds;
}

Result<double> checked_seconds(const std::filesystem::path& file, const RenderPlan& plan, const PlanLook& look, SampleSpan samples) {
    const Result<ResumeImage> part = read_resume_image(file.string());
    if (!part) return part.error();
    const SnapshotMetadata& m = part->metadata;
    const auto wrong = [&](const char* what) { return Error{.file = file.string(), .what = what}; };
    if (m.version != plan.version) return wrong("was rendered by another version of the program");
    if (m.scene_hash != plan.scenes[look.scene].hash || m.edits != look.edits) return wrong("shows another scene");
    RenderSettings settings = look.settings;
    settings.first_sample = samples.first;
    if (!same_image(settings, m.settings)) return wrong("was rendered with other settings");
    if (m.first_sample != samples.first || m.last_sample != samples.last || m.spp != samples.last - samples.first)
        return wrong("holds other samples than its name says");
    return m.seconds;
}

// Ends of parts that can be reached from `from` by whole parts within `samples`.
std::set<int64_t> reached_forwards(const std::vector<Part>& parts, SampleSpan samples) {
    std::set<int64_t> reached{samples.first};
    for (const Part& part : parts) // by first sample: one pass is enough
        if (part.samples.last <= samples.last && reached.contains(part.samples.first)) reached.insert(part.samples.last);
    return reached;
}

std::set<int64_t> reached_backwards(std::vector<Part> parts, SampleSpan samples) {
    std::ranges::sort(parts, std::greater<>(), [](const Part& p) { return p.samples.last; });
    std::set<int64_t> reached{samples.last};
    for (const Part& part : parts)
        if (part.samples.first >= samples.first && reached.contains(part.samples.last)) reached.insert(part.samples.first);
    return reached;
}

} // namespace

std::filesystem::path parts_folder(const std::filesystem::path& folder, const PlanLook& look) { return folder / "parts" / look.name; }

std::filesystem::path part_file(const std::filesystem::path& folder, const PlanLook& look, SampleSpan samples) {
    return parts_folder(folder, look) / fmt::format("{:010}-{:010}.exr", samples.first, samples.last);
}

std::filesystem::path merged_file(const std::filesystem::path& folder, const PlanLook& look) {
    return folder / "merged" / (look.name + ".exr");
}

std::filesystem::path allocation_file(const std::filesystem::path& folder, const PlanLook& look) {
    return folder / "allocations" / (look.name + ".json");
}

Result<void> provide_folder(const std::filesystem::path& folder, const std::filesystem::path& inside) {
    // Before anything is created: a link may lead anywhere.
    if (!is_below(inside, folder)) return Error{.file = inside.string(), .what = "is a link that leads out of the folder of the plan"};
    std::error_code code;
    std::filesystem::create_directories(inside, code);
    if (code || !std::filesystem::is_directory(inside, code)) return Error{.file = inside.string(), .what = "cannot create this folder"};
    for (std::filesystem::directory_iterator entry(inside, code), end; !code && entry != end; entry.increment(code))
        if (entry->is_symlink(code)) return Error{.file = entry->path().string(), .what = "is a link, where a plan has files of its own"};
    return {};
}

Result<void> check_part(const std::filesystem::path& file, const RenderPlan& plan, const PlanLook& look, SampleSpan samples) {
    const Result<double> seconds = checked_seconds(file, plan, look, samples);
    return seconds ? Result<void>() : seconds.error();
}

Result<void> record_part(const Part& part, const RenderPlan& plan, const PlanLook& look) {
    std::error_code code;
    const uintmax_t bytes = std::filesystem::file_size(part.file, code);
    if (code) return Error{.file = part.file.string(), .what = "cannot be read"};
    return write_json(record_of(part.file).string(), {{"version", plan.version},
                                                      {"recipe", plan.recipe(look)},
                                                      {"samples", {part.samples.first, part.samples.last}},
                                                      {"seconds", part.seconds},
                                                      {"bytes", bytes}});
}

std::vector<Part> valid_parts(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look) {
    std::vector<Part> parts;
    const std::string recipe = plan.recipe(look);
    std::error_code code;
    for (std::filesystem::directory_iterator entry(parts_folder(folder, look), code), end; !code && entry != end; entry.increment(code)) {
        const std::filesystem::path& file = entry->path();
        const std::optional<SampleSpan> samples = samples_of(file);
        if (!samples) continue;
        Part part{file, *samples, 0};
        if (const std::optional<double> seconds = recorded_seconds(file, recipe)) {
            part.seconds = *seconds;
        } else {
            const Result<double> checked = checked_seconds(file, plan, look, *samples);
            if (!checked) continue;
            part.seconds = *checked;
            (void)record_part(part, plan, look); // only saves the next reader the check
        }
        parts.push_back(std::move(part));
    }
    std::ranges::sort(parts, {}, [](const Part& p) { return std::tuple(p.samples.first, p.samples.last); });
    return parts;
}

std::vector<Part> chain_of(const std::vector<Part>& parts, SampleSpan samples) {
    // The way back from the farthest end that whole parts reach.
    std::vector<Part> chain;
    const std::set<int64_t> reached = reached_forwards(parts, samples);
    for (int64_t end = *reached.rbegin(); end > samples.first;) {
        const auto before =
            std::ranges::find_if(parts, [&](const Part& p) { return p.samples.last == end && reached.contains(p.samples.first); });
        if (before == parts.end()) break;
        chain.push_back(*before);
        end = before->samples.first;
    }
    std::ranges::reverse(chain);
    return chain;
}

SampleSpan missing_in(const std::vector<Part>& parts, SampleSpan samples) {
    // Those of other tasks do not matter, and there may be thousands.
    const auto begin = std::ranges::lower_bound(parts, samples.first, {}, [](const Part& p) { return p.samples.first; });
    const auto end = std::ranges::lower_bound(parts, samples.last, {}, [](const Part& p) { return p.samples.first; });
    const std::vector<Part> within(begin, end);
    const std::set<int64_t> from = reached_forwards(within, samples), to = reached_backwards(within, samples);
    SampleSpan best = samples;
    for (const int64_t first : from) {
        const auto last = to.lower_bound(first);
        if (last != to.end() && *last - first < best.last - best.first) best = {first, *last};
    }
    return best;
}

} // namespace blush
