#include "render/diagnostics/fault_finder.h"

#include "render/diagnostics/replay.h"

#include <cmath>
#include <optional>

namespace blush {
namespace {

using Kind = Fault::Kind;
using Place = Fault::Place;

std::optional<Kind> fault_of(float x) {
    if (std::isnan(x)) return Kind::nan;
    if (std::isinf(x)) return Kind::infinite;
    return std::nullopt;
}
// Checks a position or direction: any sign is valid.
std::optional<Kind> fault_of_vector(const Vec3& v) {
    for (const float x : {v.x, v.y, v.z})
        if (const auto kind = fault_of(x)) return kind;
    return std::nullopt;
}
// Checks a radiance, throughput or weight.
std::optional<Kind> fault_of_light(const Vec3& v) {
    if (const auto kind = fault_of_vector(v)) return kind;
    return v.x < 0 || v.y < 0 || v.z < 0 ? std::optional(Kind::negative) : std::nullopt;
}
std::optional<Kind> fault_of_pdf(float pdf) {
    if (std::isnan(pdf)) return Kind::nan;
    if (std::isinf(pdf)) return Kind::overflowing_pdf;
    if (pdf < 0) return Kind::negative;
    return pdf == 0 ? std::optional(Kind::zero_pdf) : std::nullopt;
}

// Keeps the first reported fault.
struct Blame {
    int vertex = 0;
    std::optional<Fault> first = {};

    void operator()(std::optional<Kind> kind, Place place) {
        if (kind && !first) first = Fault{*kind, place, vertex};
    }
};

void check_ray(const ReplayedVertex& v, Blame& blame) {
    const Place place = v.bounce == 0 ? Place::camera : Place::bsdf_sample;
    blame(fault_of_vector(v.path.ray.origin), place);
    blame(fault_of_vector(v.path.ray.direction), place);
}

void check_surface(const ReplayedVertex& v, const SceneTables& scene, Blame& blame) {
    const Surface<float> s = surface_at<all_features, float>(scene, v.hit, true);
    blame(fault_of(v.hit.t), Place::geometry);
    for (const Vec3& vector : {s.position, s.ng, s.ns}) blame(fault_of_vector(vector), Place::geometry);
}

void check_emission_hit(const ReplayedVertex& v, bool escaped, Blame& blame) {
    if (!escaped) blame(fault_of_light(v.step.weights.arriving), Place::absorption);
    if (v.step.emits) blame(fault_of_light(v.step.emitted), escaped ? Place::environment : Place::emission);
}

void check_light_sample(const ReplayedVertex& v, Blame& blame) {
    const auto kind = fault_of_light(v.arrived);
    if (!kind) return;
    const StepWeights<float>& w = v.step.weights;
    blame(fault_of_pdf(w.light_pdf), Place::light_sample);
    // 0: a direction that the BSDF does not sample
    if (w.light_bsdf_pdf != 0) blame(fault_of_pdf(w.light_bsdf_pdf), Place::bsdf_eval);
    blame(kind, Place::light_sample);
}

void check_scattering(const ReplayedVertex& v, Blame& blame) {
    if (!v.step.non_finite) return;
    const auto kind = fault_of_light(v.step.next.beta);
    // Survivors are divided by their probability: check whether that division overflowed.
    const float q = v.step.weights.survival;
    if (q < 1 && !fault_of_light(v.step.next.beta * q)) blame(kind, Place::roulette);
    // The pdf of a delta lobe is infinite by definition.
    if (!std::isinf(v.step.next.pdf)) blame(fault_of_pdf(v.step.next.pdf), Place::bsdf_sample);
    blame(kind, Place::bsdf_sample);
}

} // namespace

std::optional<Fault> fault_at(const ReplayedVertex& vertex, const SceneTables& scene) {
    const bool escaped = vertex.hit.geometry < 0;
    Blame blame{vertex.bounce};
    check_ray(vertex, blame);
    if (!escaped && vertex.hit.instance != sphere_instance) check_surface(vertex, scene, blame);
    check_emission_hit(vertex, escaped, blame);
    check_light_sample(vertex, blame);
    check_scattering(vertex, blame);
    return blame.first;
}

Fault find_fault(const KernelContext& context, int x, int y, int64_t sample, TileScratch& scratch) {
    std::optional<Fault> fault;
    int last = 0;
    const Vec3 radiance = replay_sample(context, x, y, sample, max_path_length + 1, scratch, [&](const ReplayedVertex& vertex) {
        last = vertex.bounce;
        fault = fault_at(vertex, *context.scene);
        return !fault;
    });
    return fault ? *fault : Fault{fault_of_light(radiance).value_or(Kind::infinite), Place::sum, last};
}

} // namespace blush
