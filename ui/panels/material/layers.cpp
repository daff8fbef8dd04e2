#include "ui/panels/material/layers.h"

namespace blush {
namespace {

void draw_coat(Fields& f, Material& m) {
    f.number("Clear coat", m.clearcoat,
             unit_interval(0, "Weight of a thin layer of varnish: a colourless specular reflection on top, as on lacquered wood or "
                              "car paint. Light that it reflects does not reach the base layer."));
    f.number("Coat roughness", m.clearcoat_roughness, unit_interval(0, "Roughness of the coat; 0 is a mirror."));
}

void draw_sheen(Fields& f, Material& m) {
    f.color("Sheen", m.sheen_color, {0, 0, 0},
            "Colour of the sheen: light scattered by fibres at grazing angles, as on velvet, satin and dust.");
    f.number("Sheen roughness", m.sheen_roughness,
             unit_interval(0, "Roughness of the fibres. Low values give a sharp rim, high values a soft layer over the whole cloth."));
}

void draw_anisotropy(Fields& f, Material& m) {
    f.number("Anisotropy", m.anisotropy,
             unit_interval(0, "Stretches highlights along one direction, as fine parallel scratches do: brushed metal, records, hair. "
                              "The direction comes from the mesh's tangents; without tangents highlights stay round."));
    f.angle("Direction", m.anisotropy_rotation_radians,
            {.min = -360,
             .max = 360,
             .reset = 0,
             .step = 0.25f,
             .tip = "Rotation of the stretch direction, counter-clockwise from the mesh's tangent."});
}

void draw_film(Fields& f, Material& m) {
    const auto nanometres = [](float reset, const char* tip) {
        return NumberStyle{.min = 0, .max = 100000, .reset = reset, .unit = "nm", .step = 1, .tip = tip};
    };
    f.number("Iridescence", m.iridescence,
             unit_interval(0, "Weight of thin-film interference, which amplifies some colours and cancels others, "
                              "as on soap bubbles, oil and tempered steel."));
    f.number("Film IOR", m.iridescence_ior,
             {.min = 1, .max = 4, .reset = 1.3f, .step = 0.002f, .tip = "Index of refraction of the film: soap 1.33, oil 1.5."});
    f.number(
        "Film thickness", m.iridescence_thickness_maximum,
        nanometres(400,
                   "Thickness of the film. Colours change most between 100 and 1000 nm. With a thickness map: the thickness for white."));
    if (m.iridescence_thickness_texture.texture)
        f.number("Min. thickness", m.iridescence_thickness_minimum, nanometres(100, "Thickness for black in the thickness map."));
}

void draw_translucency(Fields& f, Material& m) {
    f.number("Translucency", m.diffuse_transmission,
             unit_interval(0, "Fraction of the light not reflected at the surface that is transmitted diffusely: leaves, paper, "
                              "lampshades, wax."));
    f.color("Tint", m.diffuse_transmission_color, {1, 1, 1}, "Colour of the transmitted light.");
}

} // namespace

NumberStyle unit_interval(float reset, const char* tip) {
    return {.min = 0, .max = 1, .reset = reset, .bar = true, .tip = tip, .format = "%.3f"};
}

void draw_material_layers(Fields& f, UiState& ui, Material& m) {
    if (section(ui, "Clear coat", m.clearcoat > 0)) draw_coat(f, m);
    if (section(ui, "Sheen", m.sheen_color != Vec3{0, 0, 0})) draw_sheen(f, m);
    if (section(ui, "Anisotropy", m.anisotropy > 0)) draw_anisotropy(f, m);
    if (section(ui, "Thin film", m.iridescence > 0)) draw_film(f, m);
    if (section(ui, "Translucency", m.diffuse_transmission > 0)) draw_translucency(f, m);
}

} // namespace blush
