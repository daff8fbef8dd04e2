// A scene's materials as records that rays read, and what each of them needs of a kernel.
#pragma once

#include "render/texture_table.h"
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
    std::vector<LayerRecord> layers;     // beside each of them
    std::vector<TextureUse> uses;        // a fixed number per record, so that one can change alone
    TextureTable textures;
    std::vector<int> uv_sets;            // the numbers of those that textures lie on, ascending, at most most_uv_sets
    std::vector<Diagnostic> warnings;    // beside those of the textures

    // Of the default material for an id that does not exist.
    int32_t index_of(Id<Material> id) const;
    // Valid until the table changes.
    MaterialTables tables() const;
};

// Brings the table up to date with the scene; texels are kept if the scene still reads the same textures. The result depends
// on the scene alone. Only textures that materials of some mesh read are in it. `workers`: share the work; null: none.
void build_material_table(MaterialTable& table, const Scene& scene, const Workers* workers = nullptr);
// Rewrites the record of one material. False, and nothing has changed, if the table must be built anew: the set of textures
// that are read, of their UV sets, or of materials is another.
bool update_material(MaterialTable& table, const Scene& scene, Id<Material> id);

// What of a mesh a material's textures are laid out by.
struct TextureReads {
    std::set<int> uv_sets;
    bool tangents = false;
};
TextureReads texture_reads(const Material& material);

// Nits of a surface, before its texture; an unlit one does not shine.
Vec3 emission_of(const Material& material);
inline bool is_black(const Vec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// What a kernel must know to render the material right. Vertex colours are the geometry's and not among them.
Features features_of(const Material& material);

// Absorption coefficient in 1/m that leaves `color` of white light after `distance` metres: -ln(color) / distance. Colours are
// cut to [2^-24, 1]: a colour of 0 would absorb infinitely, and no 24-bit mantissa sees the difference. No absorption for
// distance 0, which stands for glTF's infinity.
Vec3 absorption(const Vec3& color, float distance);

} // namespace blush
