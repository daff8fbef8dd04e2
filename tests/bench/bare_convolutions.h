// What the denoiser cannot be faster than: its convolutions and nothing else, as oneDNN likes them best; and what it could be at most.
#pragma once

#include "render/denoise/unet_plan.h"

#include <memory>

namespace blush::bench {

// All convolutions of a network, each of the whole image at once in the layouts of oneDNN's choice, on zeros.
class BareConvolutions {
public:
    BareConvolutions(const denoise::UnetChannels& channels, int width, int height, denoise::Element element, unsigned threads);
    ~BareConvolutions();

    void run() const;
    double operations() const; // a multiplication and an addition are two

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Operations per second of one core in a large product of matrices: the fastest of a few.
double peak_rate(denoise::Element element);

} // namespace blush::bench
