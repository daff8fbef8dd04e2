// What the command line changes in a scene: staging, camera, lens and environment when it is loaded, the size of textures on the way. The same for
// every command and the window.
#pragma once

#include "app/staging_choice.h"
#include "core/result.h"
#include "scene/light_rig.h"
#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// FILE[,intensity=X][,rotate=DEG], none, or constant=R,G,B[,intensity=X].
struct EnvironmentChoice {
    Environment::Kind kind = Environment::Kind::none;
    Vec3 color{1, 1, 1};
    std::filesystem::path file; // image
    float intensity = 1;
    float rotation_degrees = 0;
    bool operator==(const EnvironmentChoice&) const = default;
};
// Errors name what was expected.
Result<EnvironmentChoice> parse_environment(std::string_view text);

// The environment map of the light rig `studio` (scene/light_rig.h) from the assets; no environment where the installation lacks it.
Environment studio_map();
// "none", "studio", "sky".
Result<std::optional<LightRig>> parse_light(std::string_view text);

// "off", "by-light", "by-object", "by-material", "by-hand".
Result<std::optional<LightMix::Grouping>> parse_grouping(std::string_view text);

struct SceneOverrides {
    std::string camera = {}; // name of a camera or of its node, or its number from 0; empty: the scene's first
    std::optional<EnvironmentChoice> environment = {};
    std::optional<LightRig> light = {};             // where the scene has none; empty: none, with a warning
    std::optional<float> aperture = {}, focus = {}; // metres
    std::optional<LightMix::Grouping> groups = {};
    std::optional<int64_t> texture_mib = {}; // that all textures may take as decoded: while they are read, larger ones are made smaller
    StagingChoice staging = {};
};

// Without any camera in the scene, one is framed around it for a picture of `aspect` (width / height).
// Errors: no such animation, scene, variant or camera, an environment map that cannot be read, a lens that makes no sense. `warnings`: no light
// in the scene, or light asked for that the scene does not need.
// `has_view`: the scene was saved with a view, which is then kept.
Result<void> apply_overrides(const SceneOverrides& overrides, Scene& scene, float aspect, bool has_view = false,
                             std::vector<Diagnostic>* warnings = nullptr);

// The aspect of the camera that the view looks through; 0: a free view, or the camera says none.
float aspect_of_camera(const std::map<Id<Camera>, float>& aspects, const Scene& scene);

// Of the camera node that the view looks through; empty for a free view.
std::string camera_name(const Scene& scene);

} // namespace blush
