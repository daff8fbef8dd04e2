#include "ui/jobs/material_maps.h"

#include <algorithm>

namespace blush {

Result<void> set_map(Document& document, Id<Material> id, TextureRef Material::*slot, const std::string& label, Texture texture,
                     Gesture gesture) {
    if (!document.project().scene.materials.contains(id)) return Error{label, "the material that it was for is no longer there", ""};
    Scene carrier;
    carrier.textures.add(std::move(texture));
    const Edit import = Import{std::move(carrier), label};
    if (auto done = document.apply({&import, 1}, "Load " + label, gesture); !done) return done;
    Material material = *document.project().scene.materials.find(id);
    (material.*slot).texture = document.project().scene.textures.entries().back().id;
    auto done = document.apply(SetMaterial{id, std::move(material)}, gesture);
    if (!done) document.withdraw(gesture);
    return done;
}

bool has_texture_coordinates(const Scene& scene, Id<Material> material) {
    return std::ranges::any_of(scene.meshes, [&](const auto& mesh) {
        return std::ranges::any_of(
            mesh.value.parts, [&](const auto& part) { return part.material == material && part.geometry && part.geometry->has_uv_set(0); });
    });
}

} // namespace blush
