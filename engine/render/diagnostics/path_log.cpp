// Text log of one sample, vertex by vertex, using the kernels' own stages with one lane.
#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/expanded_lights.h"
#include "render/compile/render_scene.h"
#include "render/diagnostics/fault_finder.h"
#include "render/diagnostics/light_path_replay.h"
#include "render/integrator/estimator_settings.h"
#include "render/integrator/kernel_settings.h"
#include "render/pilots/learned_sampling.h"
#include "render/renderer.h"
#include "scene/affine.h"
#include "scene/reuse_setting.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <vector>

namespace blush {
namespace {

// True if the film accepts it.
bool is_valid_radiance(const Vec3& c) { return is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0; }

std::string rgb(const Vec3& c) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", c.x, c.y, c.z); }

// Nine digits identify single-precision numbers at any distance from the origin.
std::string point(const Vec3& p, const Vec3d& origin) {
    const Vec3d world = to_double(p) + origin;
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", world.x, world.y, world.z);
}

std::string object_name(const Scene& scene, int32_t object) {
    const Id<Node> id{uint32_t(object) & ~expanded_id_bit};
    const Node* node = scene.nodes.find(id);
    return node && !node->name.empty() ? node->name : fmt::format("node {}", id.value);
}
std::string material_name(const Scene& scene, Id<Material> id) {
    const Material* material = scene.materials.find(id);
    return material && !material->name.empty() ? material->name : id ? fmt::format("material {}", id.value) : "default material";
}

struct Logger {
    const Scene& scene;
    const RenderScene& compiled;
    const EstimatorSettings& settings;
    std::string text;

    template <class... T> void line(fmt::format_string<T...> format, T&&... values) {
        text += fmt::format(format, std::forward<T>(values)...) + "\n";
    }

    void vertex(int bounce, const Path<float>& path, const Hit<float>& hit) {
        line("vertex {}", bounce);
        line("  ray        from {} towards {}", point(path.ray.origin, compiled.origin()), rgb(path.ray.direction));
        line("  throughput {}  pdf {:.6g}", rgb(path.beta), path.pdf);
        if (hit.geometry < 0) {
            line("  leaves the scene");
            return;
        }
        if (hit.instance == sphere_instance) {
            const LightTables& lights = compiled.tables().lights;
            line("  hits       {}, a sphere light, at {:.6g} m",
                 object_name(scene, lights.lights[lights.first_sphere + hit.triangle].object), hit.t);
            return;
        }
        const Surface<float> s = surface_at<all_features, float>(compiled.tables(), hit, true);
        const int32_t object = compiled.tables().parts[s.part].object;
        line("  hits       {}, {}, triangle {}, at {:.6g} m", object_name(scene, object),
             material_name(scene, compiled.material_id(s.material)), hit.triangle, hit.t);
        line("  position   {}  off the surface by at most {:.3g} m", point(s.position, compiled.origin()), max_component(s.error));
        line("  normal     {} geometric, {} shading", rgb(s.ng), rgb(s.ns));
    }

    void light_path(const ReplayedLightPath& path) {
        const EmittedPath& e = path.emitted;
        line("light path {}", e.index);
        line("  leaves     {} towards {}  flux {}", e.infinite ? "the background" : "at " + point(e.light_position, compiled.origin()),
             rgb(e.direction), rgb(e.flux));
        for (size_t k = 0; k < path.vertices.size(); ++k) {
            const ReplayedLightVertex& v = path.vertices[k];
            vertex(int(k), v.path, v.hit);
            if (has_light<float>(v.light)) line("  camera     receives {} in this pixel", rgb(v.light));
        }
    }

    // Panes and blended surfaces dim the light.
    static std::string visibility(const Step<float>& step, const Vec3& reached) {
        if (!has_light<float>(reached)) return "occluded";
        const bool dimmed = luminance(reached) < 0.9999f * luminance(step.direct);
        return dimmed ? "dimmed to " + rgb(reached) : "unoccluded";
    }

