#include "io/gltf/read/camera_aspects.h"

#include "io/gltf/read/extras.h"

#include <cmath>

namespace blush {
namespace {

double number(const ParsedGltf& object, const char* key) {
    const ParsedGltf& value = gltf_member(object, key);
    return value.is_number() ? value.get<double>() : 0;
}

double aspect_of(const ParsedGltf& camera) {
    const ParsedGltf& orthographic = gltf_member(camera, "orthographic");
    const double ymag = number(orthographic, "ymag");
    return ymag != 0 ? std::abs(number(orthographic, "xmag") / ymag) : number(gltf_member(camera, "perspective"), "aspectRatio");
}

} // namespace

std::map<Id<Camera>, float> camera_aspects(const GltfOrigin& origin) {
    constexpr double min_aspect = 0.01, max_aspect = 100;
    std::map<Id<Camera>, float> aspects;
    if (!origin.json || origin.indices.cameras.empty()) return aspects;
    // Keeps only the root's member "cameras" while parsing.
    const auto keep = [](int depth, ParsedGltf::parse_event_t event, ParsedGltf& parsed) {
        return depth != 1 || event != ParsedGltf::parse_event_t::key || parsed == "cameras";
    };
    const ParsedGltf root = ParsedGltf::parse(*origin.json, keep, /*allow_exceptions=*/false);
    for (const auto& [id, index] : origin.indices.cameras)
        if (const double aspect = aspect_of(gltf_item(root, "cameras", size_t(index))); aspect >= min_aspect && aspect <= max_aspect)
            aspects[id] = float(aspect);
    return aspects;
}

} // namespace blush
