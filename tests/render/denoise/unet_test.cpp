// Convolutions and whole networks compared with a plain implementation in double precision.
#include "render/denoise/unet.h"

#include "render/denoise/band_ops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace denoise;

constexpr double epsilon = std::numeric_limits<float>::epsilon();

struct Image {
    int width, height, channels;
    std::vector<double> values;

    Image(int w, int h, int c) : width(w), height(h), channels(c), values(size_t(w) * h * c) {}
    double& at(int x, int y, int c) { return values[(size_t(y) * width + x) * channels + c]; }
    double at(int x, int y, int c) const { return values[(size_t(y) * width + x) * channels + c]; }
    // Zero outside.
    double padded(int x, int y, int c) const { return x < 0 || y < 0 || x >= width || y >= height ? 0 : at(x, y, c); }
};

// `magnitude`: the same with absolute values, before the ReLU: the reference for rounding errors.
struct Convolved {
    Image result, magnitude;
};

Convolved convolve(const Image& image, const ConvolutionWeights& weights) {
    Convolved made{{image.width, image.height, weights.outputs}, {image.width, image.height, weights.outputs}};
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++)
            for (int o = 0; o < weights.outputs; o++) {
                double sum = weights.bias[o], magnitude = std::abs(sum);
                for (int i = 0; i < weights.inputs; i++)
                    for (int v = 0; v < 3; v++)
                        for (int u = 0; u < 3; u++) {
                            const double term =
                                weights.kernel[((size_t(o) * weights.inputs + i) * 3 + v) * 3 + u] * image.padded(x + u - 1, y + v - 1, i);
                            sum += term;
                            magnitude += std::abs(term);
                        }
                made.result.at(x, y, o) = std::max(0.0, sum);
                made.magnitude.at(x, y, o) = magnitude;
            }
    return made;
}

Image pooled(const Image& image) {
    Image made(image.width / 2, image.height / 2, image.channels);
    for (int y = 0; y < made.height; y++)
        for (int x = 0; x < made.width; x++)
            for (int c = 0; c < made.channels; c++)
                made.at(x, y, c) = std::max({image.at(2 * x, 2 * y, c), image.at(2 * x + 1, 2 * y, c), image.at(2 * x, 2 * y + 1, c),
                                             image.at(2 * x + 1, 2 * y + 1, c)});
    return made;
}

Image upsampled_and_concatenated(const Image& half, const Image& skip) {
    Image made(skip.width, skip.height, half.channels + skip.channels);
    for (int y = 0; y < made.height; y++)
        for (int x = 0; x < made.width; x++)
            for (int c = 0; c < made.channels; c++)
                made.at(x, y, c) = c < half.channels ? half.at(x / 2, y / 2, c) : skip.at(x, y, c - half.channels);
    return made;
}

Image network(const Image& input, const UnetWeights& weights) {
    std::vector<Image> planes{input};
    for (int i = 0; i < unet_layer_count; i++) {
        const UnetLayer& layer = unet_layers[i];
        const Image source = layer.skip < 0 ? planes[i] : upsampled_and_concatenated(planes[i], planes[layer.skip]);
        const Image made = convolve(source, weights.layers[i]).result;
        planes.push_back(layer.pool ? pooled(made) : made);
    }
    return planes.back();
}

// Rounded to the network's element type.
float rounded_to(Element element, float x) { return element == Element::float32 ? x : denoise::to_float(to_bfloat16(x)); }

class Random {
public:
    explicit Random(uint32_t seed) : random_(seed) {}
    float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    ConvolutionWeights weights(int inputs, int outputs, float low, float high, Element element) {
        ConvolutionWeights made{inputs, outputs, std::vector<float>(size_t(inputs) * outputs * 9), std::vector<float>(outputs)};
        for (float& w : made.kernel) w = rounded_to(element, (*this)(low, high));
        for (float& b : made.bias) b = (*this)(low, high);
        return made;
    }
    Image image(int width, int height, int channels, Element element) {
        Image made(width, height, channels);
        for (double& x : made.values) x = rounded_to(element, (*this)(0, 1));
        return made;
    }

private:
    std::mt19937 random_;
};

std::vector<Element> elements() {
    if (denoise::has_bfloat16()) return {Element::float32, Element::bfloat16};
    return {Element::float32};
}

