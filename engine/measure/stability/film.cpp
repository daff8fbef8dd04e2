// Stability cases of the film: a million samples without drift, radiance from 1e-30 to 1e30, black scenes, and correctness of the
// error estimate that all other cases use.
#include "render/film/film.h"
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace blush::stability {
namespace {

Scene room(float nits) {
    Scene scene;
    place(scene, cube(true), emitter(nits, 0.5f));
    scene.view = looking({0.1f, -0.2f, 0.3f}, {0.9f, 0.35f, -0.8f}, 1.2f);
    return scene;
}

Findings radiance(float nits) { return whole(render(room(nits), settings_for(16, 16, 64)), 2 * double(nits)); }

Findings constant_for(int64_t spp) {
    Scene scene;
    constant_world(scene, 0.1f);
    return every_pixel(render(scene, settings_for(1, 1, spp)), double(0.1f));
}

// The film only: one sample of 2^24, then ones. A single precision sum would not change after the first.
Findings film_fed(int64_t samples) {
    const auto tile = std::make_unique<TileScratch>();
    Film film;
    film.reset({1, 1});
    for (int64_t first = 0; first < samples; first += tile_capacity) {
        const int count = int(std::min<int64_t>(tile_capacity, samples - first));
        for (double* column : {tile->r.data, tile->g.data, tile->b.data}) {
            std::fill_n(column, count, 1.0);
            if (first == 0) column[0] = 0x1p24;
        }
        film.add({0, 0, 1, 1, first, count}, *tile, 0);
    }
    Frame frame;
    film.resolve(frame, Workers(1));
    return {{(0x1p24 + double(samples - 1)) / double(samples), double(frame.rgba[0]), 0, 0, {}}};
}

Findings in_the_dark() {
    Scene scene = room(0);
    place(scene, sphere(false), metal(0.2f), at({0, 0, 0}, 0.3f));
    Light off;
    off.enabled = false;
    off.intensity = 1e6f;
    place_light(scene, off, at({0.5f, 0.5f, 0.5f}));
    return every_pixel(render(scene, settings_for(16, 16, 8)), 0);
}

Findings late_samples(int64_t first) {
    RenderSettings settings = settings_for(16, 16, first + 64);
    settings.first_sample = first;
    return whole(render(room(1), settings), 2);
}

// The same samples on two threads, rendered in pieces.
Findings threads_and_pieces() {
    const RenderSettings settings = settings_for(64, 64, 12);
    const RenderedImage one = render(room(1), settings);
    Renderer renderer({.threads = 2, .planes = {}});
    renderer.update(room(1), settings);
    for (const auto& [first, count] : {std::pair{0, 1}, {1, 5}, {6, 6}}) renderer.render(first, count);
    const Frame other = renderer.resolve();
    int differ = 0;
    for (size_t i = 0; i < one.frame.rgba.size(); ++i) differ += one.frame.rgba[i] != other.rgba[i];
    return {count_of(differ, "values that differ")};
}

// Over many seeds the variance of the means equals the mean squared standard error: the ratio is 1, with variance 2 / (n - 1) for
// n independent means.
Findings honest_error(int seeds) {
    double sum = 0, squares = 0, stated = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderSettings settings = settings_for(8, 8, 8);
        settings.seed = uint32_t(seed);
        const Measured m = render(room(1), settings).whole();
        sum += m.mean.x;
        squares += m.mean.x * m.mean.x;
        stated += m.error.x * m.error.x;
    }
    const double n = seeds, variance = (squares - sum * sum / n) / (n - 1);
    return {{1, variance / (stated / n), std::sqrt(2 / (n - 1)), 0, {}}};
}

} // namespace

std::vector<StabilityCase> film_cases() {
    std::vector<StabilityCase> cases;
    for (const float nits : {1e-30f, 1e-12f, 1e12f, 1e30f})
        cases.push_back({fmt::format("closed room of {:g} nits", nits), output_range, [nits] { return radiance(nits); }});
    cases.push_back({"1048576 samples of one pixel", accumulation, [] { return constant_for(1 << 20); }});
    cases.push_back({"film fed with one bright sample and 1e6 others", accumulation, [] { return film_fed(1000000); }});
    cases.push_back({"all lights off", output_range, in_the_dark});
    cases.push_back({"samples from 2^31 on", random_numbers, [] { return late_samples(int64_t(1) << 31); }});
    cases.push_back({"two threads, in pieces, bit for bit", determinism, threads_and_pieces});
    cases.push_back({"standard errors against the scatter of 1024 seeds", random_numbers, [] { return honest_error(1024); }});
    return cases;
}

} // namespace blush::stability
