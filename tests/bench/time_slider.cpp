// Latency from a step of the time slider to the first image that shows it, in scenes with few or many moving objects.
#include "tests/bench/bench.h"
#include "tests/bench/latency_probe.h"
#include "tests/bench/net.h"

#include "core/parallel.h"
#include "render/bvh/accel.h"
#include "scene/animation/deform.h"
#include "scene/animation/posed_scene.h"
#include "scene/document/scene_selection.h"

#include <algorithm>
#include <cmath>

namespace blush::bench {
namespace {

struct Stage {
    Scene scene;
    Clip clip{"all", 10, {}};
    Id<Material> material;

    Stage() {
        material = scene.materials.add(Material{});
        Light light;
        light.kind = Light::Kind::sun;
        light.intensity = 3;
        Node sun;
        sun.light = scene.lights.add(light);
        sun.local.rotation = {-0.5f, 0, 0, 0.8660254f};
        scene.nodes.add(sun);
        scene.view.position = {0, 2, 3};
    }
    Id<Mesh> mesh(Geometry geometry) {
        return scene.meshes.add({"net", {{std::make_shared<const Geometry>(std::move(geometry)), material}}});
    }
    Id<Node> show(Id<Mesh> mesh, Vec3 place) {
        Node node;
        node.mesh = mesh;
        node.local.translation = place;
        return scene.nodes.add(node);
    }
    // Up and down, starting at the current position.
    void swing(Id<Node> node) {
        const Vec3 at = scene.nodes.find(node)->local.translation;
        const auto up = std::make_shared<Keyframes>();
        up->times = {0, 5, 10};
        up->values = {at.x, at.y, at.z, at.x, at.y + 0.5f, at.z, at.x, at.y, at.z};
        clip.channels.push_back({node, Channel::Property::translation, up});
    }
    Scene finished() {
        scene.clips.add(clip);
        return scene;
    }
};

Scene rigid_nodes(int count) {
    Stage stage;
    const Id<Mesh> mesh = stage.mesh(net(10));
    const auto side = int(std::sqrt(count));
    for (int i = 0; i < count; ++i) stage.swing(stage.show(mesh, {2.f * float(i % side - side / 2), 0, -2.f * float(i / side)}));
    return stage.finished();
}

// Four joints per vertex, one of which moves.
Scene skinned_net(uint32_t n) {
    Stage stage;
    Geometry g = net(n);
    for (const Vec3& p : g.positions) {
        const float w = 0.25f * (p.x + 1);
        g.influences.insert(g.influences.end(), {{0, 1 - 2 * w}, {1, w}, {2, w}, {3, 0}});
    }
    const Id<Node> node = stage.show(stage.mesh(std::move(g)), {0, 0, 0});
    Skin skin;
    for (int j = 0; j < 4; ++j) skin.joints.push_back(stage.show({}, {0, 0, 0}));
    skin.joint_from_mesh.resize(4);
    stage.swing(skin.joints[1]);
    Node hung = *stage.scene.nodes.find(node);
    hung.skin = stage.scene.skins.add(skin);
    stage.scene.nodes.set(node, hung);
    return stage.finished();
}

Scene with_one_animated_object(uint32_t n) {
    Stage stage;
    stage.show(stage.mesh(net(n)), {0, 0, 0});
    stage.swing(stage.show(stage.mesh(net(10)), {0, 0.5f, 0}));
    return stage.finished();
}

Json measure(const Scene& scene, const Options& options) {
    LatencyProbe probe(options.threads);
    const Id<Clip> clip = scene.clips.begin()->id;
    std::vector<Response> responses;
    for (int step = 0; step <= options.edits; ++step) {
        const std::optional<Response> response =
            probe.measure(with_scene_selection(scene, {.clip = clip, .seconds = 0.01f * float(step)}), window_settings());
        if (!response) return {{"failed", "the session gave no image"}};
        if (step > 0) responses.push_back(*response); // the first opens the scene
    }
    return figures_of(responses);
}

// Parts of a step of a skin: all of its vertices, and the BVH of its triangles.
Json skin_parts(uint32_t n, const Options& options) {
    Scene scene = skinned_net(n);
    scene = with_pose_applied(with_scene_selection(scene, {.clip = scene.clips.begin()->id, .seconds = 1}));
    const auto skinned = std::ranges::find_if(scene.nodes, [](const auto& entry) { return bool(entry.value.skin); });
    WorldTransforms transforms(scene);
    const Deformation deformation = deformation_of(scene, transforms, skinned->id, skinned->value).value();
    const GeometryPtr rest = scene.meshes.find(skinned->value.mesh)->parts[0].geometry;
    const Workers one(1), all(options.threads);
    Accel accel;
    std::vector<double> on_one, on_all, bvh;
    for (int round = 0; round < options.rounds; ++round) {
        on_one.push_back(cost_of([&] { deformed(*rest, deformation, &one); }).wall_seconds);
        GeometryPtr deformed_geometry;
        on_all.push_back(cost_of([&] { deformed_geometry = deformed(*rest, deformation, &all); }).wall_seconds);
        AccelScene triangles;
        triangles.flat.push_back({deformed_geometry->serial, deformed_geometry, deformed_geometry->positions.data(),
                                  deformed_geometry->positions.size(), deformed_geometry->indices.data(),
                                  deformed_geometry->triangle_count()});
        bvh.push_back(cost_of([&] { accel.commit(triangles, nullptr, all); }).wall_seconds);
    }
    return {{"vertices_one_thread_ms", rounded(1e3 * median(on_one))},
            {"vertices_ms", rounded(1e3 * median(on_all))},
            {"bvh_ms", rounded(1e3 * median(bvh))}};
}

} // namespace

Json run_time_slider(const Options& options) {
    return {{"rigid_nodes_1000", measure(rigid_nodes(1000), options)},
            {"skinned_100k", measure(skinned_net(224), options)},
            {"skinned_1m", measure(skinned_net(708), options)},
            {"skinned_1m_parts", skin_parts(708, options)},
            {"still_1m_and_one_node", measure(with_one_animated_object(708), options)}};
}

} // namespace blush::bench
