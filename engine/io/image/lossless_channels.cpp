#include "io/image/lossless_channels.h"

#include <bit>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

namespace blush {
namespace {

constexpr std::string_view high = ".high", low = ".low", word = ".word", low_bin = ".low_bin";

void add_words(LayeredImage& image, std::string name, std::vector<uint32_t> words) {
    image.channels.push_back({std::move(name), {}, true, std::move(words)});
}

void add_doubles(LayeredImage& image, const std::string& name, const std::vector<double>& values) {
    std::vector<uint32_t> upper, lower;
    upper.reserve(values.size());
    lower.reserve(values.size());
    for (const double value : values) {
        const uint64_t bits = std::bit_cast<uint64_t>(value);
        upper.push_back(uint32_t(bits >> 32));
        lower.push_back(uint32_t(bits));
    }
    add_words(image, name + std::string(high), std::move(upper));
    add_words(image, name + std::string(low), std::move(lower));
}

// Moves the planes of low bins into the planes of their sums.
void join_low_bins(std::vector<LosslessPlane>& planes) {
    std::map<std::string, LosslessPlane*, std::less<>> sums;
    for (LosslessPlane& plane : planes) sums.emplace(plane.name, &plane);
    for (LosslessPlane& plane : planes) {
        if (!plane.name.ends_with(low_bin)) continue;
        const auto of = sums.find(std::string_view(plane.name).substr(0, plane.name.size() - low_bin.size()));
        if (of != sums.end()) of->second->low = std::exchange(plane.sums, {});
    }
    std::erase_if(planes, [](const LosslessPlane& plane) { return plane.name.ends_with(low_bin); });
}

} // namespace

void add_lossless_plane(LayeredImage& image, const std::string& layer, const LosslessPlane& plane) {
    const std::string name = layer + "." + plane.name;
    if (plane.sums.empty()) return add_words(image, name + std::string(word), plane.words);
    add_doubles(image, name, plane.sums);
    if (!plane.low.empty()) add_doubles(image, name + std::string(low_bin), plane.low);
}

std::vector<LosslessPlane> take_lossless_planes(LayeredImage& image, const std::string& layer) {
    std::map<std::string, LayeredImage::Channel*, std::less<>> low_words;
    for (LayeredImage::Channel& channel : image.channels)
        if (channel.is_uint && channel.name.ends_with(low)) low_words.emplace(channel.name, &channel);
    std::vector<LosslessPlane> planes;
    const std::string prefix = layer + ".";
    for (LayeredImage::Channel& channel : image.channels) {
        const std::string_view name = channel.name;
        if (!channel.is_uint || !name.starts_with(prefix)) continue;
        const auto without = [&](std::string_view end) {
            return std::string(name.substr(prefix.size(), name.size() - prefix.size() - end.size()));
        };
        channel.values = {};
        if (name.ends_with(word)) {
            planes.push_back({without(word), {}, std::exchange(channel.words, {})});
        } else if (name.ends_with(high)) {
            const auto lower = low_words.find(prefix + without(high) + std::string(low));
            if (lower == low_words.end()) continue;
            const std::vector<uint32_t> upper_words = std::exchange(channel.words, {}),
                                        lower_words = std::exchange(lower->second->words, {});
            lower->second->values = {};
            LosslessPlane plane{without(high)};
            plane.sums.resize(upper_words.size());
            for (size_t i = 0; i < plane.sums.size(); ++i)
                plane.sums[i] = std::bit_cast<double>(uint64_t(upper_words[i]) << 32 | lower_words[i]);
            planes.push_back(std::move(plane));
        }
    }
    join_low_bins(planes);
    return planes;
}

} // namespace blush
