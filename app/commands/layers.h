// Which planes beside the beauty a render writes: `--layers albedo,normal,...`. `bounces=N` says how many bounce
// planes, the last of which holds all further ones.
#pragma once

#include "core/result.h"
#include "render/renderer.h"

#include <string_view>

namespace blush {

struct Layers {
    bool albedo = false, normal = false, depth = false, error = false, samples = false, ids = false;
    bool film = false; // sums in full, to go on from and to merge
    bool groups = false; // light by the group of lights that it came from
    int bounces = 0; // planes of light by the number of scatterings
    bool any() const { return *this != Layers{}; }
    bool operator==(const Layers&) const = default;
};

// Errors: an unknown layer.
Result<Layers> parse_layers(std::string_view text);
// What the film must hold for them.
PlaneSet planes_of(const Layers& layers);

} // namespace blush
