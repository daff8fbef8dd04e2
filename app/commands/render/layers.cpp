#include "app/commands/render/layers.h"

#include "core/text.h"

#include <fmt/format.h>

namespace blush {
namespace {

struct LayerName {
    std::string_view name;
    bool Layers::*flag;
};
constexpr LayerName known[] = {{"albedo", &Layers::albedo}, {"normal", &Layers::normal},   {"depth", &Layers::depth},
                               {"error", &Layers::error},   {"samples", &Layers::samples}, {"id", &Layers::ids},
                               {"film", &Layers::film},     {"groups", &Layers::groups},   {"strategies", &Layers::strategies}};

Result<void> switch_on(Layers& layers, std::string_view name) {
    if (name == "bounces") {
        layers.bounces = default_bounce_planes;
        return {};
    }
    if (name.starts_with("bounces=")) {
        if (parse_number(name.substr(8), layers.bounces) && layers.bounces >= 2 && layers.bounces <= max_bounce_planes) return {};
        return Error{.what = fmt::format("bounces=N must be a number from 2 to {}, not \"{}\"", max_bounce_planes, name.substr(8))};
    }
    std::string names;
    for (const LayerName& layer : known) {
        if (layer.name == name) {
            layers.*layer.flag = true;
            return {};
        }
        names += fmt::format("{}{}", names.empty() ? "" : ", ", layer.name);
    }
    return Error{.what = fmt::format("unknown layer \"{}\" (known: {}, bounces)", name, names)};
}

} // namespace

Result<Layers> parse_layers(std::string_view text) {
    Layers layers;
    for (const std::string_view name : split(text, ','))
        if (Result<void> known_layer = switch_on(layers, name); !known_layer) return known_layer.error();
    return layers;
}

PlaneSet planes_of(const Layers& layers) {
    return {.albedo = layers.albedo,
            .normal = layers.normal,
            .depth = layers.depth,
            .ids = layers.ids,
            .bounces = layers.bounces,
            .strategies = layers.strategies};
}

} // namespace blush
