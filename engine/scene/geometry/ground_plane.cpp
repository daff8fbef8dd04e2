#include "scene/geometry/ground_plane.h"

#include "scene/affine.h"

#include <algorithm>

namespace blush {

Scene ground_plane_under(const Bounds& box, bool catches_shadows) {
    constexpr double sides = 10, gap = 1e-4; // in radii; the gap avoids coplanar surfaces
    constexpr float grey = 0.5f;
    const double radius = box.empty ? 1 : std::max(box.radius(), 1e-3);
    const float half = float(sides * radius);
    Geometry square;
    square.positions = {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}};
    square.normals = {4, {0, 1, 0}};
    square.uv = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    square.indices = {0, 1, 2, 0, 2, 3};
    Scene scene;
    Material ground;
    const char* const name = catches_shadows ? "Shadow catcher" : "Ground";
    ground.name = name;
    ground.base_color = {grey, grey, grey};
    ground.metallic = 0;
    ground.roughness = 1;
    ground.specular = 0;
    const Id<Material> material = scene.materials.add(ground);
    const Id<Mesh> mesh = scene.meshes.add({name, {{std::make_shared<const Geometry>(std::move(square)), material}}});
    Node node;
    node.name = name;
    node.shadow_catcher = catches_shadows;
    node.mesh = mesh;
    const Vec3d centre = box.empty ? Vec3d{0, 0, 0} : box.center();
    node.local.translation = to_float(Vec3d{centre.x, (box.empty ? 0 : box.low.y) - gap * radius, centre.z});
    scene.nodes.add(node);
    return scene;
}

} // namespace blush
