#include "render/denoise/networks.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>

namespace blush::denoise {
namespace {

using Clock = std::chrono::steady_clock;

// Prepared networks that are cached: the three of one high-quality image, and another size of each.
constexpr size_t max_cached_networks = 6;
constexpr auto alignment = std::align_val_t(64);

// Network rows inside the image come from the source, others are zero.
UnetSource tile_source(const NetworkJob& job, const TileGrid& grid, const Tile& tile) {
    return [&job, &grid, tile](int y, float* row) {
        const int inside = tile.y + y < job.height ? std::min(grid.width, job.width - tile.x) : 0;
        if (inside > 0) job.source(tile.x, tile.y + y, inside, row);
        std::fill(row + size_t(inside) * job.inputs, row + size_t(grid.width) * job.inputs, 0.f);
    };
}

UnetSink tile_sink(const NetworkJob& job, const Tile& tile) {
    return [&job, tile](int y, const float* row) {
        const int image_y = tile.y + y;
        if (image_y < tile.top || image_y >= tile.bottom) return;
        job.sink(tile.left, image_y, tile.right - tile.left, row + size_t(tile.left - tile.x) * 3);
    };
}

} // namespace

Networks::Networks(std::filesystem::path folder) : folder_(std::move(folder)) {}

void Networks::Free::operator()(std::byte* p) const { ::operator delete[](p, alignment); }

Result<int> Networks::run(const NetworkJob& job, const Workers& workers, const std::function<bool()>& wanted) {
    const auto begin = Clock::now();
    const auto weights = this->weights(job.network, job.inputs);
    if (!weights) return weights.error();
    const UnetChannels channels = (*weights)->channels();
    const auto grid = choose_tiles(job.width, job.height, [&](int width, int height) {
        return plan_unet(channels, width, height, job.element).bytes(workers.threads()) <= job.memory_bytes;
    });
    if (!grid) return Error{.what = fmt::format("the denoiser cannot work in {} MB", job.memory_bytes >> 20)};
    const auto unet = made(job, **weights, grid->width, grid->height);
    if (!unet) return unet.error();

    std::byte* memory = this->memory((*unet)->bytes(workers));
    seconds_of_preparation_ += std::chrono::duration<double>(Clock::now() - begin).count();
    const int tiles = grid->columns * grid->rows;
    for (int i = 0; i < tiles; i++) {
        const Tile tile = tile_at(*grid, i % grid->columns, i / grid->columns);
        const auto progress = [&](double of_tile) {
            if (job.progress) job.progress((i + of_tile) / tiles);
        };
        if (!run_unet(**unet, workers, wanted, memory, tile_source(job, *grid, tile), tile_sink(job, tile), progress)) return 0;
    }
    return tiles;
}

void Networks::release() {
    made_.clear();
    memory_.reset();
    memory_bytes_ = 0;
}

Result<const UnetWeights*> Networks::weights(const std::string& network, int inputs) {
    const auto known = weights_.find(network);
    if (known != weights_.end()) return &known->second;
    auto read = read_unet_weights(folder_ / (network + ".tza"), inputs);
    if (!read) return read.error();
    return &weights_.emplace(network, std::move(*read)).first->second;
}

Result<const Unet*> Networks::made(const NetworkJob& job, const UnetWeights& weights, int width, int height) {
    const auto same = [&](const Made& m) {
        return m.network == job.network && m.width == width && m.height == height && m.element == job.element;
    };
    const auto known = std::ranges::find_if(made_, same);
    if (known != made_.end()) {
        made_.splice(made_.begin(), made_, known);
        return &made_.front().unet;
    }
    auto unet = make_unet(weights, width, height, job.element);
    if (!unet) return unet.error();
    made_.push_front({job.network, width, height, job.element, std::move(*unet)});
    if (made_.size() > max_cached_networks) made_.pop_back();
    return &made_.front().unet;
}

std::byte* Networks::memory(size_t bytes) {
    if (bytes > memory_bytes_) {
        memory_.reset();
        memory_bytes_ = 0;
        memory_.reset(new (alignment) std::byte[bytes]);
        memory_bytes_ = bytes;
    }
    return memory_.get();
}

} // namespace blush::denoise
