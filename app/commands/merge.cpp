#include "app/commands/merge.h"

#include "app/commands/common.h"
#include "app/commands/json_output.h"
#include "app/commands/render/allocation_file.h"
#include "app/commands/render/film_json.h"
#include "app/commands/render/peak_memory.h"
#include "app/commands/render/write_image.h"
#include "render/film/film_merger.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace blush {
namespace {

struct MergeCommand {
    std::vector<std::string> inputs;
    std::string output, allocation;
    CommonOptions common;
};

// A file whose pixels are read only while they are merged.
struct Input {
    std::string file;
    SnapshotMetadata metadata;
};

struct Merged {
    SnapshotMetadata metadata;
    int width = 0, height = 0;
    bool exact = false; // from sums instead of means
};

Result<Input> read_head(const std::string& file) {
    const auto texts = read_metadata(file);
    if (!texts) return texts.error();
    Result<SnapshotMetadata> metadata = read_snapshot_metadata(*texts);
    if (!metadata) return in_file(metadata.error(), file);
    if (metadata->spp < 1) return Error{file, "has no number of samples", "blush:spp"};
    if (metadata->settings.adaptive && metadata->film.empty())
        return Error{file, "adaptive images cannot be merged from their means: render the parts with --layers film", ""};
    return Input{file, *std::move(metadata)};
}

// Checks that `b` is the next sample range of the same image.
Result<void> expect_next(const Input& a, const Input& b) {
    const auto differs = [&](const char* what) { return Error{b.file, fmt::format("{} than that of {}", what, a.file), ""}; };
    const SnapshotMetadata &m = a.metadata, &n = b.metadata;
    if (m.scene_hash != n.scene_hash || m.edits != n.edits) return differs("shows another scene");
    if (m.version != n.version) return differs(fmt::format("was rendered by another version of Blush, {},", n.version).c_str());
    RenderSettings settings = m.settings;
    settings.first_sample = n.settings.first_sample;
    if (!same_image(settings, n.settings)) return differs("was rendered with other settings");
    if (n.first_sample < m.last_sample) return Error{b.file, fmt::format("contains sample {}, as does {}", n.first_sample, a.file), ""};
    if (n.first_sample > m.last_sample)
        return Error{b.file,
                     fmt::format("begins with sample {}, but {} ends before {}: the samples between are missing", n.first_sample, a.file,
                                 m.last_sample),
                     ""};
    return {};
}

// In the order of their samples.
Result<std::vector<Input>> read_heads(const std::vector<std::string>& files) {
    std::vector<Input> inputs;
    for (const std::string& file : files) {
        Result<Input> input = read_head(file);
        if (!input) return input.error();
        inputs.push_back(*std::move(input));
    }
    std::ranges::stable_sort(inputs, {}, [](const Input& i) { return i.metadata.first_sample; });
    for (size_t i = 1; i < inputs.size(); ++i)
        if (const Result<void> next = expect_next(inputs[i - 1], inputs[i]); !next) return next.error();
    return inputs;
}

SnapshotMetadata merged_metadata(const std::vector<Input>& inputs) {
    SnapshotMetadata m = inputs.front().metadata;
    m.last_sample = inputs.back().metadata.last_sample;
    m.spp = 0;
    m.seconds = 0;
    m.partial = false;
    for (const Input& input : inputs) {
        m.spp += input.metadata.spp;
        m.seconds += input.metadata.seconds;
        m.partial |= input.metadata.partial;
    }
    m.settings.spp = m.last_sample;
    m.error.clear();
    m.denoised.clear();
    m.film.clear();
    return m;
}

// The file again, which may have been replaced since its head was read.
Result<LayeredImage> read_pixels(const Input& input) {
    Result<LayeredImage> image = read_layers(input.file);
    if (!image) return image.error();
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image->metadata);
    if (!metadata || *metadata != input.metadata) return Error{input.file, "changed while it was merged", ""};
    return image;
}

// ---- merging sums

