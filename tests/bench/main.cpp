// blush_bench: measures speed and prints JSON. Ratios are portable; absolute figures hold only for this machine when it is idle.
#include "tests/bench/bench.h"
#include "tests/bench/machine.h"
#include "tests/bench/markdown.h"
#include "tests/bench/quality/quality_plot.h"

#include "core/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <thread>

namespace blush::bench {

namespace {

struct Case : ReportedCase {
    Json (*run)(const Options&);
};
constexpr Case cases[]{
    {{"setup", "Import, compile, memory"}, run_setup},
    {{"startup", "Time to the first image, without and with textures, sky and view"}, run_startup},
    {{"rate", "Paths and rays per second compared with Embree alone"}, run_rate},
    {{"kernels", "Every feature set and instruction set"}, run_kernels},
    {{"latency", "Time from an edit to the first image"}, run_latency},
    {{"denoise", "Speed compared with the convolutions alone, remaining error"}, run_denoise},
    {{"estimate", "Cost of the error estimate"}, run_estimate},
    {{"coverage", "How often the intervals of the estimated error contain the true one"}, run_error_coverage},
    {{"recorder", "Cost of tracking the error while rendering"}, run_recorder},
    {{"lights", "Variance and cost of light selection with many lights"}, run_many_lights},
    {{"light_edits", "Time from an edit of a light to the first image, beside one mesh, a million copies of it, emissive triangles"},
     run_light_edits},
    {{"mix", "Light groups: time, cost, memory"}, run_mix},
    {{"big",
      "Time to the first image, and memory, of a million and ten million triangles, a million instances, 2000 meshes with materials"},
     run_big_scenes},
    {{"textures", "Loading 64 textures and an environment map; cost and benefit of filtering"}, run_textures},
    {{"time", "Time from a step of the time slider to the first image"}, run_time_slider},
    {{"image_quality", "FLIP and relMSE of raw and denoised images, with and without path reuse and adaptive sampling"}, run_image_quality},
    {{"quality", "FLIP and relMSE of what is on the screen at times after an edit, raw and denoised"}, run_quality},
    {{"after_edits", "relMSE of what is on the screen at times after an edit, with and without the kept field of path guiding"},
     run_after_edits},
};

std::vector<ReportedCase> reported_cases() { return {std::begin(cases), std::end(cases)}; }

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const Case& c : cases) names.emplace_back(c.name);
    return names;
}

std::string help() {
    std::string text = "Measures speed and prints JSON.";
    for (const Case& c : cases) text += fmt::format("\n  {}: {}", c.name, c.description);
    return text;
}

int fail(const Error& error) {
    fmt::print(stderr, "blush_bench: error: {}\n", error.text());
    return 1;
}

// Runs the cases of these names, or all.
Result<Json> measured(Options& options, const std::vector<std::string>& names) {
    const std::filesystem::path& folder = options.scene_folder;
    for (const auto& found : {shipped_scenes(), folder.empty() ? std::vector<BenchScene>{} : peer_scenes(folder)}) {
        if (!found) return found.error();
        for (const BenchScene& scene : *found)
            if (scene.name().find(options.only) != std::string::npos) options.scenes.push_back(scene);
    }
    Json report{{"machine", describe_machine()}, {"quick", options.quick}};
    for (const Case& c : cases) {
        if (!names.empty() && std::find(names.begin(), names.end(), c.name) == names.end()) continue;
        fmt::print(stderr, "{} ...\n", c.name);
        report[c.name] = c.run(options);
    }
    return report;
}

Result<Json> report_of(const std::filesystem::path& file) {
    const auto bytes = read_file(file, uint64_t(1) << 28);
    if (!bytes) return bytes.error();
    return Json::parse(bytes->begin(), bytes->end());
}

int run(int argc, char** argv) {
    Options options;
    options.threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::string> names;
    std::filesystem::path earlier, plot;
    bool markdown = false;
    CLI::App app{help()};
    app.add_option("cases", names, "What to measure; default: everything")->check(CLI::IsMember(case_names()));
    app.add_flag("--markdown", markdown, "Print tables instead of JSON");
    app.add_option("--scenes", options.scene_folder,
                   "Folder with the scenes of the peer comparison: cornell.glb, cornell_spheres.glb, dense_cornell.glb");
    app.add_option("--only", options.only, "Scenes whose file name contains this");
    app.add_option("--edit", options.edit, "The only kind of edit of the case \"quality\"")
        ->check(CLI::IsMember({"light", "material", "camera", "object", "environment"}));
    app.add_option("--threads", options.threads, "Largest number of threads")->check(CLI::Range(1, 1024))->capture_default_str();
    app.add_option("--seeds", options.rounds, "Seeds of each series of images, rounds of other comparisons")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--spp", options.max_samples, "Largest number of samples per pixel in a series of images")->capture_default_str();
    app.add_option("--variant", options.variant,
                   "The only variant of the case \"image_quality\": plain, reuse, adaptive or \"reuse and adaptive\"");
    app.add_option("--reference-spp", options.reference_samples, "Samples per pixel of images that errors are measured against")
        ->capture_default_str();
    app.add_option("--cache", options.cache, "Folder that keeps the reference images of the cases \"image_quality\" and \"quality\"");
    app.add_option("--longest", options.max_seconds,
                   "Seconds after an edit up to which the case \"quality\" measures; 0: its references alone, for the cache, and "
                   "\"after_edits\" without sessions")
        ->capture_default_str();
    app.add_option("--peer", options.peer_images, "JSON of tests/bench/quality/cycles_images.py, for the case \"quality\"")
        ->check(CLI::ExistingFile);
    app.add_option("--plot", plot, "SVG file for the chart of the case \"quality\"");
    app.add_option("--from", earlier, "JSON of an earlier run, to print or plot instead of measuring");
    app.add_option("--against", options.against, "Another build of blush, run in turn with this one in the cases \"big\" and \"textures\"");
    app.add_flag("--quick", options.quick, "Few rounds: for testing the benchmark, not for figures");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) { return app.exit(e) == 0 ? 0 : 2; }
    if (options.quick) {
        options.rounds = 2;
        options.edits = 5;
        options.reference_samples = 512;
        options.max_seconds = 1;
    }

    const Result<Json> report = earlier.empty() ? measured(options, names) : report_of(earlier);
    if (!report) return fail(report.error());
    if (!plot.empty()) {
        if (!report->contains("quality")) return fail({.what = "a plot needs the case \"quality\""});
        if (const auto written = write_file(plot, quality_chart(report->at("quality"))); !written) return fail(written.error());
    }
    fmt::print("{}\n", markdown ? to_markdown(*report, reported_cases()) : report->dump(2));
    return 0;
}

} // namespace
} // namespace blush::bench

int main(int argc, char** argv) {
    try {
        return blush::bench::run(argc, argv);
    } catch (const std::exception& e) { return blush::bench::fail({.what = e.what()}); }
}
