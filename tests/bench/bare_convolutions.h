// Lower bounds for the denoiser's time: its bare convolutions in oneDNN's preferred layout, and the peak arithmetic rate.
#pragma once

#include "render/denoise/unet_plan.h"

#include <memory>

namespace blush::bench {

// All convolutions of a network, each of the whole image at once in the layouts chosen by oneDNN, on zeros.
class BareConvolutions {
public:
    BareConvolutions(const denoise::UnetChannels& channels, int width, int height, denoise::Element element, unsigned threads);
    ~BareConvolutions();

    void run() const;
    double operations() const; // a multiplication and an addition count as two

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Operations per second of one core in a large matrix product: the fastest of a few runs.
double peak_rate(denoise::Element element);

} // namespace blush::bench
