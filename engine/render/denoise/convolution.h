// One 3x3 convolution with bias and ReLU over a band of rows: the only file that knows oneDNN.
#pragma once

#include "core/result.h"
#include "render/denoise/unet_plan.h"
#include "render/denoise/unet_weights.h"

#include <cstddef>
#include <memory>

namespace blush::denoise {

// Does this processor compute with bfloat16, and not only convert?
bool has_bfloat16();

// oneDNN would spread each convolution over OpenMP's threads. Ours compute a band each, under our own priorities and beside the
// renderer; so whoever makes or runs convolutions holds one of these, which leaves OpenMP this thread alone.
class OneThread {
public:
    OneThread();
    ~OneThread();
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

private:
    int threads_before_;
};

struct BandShape {
    int width = 0, rows = 0; // of the output
    Element source = Element::float32, target = Element::float32;
};

class Convolution {
public:
    // Packs the weights for this shape. Errors: oneDNN has no such convolution, or no memory for it.
    static Result<Convolution> make(const ConvolutionWeights& weights, const BandShape& shape);
    Convolution(Convolution&&) noexcept;
    Convolution& operator=(Convolution&&) noexcept;
    ~Convolution();

    // source: rows + 2 rows of inputs, the first of them above the first output row; target: rows of outputs. Both without gaps,
    // zero padding only at the left and at the right. scratch: scratch_bytes(), for this call alone. Thread-safe.
    void run(const void* source, void* target, std::byte* scratch) const;
    size_t scratch_bytes() const;

private:
    struct State;
    explicit Convolution(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace blush::denoise
