#include "app/commands/plan/render_part.h"

#include "app/commands/common.h"
#include "app/commands/plan/task_log.h"
#include "app/commands/progress.h"
#include "app/commands/render/allocation_file.h"
#include "app/commands/render/film_json.h"
#include "app/commands/render/image_metadata.h"
#include "app/commands/render/layers.h"
#include "app/commands/render/write_image.h"
#include "io/gltf/read/import_options.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "render/renderer.h"

#include <fmt/format.h>

namespace blush {

std::filesystem::path scene_path(const std::filesystem::path& folder, const PlanScene& scene) {
    const std::filesystem::path file(scene.file);
    return file.is_absolute() ? file : folder / file;
}

Result<LoadedScene> load_look(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look, const RenderRun& run,
                              const std::atomic<bool>& interrupted) {
    const PlanScene& scene = plan.scenes[look.scene];
    const std::filesystem::path file = scene_path(folder, scene);
    Result<ImportedScene> imported = [&] {
        Progress progress(run.quiet);
        return import_scene(file, plan.texture_mib, progress, interrupted);
    }();
    if (!imported && imported.error().what == import_cancelled)
        return Error{.file = file.string(), .what = fmt::format("{} before it was read", stopped_by_signal)};
    if (!imported) return imported.error();
    if (const std::string hash = scene_hash(imported->scene); hash != scene.hash)
        return Error{.file = file.string(),
                     .what = fmt::format("is not the scene of the plan: its hash is {}, that of the plan {}", hash, scene.hash)};
    LoadedScene loaded{imported->scene, std::move(imported->scene), std::move(imported->report), 0};
    if (!look.edits.empty()) {
        Result<Scene> edited = apply_edits_json(loaded.imported, look.edits, file.parent_path());
        if (!edited) return in_file(edited.error(), file.string());
        loaded.scene = *std::move(edited);
    }
    if (lights_hash(loaded.scene) != look.lights_hash)
        return Error{.file = file.string(),
                     .what = fmt::format("the environment or the light profiles of look {} are not those of the plan", look.name)};
    return loaded;
}

Result<SampleAllocation::Shares> allocation_of(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look) {
    const std::filesystem::path file = allocation_file(folder, look);
    Result<AllocationFile> allocation = read_allocation(file);
    if (!allocation) return allocation.error();
    const RenderSettings& s = look.settings;
    if (allocation_hash(*allocation) != look.allocation || allocation->scene_hash != plan.scenes[look.scene].hash ||
        allocation->width != s.width || allocation->height != s.height)
        return Error{.file = file.string(), .what = fmt::format("is not the allocation of the plan for the look {}", look.name)};
    return std::move(allocation->shares);
}

Result<void> write_part(const std::filesystem::path& file, const RenderPlan& plan, const PlanLook& look, const LoadedScene& loaded,
                        const RenderSettings& settings, const LoopResult& loop, Renderer& renderer) {
    const Layers layers = *parse_layers(plan.layers); // as read_plan() has checked
    Result<FilmState> film = renderer.save_film(settings.first_sample);
    if (!film) return film.error();
    film->seconds = loop.seconds;
    const PlanScene& scene = plan.scenes[look.scene];
    SnapshotMetadata metadata = image_metadata(scene.file, scene.hash, loaded, settings, loop);
    metadata.edits = look.edits;
    metadata.film = film_json(*film);
    const std::vector<LosslessPlane> planes = planes_in_file(*film);
    const std::vector<Vec3> error = layers.error ? renderer.resolve_error() : std::vector<Vec3>();
    const Result<int64_t> written = write_exr_image(file, loop.frame, {.error = error, .film = planes}, layers, metadata);
    return written ? Result<void>() : written.error();
}

Result<Part> render_part(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look, const LoadedScene& loaded,
                         SampleSpan samples, const RenderRun& run, const std::atomic<bool>& interrupted) {
    RenderSettings settings = look.settings;
    settings.first_sample = samples.first;
    settings.spp = samples.last;
    RendererOptions options{.threads = run.threads, .planes = planes_of(*parse_layers(plan.layers)), .is_part = true};
    if (settings.adaptive && samples.first >= SampleAllocation::pilot_samples) {
        Result<SampleAllocation::Shares> shares = allocation_of(folder, plan, look);
        if (!shares) return shares.error();
        options.allocation = *std::move(shares);
    }
    Renderer renderer(options);
    renderer.update(loaded.scene, settings);
    LoopResult loop;
    {
        Progress progress(run.quiet);
        loop = run_render_loop(renderer, settings, interrupted,
                               [&](const LoopProgress& p) { progress.update(p.fraction, fmt::format("{} spp", p.samples)); });
    }
    if (loop.samples == 0) return Error{.file = look.name, .what = fmt::format("{} before the first sample", stopped_by_signal)};
    Part part{part_file(folder, look, {samples.first, samples.first + loop.samples}),
              {samples.first, samples.first + loop.samples},
              loop.seconds};
    if (const Result<void> written = write_part(part.file, plan, look, loaded, settings, loop, renderer); !written)
        return in_file(written.error(), part.file.string());
    if (const Result<void> recorded = record_part(part, plan, look); !recorded) return recorded.error();
    return part;
}

} // namespace blush
