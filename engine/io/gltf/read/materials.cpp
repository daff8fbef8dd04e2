#include "io/gltf/read/materials.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/ids.h"
#include "io/gltf/read/object.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr const char* glossiness_extension = "KHR_materials_pbrSpecularGlossiness";

// Reads one material; the first error is kept, so that the many texture references need no test each.
class MaterialReader {
public:
    MaterialReader(const GltfContext& context, const std::vector<Id<Texture>>& textures, const Table<Texture>& pixels, size_t index)
        : context_(context), textures_(textures), pixels_(pixels), source_(context.model().materials[index]),
          where_(fmt::format("materials[{}]", index)) {
        material_.name = source_.name.empty() ? fmt::format("Material {}", index) : source_.name;
    }

    Result<Material> read() {
        read_core();
        read_alpha();
        const GltfObject extensions(context_, source_.extensions, where_ + ".extensions");
        read_emission(extensions);
        read_dielectric(extensions);
        read_transmission(extensions);
        read_clearcoat(extensions);
        read_sheen(extensions);
        read_anisotropy(extensions);
        read_iridescence(extensions);
        read_diffuse_transmission(extensions);
        material_.dispersion = extensions.object("KHR_materials_dispersion").number("dispersion", 0, 0, any_float);
        material_.unlit = extensions.has("KHR_materials_unlit");
        if (const GltfObject glossiness = extensions.object(glossiness_extension)) read_specular_glossiness(glossiness);
        if (error_) return *error_;
        return std::move(material_);
    }

private:
    float unit(double value, float otherwise, const char* key) const {
        return checked(context_, value, otherwise, 0, 1, where_ + "." + key);
    }

    // A reference by index, with KHR_texture_transform if present.
    TextureRef texture(int index, int uv_set, const GltfObject& extensions, const std::string& where) {
        TextureRef ref;
        if (index < 0) return ref;
        if (size_t(index) >= textures_.size()) {
            if (!error_) error_ = context_.error(fmt::format("texture {} does not exist; there are {}", index, textures_.size()), where);
            return ref;
        }
        const GltfObject transform = extensions.object("KHR_texture_transform");
        uv_set = transform.integer("texCoord").value_or(uv_set);
        if (uv_set < 0 || uv_set > max_uv_set) {
            context_.warn(fmt::format("ignored: a texture on TEXCOORD_{}; UV sets range from 0 to {}", uv_set, max_uv_set), where);
            return ref;
        }
        ref.texture = textures_[size_t(index)];
        if (!ref.texture) return {};
        ref.uv_set = uint8_t(uv_set);
        ref.offset = transform.vector2("offset", ref.offset);
        ref.scale = transform.vector2("scale", ref.scale);
        ref.rotation_radians = transform.number("rotation", 0, -any_float, any_float);
        return ref;
    }
    // From tinygltf's TextureInfo and similar types.
    template <class Info> TextureRef texture(const Info& info, const char* key) {
        const std::string where = where_ + "." + key;
        return texture(info.index, info.texCoord, GltfObject(context_, info.extensions, where + ".extensions"), where);
    }
    // From a textureInfo inside an extension.
    TextureRef texture(const GltfObject& info) {
        return info ? texture(info.integer("index").value_or(-1), info.integer("texCoord").value_or(0), info.object("extensions"),
                              info.where())
                    : TextureRef{};
    }

