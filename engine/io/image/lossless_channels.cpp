#include "io/image/lossless_channels.h"

#include <bit>
#include <string_view>
#include <utility>

namespace blush {
namespace {

constexpr std::string_view high = ".high", low = ".low", word = ".word";

void add_words(LayeredImage& image, std::string name, std::vector<uint32_t> words) {
    image.channels.push_back({std::move(name), {}, true, std::move(words)});
}

} // namespace

void add_lossless_plane(LayeredImage& image, const std::string& layer, const LosslessPlane& plane) {
    const std::string name = layer + "." + plane.name;
    if (plane.sums.empty()) return add_words(image, name + std::string(word), plane.words);
    std::vector<uint32_t> upper, lower;
    upper.reserve(plane.sums.size());
    lower.reserve(plane.sums.size());
    for (const double sum : plane.sums) {
        const uint64_t bits = std::bit_cast<uint64_t>(sum);
        upper.push_back(uint32_t(bits >> 32));
        lower.push_back(uint32_t(bits));
    }
    add_words(image, name + std::string(high), std::move(upper));
    add_words(image, name + std::string(low), std::move(lower));
}

std::vector<LosslessPlane> lossless_planes(const LayeredImage& image, const std::string& layer) {
    std::vector<LosslessPlane> planes;
    const std::string prefix = layer + ".";
    for (const LayeredImage::Channel& channel : image.channels) {
        const std::string_view name = channel.name;
        if (!channel.is_uint || !name.starts_with(prefix)) continue;
        const auto without = [&](std::string_view end) {
            return std::string(name.substr(prefix.size(), name.size() - prefix.size() - end.size()));
        };
        if (name.ends_with(word)) {
            planes.push_back({without(word), {}, channel.words});
        } else if (name.ends_with(high)) {
            const LayeredImage::Channel* lower = image.find(prefix + without(high) + std::string(low));
            if (!lower || !lower->is_uint) continue;
            LosslessPlane plane{without(high)};
            plane.sums.resize(channel.words.size());
            for (size_t i = 0; i < plane.sums.size(); ++i)
                plane.sums[i] = std::bit_cast<double>(uint64_t(channel.words[i]) << 32 | lower->words[i]);
            planes.push_back(std::move(plane));
        }
    }
    return planes;
}

} // namespace blush
