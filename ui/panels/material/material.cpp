// Material: glTF's metallic-roughness model with its extensions, and the textures that modulate it.
#include "ui/panels/material/layers.h"
#include "ui/panels/material/maps.h"
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

constexpr const char* alpha_modes[] = {"Opaque", "Mask", "Blend"};

void draw_surface(Fields& f, Material& m) {
    f.color("Base colour", m.base_color, {1, 1, 1},
            "Metallic 0: the diffuse albedo. Metallic 1: the specular colour. Real materials are "
            "between 0.02 and 0.9.");
    f.number("Metallic", m.metallic,
             unit_interval(1, "0 is a dielectric such as plastic, wood or stone; 1 is bare metal, which reflects in its base colour and "
                              "has no diffuse part."));
    f.number("Roughness", m.roughness,
             unit_interval(1, "Roughness of the microfacets. 0 is a mirror, 1 is fully rough. The width of the highlight grows "
                              "with its square."));
    f.number("Specular", m.specular,
             unit_interval(1, "Strength of the specular reflection of a dielectric. 0 is purely diffuse, like chalk."));
    f.color("Specular tint", m.specular_color, {1, 1, 1},
            "Colour of a dielectric's specular reflection at normal incidence. White for nearly all real materials.");
    f.number("IOR", m.ior,
             {.min = 1,
              .max = 4,
              .reset = 1.5f,
              .step = 0.002f,
              .tip = "Index of refraction: ratio of the speed of light in vacuum to that in the material: water 1.33, glass 1.5, diamond "
                     "2.42. It sets the strength of "
                     "reflection and refraction."});
    f.checkbox("Double-sided", m.double_sided, "Emit from the back as well. Reflection is always double-sided.");
    f.checkbox("Unlit", m.unlit, "Show the base colour without lighting.");
}

void draw_emission(Fields& f, Material& m) {
    f.color("Emission", m.emissive, {0, 0, 0}, "Colour of the emitted light. Every emissive triangle is a light.");
    f.checkbox("Emits", m.emits, "Off mutes this material's emission on every object that uses it.");
    f.number("Strength", m.emissive_strength,
             {.min = 0, .max = 1e12f, .reset = 1, .unit = "nits", .tip = "Luminance of the surface for an emission of 1."});
}

void draw_transmission(Fields& f, Material& m) {
    f.number("Transmission", m.transmission,
             unit_interval(0, "Fraction of the light not reflected at the surface that is transmitted, as in glass or water."));
    bool solid = m.thickness > 0;
    if (f.checkbox("Solid", solid,
                   "Solid: refraction, and absorption by depth. Otherwise the surface is thin-walled, such as a window pane."))
        m.thickness = solid ? 1.f : 0.f;
    if (!solid) return;
    f.number(
        "Dispersion", m.dispersion,
        {.min = 0,
         .max = 10,
         .reset = 0,
         .step = 0.002f,
         .tip = "How strongly the index of refraction varies with wavelength: 20 / Abbe number. Water and diamond 0.36, crown glass 0.33, "
                "rutile 2."});
    f.color("Absorption colour", m.attenuation_color, {1, 1, 1}, "Colour of white light after the absorption distance.");
    f.number("Absorption distance", m.attenuation_distance,
             {.min = 0,
              .max = 1e9f,
              .reset = 0,
              .unit = "m",
              .step = 0.001f,
              .tip = "Path length in the material after which white light has the absorption colour. 0 is no absorption."});
}

void draw_opacity(Fields& f, Material& m) {
    int alpha = int(m.alpha);
    if (f.choice("Alpha", alpha, alpha_modes,
                 "Opaque: alpha is ignored. Mask: visible or not, by the cut-off. Blend: alpha is the coverage."))
        m.alpha = Material::Alpha(alpha);
    if (m.alpha == Material::Alpha::opaque) return;
    f.number("Opacity", m.opacity, unit_interval(1, "Multiplies the alpha of the base colour texture."));
    if (m.alpha == Material::Alpha::mask)
        f.number("Cut-off", m.alpha_cutoff, unit_interval(0.5f, "Where alpha is below this, the surface is invisible."));
}

std::string material_name(const Scene& scene, Id<Material> id) {
    const Material* m = scene.materials.find(id);
    return fmt::format("{}##{}", !m ? "glTF's default" : m->name.empty() ? fmt::format("Material {}", id.value) : m->name, id.value);
}

// Chooses the part (glTF primitive) of the mesh; its material can be exchanged.
Id<Material> draw_assignment(PanelContext& c, const Node& node) {
    const Mesh* mesh = c.scene().meshes.find(node.mesh);
    if (!mesh || mesh->parts.empty()) return c.ui.selected_material;
    size_t part = 0;
    while (part < mesh->parts.size() && mesh->parts[part].material != c.ui.selected_material) ++part;
    if (part == mesh->parts.size()) part = 0;
    const Id<Material> current = mesh->parts[part].material;
    Fields f(c.ui, "Assignment");
    if (mesh->parts.size() > 1) {
        int64_t shown = int64_t(part) + 1;
        if (f.integer("Part", shown, 1, int64_t(mesh->parts.size()), 1,
                      "Part (glTF primitive) of the mesh. Each part has its own material."))
            c.ui.selected_material = mesh->parts[size_t(shown - 1)].material;
    }
    std::vector<std::string> names{material_name(c.scene(), {})};
    for (const auto& entry : c.scene().materials) names.push_back(material_name(c.scene(), entry.id));
    std::string name = material_name(c.scene(), current);
    if (!f.choice("Material", name, names, "Material of this part of the mesh.")) return current;
    const auto at = std::ranges::find(names, name) - names.begin();
    const Id<Material> chosen = at == 0 ? Id<Material>{} : c.scene().materials.entries()[size_t(at - 1)].id;
    if (c.apply(AssignMaterial{node.mesh, int(part), chosen})) c.ui.selected_material = chosen;
    return chosen;
}

} // namespace

void draw_material_panel(PanelContext& c, Id<Node> node_id) {
    const Node* node = c.scene().nodes.find(node_id);
    if (!c.scene().materials.find(c.ui.selected_material) && !(node && node->mesh)) return;
    if (!section(c.ui, "Material")) return;
    const Id<Material> id = node ? draw_assignment(c, Node(*node)) : c.ui.selected_material;
    const Material* record = c.scene().materials.find(id);
    if (!record) {
        quiet_text("glTF's default material: white and fully metallic. It cannot be edited: choose one of the scene's materials.");
        return;
    }
    Material m = *record;
    Fields f(c.ui, "Material");
    f.text("Name", m.name, "Name in the history and in saved files.");
    draw_surface(f, m);
    draw_material_maps(f, c, id, m);
    if (section(c.ui, "Emission", m.emissive != Vec3{0, 0, 0})) draw_emission(f, m);
    if (section(c.ui, "Transmission", m.transmission > 0)) draw_transmission(f, m);
    draw_material_layers(f, c.ui, m);
    if (section(c.ui, "Opacity", m.alpha != Material::Alpha::opaque)) draw_opacity(f, m);
    if (f.changed()) c.apply(SetMaterial{id, m}, f.gesture());
}

} // namespace blush
