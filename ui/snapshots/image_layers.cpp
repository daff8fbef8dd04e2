#include "ui/snapshots/image_layers.h"

#include "ui/snapshots/aov_pixels.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace blush {
namespace {

using Kind = ImageLayer::Kind;

// "diffuse" and "R" of "diffuse.R".
struct ChannelName {
    std::string layer, letter;
};
ChannelName split_name(const std::string& name) {
    const size_t dot = name.rfind('.');
    if (dot == name.npos) return {"", name};
    return {name.substr(0, dot), name.substr(dot + 1)};
}

bool is_letter(const std::string& letter, const char* upper) {
    return letter.size() == 1 && (letter[0] == *upper || letter[0] == *upper - 'A' + 'a');
}

int find_channel(const LayeredImage& part, const std::string& layer, const char* letter) {
    for (size_t i = 0; i < part.channels.size(); ++i) {
        const ChannelName name = split_name(part.channels[i].name);
        if (name.layer == layer && is_letter(name.letter, letter) && !part.channels[i].is_uint) return int(i);
    }
    return -1;
}

// The three or four channels of a layer, by their letters.
std::optional<ImageLayer> layer_of(const LayeredImage& part, const std::string& name, const char* const (&letters)[3], Kind kind) {
    ImageLayer layer{.name = name.empty() ? "Beauty" : name, .channels = {}, .kind = kind};
    for (size_t c = 0; c < 3; ++c) layer.channel[c] = find_channel(part, name, letters[c]);
    if (std::ranges::count(layer.channel, -1) > 1) return {};
    if (kind == Kind::color) layer.channel[3] = find_channel(part, name, "A");
    for (const int c : layer.channel)
        if (c >= 0) layer.channels += (layer.channels.empty() ? "" : ", ") + part.channels[size_t(c)].name;
    return layer;
}

std::vector<ImageLayer> layers_of(const LayeredImage& part) {
    std::vector<ImageLayer> layers;
    std::vector<bool> taken(part.channels.size());
    for (size_t i = 0; i < part.channels.size(); ++i) {
        if (taken[i]) continue;
        const std::string& name = part.channels[i].name;
        std::optional<ImageLayer> layer;
        if (!part.channels[i].is_uint) {
            layer = layer_of(part, split_name(name).layer, {"R", "G", "B"}, Kind::color);
            if (!layer || std::ranges::count(layer->channel, int(i)) == 0)
                layer = layer_of(part, split_name(name).layer, {"X", "Y", "Z"}, Kind::vector);
        }
        if (!layer || std::ranges::count(layer->channel, int(i)) == 0)
            layer = ImageLayer{.name = name,
                               .channels = name,
                               .kind = part.channels[i].is_uint ? Kind::id : Kind::number,
                               .channel = {int(i), -1, -1, -1}};
        for (const int c : layer->channel)
            if (c >= 0) taken[size_t(c)] = true;
        layers.push_back(*layer);
    }
    return layers;
}

struct FiniteRange {
    float low = 0, high = 0;
    bool known = false;
};
FiniteRange finite_range(const std::vector<float>& values) {
    FiniteRange r;
    for (const float v : values) {
        // Infinite depth, as written by renderers for no hit, is not part of the range.
        if (!std::isfinite(v) || std::abs(v) >= 1e9f) continue;
        r = r.known ? FiniteRange{std::min(r.low, v), std::max(r.high, v), true} : FiniteRange{v, v, true};
    }
    return r;
}

float sound(float v) { return std::isfinite(v) ? v : 0; }

} // namespace

std::vector<ImageLayer> layers_of(const std::vector<LayeredImage>& parts) {
    std::vector<ImageLayer> all;
    for (size_t p = 0; p < parts.size(); ++p) {
        const std::string prefix = parts.size() < 2 ? "" : parts[p].part.empty() ? fmt::format("Part {}: ", p + 1) : parts[p].part + ": ";
        for (ImageLayer& layer : layers_of(parts[p])) {
            layer.name = prefix + layer.name;
            layer.part = p;
            all.push_back(std::move(layer));
        }
    }
    // A colour layer without a name is the beauty.
    const auto beauty = std::ranges::find_if(all, [](const ImageLayer& l) { return l.kind == Kind::color && l.name.ends_with("Beauty"); });
    if (beauty != all.end()) std::rotate(all.begin(), beauty, beauty + 1);
    return all;
}

Result<std::shared_ptr<ImageLayers>> open_image_layers(const std::filesystem::path& file) {
    Result<std::vector<LayeredImage>> parts = read_parts(file);
    if (!parts) return parts.error();
    auto image = std::make_shared<ImageLayers>(ImageLayers{file, *std::move(parts), {}});
    image->layers = layers_of(image->parts);
    if (image->layers.empty()) return Error{file.string(), "has no channels", ""};
    return image;
}

bool is_panorama(const ImageLayers& p) {
    const LayeredImage& image = p.parts.front();
    return p.parts.size() == 1 && image.width == 2 * image.height && p.layers.size() == 1 && p.layers.front().kind == Kind::color;
}

FramePtr frame_of(const ImageLayers& image) {
    const ImageLayer& layer = image.layers[image.chosen];
    const LayeredImage& part = image.parts[layer.part];
    auto frame = std::make_shared<Frame>();
    frame->width = part.width;
    frame->height = part.height;
    frame->complete = true;
    const size_t pixels = size_t(part.width) * size_t(part.height);
    frame->rgba.assign(4 * pixels, 1.f);
    const auto& first = part.channels[size_t(layer.channel[0])];
    const FiniteRange range = layer.kind == Kind::number ? finite_range(first.values) : FiniteRange{};
    for (size_t i = 0; i < pixels; ++i) {
        float* to = &frame->rgba[4 * i];
        if (layer.kind == Kind::number) {
            const float v = sound(first.values[i]), span = range.high - range.low;
            to[0] = to[1] = to[2] = span > 0 ? std::clamp((v - range.low) / span, 0.f, 1.f) : 0.f;
        } else if (layer.kind == Kind::id) {
            const Vec3 c = id_color(first.words[i]);
            std::copy_n(&c.x, 3, to);
        } else {
            for (size_t c = 0; c < 4; ++c)
                if (layer.channel[c] >= 0) to[c] = sound(part.channels[size_t(layer.channel[c])].values[i]);
            for (size_t c = 0; c < 3 && layer.kind == Kind::vector; ++c) to[c] = to[c] / 2 + 0.5f;
        }
    }
    return frame;
}

std::string range_text(const ImageLayers& image) {
    const ImageLayer& layer = image.layers[image.chosen];
    if (layer.kind != Kind::number) return {};
    const FiniteRange r = finite_range(image.parts[layer.part].channels[size_t(layer.channel[0])].values);
    return r.known ? fmt::format("from {:.4g} to {:.4g}", r.low, r.high) : "no numbers";
}

} // namespace blush
