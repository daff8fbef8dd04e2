#include "tests/render/denoise/agreement.h"

#include "io/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace blush::test {
namespace {

std::vector<float> interleaved(const LayeredImage& image, const std::string& prefix, const char* components) {
    std::vector<float> values(size_t(image.width) * image.height * 3);
    for (int c = 0; c < 3; c++) {
        const auto* channel = image.find(prefix + components[c]);
        if (!channel) return {};
        for (size_t i = 0; i < channel->values.size(); i++) values[3 * i + c] = channel->values[i];
    }
    return values;
}

} // namespace

Planes golden(const std::string& name) {
    const auto image = read_layers(std::string(BLUSH_GOLDEN) + "/" + name + ".exr");
    if (!image) throw std::runtime_error(image.error().text());
    return {image->width, image->height, interleaved(*image, "", "RGB"), interleaved(*image, "albedo.", "RGB"),
            interleaved(*image, "normal.", "XYZ")};
}

Planes noisy_planes(int width, int height, uint32_t seed) {
    Planes planes = constant_planes(width, height, 0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                const size_t i = (size_t(y) * width + x) * 3 + c;
                const float smooth = 0.5f + 0.4f * std::sin(0.05f * float(x + c * 7)) * std::cos(0.07f * float(y));
                planes.color[i] = smooth * -2 * std::log(1 - 0.999f * uniform(random));
                planes.albedo[i] = smooth * (0.9f + 0.1f * uniform(random));
                planes.normal[i] = c == 1 ? std::sqrt(0.5f) : std::sqrt(0.25f) * (x / 40 % 2 ? 1.f : -1.f);
            }
    return planes;
}

Planes constant_planes(int width, int height, float value) {
    const size_t count = size_t(width) * height * 3;
    Planes planes{width, height, std::vector<float>(count, value), std::vector<float>(count, 0.5f), std::vector<float>(count, 0.f)};
    for (size_t i = 1; i < count; i += 3) planes.normal[i] = 1;
    return planes;
}

Difference relative_difference(std::span<const float> a, std::span<const float> b, float floor) {
    EXPECT_EQ(a.size(), b.size());
    Difference d;
    size_t count = 0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); i++) {
        if (!(std::abs(b[i]) > floor)) continue;
        const double relative = std::abs(double(a[i]) - b[i]) / std::abs(double(b[i]));
        d.largest = std::max(d.largest, std::isfinite(relative) ? relative : INFINITY);
        d.mean += relative;
        count++;
    }
    d.mean /= double(std::max<size_t>(1, count));
    return d;
}

Denoised denoised(Denoiser& denoiser, const Planes& planes, const DenoiseOptions& options) {
    auto made = denoiser.denoise(planes.input(), options);
    if (!made) {
        ADD_FAILURE() << made.error().text();
        return {};
    }
    EXPECT_TRUE(made->has_value()) << "stopped without being cancelled";
    return *made ? std::move(**made) : Denoised{};
}

Denoised denoised(const Planes& planes, const DenoiseOptions& options, unsigned threads) {
    Denoiser denoiser(BLUSH_WEIGHTS, threads);
    return denoised(denoiser, planes, options);
}

bool has_bfloat16() {
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx512bf16");
}

} // namespace blush::test
