#include "measure/convergence/reference.h"

#include <algorithm>
#include <chrono>

namespace blush {
namespace {

constexpr int64_t batch = 8; // samples between checks of time and cancellation; even, so that both half buffers have as many

} // namespace

MeasuredImage measured_image(Renderer& renderer) {
    const Frame frame = renderer.resolve();
    MeasuredImage m;
    m.image = {frame.width, frame.height, {}};
    m.image.pixels.reserve(frame.rgba.size() / 4);
    for (size_t i = 0; i < frame.rgba.size(); i += 4) m.image.pixels.push_back({frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]});
    m.error = renderer.resolve_error();
    m.samples = frame.samples;
    m.variance_factor = renderer.reuse_covariance().means;
    return m;
}

RenderSettings reference_settings(const RenderSettings& settings) {
    // Copies the settings that change the expected value; others keep their unbiased defaults.
    RenderSettings r;
    r.width = settings.width;
    r.height = settings.height;
    r.resolution_scale = settings.resolution_scale;
    r.max_bounces = settings.max_bounces;
    r.filter = settings.filter;
    r.energy_compensation = settings.energy_compensation;
    r.spp = 0;
    return r;
}

uint32_t reference_seed(std::span<const uint32_t> compared) {
    uint32_t seed = 0xb1005eed;
    while (std::find(compared.begin(), compared.end(), seed) != compared.end()) ++seed;
    return seed;
}

void extend_reference(Reference& reference, Renderer& renderer, const Scene& scene, const RenderSettings& settings,
                      const ReferenceBudget& budget, const std::function<bool()>& wanted, const std::function<void(double)>& progress) {
    const int64_t begin = reference.first_sample + reference.measured.samples;
    const auto fraction = [&](int64_t done, double seconds) {
        double f = 0;
        if (budget.samples > 0) f = std::max(f, double(reference.measured.samples + done) / double(budget.samples));
        if (budget.seconds > 0) f = std::max(f, (reference.seconds + seconds) / budget.seconds);
        return f;
    };
    if (fraction(0, 0) >= 1) return;
    RenderSettings r = reference_settings(settings);
    r.seed = reference.seed;
    renderer.update(scene, r);
    renderer.clear();
    const auto started = std::chrono::steady_clock::now();
    int64_t done = 0;
    double seconds = 0;
    while (fraction(done, seconds) < 1 && wanted()) {
        renderer.render(begin + done, batch);
        done += batch;
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
        progress(std::min(1.0, fraction(done, seconds)));
    }
    if (done == 0) return;
    reference.measured = merged(reference.measured, measured_image(renderer));
    reference.seconds += seconds;
}

double mean_square_error(const MeasuredImage& image) {
    double sum = 0;
    for (const Vec3& e : image.error) sum += double(e.x) * double(e.x) + double(e.y) * double(e.y) + double(e.z) * double(e.z);
    return image.error.empty() ? 0 : sum / (3 * double(image.error.size()));
}

bool clearly_better(double reference_mse, double image_mse) { return reference_mse <= 0.1 * image_mse; }

} // namespace blush
