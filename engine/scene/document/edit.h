// Edits of the project as values: apply() computes the next project, label() names the undo step.
#pragma once

#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

#include <string>
#include <variant>

namespace blush {

struct Project {
    Scene scene;
    RenderSettings render;
    ViewSettings view;
    bool operator==(const Project&) const = default;
};

struct SetNode {
    Id<Node> id;
    Node node;
};
struct SetMaterial {
    Id<Material> id;
    Material material;
};
struct SetLight {
    Id<Light> id;
    Light light;
};
struct SetCamera {
    Id<Camera> id;
    Camera camera;
};
struct SetTexture {
    Id<Texture> id;
    Texture texture;
};
struct AssignMaterial {
    Id<Mesh> mesh;
    int part = 0;
    Id<Material> material;
};
struct MakeEmissive {
    Id<Node> node;
    float nits = 1;
}; // makes its mesh and materials unique and emissive
struct SetEnvironment {
    Environment environment;
};
struct SetMix {
    LightMix mix;
};
struct BakeMix {
    Scene scene;
}; // the same scene with the mix in its lights (render/light_mix/bake_mix.h)
struct SetLens {
    Lens lens;
}; // of the view
struct SetSceneSelection {
    SceneSelection scene_selection;
}; // a view through an animated camera follows it
struct SetRender {
    RenderSettings settings;
};
struct SetView {
    ViewSettings settings;
};
struct AddLight {
    Node node;
    Light light;
}; // apply sets node.light
struct DuplicateNode {
    Id<Node> id;
}; // with its subtree; lights are copied, meshes are shared
struct RemoveNode {
    Id<Node> id;
}; // with its subtree; unreferenced records stay in their tables
struct Import {
    Scene scene;
    std::string name;
}; // merges the nodes of another scene with new ids
struct LookThrough {
    Id<Node> camera_node;
};
struct Restore {
    Project project;
    std::string name;
}; // the whole project, from the snapshot of that name

using Edit =
    std::variant<SetNode, SetMaterial, SetLight, SetCamera, SetTexture, AssignMaterial, MakeEmissive, SetEnvironment, SetMix, BakeMix,
                 SetLens, SetSceneSelection, SetRender, SetView, AddLight, DuplicateNode, RemoveNode, Import, LookThrough, Restore>;

// "Change light Key", for the history menu.
std::string label(const Edit& edit, const Project& project);

// Returns the next project. Errors: an id that does not exist, a parent cycle, a number that is not finite or out of range
// (validate.h).
// Called as blush::apply, since an Edit is a std::variant and brings std::apply along.
Result<Project> apply(const Project& project, const Edit& edit);

} // namespace blush
