#include "ui/panels/material/maps.h"

#include "ui/jobs/map_thumbnails.h"
#include "ui/panels/material/layers.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

struct Slot {
    const char* label;
    TextureRef Material::*ref;
    const char* tip;
};

constexpr Slot usual[] = {
    {"Base colour map", &Material::base_color_texture, "Multiplies the base colour; its alpha multiplies the opacity."},
    {"Metal-rough map", &Material::metallic_roughness_texture, "Green multiplies roughness, blue multiplies metallic."},
    {"Normal map", &Material::normal_texture, "Normal map: fine relief without geometry."},
    {"Emission map", &Material::emissive_texture, "Multiplies the emission."},
};
constexpr Slot further[] = {
    {"Specular map", &Material::specular_texture, "Its alpha multiplies the specular strength."},
    {"Specular tint map", &Material::specular_color_texture, "Multiplies the specular tint."},
    {"Transmission map", &Material::transmission_texture, "Red multiplies the transmission."},
};

std::string name_of(const Texture& t, Id<Texture> id) {
    return !t.name.empty() ? t.name : !t.source.empty() && t.source != "embedded" ? t.source : fmt::format("Image {}", id.value);
}

std::string size_of(const Texture& t) { return t.image ? fmt::format("{} × {}", t.image->width, t.image->height) : "missing"; }

ImVec2 fitted(const MapThumbnails::MapPreview& p, float side) {
    const float scale = side / std::max({p.width, p.height, 1.f});
    return {std::max(1.f, p.width * scale), std::max(1.f, p.height * scale)};
}

void draw_preview(PanelContext& c, const Texture& texture, const MapThumbnails::MapPreview& image, const std::string& name) {
    if (!tip_is_due(c.ui)) return;
    const float em = ImGui::GetFontSize(), side = em * 18;
    const ImVec2 size = fitted(image, side), padding = ImGui::GetStyle().WindowPadding;
    place_next_tip({std::max(size.x, em * 8) + 2 * padding.x, size.y + em * 2.5f + 2 * padding.y});
    ImGui::BeginTooltip();
    if (image.texture) ImGui::Image(image.texture, size);
    ImGui::TextUnformatted(elided(name, side).c_str());
    ImGui::TextDisabled("%s%s", size_of(texture).c_str(), texture.image && texture.image->bytes.empty() ? ", more than 8 bits" : "");
    c.ui.probe.record("Map preview", {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    ImGui::EndTooltip();
}

// The image, scaled to fit into a square.
void draw_thumbnail(PanelContext& c, const Texture& texture, const std::string& label, const std::string& name, float side) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const MapThumbnails::MapPreview image =
        c.ui.maps.thumbnails && texture.image ? c.ui.maps.thumbnails->of(*texture.image) : MapThumbnails::MapPreview{};
    ImGui::Dummy({side, side});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + side, at.y + side}, tone::surround, ImGui::GetStyle().FrameRounding);
    if (image.texture) {
        const ImVec2 size = fitted(image, side), low{at.x + (side - size.x) / 2, at.y + (side - size.y) / 2};
        draw.AddImage(image.texture, low, {low.x + size.x, low.y + size.y});
    }
    c.ui.probe.record_last_item("Map/" + label);
    draw_preview(c, texture, image, name);
}

void ask_for_file(PanelContext& c, Id<Material> id, const Slot& slot) {
    c.ui.maps.material = id;
    c.ui.maps.slot = slot.ref;
    c.ui.maps.label = slot.label;
    c.ui.commands.push_back(Command::map);
}

void load_button(PanelContext& c, Id<Material> id, const Slot& slot, const char* text, float width) {
    if (ImGui::Button(text, {width, 0})) ask_for_file(c, id, slot);
    c.ui.probe.record_last_item(std::string("Map/") + slot.label + "/" + text);
    tip_for_last_item(c.ui, "Choose an image file (.png, .jpg, .webp, .bmp, .exr, .hdr). The image is saved with the scene.");
}

// One of the scene's images, or none.
bool choose_image(PanelContext& c, const Slot& slot, TextureRef& ref) {
    const Scene& scene = c.scene();
    const Texture* current = scene.textures.find(ref.texture);
    const Id<Texture> before = ref.texture;
    const std::string chosen = current ? name_of(*current, ref.texture) : "none";
    const std::string shown = elided(chosen, ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x);
    if (ImGui::BeginCombo("##image", shown.c_str())) {
        if (ImGui::Selectable("none", !current)) ref = {};
        for (const auto& [id, texture] : scene.textures)
            if (ImGui::Selectable(fmt::format("{}##{}", name_of(texture, id), id.value).c_str(), id == ref.texture)) ref.texture = id;
        ImGui::EndCombo();
    } else {
        c.ui.probe.record_last_item(std::string("Material/") + slot.label);
        tip_for_last_item(c.ui, (shown == chosen ? std::string(slot.tip) : chosen + "\n" + slot.tip).c_str());
    }
    return ref.texture != before;
}

