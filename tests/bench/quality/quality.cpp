// Time to quality after an edit: FLIP and relMSE of what is on the screen against the converged image of the edited scene, at fixed
// times after the edit, raw and denoised.
#include "tests/bench/bench.h"
#include "tests/bench/edits.h"
#include "tests/bench/quality/peer_images.h"
#include "tests/bench/quality/quality_scenes.h"
#include "tests/bench/quality/screen.h"
#include "tests/bench/quality/shown_error.h"

#include "app/commands/converge/reference_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace blush::bench {
namespace {

constexpr int edit_step = 50;        // an edit that is plain to see: light times 1.5, camera by a twentieth of the distance
constexpr double refined_before = 1; // seconds between the image of the scene before the edit and the edit

constexpr double quiet_share =
    0.88; // of the time of all threads, in a run that other load does not disturb; the denoiser does not keep all busy
constexpr int max_attempts = 5;

constexpr const char* kinds[]{"light", "material", "camera", "object", "environment"};
constexpr const char* images[]{"raw", "denoised"};

std::vector<double> deadlines_of(const Options& options) {
    std::vector<double> deadlines{0.033, 0.1, 0.3, 1, 3, 10};
    std::erase_if(deadlines, [&](double d) { return d > options.max_seconds; });
    return deadlines;
}

RenderSettings settings_of(const Options& options) {
    RenderSettings settings = window_settings();
    if (options.quick) settings.width = 320, settings.height = 180;
    return settings;
}

// The converged image; samples in the cache are kept and added to.
Reference reference_of(const Scene& scene, const Options& options) {
    const RenderSettings settings = settings_of(options);
    const std::vector<uint32_t> compared = [&] {
        std::vector<uint32_t> seeds;
        for (int round = 0; round < options.rounds; ++round) seeds.push_back(uint32_t(round));
        return seeds;
    }();
    const std::string key = reference_key(scene, settings);
    std::optional<Reference> cached = cached_reference(options.cache, key, compared);
    Reference reference = cached ? std::move(*cached) : Reference();
    if (!cached) reference.seed = reference_seed(compared);
    const int64_t before = reference.measured.samples;
    Renderer renderer({.threads = options.threads, .planes = {}});
    extend_reference(
        reference, renderer, scene, settings, {.samples = options.reference_samples}, [] { return true; }, [](double) {});
    if (reference.measured.samples > before)
        if (const auto written = cache_reference(options.cache, key, reference); !written)
            fmt::print(stderr, "{}\n", written.error().text());
    return reference;
}

// The measurements at one time after an edit, over the rounds.
struct AtDeadline {
    std::vector<double> flip, relmse, divider, samples;
};
struct Curve {
    std::vector<double> first_ms; // of rounds that showed an image of the edited scene
    std::vector<double> share;    // of the time of all threads that this process got: far below 1 if others keep the machine busy
    std::vector<AtDeadline> at;
};

void add(Curve& curve, const AfterEdit& after, const ErrorMeter& meter, bool denoised) {
    if (after.first_ms > 0) curve.first_ms.push_back(after.first_ms);
    curve.at.resize(after.images.size());
    ShownError error;
    for (size_t i = 0; i < after.images.size(); ++i) {
        const Images& now = after.images[i];
        if (i == 0 || now.frame != after.images[i - 1].frame || now.denoised != after.images[i - 1].denoised)
            error = meter.of(now, denoised);
        AtDeadline& at = curve.at[i];
        at.flip.push_back(error.flip);
        at.relmse.push_back(error.relmse);
        // Of the image that is shown; 0 of the one of before the edit.
        const bool is_new = now.frame->revision == after.revision, shows_denoised = denoised && now.denoised;
        at.divider.push_back(!is_new ? 0 : shows_denoised ? now.denoised->divider : now.frame->divider);
        at.samples.push_back(double(!is_new ? 0 : shows_denoised ? now.denoised->samples : now.frame->samples));
    }
}

Json row_of(const Curve& curve, const std::vector<double>& deadlines) {
    Json row{{"first_image_ms", curve.first_ms.empty() ? Json() : Json(rounded(median(curve.first_ms)))}};
    for (const double d : deadlines) row["ms"].push_back(1e3 * d);
    for (const auto& [name, values] : {std::pair{"flip", &AtDeadline::flip},
                                       {"relmse", &AtDeadline::relmse},
                                       {"divider", &AtDeadline::divider},
                                       {"samples", &AtDeadline::samples}})
        for (const AtDeadline& at : curve.at) row[name].push_back(rounded(median(at.*values)));
    row["share_of_cores"] = rounded(median(curve.share));
    return row;
}

struct Run {
    AfterEdit after;
    double share = 0;
};

// Other load starves the session's threads, whose priority is low: a run that it disturbs is repeated a few times.
Run least_disturbed_run(Screen& screen, const Scene& before, const Scene& edited, const RenderSettings& settings, const Options& options) {
    const std::vector<double> deadlines = deadlines_of(options);
    Run best;
    for (int attempt = 0; attempt < max_attempts && best.share < quiet_share; ++attempt) {
        if (const auto shown = screen.show(before, settings, refined_before); !shown) throw std::runtime_error(shown.error().text());
        Run run;
        const Cost cost = cost_of([&] { run.after = checked(screen.edit(edited, settings, deadlines)); });
        run.share = cost.core_seconds / (cost.wall_seconds * options.threads);
        if (run.share > best.share) best = std::move(run);
    }
    return best;
}

Json measure(const BenchScene& scene, const ColorManagement& color, const Options& options) {
    const std::vector<double> deadlines = deadlines_of(options);
    std::vector<EditKind> edits = edits_of(scene.scene);
    if (!options.edit.empty()) std::erase_if(edits, [&](const EditKind& kind) { return kind.name != options.edit; });

    std::map<std::string, Scene> edited;
    std::map<std::string, ErrorMeter> meters;
    for (const EditKind& kind : edits) {
        Scene& after = edited[kind.name] = scene.scene;
        kind.apply(after, edit_step);
        Reference reference = reference_of(after, options);
        if (!deadlines.empty()) meters.emplace(kind.name, ErrorMeter(color, std::move(reference.measured)));
    }
    if (deadlines.empty()) return Json::array(); // the cache has the references

    std::map<std::pair<std::string, std::string>, Curve> curves; // by kind of edit and of image
    for (int round = 0; round < options.rounds; ++round)
        for (const std::string image : images) {
            const bool denoised = image == "denoised";
            Screen screen(options.threads, denoised);
            RenderSettings settings = settings_of(options);
            settings.seed = uint32_t(round);
            for (const EditKind& kind : edits) {
                const Run run = least_disturbed_run(screen, scene.scene, edited[kind.name], settings, options);
                Curve& curve = curves[{kind.name, image}];
                curve.share.push_back(run.share);
                add(curve, run.after, meters.at(kind.name), denoised);
            }
        }

    Json rows = Json::array();
    for (const std::string kind : kinds) {
        if (!options.edit.empty() && kind != options.edit) continue;
        if (!edited.contains(kind)) {
            rows.push_back({{"scene", scene.name()}, {"edit", kind}, {"skipped", "the scene has none"}});
            continue;
        }
        for (const std::string image : images) {
            Json row{{"scene", scene.name()}, {"edit", kind}, {"image", image}};
            row.update(row_of(curves[{kind, image}], deadlines));
            row["reference_relmse"] = rounded(meters.at(kind).reference_relmse());
            rows.push_back(row);
        }
    }
    return rows;
}

// Means over kinds of edits, by scene and image.
Json means_over_edits(const Json& curves) {
    struct Sum {
        std::vector<double> first_ms, flip, relmse;
        Json ms;
        int edits = 0;
    };
    std::vector<std::pair<std::pair<std::string, std::string>, Sum>> sums; // in the order of the rows
    const auto add = [](std::vector<double>& to, const Json& values) {
        to.resize(values.size());
        for (size_t i = 0; i < values.size(); ++i) to[i] += values.at(i).get<double>();
    };
    for (const Json& row : curves) {
        if (!row.contains("flip")) continue;
        const std::pair<std::string, std::string> key{row.at("scene"), row.at("image")};
        auto found = std::ranges::find(sums, key, [](const auto& s) { return s.first; });
        if (found == sums.end()) found = sums.insert(sums.end(), {key, {}});
        Sum& sum = found->second;
        add(sum.flip, row.at("flip"));
        add(sum.relmse, row.at("relmse"));
        if (row.contains("first_image_ms") && row["first_image_ms"].is_number()) sum.first_ms.push_back(row["first_image_ms"]);
        sum.ms = row.at("ms");
        ++sum.edits;
    }
    Json rows = Json::array();
    for (auto& [key, sum] : sums) {
        Json row{{"scene", key.first}, {"image", key.second}, {"edits", sum.edits}, {"ms", sum.ms}};
        row["first_image_ms"] = sum.first_ms.empty() ? Json() : Json(rounded(median(sum.first_ms)));
        for (const auto& [name, values] : {std::pair{"flip", &sum.flip}, {"relmse", &sum.relmse}})
            for (const double v : *values) row[name].push_back(rounded(v / sum.edits));
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace

Json run_quality(const Options& options) {
    std::vector<BenchScene> scenes = options.scenes;
    for (BenchScene& scene : checked(quality_scenes(options.scene_folder)))
        if (scene.name().find(options.only) != std::string::npos) scenes.push_back(std::move(scene));
    if (options.quick && scenes.size() > 1) scenes.resize(1);
    const ColorManagement color = checked(ColorManagement::load(BLUSH_ASSETS));
    const RenderSettings settings = settings_of(options);
    Json result{{"width", settings.width},
                {"height", settings.height},
                {"threads", options.threads},
                {"rounds", options.rounds},
                {"reference_samples", options.reference_samples},
                {"curves", Json::array()}};
    for (const BenchScene& scene : scenes) {
        fmt::print(stderr, "  {}\n", scene.name());
        for (Json& row : measure(scene, color, options)) result["curves"].push_back(std::move(row));
    }
    for (const std::filesystem::path& file : options.peer_images) result["curves"].push_back(peer_row(file, color));
    result["means"] = means_over_edits(result["curves"]);
    return result;
}

} // namespace blush::bench
