#include "app/commands/merge.h"

#include "app/commands/common.h"
#include "app/commands/json_output.h"
#include "app/commands/render/film_json.h"
#include "app/commands/render/write_image.h"

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
    std::string output;
    CommonOptions common;
};

struct Input {
    std::string file;
    LayeredImage image;
    SnapshotMetadata metadata;
    std::optional<FilmState> film;
};

struct Merged {
    SnapshotMetadata metadata;
    int width = 0, height = 0;
    bool exact = false; // from sums instead of means
};

Result<Input> read_input(const std::string& file) {
    Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image->metadata);
    if (!metadata) return in_file(metadata.error(), file);
    Input input{file, *std::move(image), *metadata, {}};
    if (metadata->spp < 1) return Error{file, "has no number of samples", "blush:spp"};
    if (metadata->settings.adaptive)
        return Error{file, "adaptive renders cannot be merged: the sampling of each depends on all its samples", ""};
    if (metadata->film.empty()) return input;
    Result<FilmState> film = film_in_file(input.image, *metadata);
    if (!film) return in_file(film.error(), file);
    input.film = *std::move(film);
    return input;
}

// Checks that `b` is another sample range of the same image.
Result<void> expect_same_image(const Input& a, const Input& b) {
    const auto differs = [&](const char* what) { return Error{b.file, fmt::format("{} than that of {}", what, a.file), ""}; };
    const SnapshotMetadata &m = a.metadata, &n = b.metadata;
    if (m.scene_hash != n.scene_hash || m.edits != n.edits) return differs("shows another scene");
    RenderSettings settings = m.settings;
    settings.first_sample = n.settings.first_sample;
    if (!same_image(settings, n.settings)) return differs("was rendered with other settings");
    if (a.image.width != b.image.width || a.image.height != b.image.height) return differs("has another size");
    if (n.first_sample < m.last_sample) return Error{b.file, fmt::format("contains sample {}, as does {}", n.first_sample, a.file), ""};
    if (n.first_sample > m.last_sample)
        return Error{b.file,
                     fmt::format("begins with sample {}, but {} ends before {}: the samples between are missing", n.first_sample, a.file,
                                 m.last_sample),
                     ""};
    return {};
}

Result<std::vector<Input>> read_inputs(const std::vector<std::string>& files) {
    std::vector<Input> inputs;
    for (const std::string& file : files) {
        Result<Input> input = read_input(file);
        if (!input) return input.error();
        inputs.push_back(*std::move(input));
    }
    std::ranges::stable_sort(inputs, {}, [](const Input& i) { return i.metadata.first_sample; });
    for (size_t i = 1; i < inputs.size(); ++i)
        if (const Result<void> same = expect_same_image(inputs[i - 1], inputs[i]); !same) return same.error();
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

// ---- merging sums

Result<void> write_sum(const MergeCommand& c, std::vector<Input>& inputs, SnapshotMetadata& metadata) {
    FilmState sum = *std::move(inputs.front().film);
    for (size_t i = 1; i < inputs.size(); ++i) {
        Result<FilmState> more = merge_films(sum, *inputs[i].film, metadata.settings);
        if (!more) return in_file(more.error(), inputs[i].file);
        sum = *std::move(more);
    }
    const Result<ResolvedFilm> resolved = resolve_film(sum, metadata.settings, c.common.threads);
    if (!resolved) return in_file(resolved.error(), inputs.front().file);
    metadata.error = error_text(resolved->frame.error);
    metadata.film = film_json(sum);
    const auto has = [&](const char* channel) { return inputs.front().image.find(channel) != nullptr; };
    const bool groups =
        std::ranges::any_of(inputs.front().image.channels, [](const auto& channel) { return channel.name.starts_with("group."); });
    const Layers layers{.albedo = has("albedo.R"),
                        .normal = has("normal.X"),
                        .depth = has("depth.Z"),
                        .error = has("error.R"),
                        .samples = has("samples.Y"),
                        .ids = has("id.object"),
                        .film = true,
                        .groups = groups};
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

// In double precision, rounded once. Standard errors are combined as for independent inputs.
Result<LayeredImage::Channel> mean_channel(const std::vector<Input>& inputs, const LayeredImage::Channel& first, Rule rule, int64_t spp) {
    LayeredImage::Channel merged = first;
    if (rule == Rule::first) return merged;
    std::vector<double> sums(first.values.size());
    for (const Input& input : inputs) {
        const LayeredImage::Channel* channel = input.image.find(first.name);
        if (!channel || channel->values.size() != sums.size()) return Error{input.file, "has no channel " + first.name, ""};
        const double weight = double(input.metadata.spp);
        for (size_t i = 0; i < sums.size(); ++i) {
            const double value = channel->values[i];
            sums[i] += rule == Rule::mean ? weight * value : rule == Rule::sum ? value : weight * value * weight * value;
        }
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        const double value = rule == Rule::root_of_squares ? std::sqrt(sums[i]) : sums[i];
        merged.values[i] = float(rule == Rule::sum ? value : value / double(spp));
    }
    return merged;
}

Result<void> write_mean(const MergeCommand& c, const std::vector<Input>& inputs, const SnapshotMetadata& metadata) {
    const LayeredImage& first = inputs.front().image;
    LayeredImage merged{first.width, first.height, {}, snapshot_texts(metadata)};
    for (const LayeredImage::Channel& channel : first.channels) {
        const std::optional<Rule> rule = rule_of(channel);
        if (!rule) continue;
        Result<LayeredImage::Channel> mean = mean_channel(inputs, channel, *rule, metadata.spp);
        if (!mean) return mean.error();
        merged.channels.push_back(*std::move(mean));
    }
    return write_exr(c.output, merged);
}

Result<Merged> merge(const MergeCommand& c) {
    Result<std::vector<Input>> inputs = read_inputs(c.inputs);
    if (!inputs) return inputs.error();
    Merged merged{merged_metadata(*inputs), inputs->front().image.width, inputs->front().image.height};
    merged.exact = std::ranges::all_of(*inputs, [](const Input& i) { return i.film.has_value(); });
    const Result<void> written = merged.exact ? write_sum(c, *inputs, merged.metadata) : write_mean(c, *inputs, merged.metadata);
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
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_merge(*command); }; });
}

} // namespace blush
