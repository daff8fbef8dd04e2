// Pilot of the adjoint: renders the image at a low resolution, records what its paths find, and measures what that is worth.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"
#include "render/roulette/adjoint_field.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct AdjointPilot {
    Roulette::Rule best = Roulette::Rule::sqrt; // the rule itself; of `automatic` the best learned one, sqrt if none was learned
    AdjointField field = {};                    // of that rule; empty if it does not pay
    std::string why_not = {};                   // of `automatic`: why nothing was learned
    int start = 0;                              // of `automatic`: bounce before which no path ends
    std::optional<PilotFigures> figures = {};   // of `automatic`: with the best learned rule over sqrt
    bool operator==(const AdjointPilot&) const = default;
};

// What `automatic` does where manifold sampling is used. Most of the noise is in paths that meet caustics of later surfaces there, with the
// weights of those that roulette has ended: a later start saves more noise than it costs. No learning: a pilot is too short to tell what
// a rule does to such rare light.
AdjointPilot roulette_with_manifolds();

// `context` as for the film at full resolution, except its seed and groups, with what other pilots have learned. `group_size`: of path
// reuse, with which rules are compared. The seed differs from that of the image, so the result does not depend on the image's samples. It
// is the same for any number of threads and any instruction set. `scratch`: one per worker, allocated if needed. Empty if `wanted` returned
// false.
std::optional<AdjointPilot> learn_adjoint(const KernelContext& context, int group_size, const Kernel& kernel, const Workers& workers,
                                          std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
