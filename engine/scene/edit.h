// An Edit is a sentence about the project: a value, with a label, that apply() turns into the next project.
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

struct SetNode { Id<Node> id; Node node; };
struct SetMaterial { Id<Material> id; Material material; };
struct SetLight { Id<Light> id; Light light; };
struct SetCamera { Id<Camera> id; Camera camera; };
struct SetTexture { Id<Texture> id; Texture texture; };
struct AssignMaterial { Id<Mesh> mesh; int part = 0; Id<Material> material; };
struct MakeEmissive { Id<Node> node; float nits = 1; }; // its mesh and materials become its own, and shine
struct SetEnvironment { Environment environment; };
struct SetMix { LightMix mix; };
struct BakeMix { Scene scene; };        // the same scene with the mix in its lights (render/bake_mix.h)
struct SetLens { Lens lens; };          // of the view
struct SetStaging { Staging staging; }; // a view through a camera that moves goes along
struct SetRender { RenderSettings settings; };
struct SetView { ViewSettings settings; };
struct AddLight { Node node; Light light; }; // node.light is filled in by apply
struct DuplicateNode { Id<Node> id; };       // with its subtree; lights are copied, meshes are shared
struct RemoveNode { Id<Node> id; };          // with its subtree; records nobody uses any more stay, unreferenced
struct Import { Scene scene; std::string name; }; // merges the nodes of another scene under fresh ids
struct LookThrough { Id<Node> camera_node; };
struct Restore { Project project; std::string name; }; // all of it, as it was kept in the snapshot of that name

using Edit = std::variant<SetNode, SetMaterial, SetLight, SetCamera, SetTexture, AssignMaterial, MakeEmissive, SetEnvironment, SetMix, BakeMix, SetLens,
                          SetStaging, SetRender, SetView, AddLight, DuplicateNode, RemoveNode, Import, LookThrough, Restore>;

// "Change light Key", for the history menu.
std::string label(const Edit& edit, const Project& project);

// The next project. Errors: an id that does not exist, a parent cycle, a number that is not finite or out of its range (validate.h).
// Called as blush::apply, since an Edit is a std::variant and brings std::apply along.
Result<Project> apply(const Project& project, const Edit& edit);

} // namespace blush
