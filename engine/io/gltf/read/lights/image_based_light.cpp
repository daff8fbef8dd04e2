#include "io/gltf/read/lights/image_based_light.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/images/images.h"
#include "io/gltf/read/object.h"
#include "io/image/cube_map.h"
#include "io/image/environment_image.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace blush {
namespace {

constexpr const char* image_based_extension = "EXT_lights_image_based";
constexpr double degrees = 180 / std::numbers::pi;
constexpr int max_face_size = 8192;

const ParsedGltf& light_of(const ParsedGltf& root, const ParsedGltf& gltf_scene) {
    static const ParsedGltf null;
    const ParsedGltf& index = gltf_member(gltf_member(gltf_member(gltf_scene, "extensions"), image_based_extension), "light");
    return index.is_number_unsigned() ? gltf_light(root, image_based_extension, index.get<size_t>()) : null;
}

// The rotation of the file; identity if missing or invalid.
Quat rotation_of(const ParsedGltf& light) {
    Quat q;
    if (!read_json(Json(gltf_member(light, "rotation")), std::array{&q.x, &q.y, &q.z, &q.w})) return {};
    const float size = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    if (!(size > 1e-6f) || !std::isfinite(size)) return {};
    return {q.x / size, q.y / size, q.z / size, q.w / size};
}
bool is_about_y(const Quat& q) { return q.x == 0 && q.z == 0; }

// 8-bit values are sRGB. Four channels are RGBD: RGB divided by D, which may exceed 1.
Result<ImagePtr> read_face(const GltfContext& context, const ParsedGltf& index) {
    const size_t images = context.model().images.size();
    if (!index.is_number_unsigned() || index.get<size_t>() >= images)
        return Error{"", fmt::format("an image that does not exist; there are {}", images), ""};
    const Result<std::span<const uint8_t>> bytes = encoded_image(context, index.get<size_t>());
    if (!bytes) return bytes.error();
    const Result<ImagePtr> face = read_environment_image(*bytes, fmt::format("images[{}]", index.get<size_t>()),
                                                         {max_face_size, int64_t(max_face_size) * max_face_size});
    if (!face || (*face)->channels < 4) return face;
    auto image = std::make_shared<Image>(**face);
    for (size_t i = 0; i < image->floats.size(); i += 4) {
        const float divisor = std::max(image->floats[i + 3], 1.f / 255);
        for (size_t c = 0; c < 3; ++c) image->floats[i + c] /= divisor;
    }
    return ImagePtr(std::move(image));
}

Result<ImagePtr> read_map(const GltfContext& context, const ParsedGltf& light, const Quat& rotation) {
    const ParsedGltf& level = gltf_element(gltf_member(light, "specularImages"), 0);
    CubeFaces faces;
    for (size_t i = 0; i < faces.size(); ++i) {
        Result<ImagePtr> face = read_face(context, gltf_element(level, i));
        if (!face) return face;
        faces[i] = *std::move(face);
    }
    return lat_long_of(faces, rotation);
}

} // namespace

Environment import_image_light(const GltfContext& context, const ParsedGltf& gltf_scene, const std::string& scene_where) {
    const std::string where = fmt::format("{}.extensions.{}", scene_where, image_based_extension);
    if (!gltf_member(gltf_member(gltf_scene, "extensions"), image_based_extension).is_object()) return {};
    const ParsedGltf& light = light_of(context.json(), gltf_scene);
    Environment environment;
    environment.kind = Environment::Kind::image;
    const ParsedGltf& intensity = gltf_member(light, "intensity");
    if (intensity.is_number()) environment.intensity = checked(context, intensity.get<double>(), 1, 0, any_float, where + ".intensity");
    Quat rotation = rotation_of(light);
    if (is_about_y(rotation)) {
        environment.rotation_degrees = float(2 * std::atan2(double(rotation.y), double(rotation.w)) * degrees);
        rotation = {};
    }
    if (context.known) return context.known->image_light ? environment : Environment{};
    Result<ImagePtr> image = read_map(context, light, rotation);
    if (!image) {
        context.warn("the image-based light is not shown: " + image.error().text(), where);
        return {};
    }
    environment.image = *std::move(image);
    return environment;
}

void write_image_light(GltfDocument& document, const Environment& read, const Environment& wanted) {
    Json& scene = document.scene();
    const Json& reference = child_or_null(child_or_null(scene, "extensions"), image_based_extension);
    size_t index = 0;
    const Json* lights = document.find_list(image_based_extension);
    if (!document.indices.image_light || !read_json(child_or_null(reference, "light"), index) || !lights || index >= lights->size()) return;
    if (wanted.kind != Environment::Kind::image || wanted.image != document.indices.image_light) {
        document.indices.image_light = nullptr;
        return erase_extension(scene, image_based_extension);
    }
    Json& light = document.object(image_based_extension, int(index));
    if (read.intensity != wanted.intensity) set_number(light, "intensity", wanted.intensity, 1);
    if (read.rotation_degrees == wanted.rotation_degrees || !is_about_y(rotation_of(ParsedGltf(light)))) return;
    const double half = double(wanted.rotation_degrees) / degrees / 2;
    set_vector(light, "rotation", {0, float(std::sin(half)), 0, float(std::cos(half))}, {0, 0, 0, 1});
}

} // namespace blush
