// Files with EXT_lights_ies and EXT_lights_image_based, made in memory.
#pragma once

#include "io/image/image_io.h"
#include "tests/io/gltf/saving.h"

#include <array>

namespace blush::test {

inline const std::filesystem::path downlight = std::filesystem::path(BLUSH_ASSETS) / "ies" / "downlight.ies";

inline Json light_node(int light, Json more = Json::object()) {
    more["light"] = light;
    return {{"extensions", {{"EXT_lights_ies", more}}}};
}

// Two lights of one profile, one of them twice, and one of a profile within the file.
inline GltfBuilder with_luminaires(const TempFolder& folder) {
    std::filesystem::copy_file(downlight, folder / "down light.ies", std::filesystem::copy_options::overwrite_existing);
    GltfBuilder b;
    b.json["extensionsUsed"] = {"EXT_lights_ies"};
    const int view = b.buffer_view(text_of(downlight));
    b.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"uri", "down%20light.ies"}}, {{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}, {"name", "within"}}};
    b.add("nodes", light_node(0));
    b.add("nodes", light_node(0, {{"multiplier", 0.25}, {"color", {1, 0.5, 0.25}}}));
    b.add("nodes", light_node(0));
    b.add("nodes", light_node(1, {{"multiplier", 3}}));
    b.add("scenes", {{"nodes", {0, 1, 2, 3}}});
    return b;
}

// The faces of a cube in six colours, of `side` texels.
inline constexpr Vec3 face_colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
inline Image face_image(int side, int channels, const Vec3& color, uint8_t last = 255) {
    Image image;
    image.width = image.height = side;
    image.channels = channels;
    for (int i = 0; i < side * side; ++i) {
        for (const float c : {color.x, color.y, color.z}) image.bytes.push_back(uint8_t(255 * c));
        if (channels == 4) image.bytes.push_back(last);
    }
    return image;
}

inline GltfBuilder with_image_light(const std::array<Image, 6>& faces, Json more = Json::object()) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"EXT_lights_image_based"};
    for (const Image& face : faces) {
        const auto png = encode_png(face);
        const int view = b.buffer_view({reinterpret_cast<const char*>(png->data()), png->size()});
        b.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    }
    more["specularImages"] = Json::array({Json::array({0, 1, 2, 3, 4, 5})});
    more["specularImageSize"] = faces[0].width;
    more["irradianceCoefficients"] = std::vector<std::vector<float>>(9, {0, 0, 0});
    b.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({more});
    b.add("scenes", {{"nodes", {b.add("nodes", {{"name", "a place"}})}}, {"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}});
    return b;
}
inline std::array<Image, 6> coloured_faces(int side) {
    std::array<Image, 6> faces;
    for (size_t i = 0; i < 6; ++i) faces[i] = face_image(side, 3, face_colors[i]);
    return faces;
}

} // namespace blush::test
