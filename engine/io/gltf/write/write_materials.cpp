#include "io/gltf/write/write.h"

#include <algorithm>

namespace blush {
namespace {

// Writes a material into its object.
class MaterialWriter {
public:
    MaterialWriter(GltfDocument& document, Json& object, const Material& material) : document_(document), object_(object), m_(material) {}

    void write() {
        // An edited material is written in its converted form.
        erase_extension(object_, "KHR_materials_pbrSpecularGlossiness");
        write_core();
        write_alpha();
        write_emission();
        write_dielectric();
        write_transmission();
        write_clearcoat();
        write_sheen();
        write_anisotropy();
        write_iridescence();
        write_diffuse_transmission();
        write_unlit();
    }

private:
    const Json& existing(const char* name) const { return child_or_null(child_or_null(object_, "extensions"), name); }
    // The extension object, created if `wanted` and the material is not unlit; null if absent.
    Json* extension(const char* name, bool wanted) {
        return (wanted && !m_.unlit) || existing(name).is_object() ? &extension_of(object_, name) : nullptr;
    }

    // Keeps references to textures that could not be imported.
    void texture(Json& parent, const char* key, const TextureRef& ref) {
        const auto index = document_.indices.textures.find(ref.texture);
        if (index == document_.indices.textures.end()) {
            int now = -1;
            read_json(child_or_null(child_or_null(parent, key), "index"), now);
            const bool shown = std::ranges::any_of(document_.indices.textures, [&](const auto& entry) { return entry.second == now; });
            if (shown) erase(parent, key);
            return;
        }
        Json& info = child(parent, key);
        set_index(info, "index", index->second);
        set_number(info, "texCoord", ref.uv_set, 0);
        const TextureRef plain;
        if (ref.offset == plain.offset && ref.scale == plain.scale && ref.rotation_radians == plain.rotation_radians &&
            !child_or_null(child_or_null(info, "extensions"), "KHR_texture_transform").is_object())
            return;
        Json& transform = extension_of(info, "KHR_texture_transform");
        erase(transform, "texCoord");
        set_vector(transform, "offset", {ref.offset.x, ref.offset.y}, {0, 0});
        set_vector(transform, "scale", {ref.scale.x, ref.scale.y}, {1, 1});
        set_number(transform, "rotation", ref.rotation_radians, 0);
    }

    void write_core() {
        Json& pbr = child(object_, "pbrMetallicRoughness");
        set_vector(pbr, "baseColorFactor", {m_.base_color.x, m_.base_color.y, m_.base_color.z, m_.opacity}, {1, 1, 1, 1});
        set_number(pbr, "metallicFactor", m_.metallic, 1);
        set_number(pbr, "roughnessFactor", m_.roughness, 1);
        texture(pbr, "baseColorTexture", m_.base_color_texture);
        texture(pbr, "metallicRoughnessTexture", m_.metallic_roughness_texture);
        if (pbr.empty()) erase(object_, "pbrMetallicRoughness");
        texture(object_, "normalTexture", m_.normal_texture);
        if (const auto normal = object_.find("normalTexture"); normal != object_.end()) set_number(*normal, "scale", m_.normal_scale, 1);
    }

    void write_alpha() {
        const char* const mode = m_.alpha == Material::Alpha::mask ? "MASK" : m_.alpha == Material::Alpha::blend ? "BLEND" : "OPAQUE";
        const Json& now = child_or_null(object_, "alphaMode");
        if (now != mode && !(now.is_null() && m_.alpha == Material::Alpha::opaque)) object_["alphaMode"] = mode;
        // alphaCutoff is allowed in MASK mode only.
        if (m_.alpha == Material::Alpha::mask)
            set_number(object_, "alphaCutoff", m_.alpha_cutoff, 0.5f);
        else
            erase(object_, "alphaCutoff");
        // KHR_materials_volume is for closed, single-sided surfaces.
        if (!existing("KHR_materials_volume").is_object()) set_flag(object_, "doubleSided", m_.double_sided);
    }

