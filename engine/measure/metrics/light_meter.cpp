#include "measure/metrics/light_meter.h"

#include "core/math.h"

#include <array>

namespace blush {

struct LightMeters::State {
    explicit State(const RendererOptions& options) : renderer(options) {}
    Renderer renderer;
    bool gives_light = false; // the scene has light
    std::vector<MeterPlace> places;
    std::vector<std::vector<double>> lux; // by place, one value per round
    std::vector<MeterReading> readings;
};

LightMeters::LightMeters(const RendererOptions& options) : state_(std::make_unique<State>(options)) {}
LightMeters::~LightMeters() = default;

void LightMeters::begin(const Scene& scene, const RenderSettings& settings, std::span<const MeterPlace> places) {
    RenderSettings alone = settings;
    alone.width = alone.height = 1; // no image is needed
    alone.region = {};
    state_->renderer.update(scene, alone);
    state_->gives_light = state_->renderer.has_light();
    state_->places.assign(places.begin(), places.end());
    state_->lux.assign(places.size(), {});
    state_->readings.assign(places.size(), {});
}

bool LightMeters::round(int samples, const std::function<bool()>& wanted) {
    State& s = *state_;
    std::vector<Vec3d> irradiance;
    for (size_t i = 0; i < s.places.size(); ++i) {
        if (wanted && !wanted()) return false;
        irradiance.push_back(s.renderer.irradiance(s.places[i], uint32_t(s.lux[i].size()), samples));
    }
    for (size_t i = 0; i < s.places.size(); ++i) {
        MeterReading& r = s.readings[i];
        s.lux[i].push_back(luminance(irradiance[i]));
        r.rgb = (r.rgb * double(r.rounds) + irradiance[i]) / double(r.rounds + 1);
        ++r.rounds;
        r.lux = mean_interval(s.lux[i]);
        // All estimates are 0 although the scene has light: the value is unknown.
        if (r.lux.value == 0 && s.gives_light) r.lux.known = false;
    }
    return true;
}

const std::vector<MeterReading>& LightMeters::readings() const { return state_->readings; }

} // namespace blush
