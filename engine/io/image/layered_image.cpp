// Lookup of the channels of a layered image by name.
#include "io/image/image_io.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {

const LayeredImage::Channel* LayeredImage::find(std::string_view name) const {
    const auto it = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
    return it == channels.end() ? nullptr : &*it;
}

std::array<const LayeredImage::Channel*, 3> LayeredImage::find_color(std::string_view layer) const {
    const auto named = [&](const char* letter) { return find(layer.empty() ? letter : fmt::format("{}.{}", layer, letter)); };
    const std::array<const Channel*, 3> rgb{named("R"), named("G"), named("B")};
    if (rgb[0] && rgb[1] && rgb[2]) return rgb;
    const Channel* grey = named("Y");
    return {grey, grey, grey};
}

void LayeredImage::set(Channel channel, std::string_view behind) {
    const auto named = [&](std::string_view name) {
        return std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
    };
    if (const auto there = named(channel.name); there != channels.end()) {
        *there = std::move(channel);
        return;
    }
    const auto before = named(behind);
    channels.insert(before == channels.end() ? before : before + 1, std::move(channel));
}

} // namespace blush
