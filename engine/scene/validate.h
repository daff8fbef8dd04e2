// What every value in a project must keep, whoever made it: finite numbers in ranges that mean something.
// Whether ids exist is the business of whoever holds the scene (edit.cpp).
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
Result<void> validate(const RenderSettings& settings);
Result<void> validate(const ViewSettings& settings);

} // namespace blush
