// One 3x3 convolution with bias and ReLU over a band of rows; the only file that uses oneDNN.
#pragma once

#include "core/result.h"
#include "render/denoise/unet_plan.h"
#include "render/denoise/unet_weights.h"

#include <cstddef>
#include <memory>

namespace blush::denoise {

// True if the processor has bfloat16 arithmetic, not only conversions.
bool has_bfloat16();

// oneDNN would spread each convolution over OpenMP threads. Our workers compute one band each, at their own priority next to the
// renderer; so code that creates or runs convolutions holds one of these, which limits OpenMP to this thread.
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
    // Packs the weights for this shape. Errors: oneDNN does not support the convolution, or out of memory.
    static Result<Convolution> make(const ConvolutionWeights& weights, const BandShape& shape);
    Convolution(Convolution&&) noexcept;
    Convolution& operator=(Convolution&&) noexcept;
    ~Convolution();

    // source: rows + 2 rows of inputs, starting above the first output row; target: rows of outputs. Both without gaps; the zero
    // padding at the left and right is implicit. scratch: scratch_bytes(), exclusive to this call. Thread-safe.
    void run(const void* source, void* target, std::byte* scratch) const;
    size_t scratch_bytes() const;

private:
    struct State;
    explicit Convolution(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace blush::denoise
