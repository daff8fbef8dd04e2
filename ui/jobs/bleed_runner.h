// Runs the bleed probe and its map on threads of their own, while their panel is open.
#pragma once

#include "measure/metrics/bleed_map.h"
#include "measure/metrics/bleed_probe.h"
#include "ui/jobs/image_input.h"
#include "ui/jobs/round_runner.h"

#include <optional>

namespace blush {

// Who lights a place.
class BleedWork {
public:
    struct Input : ImageInput {
        Input(const Scene& scene, const RenderSettings& settings, const BleedTarget& target);

        BleedTarget target;
        bool has_same_result(const Input& other) const;
    };
    using Output = std::optional<BleedReport>;

    void begin(const Input& q) { probe_.begin(q.scene, q.settings, std::span(&q.target, 1)); }
    bool round(const std::function<bool()>& wanted) { return probe_.round(wanted); }
    Output output() const { return probe_.report(0); }
    static bool is_good(const Output& report);

private:
    BleedProbe probe_{0, true};
};
using BleedRunner = RoundRunner<BleedWork>;

// The greatest sender of each part of the image.
class BleedMapWork {
public:
    using Input = ImageInput;
    using Output = BleedGrid;

    static constexpr int cell = 16; // pixels

    void begin(const Input& q) { map_.begin(q.scene, q.settings, cell); }
    bool round(const std::function<bool()>& wanted) { return map_.round(wanted); }
    Output output() const { return map_.grid(); }
    static bool is_good(const Output& grid) { return grid.passes >= 4; }

private:
    BleedMap map_{0, true};
};
using BleedMapRunner = RoundRunner<BleedMapWork>;

} // namespace blush
