#include "render/materials/material_table.h"

#include "render/materials/material_factors.h"
#include "render/materials/material_layers.h"
#include "shading/microfacet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace blush {
namespace {

constexpr float max_radiance = 1e30f; // nits: products along a path stay finite

bool has_normal_map(const Material& m) { return !m.unlit && m.normal_texture.texture && m.normal_scale != 0; }
Vec3 sigma_of(const Material& m) { return is_solid(m) ? absorption(m.attenuation_color, m.attenuation_distance) : Vec3{0, 0, 0}; }

constexpr std::array texture_slots{
    CompiledSlot<MaterialRecord>{&Material::base_color_texture, &MaterialRecord::base_color_texture, true,
                                 [](const Material&) { return true; }},
    CompiledSlot<MaterialRecord>{&Material::metallic_roughness_texture, &MaterialRecord::metallic_roughness_texture, false, reflects},
    CompiledSlot<MaterialRecord>{&Material::normal_texture, &MaterialRecord::normal_texture, false, has_normal_map},
    CompiledSlot<MaterialRecord>{&Material::emissive_texture, &MaterialRecord::emissive_texture, true,
                                 [](const Material& m) { return !is_black(emission_of(m)); }},
    CompiledSlot<MaterialRecord>{&Material::specular_texture, &MaterialRecord::specular_texture, false,
                                 [](const Material& m) { return !m.unlit && m.specular > 0; }},
    CompiledSlot<MaterialRecord>{&Material::specular_color_texture, &MaterialRecord::specular_color_texture, true,
                                 [](const Material& m) { return !m.unlit && m.specular > 0; }},
    CompiledSlot<MaterialRecord>{&Material::transmission_texture, &MaterialRecord::transmission_texture, false, transmits},
};

constexpr size_t slots_per_material = texture_slots.size() + layer_texture_slots.size();

// Calls visit(slot) for each slot that a material reads.
template <class Visit> void each_read_slot(const Material& m, const Visit& visit) {
    for (const auto& slot : texture_slots)
        if (slot.is_read(m)) visit(slot);
    for (const auto& slot : layer_texture_slots)
        if (slot.is_read(m)) visit(slot);
}

// Materials of all meshes, each once.
std::vector<const Material*> used_materials(const Scene& scene) {
    std::set<Id<Material>> ids;
    for (const auto& [id, mesh] : scene.meshes) {
        for (const MeshPart& part : mesh.parts) ids.insert(part.material);
    }
    std::vector<const Material*> materials;
    for (const Id<Material> id : ids)
        if (const Material* material = scene.materials.find(id)) materials.push_back(material);
    return materials;
}

// The UV sets that these materials use, ascending, without limit.
std::vector<int> uv_sets_of(const std::vector<const Material*>& materials) {
    std::set<int> sets;
    for (const Material* material : materials) sets.merge(texture_reads(*material).uv_sets);
    return {sets.begin(), sets.end()};
}

// The textures that these materials use, in the order that the texture table needs.
std::vector<TextureSource> texture_sources(const Scene& scene, const std::vector<const Material*>& materials) {
    std::vector<std::tuple<Id<Texture>, bool>> keys;
    for (const Material* material : materials) {
        each_read_slot(*material, [&](const auto& slot) { keys.emplace_back((material->*slot.ref).texture, slot.is_color); });
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

// True if delta lobes of the material can be events of manifold sampling: their normal is the interpolated one, and they are the same
// whatever the width that textures are filtered over.
bool may_chain(const Material& m) {
    return is_smooth(m) && !m.metallic_roughness_texture.texture && !has_normal_map(m) && m.alpha == Material::Alpha::opaque &&
           !is_coated(m) && !has_sheen(m) && !is_anisotropic(m) && !is_translucent(m) && (!transmits(m) || is_solid(m));
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
    if (transmits(m)) r.transmission = unit(m.transmission);
    if ((transmits(m) || is_translucent(m)) && is_thin(m)) r.flags |= material_thin;
    r.sigma_a = sigma_of(m);
    if (has_normal_map(m) && std::isfinite(m.normal_scale)) r.normal_scale = m.normal_scale;
    r.emission = emission_of(m);
    if (!is_black(r.emission)) r.flags |= material_emissive;
    if (m.double_sided) r.flags |= material_double_sided;
    if (m.unlit) r.flags |= material_unlit;
    if (may_pass_straight(m)) r.flags |= material_pane;
    if (may_chain(m)) r.flags |= material_chains;
    if (m.alpha != Material::Alpha::opaque) {
        r.alpha = m.alpha == Material::Alpha::mask ? alpha_mask : alpha_blend;
        r.opacity = unit(m.opacity);
        r.alpha_cutoff = within(m.alpha_cutoff, 0, 2); // above 1 all is cut out, as in the glTF specification
    }
    return r;
}

// KHR_texture_transform: scale, rotate counter-clockwise as seen with v downwards, translate. The listing in the specification
// rotates the other way; its text and all implementations rotate this way (KhronosGroup/glTF issue 1563).
TextureUse texture_use(const TextureRef& ref, int32_t texture, float texels_per_unit, int32_t uv_set) {
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
    // rotation keeps the area
    use.texels_per_uv = float(std::sqrt(std::abs(double(ref.scale.x) * ref.scale.y))) * texels_per_unit;
    return use;
}

void choose_uv_sets(MaterialTable& table, const std::vector<const Material*>& used) {
    table.uv_sets = uv_sets_of(used);
    table.warnings.clear();
    if (table.uv_sets.size() <= max_uv_sets) return;
    table.warnings.push_back({Diagnostic::Severity::warning,
                              fmt::format("textures use {} UV sets; those on sets beyond {} are read as white", table.uv_sets.size(),
                                          table.uv_sets[max_uv_sets - 1]),
                              "materials"});
    table.uv_sets.resize(max_uv_sets);
}

// Writes the texture uses of one record of a material, starting at index `use`.
template <class Record, size_t N> void write_uses(MaterialTable& table, size_t use, const Material& material,
                                                  const std::array<CompiledSlot<Record>, N>& slots, Record& record) {
    for (const CompiledSlot<Record>& slot : slots) {
        const TextureRef& ref = material.*slot.ref;
        const auto uv_set = std::ranges::find(table.uv_sets, int(ref.uv_set));
        const bool reads = slot.is_read(material) && uv_set != table.uv_sets.end();
        const int32_t texture = reads ? table.textures.index_of(ref.texture, slot.is_color) : -1;
        table.uses[use] = texture < 0
                              ? TextureUse{}
                              : texture_use(ref, texture, table.textures.texels_per_unit(texture), int32_t(uv_set - table.uv_sets.begin()));
        if (texture >= 0) record.*slot.index = int32_t(use);
        ++use;
    }
}

void write_material(MaterialTable& table, size_t index, const Material& material) {
    table.records[index] = factors_of(material);
    table.layers[index] = layer_factors_of(material);
    const size_t use = index * slots_per_material;
    write_uses(table, use, material, texture_slots, table.records[index]);
    write_uses(table, use + texture_slots.size(), material, layer_texture_slots, table.layers[index]);
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
    MaterialTables t{records.data(), layers.data(), textures.tables()};
    t.textures.uses = uses.data();
    t.textures.uv_sets = int32_t(uv_sets.size());
    return t;
}

void build_material_table(MaterialTable& table, const Scene& scene, const Workers* workers) {
    const std::vector<const Material*> used = used_materials(scene);
    std::vector<TextureSource> sources = texture_sources(scene, used);
    if (sources != table.textures.sources) table.textures = build_texture_table(std::move(sources), std::move(table.textures), workers);
    choose_uv_sets(table, used);
    const size_t count = scene.materials.size() + 1;
    table.ids.clear();
    table.records.resize(count);
    table.layers.resize(count);
    table.uses.resize(count * slots_per_material);
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
    const std::vector<const Material*> used = used_materials(scene);
    if (uv_sets_of(used) != table.uv_sets || texture_sources(scene, used) != table.textures.sources) return false;
    write_material(table, size_t(table.index_of(id)), *material);
    return true;
}

TextureReads texture_reads(const Material& m) {
    TextureReads reads;
    each_read_slot(m, [&](const auto& slot) { reads.uv_sets.insert((m.*slot.ref).uv_set); });
    reads.tangents = has_normal_map(m) || has_coat_normal_map(m) || is_anisotropic(m);
    return reads;
}

Features features_of(const Material& m) {
    Features f = layer_features_of(m);
    if (reflects(m)) f = f.with(Feature::specular);
    if (transmits(m) || is_solid(m)) f = f.with(Feature::transmission);
    if (!is_black(sigma_of(m))) f = f.with(Feature::absorption);
    each_read_slot(m, [&](const auto&) { f = f.with(Feature::textures); });
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
