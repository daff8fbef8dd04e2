#include "tests/bench/bare_convolutions.h"

#include "core/openmp.h"
#include "tests/bench/bench.h"

#include <oneapi/dnnl/dnnl.hpp>

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace blush::bench {
namespace {

using dnnl::memory;
using tag = memory::format_tag;

const dnnl::engine& processor() {
    static const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
    return engine;
}

memory::data_type type_of(denoise::Element element) {
    return element == denoise::Element::float32 ? memory::data_type::f32 : memory::data_type::bf16;
}

memory zeros(const memory::desc& description) {
    memory made(description, processor());
    std::memset(made.get_data_handle(), 0, description.get_size());
    return made;
}

struct Work {
    dnnl::primitive primitive;
    std::unordered_map<int, memory> arguments;
};

dnnl::convolution_forward::primitive_desc convolution(int inputs, int outputs, int width, int height, memory::data_type type) {
    const memory::desc source({1, inputs, height, width}, type, tag::any), kernel({outputs, inputs, 3, 3}, type, tag::any),
        bias({outputs}, memory::data_type::f32, tag::x), target({1, outputs, height, width}, type, tag::any);
    dnnl::post_ops relu;
    relu.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
    dnnl::primitive_attr attributes;
    attributes.set_post_ops(relu);
    return {{dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_auto, source, kernel, bias, target, {1, 1}, {1, 1}, {1, 1}},
            attributes,
            processor()};
}

} // namespace

struct BareConvolutions::State {
    unsigned threads;
    memory source = {}, target = {}; // size of the largest layer
    std::vector<Work> work = {};
    double operations = 0;
};

BareConvolutions::BareConvolutions(const denoise::UnetChannels& channels, int width, int height, denoise::Element element, unsigned threads)
    : state_(new State{.threads = threads}) {
    omp_set_num_threads(int(threads));
    const denoise::UnetPlan plan = plan_unet(channels, width, height, denoise::Element::float32);
    std::vector<dnnl::convolution_forward::primitive_desc> layers;
    size_t source_bytes = 0, target_bytes = 0;
    for (int i = 0; i < denoise::unet_layer_count; i++) {
        const auto& layer = denoise::unet_layers[i];
        const auto &source = plan.planes[i], &target = plan.planes[i + 1];
        const int inputs = source.channels + (layer.skip >= 0 ? plan.planes[layer.skip].channels : 0), pooled = layer.pool ? 2 : 1;
        const int made_width = target.width * pooled, made_height = target.height * pooled;
        layers.push_back(convolution(inputs, target.channels, made_width, made_height, type_of(element)));
        source_bytes = std::max(source_bytes, layers.back().src_desc().get_size());
        target_bytes = std::max(target_bytes, layers.back().dst_desc().get_size());
        state_->operations += 2.0 * 9 * inputs * target.channels * made_width * made_height;
    }
    const auto bytes = [](size_t count) { return zeros(memory::desc({memory::dim(count)}, memory::data_type::u8, tag::x)); };
    state_->source = bytes(source_bytes);
    state_->target = bytes(target_bytes);
    for (const auto& layer : layers)
        state_->work.push_back({dnnl::convolution_forward(layer),
                                {{DNNL_ARG_SRC, memory(layer.src_desc(), processor(), state_->source.get_data_handle())},
                                 {DNNL_ARG_WEIGHTS, zeros(layer.weights_desc())},
                                 {DNNL_ARG_BIAS, zeros(layer.bias_desc())},
                                 {DNNL_ARG_DST, memory(layer.dst_desc(), processor(), state_->target.get_data_handle())}}});
}

BareConvolutions::~BareConvolutions() = default;

void BareConvolutions::run() const {
    omp_set_num_threads(int(state_->threads));
    dnnl::stream stream(processor());
    for (const Work& work : state_->work) work.primitive.execute(stream, work.arguments);
    stream.wait();
}

double BareConvolutions::operations() const { return state_->operations; }

double peak_rate(denoise::Element element) {
    constexpr int side = 1024, rounds = 10;
    omp_set_num_threads(1);
    const memory::desc factor({side, side}, type_of(element), tag::any), product({side, side}, memory::data_type::f32, tag::any);
    const dnnl::matmul::primitive_desc made({factor, factor, product}, processor());
    const Work work{
        dnnl::matmul(made),
        {{DNNL_ARG_SRC, zeros(made.src_desc())}, {DNNL_ARG_WEIGHTS, zeros(made.weights_desc())}, {DNNL_ARG_DST, zeros(made.dst_desc())}}};
    dnnl::stream stream(processor());
    double fastest = 0;
    for (int round = 0; round < rounds; round++) {
        const Cost cost = cost_of([&] {
            work.primitive.execute(stream, work.arguments);
            stream.wait();
        });
        fastest = std::max(fastest, 2.0 * side * side * side / cost.core_seconds);
    }
    return fastest;
}

} // namespace blush::bench
