#include "render/pilots/guiding_choice.h"

#include "render/compile/render_scene.h"
#include "render/pilots/caustic_limits.h"

#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

// Why path guiding cannot gain anything; null if it may.
const char* why_no_guiding(const RenderSettings& settings, const RenderScene& scene) {
    if (const char* why = why_excluded(settings, CausticStrategy::guiding)) return why;
    if (const char* why = why_no_guides(scene.tables().guides.casters, scene.tables().emission_casters)) return why;
    if (!scene.may_be_lambertian()) return "no surface is Lambertian";
    if (settings.max_bounces != unlimited_bounces && settings.max_bounces < 2) return "paths end before light has been focused";
    return nullptr;
}

} // namespace

GuidingChoice::GuidingChoice(const RenderSettings& settings, const RenderScene& scene) : useless_(why_no_guiding(settings, scene)) {}

void GuidingChoice::decide(GuidingField field) {
    if (!useless_) field_ = std::move(field);
}

SceneTables GuidingChoice::tables(SceneTables scene, int64_t sample) const {
    if (sample > 0 && pays()) scene.guides.learned = field_->tables();
    return scene;
}

void GuidingChoice::leave_to_manifolds() {
    if (!pays() || released_) return;
    released_ = field_->memory_bytes();
    field_->release();
}

FeatureUse GuidingChoice::report(const KeptField* kept) const {
    FeatureUse use{.part = "kernel", .name = "path guiding", .used = pays() && !released_, .why = {}};
    if (useless_)
        use.why = useless_;
    else if (!field_ && kept) {
        use.used = true;
        use.bytes = kept->memory_bytes();
        use.why = fmt::format("directions learned {} {} ago, variance was {:.2f} of that without; a pilot decides after the first sample",
                              kept->edits(), kept->edits() == 1 ? "edit" : "edits", kept->figures()->cost());
    } else if (!field_)
        use.why = "a pilot decides after the first sample";
    else if (!field_->figures())
        use.why = "pilot: no photon arrives on a surface that is seen";
    else if (released_)
        use.why = fmt::format("manifold sampling finds this light; pilot: expected variance would be {:.2f} of that without either",
                              field_->figures()->cost());
    else
        use.why = fmt::format("pilot: expected variance is {:.2f} of that without", field_->figures()->cost());
    if (pays()) use.bytes = released_.value_or(field_->memory_bytes());
    if (field_) use.pilot = field_->figures();
    return use;
}

} // namespace blush
