// Validation of every value in a project, whatever its source: finite numbers in meaningful ranges.
#pragma once

#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

namespace blush {

// Errors name the field, its range and its value; Error::where names the record: "light \"Key\"".
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
// Checks array sizes and indices only. The renderer skips values that it cannot use.
Result<void> validate(const Mesh& mesh);
Result<void> validate(const Skin& skin);
Result<void> validate(const Clip& clip);
// Checks every record, every id (references.h), and that nodes form a forest.
Result<void> validate(const Scene& scene);

} // namespace blush
