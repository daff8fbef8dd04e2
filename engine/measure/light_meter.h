// Light meters: illuminance at places, measured in rounds beside the renderer, each reading with its 95 % interval.
#pragma once

#include "measure/intervals.h"
#include "render/renderer.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace blush {

struct MeterReading {
    int64_t rounds = 0; // independent estimates so far
    Interval lux;       // illuminance: the luminance of the irradiance; its interval is Student's, of the rounds; not known while a scene that
                        // gives light has shown none here
    Vec3d rgb{0, 0, 0}; // irradiance, linear Rec.709
};

// A scene of its own, so that it can run beside others.
class LightMeters {
public:
    explicit LightMeters(const RendererOptions& options);
    ~LightMeters();

    // Starts anew. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, std::span<const MeterPlace> places);
    // One more estimate at each place, `samples` paths each. False if `wanted` said so and the round was given up; it counts for nothing.
    bool round(int samples, const std::function<bool()>& wanted = {});
    // In the order of the places.
    const std::vector<MeterReading>& readings() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
