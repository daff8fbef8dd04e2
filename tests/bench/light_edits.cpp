// Edits of lights beside one mesh, beside a million copies of it, and beside 8000 emissive triangles: milliseconds from the edit to
// the first image of the session, and core milliseconds of compiling the edited scene alone. The cost should be that of the light, not of
// the scene.
#include "tests/bench/bench.h"
#include "tests/bench/latency_probe.h"
#include "tests/bench/net.h"

#include "render/renderer.h"

#include <cmath>
#include <map>
#include <random>

namespace blush::bench {
namespace {

constexpr uint32_t tree_side = 100, emitter_side = 64; // 20,000 triangles as in the case "big", and 8192
constexpr uint32_t many_nodes = 20000;

struct LitScene {
    const char* name;
    Scene scene;
    Id<Node> lamp, panel, ball; // nodes of a point, a rectangle and a sphere light
    Id<Material> glow = {};     // none: no emissive mesh
};

Id<Node> add_light(Scene& scene, Light::Kind kind, Vec3 place) {
    Light light;
    light.kind = kind;
    light.intensity = kind == Light::Kind::point ? 20 : 5;
    light.width = light.height = 0.5f;
    light.radius = kind == Light::Kind::sphere ? 0.1f : 0;
    Node node;
    node.light = scene.lights.add(light);
    node.local.translation = place;
    node.local.rotation = {-0.7071068f, 0, 0, 0.7071068f}; // lights point down
    return scene.nodes.add(node);
}

Id<Node> show(Scene& scene, Id<Mesh> mesh, InstancesPtr copies, Vec3 place) {
    Node node;
    node.mesh = mesh;
    node.instances = std::move(copies);
    node.local.translation = place;
    return scene.nodes.add(node);
}

LitScene lit(const char* name, uint32_t side) {
    LitScene lit{name, {}, {}, {}, {}};
    Scene& scene = lit.scene;
    Material grey;
    grey.metallic = 0;
    scene.meshes.add({"net", {{std::make_shared<const Geometry>(net(side)), scene.materials.add(grey)}}});
    lit.lamp = add_light(scene, Light::Kind::point, {0.3f, 2, 0.2f});
    lit.panel = add_light(scene, Light::Kind::rectangle, {-0.5f, 1.5f, 0});
    lit.ball = add_light(scene, Light::Kind::sphere, {0.8f, 1, 0});
    scene.view.position = {0, 2, 3};
    scene.view.rotation = {-0.2588190f, 0, 0, 0.9659258f}; // 30 degrees down
    return lit;
}

LitScene one_mesh() {
    LitScene lit = bench::lit("one_mesh", tree_side);
    show(lit.scene, lit.scene.meshes.begin()->id, {}, {0, 0, 0});
    return lit;
}

// Copies by EXT_mesh_gpu_instancing, as in the case "big".
LitScene copies(uint32_t count) {
    LitScene lit = bench::lit("instances_1m", tree_side);
    auto places = std::make_shared<Instances>();
    const auto side = uint32_t(std::sqrt(double(count)));
    for (uint32_t i = 0; i < count; ++i) {
        Affine place;
        place.t = {2.5f * (float(i % side) - float(side / 2)), 0, -2.5f * float(i / side)};
        places->node_from_copy.push_back(place);
    }
    show(lit.scene, lit.scene.meshes.begin()->id, std::move(places), {0, 0, 0});
    return lit;
}

// Nodes that share a mesh.
LitScene nodes(uint32_t count) {
    LitScene lit = bench::lit("nodes_20k", tree_side);
    const auto side = uint32_t(std::sqrt(double(count)));
    for (uint32_t i = 0; i < count; ++i)
        show(lit.scene, lit.scene.meshes.begin()->id, {}, {2.5f * (float(i % side) - float(side / 2)), 0, -2.5f * float(i / side)});
    return lit;
}

LitScene emissive_triangles() {
    LitScene lit = bench::lit("emissive_8k", tree_side);
    show(lit.scene, lit.scene.meshes.begin()->id, {}, {0, 0, 0});
    Material glow;
    glow.emissive = {1, 0.8f, 0.6f};
    glow.double_sided = true;
    lit.glow = lit.scene.materials.add(glow);
    const Id<Mesh> emitter = lit.scene.meshes.add({"emitter", {{std::make_shared<const Geometry>(net(emitter_side)), lit.glow}}});
    show(lit.scene, emitter, {}, {0, 1.5f, -2.5f});
    return lit;
}

struct NamedEdit {
    std::string name;
    std::function<void(Scene&, int step)> apply; // each step gives a different scene
};

std::vector<NamedEdit> edits_of(const LitScene& lit, const std::string& light, Id<Node> node) {
    const Id<Light> id = lit.scene.nodes.find(node)->light;
    const auto light_edit = [&](const char* name, void (*change)(Light&, int)) {
        return NamedEdit{light + "_" + name, [id, change, base = *lit.scene.lights.find(id)](Scene& s, int step) {
                             Light edited = base;
                             change(edited, step);
                             s.lights.set(id, edited);
                         }};
    };
    return {light_edit("intensity", [](Light& l, int step) { l.intensity *= 1 + 0.01f * float(step); }),
            light_edit("colour", [](Light& l, int step) { l.color.y = 1 - 0.01f * float(step % 50); }),
            light_edit("mute", [](Light& l, int step) { l.enabled = step % 2 == 0; }),
            {light + "_move", [node, base = *lit.scene.nodes.find(node)](Scene& s, int step) {
                 Node moved = base;
                 moved.local.translation.x += 0.005f * float(step);
                 s.nodes.set(node, moved);
             }}};
}

std::vector<NamedEdit> edits_of(const LitScene& lit) {
    std::vector<NamedEdit> all;
    for (const auto& [name, node] : {std::pair("point", lit.lamp), {"rectangle", lit.panel}, {"sphere", lit.ball}})
        for (NamedEdit& edit : edits_of(lit, name, node)) all.push_back(std::move(edit));
    if (lit.glow)
        all.push_back({"material_strength", [id = lit.glow, base = *lit.scene.materials.find(lit.glow)](Scene& s, int step) {
                           Material edited = base;
                           edited.emissive_strength *= 1 + 0.01f * float(step);
                           s.materials.set(id, edited);
                       }});
    return all;
}

// Core milliseconds of compiling each edited scene, by edit.
std::map<std::string, std::vector<double>> compile_ms(const LitScene& lit, const Options& options) {
    Renderer renderer({.threads = options.threads, .planes = {}});
    renderer.update(lit.scene, window_settings());
    std::map<std::string, std::vector<double>> ms;
    for (const NamedEdit& edit : edits_of(lit)) {
        renderer.update(lit.scene, window_settings()); // takes the last edit back
        for (int step = 1; step <= options.edits; ++step) {
            Scene edited = lit.scene;
            edit.apply(edited, step);
            ms[edit.name].push_back(1e3 * cost_of([&] { renderer.update(edited, window_settings()); }).core_seconds);
        }
    }
    return ms;
}

Json measure(const LitScene& lit, const Options& options) {
    const std::map<std::string, std::vector<double>> compiling = compile_ms(lit, options);
    LatencyProbe probe(options.threads);
    std::mt19937 random(1);
    Json result;
    for (const NamedEdit& edit : edits_of(lit)) {
        if (!probe.measure(lit.scene, window_settings())) return {{"failed", edit.name}}; // takes the last edit back
        std::vector<Response> responses;
        for (int step = 1; step <= options.edits; ++step) {
            render_for_a_while(random);
            Scene edited = lit.scene;
            edit.apply(edited, step);
            const std::optional<Response> response = probe.measure(edited, window_settings());
            if (!response) return {{"failed", edit.name}};
            responses.push_back(*response);
        }
        result[edit.name] = figures_of(responses);
        result[edit.name]["compile_p50_core_ms"] = rounded(quantile(compiling.at(edit.name), 0.5));
        result[edit.name]["compile_p95_core_ms"] = rounded(quantile(compiling.at(edit.name), 0.95));
    }
    return result;
}

} // namespace

Json run_light_edits(const Options& options) {
    Json result;
    for (LitScene (*make)() : {+[] { return one_mesh(); }, +[] { return copies(1'000'000); }, +[] { return nodes(many_nodes); },
                               +[] { return emissive_triangles(); }}) {
        const LitScene lit = make();
        result[lit.name] = measure(lit, options);
        if (lit.name == std::string("one_mesh")) continue;
        for (auto& [edit, figures] : result[lit.name].items())
            if (const auto one = result["one_mesh"].find(edit); one != result["one_mesh"].end() && figures.is_object())
                figures["first_image_p95_over_one_mesh"] =
                    rounded(figures.value("first_image_p95_ms", 0.0) / one->value("first_image_p95_ms", 0.0));
    }
    return result;
}

} // namespace blush::bench
