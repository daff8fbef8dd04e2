#include "app/commands/info.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/json_output.h"
#include "app/commands/load_scene.h"
#include "app/commands/progress.h"
#include "app/commands/render/command_feature_report.h"
#include "render/compile/kernel_speed.h"
#include "scene/world_transforms.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace blush {
namespace {

struct InfoCommand {
    std::string scene;
    SceneOverrides overrides;
    bool measure = false;
    CommonOptions common;
};

struct LightCounts {
    int64_t point = 0, spot = 0, sun = 0, rectangle = 0, disk = 0, sphere = 0;
};

LightCounts count_lights(const Scene& scene) {
    LightCounts counts;
    WorldTransforms placements(scene);
    for (const auto& [id, node] : scene.nodes) {
        const Light* light = scene.lights.find(node.light);
        if (!light || !placements(id).visible) continue;
        switch (light->kind) {
        case Light::Kind::point: ++counts.point; break;
        case Light::Kind::spot: ++counts.spot; break;
        case Light::Kind::sun: ++counts.sun; break;
        case Light::Kind::rectangle: ++counts.rectangle; break;
        case Light::Kind::disk: ++counts.disk; break;
        case Light::Kind::sphere: ++counts.sphere; break;
        }
    }
    return counts;
}

int64_t count_cameras(const Scene& scene) {
    return std::count_if(scene.nodes.begin(), scene.nodes.end(), [](const auto& entry) { return bool(entry.value.camera); });
}

// Warnings of import and compilation, in one list.
std::vector<Diagnostic> all_diagnostics(const ImportReport& report, const CompiledInfo& info) {
    std::vector<Diagnostic> all = report.diagnostics;
    all.insert(all.end(), info.warnings.begin(), info.warnings.end());
    return all;
}

std::string line_of(const Diagnostic& d) { return Error{{}, d.what, d.where}.text(); }

OrderedJson speed_json(const KernelSpeed& s) {
    return {{"own", s.own},
            {"own_mpaths_per_s", s.own_mpaths_per_s},
            {"full", s.full},
            {"full_mpaths_per_s", s.full_mpaths_per_s},
            {"ratio", s.ratio}};
}

// Results of `info` in addition to the import report.
struct Findings {
    CompiledInfo info;
    std::optional<KernelSpeed> speed;
};

OrderedJson info_json(const LoadedScene& loaded, const Findings& findings) {
    const CompiledInfo& info = findings.info;
    const LightCounts lights = count_lights(loaded.scene);
    const ImportReport& report = loaded.report;
    OrderedJson warnings = OrderedJson::array();
    for (const Diagnostic& d : all_diagnostics(report, info)) warnings.push_back(line_of(d));
    OrderedJson json;
    json["meshes"] = info.meshes;
    json["triangles"] = info.triangles;
    json["instances"] = info.instances;
    json["materials"] = info.materials;
    json["textures"] = info.textures;
    json["lights"] = {{"point", lights.point},
                      {"spot", lights.spot},
                      {"sun", lights.sun},
                      {"rectangle", lights.rectangle},
                      {"disk", lights.disk},
                      {"sphere", lights.sphere},
                      {"emissive_triangles", info.emissive_triangles},
                      {"environment", info.environment}};
    json["cameras"] = count_cameras(loaded.scene);
    json["animations"] = OrderedJson::array();
    for (const auto& [id, clip] : loaded.scene.clips) json["animations"].push_back({{"name", clip.name}, {"seconds", clip.seconds}});
    json["scenes"] = loaded.scene.scene_names;
    json["variants"] = loaded.scene.variants;
    json["extensions"] = {{"used", report.extensions_used},
                          {"honoured", report.extensions_honoured},
                          {"approximated", report.extensions_approximated},
                          {"ignored", report.extensions_ignored}};
    json["warnings"] = warnings;
    json["kernel"] = kernel_json(info.kernel, info.features);
    if (findings.speed) json["kernel"]["speed"] = speed_json(*findings.speed);
    json["memory_mb"] = info.memory_mb;
    json["seconds"] = report.seconds + info.seconds_setup;
    return json;
}

void print_list(std::string_view name, const std::vector<std::string>& items) {
    if (!items.empty()) fmt::print("{:<22} {}\n", name, fmt::join(items, ", "));
}

// Names of animations, scenes and material variants.
void print_offers(const Scene& scene) {
    std::vector<std::string> clips;
    for (const auto& [id, clip] : scene.clips) clips.push_back(fmt::format("{} ({:.4g} s)", clip.name, clip.seconds));
    print_list("animations", clips);
    print_list("scenes", scene.scene_names);
    print_list("material variants", scene.variants);
}

// One line each, by part.
void print_uses(const char* title, const FeatureReport& feature_report, bool used) {
    fmt::print("{}\n", title);
    for (const FeatureUse& use : feature_report)
        if (use.used == used) fmt::print("  {:<9} {:<26} {:<52} {}\n", use.part, use.name, use.why, cost_text(use));
}

void print_info(const InfoCommand& c, const LoadedScene& loaded, const Findings& findings) {
    const CompiledInfo& info = findings.info;
    const LightCounts lights = count_lights(loaded.scene);
    fmt::print("{}\n", c.scene);
    fmt::print("{:<22} {} meshes, {} instances, {} triangles\n", "geometry", info.meshes, info.instances, info.triangles);
    fmt::print("{:<22} {} materials, {} textures\n", "surfaces", info.materials, info.textures);
    fmt::print("{:<22} {} point, {} spot, {} sun, {} rectangle, {} disk, {} sphere, {} emissive triangles, {}\n", "lights", lights.point,
               lights.spot, lights.sun, lights.rectangle, lights.disk, lights.sphere, info.emissive_triangles,
               info.environment ? "an environment" : "no environment");
    fmt::print("{:<22} {}\n", "cameras", count_cameras(loaded.scene));
    print_offers(loaded.scene);
    print_list("extensions honoured", loaded.report.extensions_honoured);
    print_list("  approximated", loaded.report.extensions_approximated);
    print_list("  ignored", loaded.report.extensions_ignored);
    for (const Diagnostic& d : all_diagnostics(loaded.report, info))
        fmt::print("{:<22} {}\n", d.severity == Diagnostic::Severity::warning ? "warning" : "note", line_of(d));
    fmt::print("{:<22} {}\n", "kernel", info.kernel);
    if (const auto& s = findings.speed)
        fmt::print("{:<22} {:.2f} Mpaths/s of one core, {} {:.2f}: {:.2f} times as fast\n", "", s->own_mpaths_per_s, s->full,
                   s->full_mpaths_per_s, s->ratio);
    for (const FeatureUse& use : info.features)
        if (const auto& p = use.pilot)
            fmt::print("{:<22} {}{}: MSE x {:.3f}, relMSE x {:.3f}, of a typical tile x {:.3f}, work x {:.3f}\n", "pilot", use.name,
                       p->group_size > 0 ? fmt::format(" in groups of {}", p->group_size) : "", p->mse, p->relmse, p->typical, p->work);
    print_uses("with", info.features, true);
    print_uses("left out", info.features, false);
    fmt::print("{:<22} {:.1f} MB, {:.2f} s to load, {:.2f} s to set up\n", "cost", info.memory_mb, loaded.report.seconds,
               info.seconds_setup);
}

int run_info(const InfoCommand& c) {
    const InterruptGuard guard;
    const RenderSettings settings = recommended_settings();
    Result<LoadedScene> loaded = [&] {
        Progress progress(c.common.quiet);
        return load_scene(c.scene, c.overrides, float(settings.width) / float(settings.height), progress, guard.interrupted());
    }();
    if (!loaded) return failed(loaded.error());
    Renderer renderer({.threads = c.common.threads, .planes = {}});
    renderer.update(loaded->scene, settings);
    if (c.measure) renderer.decide();
    Findings findings{renderer.info(), {}};
    if (c.measure) findings.speed = measure_kernel_speed(loaded->scene, settings);
    findings.info.features =
        with_command_features(findings.info.features, c.measure ? measure_command_features(c.common.threads) : CommandFeatures{});
    if (const Result<void> written = write_json(c.common.json, info_json(*loaded, findings)); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_info(c, *loaded, findings);
    return exit_done;
}

} // namespace

void add_info_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<InfoCommand>();
    CLI::App* sub = app.add_subcommand("info", "Print the content of a scene, its ignored features, and the kernel that it needs");
    sub->add_option("scene", command->scene, "glTF file (.gltf, .glb)")->required()->type_name("SCENE");
    sub->add_flag("--measure", command->measure,
                  "Measure the effect of specialisation: the speed of this scene's kernel and of the kernel with all features, in turns "
                  "for a few seconds, the start-up time of OpenImageIO, the view transform and the denoiser, and what path reuse, learned "
                  "visibility, learned portals, path guiding, learned roulette and smooth edges gain and cost");
    add_scene_selection_options(*sub, command->overrides.scene_selection);
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_info(*command); }; });
}

} // namespace blush