// The image with one row of padding above and below, in bytes of the element type.
template <class T> std::vector<T> rows_of(const Image& image) {
    std::vector<float> values(size_t(image.width) * image.channels * (image.height + 2));
    std::ranges::copy(image.values, values.begin() + long(image.width) * image.channels);
    std::vector<T> made(values.size());
    for (size_t i = 0; i < values.size(); i++)
        if constexpr (std::is_same_v<T, float>)
            made[i] = values[i];
        else
            made[i] = to_bfloat16(values[i]);
    return made;
}

struct Shape {
    int inputs, outputs, width, rows;
};

template <class T> void check_convolution(const Shape& s, Element element) {
    Random random{uint32_t(s.inputs * 100 + s.outputs)};
    const ConvolutionWeights weights = random.weights(s.inputs, s.outputs, -1, 1, element);
    const Image image = random.image(s.width, s.rows, s.inputs, element);
    const Convolved expected = convolve(image, weights);

    const auto convolution = Convolution::make(weights, {s.width, s.rows, element, Element::float32});
    ASSERT_TRUE(convolution) << convolution.error().text();
    const std::vector<T> source = rows_of<T>(image);
    std::vector<float> made(expected.result.values.size());
    std::vector<std::byte> scratch(convolution->scratch_bytes());
    convolution->run(source.data(), made.data(), scratch.data());
    // Each addition and multiplication of a sum rounds once.
    const double roundings = 9 * s.inputs + 1;
    for (size_t i = 0; i < made.size(); i++)
        ASSERT_NEAR(made[i], expected.result.values[i], roundings * epsilon * expected.magnitude.values[i]) << i;
}

TEST(Convolution, MatchesThePlainSum) {
    for (const Element element : elements())
        for (const Shape& s :
             {Shape{9, 32, 16, 8}, {3, 32, 48, 3}, {41, 32, 17, 8}, {73, 64, 33, 2}, {32, 3, 16, 8}, {160, 112, 2, 1}, {1, 1, 1, 1}})
            element == Element::float32 ? check_convolution<float>(s, element) : check_convolution<Bfloat16>(s, element);
}

// Positive weights and inputs, so that nothing cancels and relative errors only add up. Channel counts that fill no vector.
UnetWeights positive_network(int inputs, Random& random) {
    const UnetChannels outputs{inputs, 5, 7, 6, 9, 8, 10, 11, 12, 9, 7, 8, 6, 5, 7, 9, 3};
    UnetWeights weights;
    for (int i = 0; i < unet_layer_count; i++) {
        const int layer_inputs = outputs[i] + (unet_layers[i].skip >= 0 ? outputs[unet_layers[i].skip] : 0);
        weights.layers[i] = random.weights(layer_inputs, outputs[i + 1], 0, 2.f / float(9 * layer_inputs), Element::float32);
    }
    return weights;
}

TEST(Unet, MatchesTheNetworkOfPlainSums) {
    for (const auto& [width, height] : {std::pair{16, 16}, {48, 80}, {32, 208}}) {
        Random random{uint32_t(height)};
        const UnetWeights weights = positive_network(4, random);
        const Image input = random.image(width, height, 4, Element::float32);
        const Image expected = network(input, weights);

        const auto unet = make_unet(weights, width, height, Element::float32);
        ASSERT_TRUE(unet) << unet.error().text();
        const Workers workers(3);
        // NaN: nothing may be read before it is written
        std::vector<std::byte> memory(unet->bytes(workers) + 64, std::byte(0xff));
        auto* aligned = reinterpret_cast<std::byte*>((reinterpret_cast<uintptr_t>(memory.data()) + 63) / 64 * 64);
        std::vector<float> made(expected.values.size());
        const auto source = [&](int y, float* row) { std::copy_n(&input.values[size_t(y) * width * 4], width * 4, row); };
        const auto sink = [&](int y, const float* row) { std::copy_n(row, width * 3, &made[size_t(y) * width * 3]); };
        EXPECT_TRUE(run_unet(*unet, workers, {}, aligned, source, sink));

        double roundings = 0;
        for (const ConvolutionWeights& layer : weights.layers) roundings += 9 * layer.inputs + 1;
        for (size_t i = 0; i < made.size(); i++) ASSERT_NEAR(made[i], expected.values[i], roundings * epsilon * expected.values[i]) << i;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