    // A factor above 1 is moved into the strength; a strength without a factor has no effect.
    void write_emission() {
        const float largest = std::max({m_.emissive.x, m_.emissive.y, m_.emissive.z}), scale = std::max(largest, 1.0f);
        set_vector(object_, "emissiveFactor", {m_.emissive.x / scale, m_.emissive.y / scale, m_.emissive.z / scale}, {0, 0, 0});
        texture(object_, "emissiveTexture", m_.emissive_texture);
        const float strength = m_.emissive_strength * scale;
        if (largest == 0)
            erase_extension(object_, "KHR_materials_emissive_strength");
        else if (Json* e = extension("KHR_materials_emissive_strength", strength != 1))
            set_number(*e, "emissiveStrength", strength, 1);
    }

    void write_dielectric() {
        if (Json* e = extension("KHR_materials_ior", m_.ior != 1.5f)) set_number(*e, "ior", m_.ior, 1.5f);
        const Vec3& c = m_.specular_color;
        const bool specular = m_.specular != 1 || c != Vec3{1, 1, 1} || m_.specular_texture.texture || m_.specular_color_texture.texture;
        if (Json* e = extension("KHR_materials_specular", specular)) {
            set_number(*e, "specularFactor", m_.specular, 1);
            set_vector(*e, "specularColorFactor", {c.x, c.y, c.z}, {1, 1, 1});
            texture(*e, "specularTexture", m_.specular_texture);
            texture(*e, "specularColorTexture", m_.specular_color_texture);
        }
    }

    void write_transmission() {
        const bool transmits = m_.transmission != 0 || m_.transmission_texture.texture;
        if (Json* e = extension("KHR_materials_transmission", transmits)) {
            set_number(*e, "transmissionFactor", m_.transmission, 0);
            texture(*e, "transmissionTexture", m_.transmission_texture);
        }
        const Vec3& c = m_.attenuation_color;
        const bool volume = m_.thickness != 0 || c != Vec3{1, 1, 1} || m_.attenuation_distance != 0;
        if (Json* e = extension("KHR_materials_volume", volume && transmits && !m_.double_sided)) {
            set_number(*e, "thicknessFactor", m_.thickness, 0);
            set_vector(*e, "attenuationColor", {c.x, c.y, c.z}, {1, 1, 1});
            if (m_.attenuation_distance > 0)
                set_number(*e, "attenuationDistance", m_.attenuation_distance, 0);
            else
                erase(*e, "attenuationDistance");
        }
        // Dispersion requires a volume.
        const bool disperses = m_.dispersion != 0 && existing("KHR_materials_volume").is_object();
        if (Json* e = extension("KHR_materials_dispersion", disperses)) set_number(*e, "dispersion", m_.dispersion, 0);
    }

    void write_clearcoat() {
        const bool coated = m_.clearcoat != 0 || m_.clearcoat_roughness != 0 || m_.clearcoat_texture.texture ||
                            m_.clearcoat_roughness_texture.texture || m_.clearcoat_normal_texture.texture;
        Json* const e = extension("KHR_materials_clearcoat", coated);
        if (!e) return;
        set_number(*e, "clearcoatFactor", m_.clearcoat, 0);
        set_number(*e, "clearcoatRoughnessFactor", m_.clearcoat_roughness, 0);
        texture(*e, "clearcoatTexture", m_.clearcoat_texture);
        texture(*e, "clearcoatRoughnessTexture", m_.clearcoat_roughness_texture);
        texture(*e, "clearcoatNormalTexture", m_.clearcoat_normal_texture);
        if (const auto normal = e->find("clearcoatNormalTexture"); normal != e->end())
            set_number(*normal, "scale", m_.clearcoat_normal_scale, 1);
    }

    void write_sheen() {
        const Vec3& c = m_.sheen_color;
        const bool has_sheen =
            c != Vec3{0, 0, 0} || m_.sheen_roughness != 0 || m_.sheen_color_texture.texture || m_.sheen_roughness_texture.texture;
        if (Json* e = extension("KHR_materials_sheen", has_sheen)) {
            set_vector(*e, "sheenColorFactor", {c.x, c.y, c.z}, {0, 0, 0});
            set_number(*e, "sheenRoughnessFactor", m_.sheen_roughness, 0);
            texture(*e, "sheenColorTexture", m_.sheen_color_texture);
            texture(*e, "sheenRoughnessTexture", m_.sheen_roughness_texture);
        }
    }

    void write_anisotropy() {
        const bool stretched = m_.anisotropy != 0 || m_.anisotropy_rotation_radians != 0 || m_.anisotropy_texture.texture;
        if (Json* e = extension("KHR_materials_anisotropy", stretched)) {
            set_number(*e, "anisotropyStrength", m_.anisotropy, 0);
            set_number(*e, "anisotropyRotation", m_.anisotropy_rotation_radians, 0);
            texture(*e, "anisotropyTexture", m_.anisotropy_texture);
        }
    }

