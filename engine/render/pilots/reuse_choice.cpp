#include "render/pilots/reuse_choice.h"

#include "render/compile/render_scene.h"

#include <fmt/format.h>

namespace blush {
namespace {

// Why path reuse cannot gain anything; null if it may.
const char* why_useless(const RenderSettings& settings, const RenderScene& scene) {
    if (!scene.may_be_lambertian()) return "no surface is Lambertian: there is no light to share";
    // Light that a second vertex scatters has been scattered twice when it arrives.
    if (settings.max_bounces != unlimited_bounces && settings.max_bounces < 2) return "paths end before they have light to share";
    return nullptr;
}

} // namespace

int reuse_group_size(const RenderSettings& settings, const std::optional<PilotFigures>& pilot) {
    if (settings.reuse != reuse_auto) return settings.reuse;
    return pilot ? pilot->group_size : automatic_group_sizes[0];
}

ReuseChoice::ReuseChoice(const RenderSettings& settings, const RenderScene& scene) : first_(reuse_group_size(settings, {})) {
    if (settings.reuse != reuse_auto) return;
    useless_ = why_useless(settings, scene);
    automatic_ = !useless_;
    if (useless_) first_ = 1;
}

void ReuseChoice::decide(const PilotFigures& pilot) {
    if (automatic_) pilot_ = pilot;
}

int ReuseChoice::group_size(int64_t sample) const {
    if (sample == 0 || !pilot_) return first_;
    return pays() ? pilot_->group_size : 1;
}

FeatureUse ReuseChoice::report(bool excluded) const {
    FeatureUse use{.part = "kernel", .name = "path reuse", .used = first_ > 1 && pays() && !excluded, .why = {}};
    if (excluded && first_ > 1)
        use.why = "light paths or manifold sampling are used, and it does not know their densities";
    else if (pilot_)
        use.why =
            fmt::format("pilot: variance x work of groups of {} pixels is {:.2f} of that without", pilot_->group_size, pilot_->cost());
    else if (useless_)
        use.why = useless_;
    else if (first_ > 1)
        use.why = fmt::format("groups of {} pixels{}", first_, automatic_ ? "; a pilot decides after the first sample" : "");
    else
        use.why = "switched off";
    use.pilot = pilot_;
    return use;
}

} // namespace blush