void draw_image_row(Fields& f, PanelContext& c, Id<Material> id, const Slot& slot, TextureRef& ref, const Texture& texture) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, line = ImGui::GetFrameHeight(),
                side = 2 * line + ImGui::GetStyle().ItemSpacing.y;
    // The image size, below the label.
    const ImVec2 row = ImGui::GetCursorScreenPos();
    const float left = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMin().x;
    ImGui::GetWindowDrawList()->AddText({left, row.y + side - line + ImGui::GetStyle().FramePadding.y}, tone::dim_text,
                                        size_of(texture).c_str());
    draw_thumbnail(c, texture, slot.label, name_of(texture, ref.texture), side);
    ImGui::SameLine(0, gap);
    ImGui::BeginGroup();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (choose_image(c, slot, ref)) f.note_change();
    const float rest = ImGui::GetContentRegionAvail().x;
    load_button(c, id, slot, "Replace...", rest - line - gap);
    ImGui::SameLine(0, gap);
    if (ImGui::Button("×", {line, 0})) {
        ref = {};
        f.note_change();
    }
    c.ui.probe.record_last_item(std::string("Map/") + slot.label + "/Remove");
    tip_for_last_item(c.ui, "Remove the image from this material");
    ImGui::EndGroup();
}

void draw_placement(Fields& f, TextureRef& ref) {
    if (!ImGui::TreeNodeEx("Placement", ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
    int64_t uv_set = ref.uv_set;
    f.number("Offset U", ref.offset.x, {.reset = 0, .step = 0.002f, .tip = "Moves the image along U, in widths of the image."});
    f.number("Offset V", ref.offset.y, {.reset = 0, .step = 0.002f, .tip = "Moves the image along V, in heights of the image."});
    f.number("Scale U", ref.scale.x, {.reset = 1, .step = 0.005f, .tip = "How many times the image repeats over one unit of U."});
    f.number("Scale V", ref.scale.y, {.reset = 1, .step = 0.005f, .tip = "How many times the image repeats over one unit of V."});
    f.angle("Rotation", ref.rotation_radians,
            {.min = -360, .max = 360, .reset = 0, .step = 0.25f, .tip = "Rotates the image counter-clockwise about its corner."});
    if (f.integer("UV set", uv_set, 0, max_uv_set, 0, "Set of texture coordinates of the mesh (TEXCOORD_n).")) ref.uv_set = uint8_t(uv_set);
}

void draw_map(Fields& f, PanelContext& c, Id<Material> id, const Slot& slot, Material& m) {
    TextureRef& ref = m.*slot.ref;
    const Texture* texture = c.scene().textures.find(ref.texture);
    ImGui::PushID(slot.label);
    f.begin_row(slot.label, slot.tip);
    if (texture) {
        draw_image_row(f, c, id, slot, ref, *texture);
        if (ref.texture) draw_placement(f, ref);
    } else {
        const float gap = ImGui::GetStyle().ItemInnerSpacing.x, load = ImGui::GetFontSize() * 4.5f;
        ImGui::SetNextItemWidth(std::max(1.f, ImGui::GetContentRegionAvail().x - load - gap));
        if (choose_image(c, slot, ref)) f.note_change();
        ImGui::SameLine(0, gap);
        load_button(c, id, slot, "Load...", load);
    }
    ImGui::PopID();
}

} // namespace

void draw_material_maps(Fields& f, PanelContext& c, Id<Material> id, Material& m) {
    std::vector<Slot> all(std::begin(further), std::end(further));
    for (const LayerTexture& t : layer_textures) all.push_back({t.label, t.ref, t.tip});
    const auto has_image = [&](const Slot& slot) { return bool((m.*slot.ref).texture); };
    const bool open = std::ranges::any_of(usual, has_image) || std::ranges::any_of(all, has_image);
    if (!section(c.ui, "Maps", open)) return;
    for (const Slot& slot : usual) draw_map(f, c, id, slot, m);
    if (m.normal_texture.texture)
        f.number("Normal strength", m.normal_scale, {.min = -10, .max = 10, .reset = 1, .step = 0.005f, .tip = "Scale of the normal map."});
    for (const Slot& slot : all)
        if (has_image(slot)) draw_map(f, c, id, slot, m);
    if (m.clearcoat_normal_texture.texture)
        f.number("Coat normal strength", m.clearcoat_normal_scale,
                 {.min = -10, .max = 10, .reset = 1, .step = 0.005f, .tip = "Scale of the coat's normal map."});
    if (!section(c.ui, "More maps", false)) return;
    for (const Slot& slot : all)
        if (!has_image(slot)) draw_map(f, c, id, slot, m);
}

} // namespace blush
