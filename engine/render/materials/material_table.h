// A scene's materials as records for kernels, and the kernel features that each needs.
#pragma once

#include "render/materials/texture_table.h"
#include "scene/scene.h"
#include "shading/features.h"
#include "shading/material.h"

#include <cstdint>
#include <set>
#include <vector>

namespace blush {

struct MaterialTable {
    std::vector<Id<Material>> ids;       // of records[1], records[2], ...; ascending
    std::vector<MaterialRecord> records; // the first is glTF's default material
    std::vector<LayerRecord> layers;     // parallel to `records`
    std::vector<TextureUse> uses;        // a fixed number per record, so that one can change alone
    TextureTable textures;
    std::vector<int> uv_sets;         // the UV set numbers used by textures, ascending, at most max_uv_sets
    std::vector<Diagnostic> warnings; // in addition to those of the textures

    // 0, the default material, for an unknown id.
    int32_t index_of(Id<Material> id) const;
    // Valid until the table changes.
    MaterialTables tables() const;
};

// Updates the table to the scene; texels are kept if the scene still uses the same textures. The result depends on the scene
// alone. Only textures used by materials of some mesh are included. `workers`: share the work; null: single-threaded.
void build_material_table(MaterialTable& table, const Scene& scene, const Workers* workers = nullptr);
// Rewrites the record of one material. False, without changes, if the table
// must be rebuilt: the set of used textures, UV sets or materials differs.
bool update_material(MaterialTable& table, const Scene& scene, Id<Material> id);

// The mesh attributes that a material's textures need.
struct TextureReads {
    std::set<int> uv_sets;
    bool tangents = false;
};
TextureReads texture_reads(const Material& material);

// Emission in nits, before its texture; 0 for unlit materials.
Vec3 emission_of(const Material& material);
inline bool is_black(const Vec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// Features that a kernel needs to render the material. Vertex colours are a feature of the geometry and not included.
Features features_of(const Material& material);

// Absorption coefficient in 1/m such that `color` of white light is left after `distance` metres: -ln(color) / distance. Colours
// are clamped to [2^-24, 1]: 0 would give infinite absorption, and 24-bit mantissas cannot show the difference. No absorption for
// distance 0, which stands for glTF's infinity.
Vec3 absorption(const Vec3& color, float distance);

} // namespace blush
