#include "render/pilots/visibility_choice.h"

#include "render/compile/render_scene.h"

#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

// Why learned visibility cannot gain anything; null if it may.
const char* why_useless(const RenderSettings& settings, const LightTables& lights) {
    if (settings.strategy == Strategy::bsdf) return "no light is sampled";
    if (lights.tree.root_count + lights.tree.distant_count < 2) return "there are no two lights to select from";
    return nullptr;
}

} // namespace

VisibilityChoice::VisibilityChoice(const RenderSettings& settings, const RenderScene& scene)
    : useless_(why_useless(settings, scene.tables().lights)) {}

void VisibilityChoice::decide(LightVisibility learned) {
    if (!useless_) learned_ = std::move(learned);
}

SceneTables VisibilityChoice::tables(const SceneTables& scene, int64_t sample) const {
    SceneTables tables = scene;
    if (sample > 0 && pays()) tables.lights.tree.visibility = learned_->grid();
    return tables;
}

FeatureUse VisibilityChoice::report() const {
    FeatureUse use{.part = "lights", .name = "learned visibility", .used = pays(), .why = {}};
    if (useless_)
        use.why = useless_;
    else if (!learned_)
        use.why = "a pilot decides after the first sample";
    else if (!learned_->grid().factors)
        use.why = "pilot: no light was sampled";
    else
        use.why = fmt::format("pilot: second moment of light selection is {:.2f} of that without", learned_->second_moment());
    if (use.used) use.bytes = learned_->memory_bytes();
    return use;
}

} // namespace blush
