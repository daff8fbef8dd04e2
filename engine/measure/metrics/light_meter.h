// Light meters: illuminance at points on surfaces, measured in rounds besides the render, with 95 % confidence intervals.
#pragma once

#include "measure/statistics/intervals.h"
#include "render/renderer.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace blush {

struct MeterReading {
    int64_t rounds = 0; // independent estimates so far
    Interval lux;       // illuminance (luminance of the irradiance) with Student's interval over the rounds; unknown while all
                        // estimates are 0 in a scene that has light
    Vec3d rgb{0, 0, 0}; // irradiance, linear Rec.709
};

// Holds its own compiled scene, so that it can run in parallel with other renders.
class LightMeters {
public:
    explicit LightMeters(const RendererOptions& options);
    ~LightMeters();

    // Restarts the measurement. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, std::span<const MeterPlace> places);
    // Adds an estimate of `samples` paths at each place. False if `wanted` returned false: the round is then discarded.
    bool round(int samples, const std::function<bool()>& wanted = {});
    // Readings in the order of the places.
    const std::vector<MeterReading>& readings() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
