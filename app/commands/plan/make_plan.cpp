#include "app/commands/plan/make_plan.h"

#include "app/commands/common.h"
#include "app/commands/plan/gather.h"
#include "app/commands/plan/pilot.h"
#include "app/commands/progress.h"
#include "app/commands/render/layers.h"
#include "io/gltf/read/camera_aspects.h"
#include "io/image/snapshot.h"
#include "io/project/json_fields.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "render/film/sample_allocation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

namespace blush {
namespace {

// Where an error must be reached, but no number of samples is given.
constexpr int64_t default_limit = 65536;

struct ReadScene {
    ImportedScene imported;
    std::filesystem::path file; // absolute
    double seconds = 0;
};

Result<ReadScene> read_once(const std::filesystem::path& file, const RenderPlan& plan, const RenderRun& run,
                            const std::atomic<bool>& interrupted) {
    const auto begun = std::chrono::steady_clock::now();
    Progress progress(run.quiet);
    Result<ImportedScene> imported = import_scene(file, plan.texture_mib, progress, interrupted);
    if (!imported) return imported.error();
    std::error_code code;
    const std::filesystem::path real = std::filesystem::canonical(file, code);
    return ReadScene{*std::move(imported), code ? std::filesystem::absolute(file) : real,
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count()};
}

// Adds the scene to the plan: by its path, or as a copy that is the same.
Result<ReadScene> read_scene(const PlanInput& input, const std::filesystem::path& file, RenderPlan& plan, const RenderRun& run,
                             const std::atomic<bool>& interrupted) {
    Result<ReadScene> scene = read_once(file, plan, run, interrupted);
    if (!scene) return scene.error();
    const std::string hash = scene_hash(scene->imported.scene);
    std::string name = scene->file.string();
    if (input.gather) {
        const std::filesystem::path inside = std::filesystem::path("scenes") / std::to_string(plan.scenes.size() + 1);
        const Result<std::filesystem::path> copy = gather_scene(scene->file, *scene->imported.origin.json, input.folder / inside);
        if (!copy) return copy.error();
        if (scene = read_once(*copy, plan, run, interrupted); !scene) return scene.error();
        if (scene_hash(scene->imported.scene) != hash)
            return Error{.file = file.string(), .what = "cannot be gathered: its copy is another scene"};
        name = (inside / file.filename()).string();
    }
    plan.scenes.push_back({name, hash});
    return scene;
}

// The recipe of an edited scene, whose file is in `folder`. Errors: it cannot be restored from text.
Result<PlanLook> recipe_of(const PlanInput& input, const std::string& name, const RenderPlan& plan, const LoadedScene& loaded,
                           const std::filesystem::path& folder, RenderSettings settings) {
    PlanLook look{.name = name, .scene = plan.scenes.size() - 1};
    const std::string edits = edits_json(loaded.imported, loaded.scene);
    if (count_left_out(edits) > 0) return Error{.file = name, .what = "its edits cannot be stored as text: save the scene as a file first"};
    if (!edits.empty()) {
        look.edits = json_text(Json::parse(edits, nullptr, false));
        const Result<Scene> restored = apply_edits_json(loaded.imported, look.edits, folder);
        if (!restored) return in_file(restored.error(), name);
        if (edits_json(loaded.imported, *restored) != edits) return Error{.file = name, .what = "its edits cannot be restored from text"};
    }
    look.lights_hash = lights_hash(loaded.scene);
    if (input.gather) {
        Result<std::string> gathered = gather_environment(look.edits, folder, folder);
        if (!gathered) return in_file(gathered.error(), name);
        look.edits = *std::move(gathered);
    }
    settings.spp = settings.first_sample = 0;
    settings.seconds = settings.error = 0;
    settings.adaptive = plan.samples_adaptively(settings);
    look.settings = settings;
    return look;
}

// Groups for the layer, as `blush render` makes them.
void provide_groups(const RenderPlan& plan, Scene& scene) {
    if (parse_layers(plan.layers)->groups && scene.mix.grouping == LightMix::Grouping::none)
        scene.mix.grouping = LightMix::Grouping::by_light;
}

// What looks begin from: a scene as its file has it, or as a snapshot has it.
struct Base {
    std::string file, name; // for messages; of the looks
    ReadScene scene;
    std::optional<Scene> edited = {}; // of a snapshot
    RenderSettings settings = recommended_settings();
};

// The base with what the options override.
Result<LoadedScene> overridden_base(const Base& base, const RenderOptions& options, float aspect) {
    const ReadScene& scene = base.scene;
    if (!base.edited) return overridden(scene.imported, scene.file, options.overrides, aspect);
    LoadedScene loaded{scene.imported.scene, *base.edited, scene.imported.report, 0};
    if (const Result<void> applied = apply_overrides(options.overrides, loaded.scene, aspect, true); !applied)
        return in_file(applied.error(), base.file);
    // A snapshot keeps its frame, unless the look has a camera of its own.
    loaded.camera_aspect = options.overrides.camera.empty() ? float(base.settings.width) / float(base.settings.height)
                                                            : aspect_of_camera(camera_aspects(scene.imported.origin), loaded.scene);
    return loaded;
}

Result<PlanLook> resolve_look(const PlanInput& input, const LookRequest& request, const RenderPlan& plan, const Base& base) {
    const std::filesystem::path folder = base.scene.file.parent_path();
    Result<RenderOptions> options = options_of(request.words, {}, base.settings);
    if (!options) return in_file(options.error(), request.name);
    Result<RenderSettings> settings = settings_of(*options);
    if (!settings) return in_file(settings.error(), request.name);
    Result<LoadedScene> loaded = overridden_base(base, *options, float(settings->width) / float(settings->height));
    if (!loaded) return loaded.error();
    if (loaded->camera_aspect > 0 && !(options->width_given && options->height_given)) {
        follow_aspect(*options, loaded->camera_aspect);
        if (settings = settings_of(*options); !settings) return in_file(settings.error(), request.name);
    }
    for (const std::string& edits : request.edits) {
        Result<Scene> edited = apply_edits_json(loaded->scene, edits, folder);
        if (!edited) return in_file(edited.error(), request.name);
        loaded->scene = *std::move(edited);
    }
    if (request.turn) loaded->scene.view = turned(loaded->scene.view, world_bounds(loaded->scene), *request.turn);
    provide_groups(plan, loaded->scene);
    Result<PlanLook> look = recipe_of(input, request.name, plan, *loaded, folder, *settings);
    if (!look) return look.error();
    look->words = request.words;
    look->sequence = request.sequence;
    if (request.turn) look->words["turn"] = fmt::format("{:.6g}", *request.turn);
    if (base.edited) look->words["snapshot"] = std::filesystem::path(base.file).filename().string();
    return look;
}

Result<std::vector<Axis>> axes_of(const PlanInput& input, const Scene& scene) {
    std::vector<Axis> axes;
    if (!input.looks.empty()) {
        Result<std::vector<Axis>> read = read_looks(input.looks);
        if (!read) return read.error();
        axes = *std::move(read);
    }
    const auto add = [&](Result<Axis> axis) -> Result<void> {
        if (!axis) return axis.error();
        axes.push_back(*std::move(axis));
        return {};
    };
    if (!input.cameras.empty())
        if (const Result<void> added = add(camera_axis(scene, input.cameras)); !added) return added.error();
    if (!input.variants.empty())
        if (const Result<void> added = add(variant_axis(scene, input.variants)); !added) return added.error();
    if (!input.frames.empty())
        if (const Result<void> added = add(frame_axis(input.frames, input.frames_per_second, input.words)); !added) return added.error();
    if (input.turntable > 0) axes.push_back(turntable_axis(input.turntable));
    return axes;
}

// Renders the first look of a scene for a while, as the worst of all scenes counts.
Result<void> measure_first(const PlanInput& input, RenderPlan& plan, size_t first_look, const ReadScene& scene, const RenderRun& run,
                           const std::atomic<bool>& interrupted) {
    const PlanLook& look = plan.looks[first_look];
    LoadedScene loaded{scene.imported.scene, scene.imported.scene, scene.imported.report, 0};
    if (!look.edits.empty()) loaded.scene = *apply_edits_json(loaded.imported, look.edits, scene.file.parent_path());
    const Result<MeasuredCosts> costs = measure_costs(plan, look, loaded, scene.seconds, input.folder / "pilot.exr", run, interrupted);
    if (!costs) return costs.error();
    plan.costs = worst_of(plan.costs, *costs);
    return {};
}

Result<void> add_looks(const PlanInput& input, const Base& base, RenderPlan& plan, const RenderRun& run,
                       const std::atomic<bool>& interrupted) {
    const Result<std::vector<Axis>> axes = axes_of(input, base.scene.imported.scene);
    if (!axes) return in_file(axes.error(), base.file);
    const Result<std::vector<LookRequest>> requests = combinations(base.name, input.words, *axes);
    if (!requests) return requests.error();
    const size_t first_look = plan.looks.size();
    for (const LookRequest& request : *requests) {
        Result<PlanLook> look = resolve_look(input, request, plan, base);
        if (!look) return look.error();
        plan.looks.push_back(*std::move(look));
        if (interrupted) return Error{.file = base.file, .what = "interrupted"};
    }
    return measure_first(input, plan, first_look, base.scene, run, interrupted);
}

Result<void> add_scene(const PlanInput& input, const std::string& file, RenderPlan& plan, const RenderRun& run,
                       const std::atomic<bool>& interrupted) {
    Result<ReadScene> scene = read_scene(input, file, plan, run, interrupted);
    if (!scene) return scene.error();
    return add_looks(input, {file, std::filesystem::path(file).stem().string(), *std::move(scene)}, plan, run, interrupted);
}

// Where the scene of a snapshot is. Errors: nowhere.
Result<std::filesystem::path> scene_of_snapshot(const PlanInput& input, const std::string& file, const SnapshotMetadata& m) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path(), name = std::filesystem::path(m.scene).filename();
    std::vector<std::filesystem::path> candidates{folder / m.scene_file, folder / name};
    for (const std::string& scene : input.scenes) candidates.emplace_back(scene);
    std::error_code code;
    for (const std::filesystem::path& candidate : candidates)
        if (candidate.filename() == name && std::filesystem::is_regular_file(candidate, code)) return candidate;
    return Error{.file = file, .what = fmt::format("its scene {} was not found beside it nor among the scenes of the plan", m.scene)};
}

// A snapshot is a look with its edits, camera and settings; what is given besides them overrides them.
Result<void> add_snapshot(const PlanInput& input, const std::string& file, RenderPlan& plan, const RenderRun& run,
                          const std::atomic<bool>& interrupted) {
    const Result<std::map<std::string, std::string>> texts = read_metadata(file);
    if (!texts) return texts.error();
    const Result<SnapshotMetadata> m = read_snapshot_metadata(*texts);
    if (!m) return in_file(m.error(), file);
    const Result<std::filesystem::path> found = scene_of_snapshot(input, file, *m);
    if (!found) return found.error();
    Result<ReadScene> scene = read_scene(input, *found, plan, run, interrupted);
    if (!scene) return scene.error();
    if (plan.scenes.back().hash != m->scene_hash)
        return Error{.file = file, .what = fmt::format("was made from another version of {}", found->string())};
    Result<Scene> edited =
        m->edits.empty() ? Result<Scene>(scene->imported.scene) : apply_edits_json(scene->imported.scene, m->edits, found->parent_path());
    if (!edited) return in_file(edited.error(), file);
    const std::string name = m->name.empty() ? std::filesystem::path(file).stem().string() : m->name;
    return add_looks(input, {file, name, *std::move(scene), *std::move(edited), m->settings}, plan, run, interrupted);
}

// Safe for files, and different from each other: frames of one sequence stay together.
void give_safe_names(std::vector<PlanLook>& looks) {
    std::set<std::string> taken;
    for (PlanLook& look : looks) {
        const std::string frame = look.sequence.empty() ? "" : look.name.substr(look.sequence.size());
        const std::string stem = name_of_look(look.sequence.empty() ? look.name : look.sequence);
        std::string unique = stem;
        for (int i = 2; !taken.insert(unique + frame).second; ++i) unique = fmt::format("{}-{}", stem, i);
        look.name = unique + frame;
        if (!look.sequence.empty()) look.sequence = unique;
    }
}

} // namespace

