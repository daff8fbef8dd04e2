// Scene options of the command line: selection of clip, scene and variant, camera, lens, environment and texture memory. The same
// for all commands and the window.
#pragma once

#include "app/common/scene_selection_options.h"
#include "core/result.h"
#include "scene/lights/light_rig.h"
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
// Error messages name the expected format.
Result<EnvironmentChoice> parse_environment(std::string_view text);

// The environment of the studio lighting (scene/lights/light_rig.h) from the assets; none if the file is not installed.
Environment studio_map();
// "none", "studio", "sky".
Result<std::optional<LightRig>> parse_light(std::string_view text);

// "off", "by-light", "by-object", "by-material", "by-hand".
Result<std::optional<LightMix::Grouping>> parse_grouping(std::string_view text);

struct SceneOverrides {
    std::string camera = {}; // name of a camera or its node, or index from 0; empty: the scene's first
    std::optional<EnvironmentChoice> environment = {};
    std::optional<LightRig> light = {};             // lighting for a scene without lights; empty: none, with a warning
    std::optional<float> aperture = {}, focus = {}; // metres
    std::optional<LightMix::Grouping> groups = {};
    std::optional<int64_t> texture_mib = {}; // memory limit for all decoded textures in MiB; larger ones are downsampled while loading
    SceneSelectionOptions scene_selection = {};
};

// Without a camera in the scene, one is framed around it for an image of `aspect` (width / height). Errors: unknown animation,
// scene, variant or camera, unreadable environment map, invalid lens. `warnings`: no light in the scene, or --light not needed.
// `has_view`: the scene was saved with a view, which is used.
Result<void> apply_overrides(const SceneOverrides& overrides, Scene& scene, float aspect, bool has_view = false,
                             std::vector<Diagnostic>* warnings = nullptr);

// Aspect ratio of the camera of the view; 0: a free view, or the camera has none.
float aspect_of_camera(const std::map<Id<Camera>, float>& aspects, const Scene& scene);

// Name of the view's camera node; empty for a free view.
std::string camera_name(const Scene& scene);

} // namespace blush
