#include "render/denoise/convolution.h"

#include "core/openmp.h"

#include <oneapi/dnnl/dnnl.hpp>

#include <fmt/format.h>

namespace blush::denoise {
namespace {

using dnnl::memory;

const dnnl::engine& processor() {
    static const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
    return engine;
}

memory::data_type type_of(Element element) { return element == Element::float32 ? memory::data_type::f32 : memory::data_type::bf16; }

dnnl::convolution_forward::primitive_desc describe(const ConvolutionWeights& weights, const BandShape& shape) {
    using tag = memory::format_tag;
    const memory::desc source({1, weights.inputs, shape.rows + 2, shape.width}, type_of(shape.source), tag::nhwc);
    const memory::desc kernel({weights.outputs, weights.inputs, 3, 3}, type_of(shape.source), tag::any);
    const memory::desc bias({weights.outputs}, memory::data_type::f32, tag::x);
    const memory::desc target({1, weights.outputs, shape.rows, shape.width}, type_of(shape.target), tag::nhwc);
    dnnl::post_ops relu;
    relu.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
    dnnl::primitive_attr attributes;
    attributes.set_post_ops(relu);
    attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
    const dnnl::convolution_forward::desc convolution(dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_direct, source,
                                                      kernel, bias, target, {1, 1}, {0, 1}, {0, 1});
    return {convolution, attributes, processor()};
}

// Reorders `values` into the memory layout `packed`.
memory pack(const std::vector<float>& values, const memory::desc& plain, const memory::desc& packed) {
    memory from(plain, processor(), const_cast<float*>(values.data())), to(packed, processor());
    dnnl::stream stream(processor());
    dnnl::reorder(from, to).execute(stream, from, to);
    stream.wait();
    return to;
}

} // namespace

bool has_bfloat16() {
    // On older instruction sets oneDNN emulates bfloat16, slower than float32.
    switch (dnnl::get_effective_cpu_isa()) {
    case dnnl::cpu_isa::avx512_core_bf16:
    case dnnl::cpu_isa::avx512_core_amx: return true;
    default: return false;
    }
}

OneThread::OneThread() : threads_before_(omp_get_max_threads()) { omp_set_num_threads(1); }
OneThread::~OneThread() { omp_set_num_threads(threads_before_); }

struct Convolution::State {
    dnnl::convolution_forward::primitive_desc description;
    dnnl::convolution_forward primitive;
    memory kernel, bias;
};

Convolution::Convolution(std::unique_ptr<State> state) : state_(std::move(state)) {}
Convolution::Convolution(Convolution&&) noexcept = default;
Convolution& Convolution::operator=(Convolution&&) noexcept = default;
Convolution::~Convolution() = default;

Result<Convolution> Convolution::make(const ConvolutionWeights& weights, const BandShape& shape) {
    const OneThread one_thread;
    try {
        auto state = std::make_unique<State>();
        state->description = describe(weights, shape);
        state->primitive = dnnl::convolution_forward(state->description);
        const memory::desc oihw({weights.outputs, weights.inputs, 3, 3}, memory::data_type::f32, memory::format_tag::oihw);
        state->kernel = pack(weights.kernel, oihw, state->description.weights_desc());
        state->bias = pack(weights.bias, state->description.bias_desc(), state->description.bias_desc());
        return Convolution(std::move(state));
    } catch (const dnnl::error& e) {
        return Error{.what = fmt::format("the denoiser's convolution of {} to {} channels cannot be created: {}", weights.inputs,
                                         weights.outputs, e.what())};
    }
}

void Convolution::run(const void* source, void* target, std::byte* scratch) const {
    const auto& description = state_->description;
    dnnl::stream stream(processor());
    state_->primitive.execute(stream, {{DNNL_ARG_SRC, memory(description.src_desc(), processor(), const_cast<void*>(source))},
                                       {DNNL_ARG_WEIGHTS, state_->kernel},
                                       {DNNL_ARG_BIAS, state_->bias},
                                       {DNNL_ARG_DST, memory(description.dst_desc(), processor(), target)},
                                       {DNNL_ARG_SCRATCHPAD, memory(description.scratchpad_desc(), processor(), scratch)}});
    stream.wait();
}

size_t Convolution::scratch_bytes() const { return state_->description.scratchpad_desc().get_size(); }

} // namespace blush::denoise
