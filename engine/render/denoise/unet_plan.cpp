#include "render/denoise/unet_plan.h"

#include <algorithm>
#include <vector>

namespace blush::denoise {
namespace {

// Copies of whole vector registers may exceed the end of a plane by less than this.
constexpr size_t slack = 64;

size_t aligned(size_t bytes) { return (bytes + 63) / 64 * 64; }

// The last layer that reads plane `plane`, the output of layer plane - 1.
int last_reader(int plane) {
    int last = plane;
    for (int layer = plane; layer < unet_layer_count; layer++)
        if (unet_layers[layer].skip == plane) last = layer;
    return last;
}

struct Block {
    size_t begin, end;
    int last_reader;
};

// The lowest free offset for `bytes` between the live blocks, which are sorted by offset.
size_t lowest_free_offset(const std::vector<Block>& live_blocks, size_t bytes) {
    size_t begin = 0;
    for (const Block& block : live_blocks) {
        if (begin + bytes <= block.begin) break;
        begin = block.end;
    }
    return begin;
}

} // namespace

UnetPlan plan_unet(const UnetChannels& channels, int width, int height, Element element) {
    UnetPlan plan;
    plan.planes[0] = {width, height, channels[0] + extra_inputs(element), element};
    for (int i = 0; i < unet_layer_count; i++) {
        const UnetLayer& layer = unet_layers[i];
        const UnetPlane& source = plan.planes[i];
        const bool up = layer.skip >= 0;
        const int made_width = up ? source.width * 2 : source.width, made_height = up ? source.height * 2 : source.height;
        plan.planes[i + 1] = {layer.pool ? made_width / 2 : made_width, layer.pool ? made_height / 2 : made_height, channels[i + 1],
                              i + 2 < unet_layer_count ? element : Element::float32};

        const int inputs = source.channels + (up ? plan.planes[layer.skip].channels : 0);
        const size_t in = size_t(band_rows + 2) * made_width * inputs * bytes_of(element);
        const size_t out = size_t(band_rows) * made_width * channels[i + 1] * sizeof(float);
        plan.band_bytes = std::max(plan.band_bytes, aligned(std::max(in, out) + slack));
    }

    std::vector<Block> live_blocks;
    for (int i = 0; i + 1 < unet_plane_count; i++) {
        UnetPlane& plane = plan.planes[i];
        // Layer i - 1 writes this plane while it reads its inputs.
        std::erase_if(live_blocks, [&](const Block& block) { return block.last_reader < i - 1; });
        const size_t bytes = aligned(plane.row_bytes() * (plane.height + 2) + slack);
        plane.offset = lowest_free_offset(live_blocks, bytes);
        const Block block{plane.offset, plane.offset + bytes, last_reader(i)};
        live_blocks.insert(std::ranges::upper_bound(live_blocks, block.begin, {}, &Block::begin), block);
        plan.plane_bytes = std::max(plan.plane_bytes, block.end);
    }
    return plan;
}

} // namespace blush::denoise