    void read_core() {
        const tinygltf::PbrMetallicRoughness& pbr = source_.pbrMetallicRoughness;
        if (pbr.baseColorFactor.size() == 4) {
            const std::vector<double>& f = pbr.baseColorFactor;
            material_.base_color = checked(context_, {f[0], f[1], f[2]}, {1, 1, 1}, 0, 1, where_ + ".baseColorFactor");
            material_.opacity = unit(f[3], 1, "baseColorFactor");
        } else {
            context_.warn("baseColorFactor does not have four numbers; white is used", where_);
        }
        material_.metallic = unit(pbr.metallicFactor, 1, "metallicFactor");
        material_.roughness = unit(pbr.roughnessFactor, 1, "roughnessFactor");
        material_.base_color_texture = texture(pbr.baseColorTexture, "baseColorTexture");
        material_.metallic_roughness_texture = texture(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
        material_.normal_texture = texture(source_.normalTexture, "normalTexture");
        material_.normal_scale = checked(context_, source_.normalTexture.scale, 1, -any_float, any_float, where_ + ".normalTexture.scale");
        material_.double_sided = source_.doubleSided;
        if (source_.occlusionTexture.index >= 0)
            context_.note("ignored: occlusion texture; path tracing computes occlusion itself", where_);
    }

    void read_alpha() {
        material_.alpha_cutoff = checked(context_, source_.alphaCutoff, 0.5f, 0, any_float, where_ + ".alphaCutoff");
        if (source_.alphaMode == "MASK")
            material_.alpha = Material::Alpha::mask;
        else if (source_.alphaMode == "BLEND")
            material_.alpha = Material::Alpha::blend;
        else if (source_.alphaMode != "OPAQUE")
            context_.warn("unknown alphaMode; OPAQUE is used", where_);
    }

    void read_emission(const GltfObject& extensions) {
        if (std::ranges::any_of(source_.emissiveFactor, [](double v) { return v > 1; }))
            context_.warn("above 1, which requires KHR_materials_emissive_strength; the value is used unchanged",
                          where_ + ".emissiveFactor");
        material_.emissive = checked(context_, source_.emissiveFactor, {0, 0, 0}, 0, any_float, where_ + ".emissiveFactor");
        material_.emissive_texture = texture(source_.emissiveTexture, "emissiveTexture");
        material_.emissive_strength = extensions.object("KHR_materials_emissive_strength").number("emissiveStrength", 1, 0, any_float);
    }

    void read_dielectric(const GltfObject& extensions) {
        // 0 means an infinite index (a mirror); other values are at least 1 (vacuum).
        const float ior = extensions.object("KHR_materials_ior").number("ior", 1.5f, 0, 1000);
        material_.ior = ior == 0 ? 0 : checked(context_, ior, 1.5f, 1, 1000, where_ + ".extensions.KHR_materials_ior.ior");
        const GltfObject specular = extensions.object("KHR_materials_specular");
        material_.specular = specular.number("specularFactor", 1, 0, 1);
        material_.specular_color = specular.vector3("specularColorFactor", {1, 1, 1}, 0, any_float);
        material_.specular_texture = texture(specular.object("specularTexture"));
        material_.specular_color_texture = texture(specular.object("specularColorTexture"));
    }

    void read_transmission(const GltfObject& extensions) {
        const GltfObject transmission = extensions.object("KHR_materials_transmission");
        material_.transmission = transmission.number("transmissionFactor", 0, 0, 1);
        material_.transmission_texture = texture(transmission.object("transmissionTexture"));
        const GltfObject volume = extensions.object("KHR_materials_volume");
        material_.thickness = volume.number("thicknessFactor", 0, 0, any_float);
        material_.attenuation_color = volume.vector3("attenuationColor", {1, 1, 1}, 0, 1);
        material_.attenuation_distance = volume.number("attenuationDistance", 0, 0, any_float);
        if (volume.has("attenuationDistance") && material_.attenuation_distance == 0)
            context_.warn("an attenuation distance of 0: absorption is ignored", volume.where() + ".attenuationDistance");
        if (volume.has("thicknessTexture")) context_.note("ignored: thickness texture; light travels through the mesh itself", where_);
    }

    void read_clearcoat(const GltfObject& extensions) {
        const GltfObject coat = extensions.object("KHR_materials_clearcoat"), normal = coat.object("clearcoatNormalTexture");
        material_.clearcoat = coat.number("clearcoatFactor", 0, 0, 1);
        material_.clearcoat_roughness = coat.number("clearcoatRoughnessFactor", 0, 0, 1);
        material_.clearcoat_normal_scale = normal.number("scale", 1, -any_float, any_float);
        material_.clearcoat_texture = texture(coat.object("clearcoatTexture"));
        material_.clearcoat_roughness_texture = texture(coat.object("clearcoatRoughnessTexture"));
        material_.clearcoat_normal_texture = texture(normal);
    }

    void read_sheen(const GltfObject& extensions) {
        const GltfObject sheen = extensions.object("KHR_materials_sheen");
        material_.sheen_color = sheen.vector3("sheenColorFactor", {0, 0, 0}, 0, 1);
        material_.sheen_roughness = sheen.number("sheenRoughnessFactor", 0, 0, 1);
        material_.sheen_color_texture = texture(sheen.object("sheenColorTexture"));
        material_.sheen_roughness_texture = texture(sheen.object("sheenRoughnessTexture"));
    }

    void read_anisotropy(const GltfObject& extensions) {
        const GltfObject anisotropy = extensions.object("KHR_materials_anisotropy");
        material_.anisotropy = anisotropy.number("anisotropyStrength", 0, 0, 1);
        material_.anisotropy_rotation_radians = anisotropy.number("anisotropyRotation", 0, -any_float, any_float);
        material_.anisotropy_texture = texture(anisotropy.object("anisotropyTexture"));
    }

    void read_iridescence(const GltfObject& extensions) {
        const GltfObject film = extensions.object("KHR_materials_iridescence");
        material_.iridescence = film.number("iridescenceFactor", 0, 0, 1);
        material_.iridescence_ior = film.number("iridescenceIor", 1.3f, 1, 1000);
        material_.iridescence_thickness_minimum = film.number("iridescenceThicknessMinimum", 100, 0, any_float);
        material_.iridescence_thickness_maximum = film.number("iridescenceThicknessMaximum", 400, 0, any_float);
        material_.iridescence_texture = texture(film.object("iridescenceTexture"));
        material_.iridescence_thickness_texture = texture(film.object("iridescenceThicknessTexture"));
    }

    void read_diffuse_transmission(const GltfObject& extensions) {
        const GltfObject diffuse = extensions.object("KHR_materials_diffuse_transmission");
        material_.diffuse_transmission = diffuse.number("diffuseTransmissionFactor", 0, 0, 1);
        material_.diffuse_transmission_color = diffuse.vector3("diffuseTransmissionColorFactor", {1, 1, 1}, 0, any_float);
        material_.diffuse_transmission_texture = texture(diffuse.object("diffuseTransmissionTexture"));
        material_.diffuse_transmission_color_texture = texture(diffuse.object("diffuseTransmissionColorTexture"));
    }

    // Converts the archived model to a dielectric of index 1.5 whose specular colour, which may exceed 1, gives the same F0. Its
    // diffuse part is diffuse * (1 - max(specular)). With a specular texture that factor is omitted, since the diffuse texture is
    // usually dark where the specular texture is bright. Glossiness is an alpha channel, which no roughness texture can refer to.
    void read_specular_glossiness(const GltfObject& model) {
        constexpr float f0 = 0.04f;
        const Vec3 specular = model.vector3("specularFactor", {1, 1, 1}, 0, 1);
        const TextureRef map = texture(model.object("specularGlossinessTexture"));
        const Vec4 diffuse = model.vector4("diffuseFactor", {1, 1, 1, 1}, 0, 1);
        const float left = map.texture ? 1 : 1 - std::max({specular.x, specular.y, specular.z});
        material_.base_color = {diffuse.x * left, diffuse.y * left, diffuse.z * left};
        material_.opacity = diffuse.w;
        material_.base_color_texture = texture(model.object("diffuseTexture"));
        material_.metallic = 0;
        material_.metallic_roughness_texture = {};
        material_.roughness = 1 - model.number("glossinessFactor", 1, 0, 1) * mean_alpha(map);
        material_.ior = 1.5f;
        material_.specular = 1;
        material_.specular_texture = {};
        material_.specular_color = {specular.x / f0, specular.y / f0, specular.z / f0};
        material_.specular_color_texture = map;
    }

    // Mean alpha; 1 without an image or alpha channel.
    float mean_alpha(const TextureRef& ref) const {
        const Texture* texture = pixels_.find(ref.texture);
        const Image* image = texture ? texture->image.get() : nullptr;
        if (!image || image->channels != 4) return 1;
        const size_t count = size_t(image->width) * size_t(image->height);
        double sum = 0;
        for (size_t i = 0; i < count; ++i) sum += image->bytes.empty() ? double(image->floats[4 * i + 3]) : image->bytes[4 * i + 3] / 255.0;
        return float(std::clamp(sum / double(count), 0.0, 1.0));
    }

    const GltfContext& context_;
    const std::vector<Id<Texture>>& textures_;
    const Table<Texture>& pixels_;
    const tinygltf::Material& source_;
    std::string where_;
    Material material_;
    std::optional<Error> error_;
};

// A path tracer needs back faces of walls: culled ones would let light from outside in.
void report_back_faces(const GltfContext& context) {
    const auto& materials = context.model().materials;
    const auto count = std::count_if(materials.begin(), materials.end(), [](const tinygltf::Material& m) { return !m.doubleSided; });
    if (count > 0)
        context.note(fmt::format("approximated: back faces of {} single-sided materials are not culled; they reflect like front faces but "
                                 "do not emit",
                                 count),
                     "materials");
}

} // namespace

bool depend_on_pixels(const GltfContext& context) {
    return std::ranges::any_of(context.model().materials,
                               [](const tinygltf::Material& m) { return m.extensions.contains(glossiness_extension); });
}

Result<std::vector<Id<Material>>> import_materials(const GltfContext& context, const std::vector<Id<Texture>>& textures, Scene& scene) {
    std::vector<std::optional<Material>> materials(context.model().materials.size());
    std::vector<uint32_t> wanted(materials.size());
    for (size_t i = 0; i < materials.size(); ++i) {
        const ParsedGltf& object = gltf_item(context.json(), "materials", i);
        if (is_fallback(object)) continue;
        Result<Material> material = MaterialReader(context, textures, scene.textures, i).read();
        if (!material) return material.error();
        read_extras(context, object, *material, fmt::format("materials[{}]", i));
        materials[i] = *std::move(material);
        wanted[i] = requested_id(object);
    }
    report_back_faces(context);
    return add_with_ids(scene.materials, std::move(materials), wanted);
}

} // namespace blush