Result<RenderPlan> make_plan(const PlanInput& input, const RenderRun& run, const std::atomic<bool>& interrupted) {
    RenderPlan plan;
    plan.version = BLUSH_VERSION;
    plan.program = input.program;
    plan.layers = input.layers;
    plan.texture_mib = input.options.overrides.texture_mib;
    plan.error = input.options.settings.error;
    plan.adaptive = input.options.settings.adaptive;
    plan.spp = plan.error > 0 && !input.options.spp_given ? default_limit : input.options.settings.spp;
    plan.frames_per_second = input.frames_per_second;
    plan.view = input.options.view;
    for (const std::string& file : input.scenes)
        if (const Result<void> added = add_scene(input, file, plan, run, interrupted); !added) return added.error();
    for (const std::string& file : input.snapshots)
        if (const Result<void> added = add_snapshot(input, file, plan, run, interrupted); !added) return added.error();
    give_safe_names(plan.looks);
    const int64_t looks = int64_t(plan.looks.size());
    plan.chunk = input.chunk          ? *input.chunk
                 : input.workers == 0 ? choose_chunk(plan.costs, looks, plan.spp)
                                      : choose_chunk_for(plan.costs, looks, plan.spp, input.workers);
    // The first round: of adaptive sampling the pilot; where an error is to be reached, one chunk.
    std::vector<LookSamples> wanted;
    for (size_t i = 0; i < plan.looks.size(); ++i) {
        const int64_t first_round = plan.looks[i].settings.adaptive ? SampleAllocation::pilot_samples
                                    : plan.error > 0                ? plan.chunk
                                                                    : plan.spp;
        wanted.push_back({i, {0, std::min(first_round, plan.spp)}});
    }
    add_tasks(plan, wanted);
    return plan;
}

void add_tasks(RenderPlan& plan, const std::vector<LookSamples>& wanted) {
    std::vector<LookSamples> left = wanted;
    for (bool more = true; more;) {
        more = false;
        for (LookSamples& look : left) {
            if (look.samples.first >= look.samples.last) continue;
            const int64_t chunk_end = std::min(look.samples.last, (look.samples.first / plan.chunk + 1) * plan.chunk);
            const int64_t end = end_of_task(plan.looks[look.look], look.samples.first, chunk_end);
            plan.tasks.push_back({look.look, {look.samples.first, end}});
            look.samples.first = end;
            more = more || end < look.samples.last;
        }
    }
}

} // namespace blush