    void outcome(const ReplayedVertex& vertex) {
        const Step<float>& step = vertex.step;
        const StepWeights<float>& w = step.weights;
        if (has_light<float>(vertex.past)) line("  background contributes {} past blended surfaces", rgb(vertex.past));
        if (has_light<float>(vertex.shared))
            line("  emission   {}, if manifold sampling does not find the same light", rgb(vertex.shared));
        else if (step.emits)
            line("  emission   contributes {}  MIS weight {:.6g}", rgb(step.emitted), w.emission);
        if (step.connects)
            line("  light      contributes {}, {} over {:.6g} m  pdf {:.6g}, BSDF pdf {:.6g}  MIS weight {:.6g}", rgb(step.direct),
                 visibility(step, vertex.arrived), step.shadow_distance, w.light_pdf, w.light_bsdf_pdf, w.light);
        if (has_light<float>(vertex.chains)) line("  chains     contribute {} by manifold sampling", rgb(vertex.chains));
        if (has_light<float>(vertex.light_vertices)) line("  chains     contribute {} by light vertices", rgb(vertex.light_vertices));
        const bool roulette = vertex.bounce + 1 >= settings.roulette.start && settings.roulette.rule != Roulette::Rule::off;
        if (roulette && w.survival < 1) line("  roulette   {} goes on with probability {:.6g}", to_string(settings.roulette), w.survival);
        if (step.non_finite) {
            line("  non-finite throughput {}  pdf {:.6g}", rgb(step.next.beta), step.next.pdf);
            return;
        }
        if (!step.continues) {
            line("  ends here");
            return;
        }
        line("  scatters   towards {}  pdf {:.6g}  throughput {}", rgb(step.next.ray.direction), step.next.pdf, rgb(step.next.beta));
    }
};

} // namespace

std::string trace_sample(const Scene& scene, const RenderSettings& settings, int x, int y, int64_t sample) {
    const Workers workers(1);
    const Scene expanded = expand_area_lights(scene);
    RenderScene compiled;
    compiled.update(expanded, settings, full_plan(), workers);
    KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height), settings.seed};
    std::vector<std::unique_ptr<TileScratch>> scratches(1);
    const Kernel& kernel = choose_kernel(compiled.features());
    LearnedSampling learned(settings, compiled, FilmSize{settings.width, settings.height});
    const bool decides = sample > 0 || settings.spp != 1; // without a limit, too
    if (decides) learned.decide(std::max<int64_t>(sample + 1, 2), context, kernel, workers, scratches, {});
    const SceneTables tables = learned.tables(compiled.tables(), decides && learned.renews_first() ? std::max<int64_t>(sample, 1) : sample);
    context.scene = &tables;
    Logger log{expanded, compiled, context.settings, {}};
    log.line("pixel {},{} sample {} seed {}", x, y, sample, settings.seed);

    // Limits the length of the log; long paths repeat themselves.
    constexpr int max_log_vertices = 1000;
    if (!scratches[0]) scratches[0] = std::make_unique<TileScratch>();
    TileScratch& scratch = *scratches[0];
    workers.run([&] {
        Vec3 radiance = replay_sample(context, x, y, sample, max_log_vertices, scratch, [&](const ReplayedVertex& vertex) {
            log.vertex(vertex.bounce, vertex.path, vertex.hit);
            log.outcome(vertex);
            return true;
        });
        std::optional<LightPathPass> pass;
        if (!decides)
            pass = learned.early_light_paths(compiled.tables(), int64_t(settings.width) * settings.height);
        else if (learned.light_paths().pays())
            pass = learned.light_path_pass(compiled.tables());
        if (pass) {
            const Kernel& with_light_paths = kernel_like(kernel, kernel.features.with(Feature::light_paths));
            KernelContext light_context = context;
            light_context.scene = &pass->tables;
            const PixelLightPaths found =
                replay_light_paths(light_context, with_light_paths, *pass->emission, pass->paths, sample, x, y, scratch);
            log.line("light paths: {} connections of {} light paths contribute {} to this pixel", found.connections, pass->paths,
                     rgb(found.light));
            for (const ReplayedLightPath& path : found.brightest) log.light_path(path);
            radiance = radiance + found.light;
        }
        if (learned.excludes_reuse())
            log.line("path reuse: not with light paths or manifold sampling");
        else if (settings.reuse == reuse_auto)
            log.line("path reuse: chosen for each image; where it is used, the film shares the light of this path; alone it is worth");
        else if (settings.reuse > 1)
            log.line("path reuse: the film shares the light of this path among {} pixels and adds shares of their light; alone this path "
                     "is worth",
                     settings.reuse);
        if (settings.smooth_edges)
            log.line("smooth edges: in a pixel at the edge of an emitter the film takes more camera rays for emission; alone this path is "
                     "worth");
        if (learned.splits(sample))
            log.line("splitting: where it pays the film follows a path in several copies; alone this path is worth");
        log.line("radiance {}", rgb(radiance));
        if (!is_valid_radiance(radiance)) {
            const Fault fault = find_fault(context, x, y, sample, scratch);
            log.line("refused    {} at {}, vertex {}", to_string(fault.kind), to_string(fault.place), fault.vertex);
        }
    });
    return log.text;
}

} // namespace blush