    void write_iridescence() {
        const Material plain;
        const bool has_film = m_.iridescence != 0 || m_.iridescence_ior != plain.iridescence_ior ||
                              m_.iridescence_thickness_minimum != plain.iridescence_thickness_minimum ||
                              m_.iridescence_thickness_maximum != plain.iridescence_thickness_maximum || m_.iridescence_texture.texture ||
                              m_.iridescence_thickness_texture.texture;
        if (Json* e = extension("KHR_materials_iridescence", has_film)) {
            set_number(*e, "iridescenceFactor", m_.iridescence, 0);
            set_number(*e, "iridescenceIor", m_.iridescence_ior, plain.iridescence_ior);
            set_number(*e, "iridescenceThicknessMinimum", m_.iridescence_thickness_minimum, plain.iridescence_thickness_minimum);
            set_number(*e, "iridescenceThicknessMaximum", m_.iridescence_thickness_maximum, plain.iridescence_thickness_maximum);
            texture(*e, "iridescenceTexture", m_.iridescence_texture);
            texture(*e, "iridescenceThicknessTexture", m_.iridescence_thickness_texture);
        }
    }

    void write_diffuse_transmission() {
        const Vec3& c = m_.diffuse_transmission_color;
        const bool translucent = m_.diffuse_transmission != 0 || c != Vec3{1, 1, 1} || m_.diffuse_transmission_texture.texture ||
                                 m_.diffuse_transmission_color_texture.texture;
        if (Json* e = extension("KHR_materials_diffuse_transmission", translucent)) {
            set_number(*e, "diffuseTransmissionFactor", m_.diffuse_transmission, 0);
            set_vector(*e, "diffuseTransmissionColorFactor", {c.x, c.y, c.z}, {1, 1, 1});
            texture(*e, "diffuseTransmissionTexture", m_.diffuse_transmission_texture);
            texture(*e, "diffuseTransmissionColorTexture", m_.diffuse_transmission_color_texture);
        }
    }

    // KHR_materials_unlit must not be combined with other material extensions.
    void write_unlit() {
        constexpr const char* unlit = "KHR_materials_unlit";
        if (existing(unlit).is_object() == m_.unlit) return;
        if (!m_.unlit) return erase_extension(object_, unlit);
        const Json& extensions = child_or_null(object_, "extensions");
        const bool alone = std::ranges::none_of(extensions.items(), [](const auto& e) { return e.key().starts_with("KHR_materials_"); });
        if (alone) extension_of(object_, unlit);
    }

    GltfDocument& document_;
    Json& object_;
    const Material& m_;
};

} // namespace

void write_material(GltfDocument& document, Json& object, const Material& material) { MaterialWriter(document, object, material).write(); }

void write_sampler(GltfDocument& document, Json& object, const Texture& texture) {
    constexpr int wraps[] = {10497, 33071, 33648}; // GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT
    constexpr int nearest = 9728, linear = 9729;   // GL_NEAREST, GL_LINEAR
    int index = -1;
    const Json* samplers = document.find_list("samplers");
    const bool has_sampler =
        read_json(child_or_null(object, "sampler"), index) && index >= 0 && samplers && size_t(index) < samplers->size();
    Json sampler = has_sampler ? document.object("samplers", index) : Json::object();
    const Json before = sampler;
    const auto set = [&](const char* key, int value, int otherwise) {
        const Json& now = child_or_null(sampler, key);
        if (now != value && !(now.is_null() && value == otherwise)) sampler[key] = value;
    };
    set("wrapS", wraps[size_t(texture.wrap_u)], wraps[0]);
    set("wrapT", wraps[size_t(texture.wrap_v)], wraps[0]);
    set("magFilter", texture.filter == Texture::Filter::nearest ? nearest : linear, linear);
    if (sampler == before) return;
    // Other textures may share the sampler, so it is not changed.
    const Json& all = document.list("samplers");
    const auto same = std::find(all.begin(), all.end(), sampler);
    const int chosen = same != all.end() ? int(same - all.begin()) : document.append("samplers", std::move(sampler));
    set_index(object, "sampler", chosen);
}

} // namespace blush
