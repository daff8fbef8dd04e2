#include "app/commands/compare.h"

#include "app/commands/common.h"
#include "app/commands/compare_images.h"
#include "app/commands/json_output.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <memory>
#include <optional>

namespace blush {
namespace {

struct CompareCommand {
    std::string a, b, layer;
    CommonOptions common;
};

Result<Metrics> compare_files(const CompareCommand& c) {
    const Result<ImageToCompare> a = read_image_to_compare(c.a, c.layer);
    if (!a) return a.error();
    const Result<ImageToCompare> b = read_image_to_compare(c.b);
    if (!b) return b.error();
    if (a->encoding != b->encoding)
        return Error{.file = c.a, .what = fmt::format("a scene-linear image cannot be compared with a display-encoded one, {}", c.b)};
    const Result<Metrics> metrics = compare(a->image, b->image, a->encoding);
    if (!metrics) return in_file(metrics.error(), c.a);
    return metrics;
}

OrderedJson metrics_json(const Metrics& m) {
    OrderedJson json;
    json["mse"] = m.mse;
    json["rmse"] = m.rmse;
    json["relmse"] = m.relmse;
    json["mae"] = m.mae;
    json["psnr"] = m.psnr; // null for equal images
    json["flip"] = m.flip.mean;
    json["flip_quartile_1"] = m.flip.first_quartile;
    json["flip_median"] = m.flip.median;
    json["flip_quartile_3"] = m.flip.third_quartile;
    json["flip_max"] = m.flip.largest;
    json["flip_above_0.1_percent"] = 100 * m.flip.share_noticeable;
    json["mean_a"] = m.mean_a;
    json["mean_b"] = m.mean_b;
    json["max_abs"] = m.max_abs;
    json["nonfinite_a"] = m.nonfinite_a;
    json["nonfinite_b"] = m.nonfinite_b;
    return json;
}

void print_table(const Metrics& m) {
    const auto row = [](std::string_view name, double value) { fmt::print("{:<12} {:.6g}\n", name, value); };
    const auto color = [](std::string_view name, const std::array<double, 3>& c) {
        fmt::print("{:<12} {:.6g} {:.6g} {:.6g}\n", name, c[0], c[1], c[2]);
    };
    row("mse", m.mse);
    row("rmse", m.rmse);
    row("relmse", m.relmse);
    row("mae", m.mae);
    row("psnr", m.psnr);
    row("flip", m.flip.mean);
    row("  quartile_1", m.flip.first_quartile);
    row("  median", m.flip.median);
    row("  quartile_3", m.flip.third_quartile);
    row("  max", m.flip.largest);
    row("  % over 0.1", 100 * m.flip.share_noticeable);
    color("mean_a", m.mean_a);
    color("mean_b", m.mean_b);
    row("max_abs", m.max_abs);
    row("nonfinite_a", double(m.nonfinite_a));
    row("nonfinite_b", double(m.nonfinite_b));
}

// Printed even with --quiet: the metrics do not cover all pixels.
void warn_of_non_finite(const std::string& file, int64_t pixels) {
    if (pixels > 0)
        print_warnings(file, {{Diagnostic::Severity::warning,
                               fmt::format("{} pixel{} not finite: the metrics ignore {}", pixels, pixels == 1 ? " is" : "s are",
                                           pixels == 1 ? "it" : "them"),
                               ""}});
}

int run_compare(const CompareCommand& c) {
    std::optional<tbb::global_control> limit;
    if (c.common.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, c.common.threads);
    const Result<Metrics> metrics = compare_files(c);
    if (!metrics) return failed(metrics.error());
    warn_of_non_finite(c.a, metrics->nonfinite_a);
    warn_of_non_finite(c.b, metrics->nonfinite_b);
    if (const Result<void> written = write_json(c.common.json, metrics_json(*metrics)); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_table(*metrics);
    return exit_done;
}

} // namespace

void add_compare_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<CompareCommand>();
    CLI::App* sub = app.add_subcommand("compare", "Print the difference of two images; B is the reference");
    sub->add_option("a", command->a, "Image")->required()->type_name("A");
    sub->add_option("b", command->b, "Reference image of the same size")->required()->type_name("B");
    sub->add_option("--layer", command->layer, "A layer of A instead of its beauty, for example \"denoised\"")->type_name("NAME");
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_compare(*command); }; });
}

} // namespace blush
