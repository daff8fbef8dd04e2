#include "render/denoise/unet.h"

#include "render/denoise/band_ops.h"

#include <algorithm>

namespace blush::denoise {
namespace {

// For a layer with split input: duplicates the weights of the split channels, which start at `first`.
ConvolutionWeights duplicate_split_weights(const ConvolutionWeights& weights, int first) {
    ConvolutionWeights made{weights.inputs + split_channels, weights.outputs, {}, weights.bias};
    for (int o = 0; o < weights.outputs; o++) {
        const float* kernels = &weights.kernel[size_t(o) * weights.inputs * 9];
        made.kernel.insert(made.kernel.end(), kernels, kernels + weights.inputs * 9);
        made.kernel.insert(made.kernel.end(), kernels + first * 9, kernels + (first + split_channels) * 9);
    }
    return made;
}

// The weights of layer `layer`, adapted to the plane layout of `element`.
ConvolutionWeights layer_weights(const UnetWeights& weights, int layer, Element element) {
    const bool reads_input = layer == 0 || unet_layers[layer].skip == 0;
    if (!reads_input || extra_inputs(element) == 0) return weights.layers[layer];
    return duplicate_split_weights(weights.layers[layer], layer == 0 ? 0 : weights.layers[layer - 1].outputs);
}

int bands_of(int rows) { return (rows + band_rows - 1) / band_rows; }

// One inference of the network.
template <class T> class Pass {
public:
    Pass(const Unet& unet, const Workers& workers, const std::function<bool()>& wanted, std::byte* memory)
        : unet_(unet), workers_(workers), wanted_(wanted), memory_(memory) {}

    bool read(const UnetSource& source) const {
        const UnetPlane& input = unet_.plan.planes[0];
        clear_borders(0);
        return workers_.for_each(bands_of(input.height), wanted_, [&](int64_t band, unsigned worker) {
            float* row = reinterpret_cast<float*>(own(worker).source);
            for (int y = int(band) * band_rows; y < std::min(input.height, int(band + 1) * band_rows); y++) {
                source(y, row);
                read_row(row, row_of(0, y), input);
            }
        });
    }

    bool compute(int layer, const UnetSink& sink) const {
        const UnetPlane& made = unet_.plan.planes[layer + 1];
        const int height = unet_layers[layer].pool ? made.height * 2 : made.height;
        const bool last = layer + 1 == unet_layer_count;
        if (!last) clear_borders(layer + 1);
        return workers_.for_each(bands_of(height), wanted_, [&](int64_t band, unsigned worker) {
            const int y = int(band) * band_rows, rows = std::min(band_rows, height - y);
            const OneThread one_thread;
            const Own own = this->own(worker);
            const void* source = unet_layers[layer].skip < 0 ? bytes_at(layer, y - 1) : join(layer, y, rows, own.source);
            std::byte* target = unet_layers[layer].pool || last ? own.target : bytes_at(layer + 1, y);
            const Unet::Layer& code = unet_.layers[layer];
            (rows == std::min(band_rows, height) ? code.band : *code.last_band).run(source, target, own.scratch);
            if (unet_layers[layer].pool) pool(layer, y, rows, target);
            if (last)
                for (int i = 0; i < rows; i++) sink(y + i, reinterpret_cast<const float*>(target) + made.row_elements() * i);
        });
    }

private:
    void read_row(const float* row, float* to, const UnetPlane& input) const { std::copy_n(row, input.row_elements(), to); }
    void read_row(const float* row, Bfloat16* to, const UnetPlane& input) const {
        split_row(row, input.channels - split_channels, split_channels, to, input.width);
    }

    struct Own {
        std::byte *source, *target, *scratch; // per worker: input rows of a band, output rows, scratch of the convolution
    };
    Own own(unsigned worker) const {
        const UnetPlan& plan = unet_.plan;
        std::byte* begin = memory_ + plan.plane_bytes + worker * (2 * plan.band_bytes + unet_.scratch_bytes);
        return {begin, begin + plan.band_bytes, begin + 2 * plan.band_bytes};
    }
    // Rows -1 and height are the zero padding.
    std::byte* bytes_at(int plane, int y) const {
        const UnetPlane& p = unet_.plan.planes[plane];
        return memory_ + p.offset + p.row_bytes() * (y + 1);
    }
    T* row_of(int plane, int y) const { return reinterpret_cast<T*>(bytes_at(plane, y)); }
    void clear_borders(int plane) const {
        const UnetPlane& p = unet_.plan.planes[plane];
        for (const int y : {-1, p.height}) std::fill_n(bytes_at(plane, y), p.row_bytes(), std::byte(0));
    }

    // Assembles the input of layer `layer` for its rows [y, y + rows) from two planes (skip connection).
    const void* join(int layer, int y, int rows, std::byte* memory) const {
        const UnetPlane& half = unet_.plan.planes[layer];
        const int skip = unet_layers[layer].skip;
        const UnetPlane& skipped = unet_.plan.planes[skip];
        const size_t elements = size_t(skipped.width) * (half.channels + skipped.channels);
        T* to = reinterpret_cast<T*>(memory);
        for (int v = y - 1; v <= y + rows; v++, to += elements) {
            if (v < 0 || v >= skipped.height)
                std::fill_n(to, elements, T(0));
            else
                upsample_and_concat_row(row_of(layer, v / 2), half.channels, row_of(skip, v), skipped.channels, to, skipped.width);
        }
        return memory;
    }

    void pool(int layer, int y, int rows, const std::byte* memory) const {
        const UnetPlane& made = unet_.plan.planes[layer + 1];
        const size_t elements = made.row_elements() * 2;
        const T* from = reinterpret_cast<const T*>(memory);
        for (int i = 0; i < rows; i += 2, from += 2 * elements)
            max_pool_rows(from, from + elements, row_of(layer + 1, (y + i) / 2), made.width, made.channels);
    }

    const Unet& unet_;
    const Workers& workers_;
    const std::function<bool()>& wanted_;
    std::byte* memory_;
};

template <class T> bool run(const Unet& unet, const Workers& workers, const std::function<bool()>& wanted, std::byte* memory,
                            const UnetSource& source, const UnetSink& sink, const std::function<void(double)>& progress) {
    const Pass<T> pass(unet, workers, wanted, memory);
    if (!pass.read(source)) return false;
    for (int layer = 0; layer < unet_layer_count; layer++) {
        if (!pass.compute(layer, sink)) return false;
        if (progress) progress(unet.done_after[size_t(layer)]);
    }
    return true;
}

} // namespace

Result<Unet> make_unet(const UnetWeights& weights, int width, int height, Element element) {
    Unet unet{.plan = plan_unet(weights.channels(), width, height, element)};
    double multiplications = 0;
    for (int i = 0; i < unet_layer_count; i++) {
        const ConvolutionWeights packed = layer_weights(weights, i, element);
        const UnetPlane& made = unet.plan.planes[i + 1];
        const int scale = unet_layers[i].pool ? 2 : 1, rows = made.height * scale;
        multiplications += double(made.width) * made.height * (scale * scale) * packed.inputs * packed.outputs;
        unet.done_after.push_back(multiplications);
        BandShape shape{made.width * scale, std::min(band_rows, rows), unet.plan.planes[i].element, made.element};
        auto band = Convolution::make(packed, shape);
        if (!band) return band.error();
        unet.layers.push_back({std::move(*band), {}});
        unet.scratch_bytes = std::max(unet.scratch_bytes, unet.layers.back().band.scratch_bytes());

        shape.rows = rows % shape.rows;
        if (shape.rows == 0) continue;
        auto last = Convolution::make(packed, shape);
        if (!last) return last.error();
        unet.layers.back().last_band = std::move(*last);
        unet.scratch_bytes = std::max(unet.scratch_bytes, unet.layers.back().last_band->scratch_bytes());
    }
    for (double& done : unet.done_after) done /= multiplications;
    unet.scratch_bytes = (unet.scratch_bytes + 63) / 64 * 64;
    return unet;
}

bool run_unet(const Unet& unet, const Workers& workers, const std::function<bool()>& wanted, std::byte* memory, const UnetSource& source,
              const UnetSink& sink, const std::function<void(double)>& progress) {
    const auto typed = unet.plan.planes[0].element == Element::float32 ? run<float> : run<Bfloat16>;
    return typed(unet, workers, wanted, memory, source, sink, progress);
}

} // namespace blush::denoise