// Adds the layers of a part: one of a single sample has no error.
void add_layers(Layers& layers, const LayeredImage& image) {
    const auto has = [&](const char* channel) { return image.find(channel) != nullptr; };
    const bool groups = std::ranges::any_of(image.channels, [](const auto& channel) { return channel.name.starts_with("group."); });
    layers.albedo |= has("albedo.R");
    layers.normal |= has("normal.X");
    layers.depth |= has("depth.Z");
    layers.error |= has("error.R");
    layers.samples |= has("samples.Y");
    layers.ids |= has("id.object");
    layers.groups |= groups;
}

Result<void> write_allocation_of(const MergeCommand& c, const FilmState& sum, const SnapshotMetadata& metadata) {
    if (sum.shares[0].empty())
        return Error{c.allocation,
                     "no allocation: it needs adaptive parts that hold the samples 0:16 and of which one ends with sample 8, such as 0:8 "
                     "and 8:16",
                     ""};
    return write_allocation(c.allocation, {metadata.scene_hash, sum.width, sum.height, sum.shares});
}

Result<void> write_sum(const MergeCommand& c, const std::vector<Input>& inputs, Merged& merged) {
    SnapshotMetadata& metadata = merged.metadata;
    FilmMerger merger(metadata.settings);
    Layers layers{.film = true};
    for (const Input& input : inputs) {
        Result<LayeredImage> image = read_pixels(input);
        if (!image) return image.error();
        add_layers(layers, *image);
        const Result<FilmState> part = film_in_file(*image, input.metadata);
        if (!part) return in_file(part.error(), input.file);
        if (part->first_sample != input.metadata.first_sample || part->samples != input.metadata.spp)
            return Error{input.file, "its samples are not those that its header names", "blush:film"};
        if (const Result<void> added = merger.add(*part); !added) return in_file(added.error(), input.file);
    }
    const FilmState sum = merger.sum();
    if (!c.allocation.empty())
        if (const Result<void> written = write_allocation_of(c, sum, metadata); !written) return written.error();
    const Result<ResolvedFilm> resolved = resolve_film(sum, metadata.settings, c.common.threads);
    if (!resolved) return in_file(resolved.error(), inputs.front().file);
    metadata.error = error_text(resolved->frame.error);
    metadata.film = film_json(sum);
    merged.width = sum.width;
    merged.height = sum.height;
    const std::vector<LosslessPlane> planes = planes_in_file(sum);
    ExtraLayers extra{.film = planes};
    if (layers.error) extra.error = resolved->error;
    const Result<int64_t> written = write_exr_image(c.output, resolved->frame, extra, layers, metadata);
    return written ? Result<void>() : written.error();
}

// ---- merging means

// How a channel is merged, if not by its mean.
enum class Rule { mean, sum, root_of_squares, first };
std::optional<Rule> rule_of(const LayeredImage::Channel& channel) {
    const std::string_view name = channel.name;
    if (name.starts_with("denoised.") || name.starts_with("film.")) return std::nullopt; // only valid for a single input
    if (channel.is_uint || name == "depth.Z") return Rule::first;
    if (name == "samples.Y") return Rule::sum;
    return name.starts_with("error.") ? Rule::root_of_squares : Rule::mean;
}

// A channel of the merged image while the files are read, one after the other.
struct ChannelSum {
    LayeredImage::Channel first; // of the first file
    Rule rule = Rule::mean;
    std::vector<double> sums = {};
};

// In double precision. Standard errors are combined as for independent inputs.
Result<void> add_channel(ChannelSum& to, const LayeredImage& image, const Input& input) {
    if (to.rule == Rule::first) return {};
    const LayeredImage::Channel* channel = image.find(to.first.name);
    if (!channel || channel->values.size() != to.first.values.size()) return Error{input.file, "has no channel " + to.first.name, ""};
    to.sums.resize(channel->values.size());
    const double weight = double(input.metadata.spp);
    for (size_t i = 0; i < to.sums.size(); ++i) {
        const double value = channel->values[i];
        to.sums[i] += to.rule == Rule::mean ? weight * value : to.rule == Rule::sum ? value : weight * value * weight * value;
    }
    return {};
}

