#include "io/project/scene_hash.h"

#include "core/hash64.h"
#include "io/project/scene_fields.h"
#include "scene/geometry/tangents.h"
#include "scene/lights/ies_profile.h"

#include <bit>
#include <fmt/format.h>
#include <span>

namespace blush {
namespace {

class Hasher : public Hash64 {
public:
    // Hashes fields by type. Skips strings (names and paths) and camera ids, which affect the image only through the view.
    void operator()(std::string_view, const std::string&) {}
    void operator()(std::string_view, const Id<Camera>&) {}
    void operator()(std::string_view, const float& v) { word(std::bit_cast<uint32_t>(v)); }
    template <class T>
    requires std::integral<T> || std::is_enum_v<T>
    void operator()(std::string_view, const T& v) { word(uint64_t(v)); }
    template <class T> void operator()(std::string_view, const Id<T>& id) { word(id.value); }
    template <class T>
    requires std::same_as<T, Vec2> || std::same_as<T, Vec3> || std::same_as<T, Quat>
    void operator()(std::string_view, const T& v) { bytes(std::as_bytes(std::span(&v, 1))); }
    void operator()(std::string_view, const std::optional<Affine>& m) {
        word(m.has_value());
        if (m) bytes(std::as_bytes(std::span(&*m, 1)));
    }
    template <Fielded T> void operator()(std::string_view, const T& record) { visit_fields(record, *this); }
    template <class T> void operator()(std::string_view, const std::vector<T>& list) {
        word(list.size());
        for (const T& item : list) (*this)({}, item);
    }
};

void hash_image(Hasher& hash, const ImagePtr& image) {
    hash.word(image != nullptr);
    if (!image) return;
    for (const int v : {image->width, image->height, image->channels}) hash.word(uint64_t(v));
    hash.array(image->bytes);
    hash.array(image->floats);
}

void hash_profile(Hasher& hash, const IesPtr& profile) {
    hash.word(profile != nullptr);
    if (!profile) return;
    hash.word(uint64_t(profile->type));
    hash.array(profile->vertical);
    hash.array(profile->horizontal);
    hash.array(profile->candela);
}

void hash_mesh(Hasher& hash, const Mesh& mesh) {
    hash.word(mesh.parts.size());
    for (const MeshPart& part : mesh.parts) {
        hash.word(part.material.value);
        hash.word(part.geometry != nullptr);
        if (!part.geometry) continue;
        const GeometryPtr geometry = without_generated_tangents(part.geometry); // generated tangents follow from the other attributes
        const Geometry& g = *geometry;
        hash.array(g.positions);
        hash.array(g.normals);
        hash.array(g.tangents);
        hash.word(g.uv.size());
        for (const GeometryArray<Vec2>& uv : g.uv) hash.array(uv);
        hash.array(g.colors);
        hash.array(g.indices);
        for (const MorphTargetPtr& target : g.targets) {
            hash.array(target->positions);
            hash.array(target->normals);
            hash.array(target->tangents);
        }
        for (const Influence& by : g.influences) {
            hash.word(by.joint);
            hash.word(std::bit_cast<uint32_t>(by.weight));
        }
    }
}

void hash_skin(Hasher& hash, const Skin& skin) {
    for (const Id<Node> joint : skin.joints) hash.word(joint.value);
    hash.array(skin.joint_from_mesh);
}

void hash_clip(Hasher& hash, const Clip& clip) {
    hash.word(clip.channels.size());
    for (const Channel& channel : clip.channels) {
        hash.word(channel.node.value);
        hash.word(uint64_t(channel.property));
        hash.word(uint64_t(channel.keyframes->interpolation));
        hash.array(channel.keyframes->times);
        hash.array(channel.keyframes->values);
    }
}

template <class T> void hash_fields(Hasher& hash, const Table<T>& table) {
    hash.word(table.size());
    for (const auto& [id, record] : table) {
        hash.word(id.value);
        visit_fields(record, hash);
    }
}

} // namespace

std::string scene_hash(const Scene& scene) {
    Hasher hash;
    hash_fields(hash, scene.nodes);
    for (const auto& [id, node] : scene.nodes)
        if (node.instances) {
            hash.word(id.value);
            hash.array(node.instances->node_from_copy);
        }
    hash_fields(hash, scene.materials);
    hash_fields(hash, scene.lights);
    for (const auto& [id, light] : scene.lights) hash_profile(hash, light.ies);
    hash_fields(hash, scene.textures);
    for (const auto& [id, texture] : scene.textures) hash_image(hash, texture.image);
    for (const auto& [id, mesh] : scene.meshes) {
        hash.word(id.value);
        hash_mesh(hash, mesh);
    }
    for (const auto& [id, skin] : scene.skins) hash_skin(hash, skin);
    for (const auto& [id, clip] : scene.clips) hash_clip(hash, clip);
    visit_fields(scene.scene_selection, hash);
    visit_fields(scene.environment, hash);
    if (scene.environment.kind == Environment::Kind::image) hash_image(hash, scene.environment.image);
    // The pivot does not affect the image; position, rotation and lens do.
    hash("position", scene.view.position);
    hash("rotation", scene.view.rotation);
    hash("lens", scene.view.lens);
    return fmt::format("{:016x}", hash.value());
}

} // namespace blush
