#include "render/material_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace blush {
namespace {

// NaN becomes `low`.
float within(float x, float low, float high) { return x >= low ? std::min(x, high) : low; }
float unit(float x) { return within(x, 0, 1); }
Vec3 within(const Vec3& v, float low, float high) { return {within(v.x, low, high), within(v.y, low, high), within(v.z, low, high)}; }

constexpr float max_radiance = 1e30f; // nits: whatever is multiplied with it on a path stays finite

// Which lobes a material has, after the order of precedence of glTF's parameters.
bool reflects(const Material& m) { return !m.unlit && (m.specular > 0 || m.metallic > 0 || m.transmission > 0); }
bool transmits(const Material& m) { return !m.unlit && m.transmission > 0; }
bool has_normal_map(const Material& m) { return !m.unlit && m.normal_texture.texture && m.normal_scale != 0; }
bool is_thin(const Material& m) { return !(m.thickness > 0); }
Vec3 sigma_of(const Material& m) {
    return transmits(m) && !is_thin(m) ? absorption(m.attenuation_color, m.attenuation_distance) : Vec3{0, 0, 0};
}

struct TextureSlot {
    TextureRef Material::*ref;
    int32_t MaterialRecord::*index;
    bool is_color;
    bool (*is_read)(const Material&);
};
constexpr std::array texture_slots{
    TextureSlot{&Material::base_color_texture, &MaterialRecord::base_color_texture, true, [](const Material&) { return true; }},
    TextureSlot{&Material::metallic_roughness_texture, &MaterialRecord::metallic_roughness_texture, false, reflects},
    TextureSlot{&Material::normal_texture, &MaterialRecord::normal_texture, false, has_normal_map},
    TextureSlot{&Material::emissive_texture, &MaterialRecord::emissive_texture, true,
                [](const Material& m) { return !is_black(emission_of(m)); }},
    TextureSlot{&Material::specular_texture, &MaterialRecord::specular_texture, false,
                [](const Material& m) { return !m.unlit && m.specular > 0; }},
    TextureSlot{&Material::specular_color_texture, &MaterialRecord::specular_color_texture, true,
                [](const Material& m) { return !m.unlit && m.specular > 0; }},
    TextureSlot{&Material::transmission_texture, &MaterialRecord::transmission_texture, false, transmits},
};

bool is_read(const TextureSlot& slot, const Material& m) { return (m.*slot.ref).texture && slot.is_read(m); }

// Those of all meshes, each once.
std::vector<const Material*> worn_materials(const Scene& scene) {
    std::set<Id<Material>> ids;
    for (const auto& [id, mesh] : scene.meshes) {
        for (const MeshPart& part : mesh.parts) ids.insert(part.material);
    }
    std::vector<const Material*> materials;
    for (const Id<Material> id : ids)
        if (const Material* material = scene.materials.find(id)) materials.push_back(material);
    return materials;
}

// The UV sets that these materials read, ascending, whatever their number.
std::vector<int> uv_sets_of(const std::vector<const Material*>& materials) {
    std::set<int> sets;
    for (const Material* material : materials) sets.merge(texture_reads(*material).uv_sets);
    return {sets.begin(), sets.end()};
}

// What these materials read, in the order the texture table wants.
std::vector<TextureSource> texture_sources(const Scene& scene, const std::vector<const Material*>& materials) {
    std::vector<std::tuple<Id<Texture>, bool>> keys;
    for (const Material* material : materials) {
        for (const TextureSlot& slot : texture_slots) {
            if (is_read(slot, *material)) keys.emplace_back((material->*slot.ref).texture, slot.is_color);
        }
    }
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

    std::vector<TextureSource> sources;
    for (const auto& [id, is_color] : keys) {
        const Texture* t = scene.textures.find(id);
        if (t && t->image) sources.push_back({id, is_color, t->image, t->wrap_u, t->wrap_v, t->filter, t->name});
    }
    return sources;
}

MaterialRecord factors_of(const Material& m) {
    MaterialRecord r;
    r.base_color = within(m.base_color, 0, 1);
    if (reflects(m)) {
        r.metallic = unit(m.metallic);
        r.roughness = unit(m.roughness);
        r.ior = m.ior == 0 ? 0 : within(m.ior, 1, 1000);
        r.specular = unit(m.specular);
        r.specular_color = within(m.specular_color, 0, max_radiance);
    }
    if (transmits(m)) {
        r.transmission = unit(m.transmission);
        if (is_thin(m)) r.flags |= material_thin;
        r.sigma_a = sigma_of(m);
    }
    if (has_normal_map(m) && std::isfinite(m.normal_scale)) r.normal_scale = m.normal_scale;
    r.emission = emission_of(m);
    if (!is_black(r.emission)) r.flags |= material_emissive;
    if (m.double_sided) r.flags |= material_double_sided;
    if (m.unlit) r.flags |= material_unlit;
    if (m.alpha != Material::Alpha::opaque) {
        r.alpha = m.alpha == Material::Alpha::mask ? alpha_mask : alpha_blend;
        r.opacity = unit(m.opacity);
        r.alpha_cutoff = within(m.alpha_cutoff, 0, 2); // above 1 nothing is left, as glTF says
    }
    return r;
}

// KHR_texture_transform: scaled, rotated counter-clockwise as seen with v downwards, moved. The listing in the
// specification's text turns the other way; its words and every implementation turn this way (KhronosGroup/glTF issue 1563).
TextureUse texture_use(const TextureRef& ref, int32_t texture, int32_t uv_set) {
    const double c = std::cos(double(ref.rotation_radians)), s = std::sin(double(ref.rotation_radians));
    TextureUse use{};
    use.texture = texture;
    use.uv_set = uv_set;
    use.u_from_u = float(c * ref.scale.x);
    use.u_from_v = float(s * ref.scale.y);
    use.u_offset = ref.offset.x;
    use.v_from_u = float(-s * ref.scale.x);
    use.v_from_v = float(c * ref.scale.y);
    use.v_offset = ref.offset.y;
    return use;
}

void choose_uv_sets(MaterialTable& table, const std::vector<const Material*>& worn) {
    table.uv_sets = uv_sets_of(worn);
    table.warnings.clear();
    if (table.uv_sets.size() <= most_uv_sets) return;
    table.warnings.push_back({Diagnostic::Severity::warning,
                              fmt::format("textures lie on {} UV sets; those on sets beyond {} are read as white", table.uv_sets.size(),
                                          table.uv_sets[most_uv_sets - 1]),
                              "materials"});
    table.uv_sets.resize(most_uv_sets);
}

void write_material(MaterialTable& table, size_t index, const Material& material) {
    MaterialRecord record = factors_of(material);
    for (size_t k = 0; k < texture_slots.size(); ++k) {
        const TextureSlot& slot = texture_slots[k];
        const TextureRef& ref = material.*slot.ref;
        const auto uv_set = std::ranges::find(table.uv_sets, int(ref.uv_set));
        const bool reads = is_read(slot, material) && uv_set != table.uv_sets.end();
        const int32_t texture = reads ? table.textures.index_of(ref.texture, slot.is_color) : -1;
        const size_t use = index * texture_slots.size() + k;
        table.uses[use] = texture < 0 ? TextureUse{} : texture_use(ref, texture, int32_t(uv_set - table.uv_sets.begin()));
        if (texture >= 0) record.*slot.index = int32_t(use);
    }
    table.records[index] = record;
}

} // namespace

