#include "render/diagnostics/bleed_tracer.h"

#include "render/integrator/kernel_settings.h"
#include "render/light_mix/bake_mix.h"
#include "scene/changes.h"

#include <limits>
#include <utility>

namespace blush {

BleedTracer::BleedTracer(unsigned threads, bool low_priority) : workers_(threads, low_priority), scratch_(workers_.threads()) {}

void BleedTracer::begin(const Scene& scene, const RenderSettings& settings) {
    Scene baked = scene.mix.grouping == LightMix::Grouping::none ? scene : bake_mix(scene).scene;
    baked.mix.grouping = LightMix::Grouping::by_light;
    groups_ = make_light_groups(baked, std::numeric_limits<int>::max());
    baked.mix = {};
    Scene now = expand_area_lights(baked, &meshes_, &workers_);
    const UpdatePlan todo = expanded_ ? plan(diff(*expanded_, settings_, now, settings)) : full_plan();
    compiled_.update(now, settings, todo, workers_, &groups_);
    expanded_ = std::move(now);
    settings_ = settings;
}

std::vector<BleedSums> BleedTracer::traced(int64_t count, const std::function<bool()>& wanted,
                                           const std::function<BleedSums(const KernelContext&, int64_t i, TileScratch&)>& trace_one) {
    const KernelContext context{&compiled_.tables(), &compiled_.accel(), kernel_settings(settings_, settings_.width, settings_.height),
                                settings_.seed};
    std::vector<BleedSums> batches(static_cast<size_t>(count));
    const bool done = workers_.for_each(count, wanted, [&](int64_t i, unsigned worker) {
        if (!scratch_[worker]) scratch_[worker] = std::make_unique<TileScratch>();
        batches[size_t(i)] = trace_one(context, i, *scratch_[worker]);
    });
    return done ? std::move(batches) : std::vector<BleedSums>();
}

std::vector<BleedSums> BleedTracer::trace(const BleedTarget& target, int64_t first, int64_t count, const std::function<bool()>& wanted) {
    return traced(count, wanted, [&](const KernelContext& context, int64_t i, TileScratch& scratch) {
        return trace_bleed_batch(context, target, compiled_.origin(), first + i, scratch);
    });
}

std::vector<BleedSums> BleedTracer::trace_each(std::span<const BleedTarget> targets, int64_t batch, const std::function<bool()>& wanted) {
    return traced(int64_t(targets.size()), wanted, [&](const KernelContext& context, int64_t i, TileScratch& scratch) {
        return trace_bleed_batch(context, targets[size_t(i)], compiled_.origin(), batch, scratch);
    });
}

} // namespace blush