// Rounded once.
LayeredImage::Channel mean_of(ChannelSum sum, int64_t spp) {
    for (size_t i = 0; i < sum.sums.size(); ++i) {
        const double value = sum.rule == Rule::root_of_squares ? std::sqrt(sum.sums[i]) : sum.sums[i];
        sum.first.values[i] = float(sum.rule == Rule::sum ? value : value / double(spp));
    }
    return std::move(sum.first);
}

Result<void> write_mean(const MergeCommand& c, const std::vector<Input>& inputs, Merged& result) {
    std::vector<ChannelSum> sums;
    for (const Input& input : inputs) {
        const Result<LayeredImage> image = read_pixels(input);
        if (!image) return image.error();
        if (&input == &inputs.front()) {
            result.width = image->width;
            result.height = image->height;
            for (const LayeredImage::Channel& channel : image->channels)
                if (const std::optional<Rule> rule = rule_of(channel)) sums.push_back({channel, *rule});
        }
        if (image->width != result.width || image->height != result.height)
            return Error{input.file, "has another size than that of " + inputs.front().file, ""};
        for (ChannelSum& sum : sums)
            if (const Result<void> added = add_channel(sum, *image, input); !added) return added.error();
    }
    LayeredImage merged{result.width, result.height, {}, snapshot_texts(result.metadata)};
    for (ChannelSum& sum : sums) merged.channels.push_back(mean_of(std::move(sum), result.metadata.spp));
    return write_exr(c.output, merged);
}

Result<Merged> merge(const MergeCommand& c) {
    const Result<std::vector<Input>> inputs = read_heads(c.inputs);
    if (!inputs) return inputs.error();
    Merged merged{merged_metadata(*inputs)};
    merged.exact = std::ranges::none_of(*inputs, [](const Input& i) { return i.metadata.film.empty(); });
    if (!merged.exact && !c.allocation.empty())
        return Error{c.allocation, "no allocation: the parts have no sums; render them with --layers film", ""};
    const Result<void> written = merged.exact ? write_sum(c, *inputs, merged) : write_mean(c, *inputs, merged);
    if (!written) return written.error();
    return merged;
}

OrderedJson merged_json(const MergeCommand& c, const Merged& m) {
    return {{"inputs", c.inputs},
            {"width", m.width},
            {"height", m.height},
            {"samples", {m.metadata.first_sample, m.metadata.last_sample}},
            {"spp", m.metadata.spp},
            {"seconds", m.metadata.seconds},
            {"from", m.exact ? "sums" : "means"},
            {"partial", m.metadata.partial},
            {"peak_memory_mb", peak_memory_mb()},
            {"output", c.output}};
}

int run_merge(const MergeCommand& c) {
    if (lower_extension(c.output) != ".exr") return bad_usage("merge needs -o OUT.exr");
    if (const Result<void> folder = expect_folder(c.output); !folder) return failed(folder.error());
    const Result<Merged> merged = merge(c);
    if (!merged) return failed(in_file(merged.error(), c.output));
    if (const Result<void> written = write_json(c.common.json, merged_json(c, *merged)); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-")
        fmt::print("{}: {}x{}, samples {}:{} of {} images, {}\n", c.output, merged->width, merged->height, merged->metadata.first_sample,
                   merged->metadata.last_sample, c.inputs.size(), merged->exact ? "from their sums" : "from their means");
    return exit_done;
}

} // namespace

void add_merge_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<MergeCommand>();
    CLI::App* sub = app.add_subcommand("merge", "Merge renders of the same scene with different sample ranges");
    sub->add_option("inputs", command->inputs,
                    "EXR files with consecutive --samples ranges, in any order; if all have the layer film, "
                    "their sums are added, and the result can be resumed")
        ->required()
        ->expected(2, 100000)
        ->type_name("EXR");
    sub->add_option("-o,--output", command->output, "Output file")->required()->type_name("OUT");
    sub->add_option("--allocation", command->allocation,
                    "Write the allocation of adaptive sampling, decided from the samples 0:8 and 8:16, for render --allocation")
        ->type_name("JSON");
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_merge(*command); }; });
}

} // namespace blush