Vec3 emission_of(const Material& m) {
    if (m.unlit) return {0, 0, 0};
    const auto channel = [&](float c) { return within(c * m.emissive_strength, 0, max_radiance); };
    return {channel(m.emissive.x), channel(m.emissive.y), channel(m.emissive.z)};
}

int32_t MaterialTable::index_of(Id<Material> id) const {
    const auto it = std::ranges::lower_bound(ids, id);
    return it != ids.end() && *it == id ? int32_t(it - ids.begin()) + 1 : 0;
}

MaterialTables MaterialTable::tables() const {
    MaterialTables t{records.data(), textures.tables()};
    t.textures.uses = uses.data();
    t.textures.uv_sets = int32_t(uv_sets.size());
    return t;
}

void build_material_table(MaterialTable& table, const Scene& scene) {
    const std::vector<const Material*> worn = worn_materials(scene);
    std::vector<TextureSource> sources = texture_sources(scene, worn);
    if (sources != table.textures.sources) {
        table.textures = {}; // frees the old texels before the new ones are there
        table.textures = build_texture_table(std::move(sources));
    }
    choose_uv_sets(table, worn);
    const size_t count = scene.materials.size() + 1;
    table.ids.clear();
    table.records.resize(count);
    table.uses.resize(count * texture_slots.size());
    write_material(table, 0, Material{});
    for (const auto& [id, material] : scene.materials) {
        table.ids.push_back(id);
        write_material(table, table.ids.size(), material);
    }
}

bool update_material(MaterialTable& table, const Scene& scene, Id<Material> id) {
    const Material* material = scene.materials.find(id);
    const bool same_materials = std::ranges::equal(table.ids, scene.materials, {}, {}, &Table<Material>::Entry::id);
    if (!material || !same_materials) return false;
    const std::vector<const Material*> worn = worn_materials(scene);
    if (uv_sets_of(worn) != table.uv_sets || texture_sources(scene, worn) != table.textures.sources) return false;
    write_material(table, size_t(table.index_of(id)), *material);
    return true;
}

TextureReads texture_reads(const Material& m) {
    TextureReads reads;
    for (const TextureSlot& slot : texture_slots)
        if (is_read(slot, m)) reads.uv_sets.insert((m.*slot.ref).uv_set);
    reads.normal_map = has_normal_map(m);
    return reads;
}

Features features_of(const Material& m) {
    Features f = no_features;
    if (reflects(m)) f = f.with(Feature::specular);
    if (transmits(m)) f = f.with(Feature::transmission);
    if (!is_black(sigma_of(m))) f = f.with(Feature::absorption);
    if (std::ranges::any_of(texture_slots, [&](const TextureSlot& slot) { return is_read(slot, m); })) f = f.with(Feature::textures);
    if (has_normal_map(m)) f = f.with(Feature::normal_maps);
    if (m.unlit) f = f.with(Feature::unlit);
    if (!is_black(emission_of(m))) f = f.with(Feature::emissive_triangles);
    return f;
}

Vec3 absorption(const Vec3& color, float distance) {
    if (!(distance > 0) || !std::isfinite(distance)) return {0, 0, 0};
    const auto channel = [&](float c) { return float(std::min(-std::log(double(within(c, 0x1p-24f, 1))) / distance, 1e30)); };
    return {channel(color.x), channel(color.y), channel(color.z)};
}

} // namespace blush
