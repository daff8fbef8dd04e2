// What every value in a project must keep, whoever made it: finite numbers in ranges that mean something.
#pragma once

#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

namespace blush {

// Errors name the field, its range and its value; `where` says which record: "light \"Key\"".
Result<void> validate(const Node& node);
Result<void> validate(const Material& material);
Result<void> validate(const Light& light);
Result<void> validate(const Texture& texture);
Result<void> validate(const Camera& camera);
Result<void> validate(const Lens& lens);
Result<void> validate(const Environment& environment);
Result<void> validate(const LightMix& mix);
Result<void> validate(const RenderSettings& settings);
Result<void> validate(const ViewSettings& settings);
// Array sizes and indices; the numbers themselves are the renderer's business, which drops what it cannot use.
Result<void> validate(const Mesh& mesh);
Result<void> validate(const Skin& skin);
Result<void> validate(const Clip& clip);
// Every record, every id (references.h), and that nodes form a forest.
Result<void> validate(const Scene& scene);

} // namespace blush
