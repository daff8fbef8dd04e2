// Caches the networks in use: weights, networks for recent sizes, working memory.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "render/denoise/tiles.h"
#include "render/denoise/unet.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace blush::denoise {

// Writes `count` pixels of network input (all channels) starting at (x, y), all within the image.
using ImageSource = std::function<void(int x, int y, int count, float* row)>;
// Receives `count` pixels of network output, three channels, starting at (x, y).
using ImageSink = std::function<void(int x, int y, int count, const float* row)>;

struct NetworkJob {
    std::string network; // "rt_hdr": FOLDER/rt_hdr.tza
    int inputs = 3;      // channels
    int width = 0, height = 0;
    Element element = Element::float32;
    uint64_t memory_bytes = 0;
    ImageSource source = {};
    ImageSink sink = {};
    std::function<void(double)> progress = {}; // gets the completed fraction
};

class Networks {
public:
    explicit Networks(std::filesystem::path folder);

    // Each pixel of the image is output exactly once. Returns the number of tiles; 0 if cancelled. Errors: weights, convolutions,
    // not enough memory for the smallest tile.
    Result<int> run(const NetworkJob& job, const Workers& workers, const std::function<bool()>& wanted);
    // Frees everything but the weights.
    void release();
    // Total seconds so far of reading weights, building networks and allocating memory, which a second run of the same size saves.
    double seconds_of_preparation() const { return seconds_of_preparation_; }

private:
    struct Made {
        std::string network;
        int width, height;
        Element element;
        Unet unet;
    };
    struct Free {
        void operator()(std::byte* p) const;
    };

    Result<const UnetWeights*> weights(const std::string& network, int inputs);
    Result<const Unet*> made(const NetworkJob& job, const UnetWeights& weights, int width, int height);
    std::byte* memory(size_t bytes);

    std::filesystem::path folder_;
    std::map<std::string, UnetWeights> weights_;
    std::list<Made> made_; // most recently used first
    std::unique_ptr<std::byte[], Free> memory_;
    size_t memory_bytes_ = 0;
    double seconds_of_preparation_ = 0;
};

} // namespace blush::denoise
