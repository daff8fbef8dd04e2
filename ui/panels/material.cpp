// Material: glTF's metallic-roughness model with its extensions, and the textures that modulate it.
#include "ui/panels/material_layers.h"
#include "ui/panels/material_maps.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>

namespace blush {
namespace {

constexpr const char* alpha_modes[] = {"Opaque", "Mask", "Blend"};

void draw_surface(Fields& f, Material& m) {
    f.color("Base colour", m.base_color, {1, 1, 1},
            "The share of light that the surface reflects diffusely or, where it is metal, the colour of its reflection. Real surfaces lie "
            "between 0.02 and 0.9.");
    f.number("Metallic", m.metallic,
             unit_interval(1, "0 is a dielectric such as plastic, wood or stone; 1 is bare metal, which reflects in its base colour and "
                              "has no diffuse part."));
    f.number("Roughness", m.roughness,
             unit_interval(1, "How rough the surface is below what the eye resolves. 0 is a mirror, 1 is matt. The highlight widens "
                              "with its square."));
    f.number("Reflectivity", m.specular,
             unit_interval(1, "Strength of the reflection of a dielectric. 0 leaves a purely diffuse surface, as chalk nearly is."));
    f.color("Reflection tint", m.specular_color, {1, 1, 1},
            "Colour of a dielectric's reflection as seen head on. White for everything but a few fabrics.");
    f.number("Index of refraction", m.ior,
             {.min = 1,
              .max = 4,
              .reset = 1.5f,
              .step = 0.002f,
              .tip = "How much light slows down inside: water 1.33, glass 1.5, diamond 2.42. It sets how strongly a dielectric reflects "
                     "and how much it bends light."});
    f.checkbox("Double-sided", m.double_sided, "Emit from the back as well. What light falls on it, a surface reflects from both sides in any case.");
    f.checkbox("Unlit", m.unlit, "Show the base colour as it is, without any light on it.");
}

void draw_emission(Fields& f, Material& m) {
    f.color("Emission", m.emissive, {0, 0, 0}, "Colour of the light that the surface gives off. Every such triangle is a light.");
    f.checkbox("Emits", m.emits, "Otherwise its light is muted, here and wherever else the material is worn.");
    f.number("Strength", m.emissive_strength,
             {.min = 0, .max = 1e12f, .reset = 1, .unit = "nits", .tip = "Luminance of the glow for an emission of 1."});
}

void draw_transmission(Fields& f, Material& m) {
    f.number("Transmission", m.transmission,
             unit_interval(0, "Share of the light that is not reflected that passes through, as in glass or water."));
    bool solid = m.thickness > 0;
    if (f.checkbox("Solid", solid,
                   "Solid bodies bend light and tint it by depth. Otherwise the surface is a thin sheet such as a window pane."))
        m.thickness = solid ? 1.f : 0.f;
    if (!solid) return;
    f.number("Dispersion", m.dispersion,
             {.min = 0,
              .max = 10,
              .reset = 0,
              .step = 0.002f,
              .tip = "How far white light spreads into colours where it is bent: 20 over the Abbe number. Water and diamond 0.36, crown glass 0.33, "
                     "rutile 2."});
    f.color("Absorption colour", m.attenuation_color, {1, 1, 1}, "What is left of white light after the absorption distance.");
    f.number("Absorption distance", m.attenuation_distance,
             {.min = 0,
              .max = 1e9f,
              .reset = 0,
              .unit = "m",
              .step = 0.001f,
              .tip = "Depth at which white light has become the absorption colour. 0 absorbs nothing."});
}

void draw_opacity(Fields& f, Material& m) {
    int alpha = int(m.alpha);
    if (f.choice("Alpha", alpha, alpha_modes, "What opacity does: nothing, a hard cut, or that share of the light is stopped."))
        m.alpha = Material::Alpha(alpha);
    if (m.alpha == Material::Alpha::opaque) return;
    f.number("Opacity", m.opacity, unit_interval(1, "Multiplies the alpha of the base colour's texture."));
    if (m.alpha == Material::Alpha::mask)
        f.number("Cut-off", m.alpha_cutoff, unit_interval(0.5f, "Below this alpha the surface is not there."));
}

std::string material_name(const Scene& scene, Id<Material> id) {
    const Material* m = scene.materials.find(id);
    return fmt::format("{}##{}", !m ? "glTF's default" : m->name.empty() ? fmt::format("Material {}", id.value) : m->name, id.value);
}

// Which of the mesh's parts is shown; its material can be exchanged.
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
        if (f.integer("Part", shown, 1, int64_t(mesh->parts.size()), 1, "The mesh has several parts, each with a material of its own."))
            c.ui.selected_material = mesh->parts[size_t(shown - 1)].material;
    }
    std::vector<std::string> names{material_name(c.scene(), {})};
    for (const auto& entry : c.scene().materials) names.push_back(material_name(c.scene(), entry.id));
    std::string name = material_name(c.scene(), current);
    if (!f.choice("Material", name, names, "Which material this part of the mesh has.")) return current;
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
        quiet_text(
            "glTF's default material: white and fully metallic as the format defines it. Choose one of the scene's materials to edit it.");
        return;
    }
    Material m = *record;
    Fields f(c.ui, "Material");
    f.text("Name", m.name, "Used in the history and in saved files.");
    draw_surface(f, m);
    draw_material_maps(f, c, id, m);
    if (section(c.ui, "Emission", m.emissive != Vec3{0, 0, 0})) draw_emission(f, m);
    if (section(c.ui, "Transmission", m.transmission > 0)) draw_transmission(f, m);
    draw_material_layers(f, c.ui, m);
    if (section(c.ui, "Opacity", m.alpha != Material::Alpha::opaque)) draw_opacity(f, m);
    if (f.changed()) c.apply(SetMaterial{id, m}, f.gesture());
}

} // namespace blush
