#include "render/roulette/adjoint_choice.h"

#include <fmt/format.h>

namespace blush {
namespace {

// Why there is nothing to learn; null if there may be.
const char* why_useless(const RenderSettings& settings) {
    if (!settings.roulette.learns()) return "the rule of Russian roulette reads the throughput alone";
    if (settings.max_bounces != unlimited_bounces && settings.max_bounces < settings.roulette.start)
        return "paths end before roulette begins";
    return nullptr;
}

} // namespace

AdjointChoice::AdjointChoice(const RenderSettings& settings)
    : useless_(why_useless(settings)), width_(settings.width), height_(settings.height) {}

SceneTables AdjointChoice::tables(const SceneTables& scene, int64_t sample) const {
    SceneTables tables = scene;
    if (sample > 0 && pays()) tables.roulette_start = learned_->start;
    if (sample >= first_sample && pays()) tables.adjoint = learned_->field.tables(width_, height_);
    // Manifold sampling and light paths pair one vertex of a sample with another.
    if (!scene.manifolds.empty() || !scene.emission.empty()) tables.adjoint.splits = nullptr;
    return tables;
}

FeatureUse AdjointChoice::report() const {
    FeatureUse use{.part = "kernel", .name = "learned roulette", .used = pays(), .why = {}};
    if (useless_)
        use.why = useless_;
    else if (!learned_)
        use.why = "a pilot learns it after the fourth sample";
    else if (learned_->figures)
        use.why = fmt::format("pilot: variance x work of the {} rule is {:.2f} of that of the square root",
                              learned_->best == Roulette::Rule::adjoint ? "adjoint" : "efficiency", learned_->figures->cost());
    else if (learned_->best == Roulette::Rule::sqrt)
        use.why = learned_->why_not;
    else if (learned_->field.empty())
        use.why = "pilot: no light was found";
    else
        use.why = fmt::format("pilot: the variance of a sample is {:.3g} times the square of its pixel, for {:.3g} rays",
                              learned_->field.relative_variance(), learned_->field.rays_per_sample());
    if (learned_ && !learned_->field.empty()) use.bytes = learned_->field.memory_bytes();
    if (learned_) use.pilot = learned_->figures;
    return use;
}

} // namespace blush
