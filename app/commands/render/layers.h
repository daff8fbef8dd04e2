// Layers that a render writes beside the beauty: `--layers albedo,normal,...`. `bounces=N` is the number of bounce planes, the
// last of which contains all further bounces.
#pragma once

#include "core/result.h"
#include "render/film/film_size.h"

#include <string_view>

namespace blush {

struct Layers {
    bool albedo = false, normal = false, depth = false, error = false, samples = false, ids = false;
    bool film = false;       // full sums, for --continue and merge
    bool groups = false;     // one plane per light group
    int bounces = 0;         // number of planes by bounce
    bool strategies = false; // one plane per strategy that finds light
    bool any() const { return *this != Layers{}; }
    bool operator==(const Layers&) const = default;
};

// Errors: unknown layer.
Result<Layers> parse_layers(std::string_view text);
// The film planes that they need.
PlaneSet planes_of(const Layers& layers);

} // namespace blush
