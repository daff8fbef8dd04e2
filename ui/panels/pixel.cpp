// Pixel panel: scene-linear and displayed colour, luminance, and the first hit of one pixel.
#include "color/illuminance.h"
#include "core/math.h"
#include "core/text.h"
#include "render/film/coverage.h"
#include "scene/node_name.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/aov_pixels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/value_text.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

void row(const PanelContext& c, const char* name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    elided_text(c.ui, value, tone::text);
}

std::string triple(const Vec3& v) {
    return fmt::format("{}  {}  {}", shown_number(double(v.x)), shown_number(double(v.y)), shown_number(double(v.z)));
}

std::string displayed(const PanelContext& c, const Vec3& rgb, const Vec3& albedo, float coverage) {
    float shown[3] = {rgb.x, rgb.y, rgb.z};
    if (const auto done = show(c.color, c.shown_view(), shown, {std::array{albedo}, std::array{coverage}}); !done)
        return done.error().text();
    const auto byte = [](float x) { return int(std::clamp(x, 0.f, 1.f) * 255 + 0.5f); };
    return fmt::format("{:.3f}  {:.3f}  {:.3f}   #{:02x}{:02x}{:02x}", shown[0], shown[1], shown[2], byte(shown[0]), byte(shown[1]),
                       byte(shown[2]));
}

// Value of the group, bounce or strategy that the viewport shows.
void draw_planes(const PanelContext& c, const Frame& f, size_t pixel) {
    const AovView& view = c.ui.aov;
    const size_t k = size_t(view.index);
    if (view.show == ImageView::Show::group && k < f.groups.size()) row(c, name_of(view, &f).c_str(), triple(group_pixel(f, k, pixel)));
    if (view.show == ImageView::Show::strategy && k < f.strategies.size())
        row(c, name_of(view, &f).c_str(), triple(f.strategies[k][pixel]));
    if (view.show == ImageView::Show::bounces && k < f.bounces.size())
        row(c, fmt::format("Bounce {}", k).c_str(), triple(f.bounces[k][pixel]));
}

void draw_values(const PanelContext& c, const Frame& f, int x, int y) {
    const size_t i = size_t(y) * size_t(f.width) + size_t(x);
    const float* rgba = &f.rgba[4 * i];
    row(c, "Pixel", f.divider > 1 ? fmt::format("{}, {}  at 1/{} size", x, y, f.divider) : fmt::format("{}, {}", x, y));
    row(c, "Linear RGB", triple({rgba[0], rgba[1], rgba[2]}));
    const float nits = luminance(Vec3{rgba[0], rgba[1], rgba[2]});
    row(c, "Luminance", shown_number(double(nits)) + " nits");
    if (nits > 0)
        row(c, "EV from grey",
            fmt::format("{}   at ISO 100 {}",
                        signed_number(stops_from_grey(display_parameters_of(c.shown_view()), {rgba[0], rgba[1], rgba[2]}), 2),
                        signed_number(std::log2(nits / 0.125f), 2)));
    if (!f.albedo.empty() && luminance(f.albedo[i]) >= 0.01f) {
        float lux[3] = {rgba[0], rgba[1], rgba[2]};
        to_illuminance(lux, {&f.albedo[i], 1});
        row(c, "Illuminance", shown_number(double(lux[0])) + " lx, if diffuse");
    }
    if (c.denoised) row(c, "Denoised RGB", triple(denoised_pixel(f, *c.denoised, x, y)));
    const Vec3 shown = mixed_pixel(f, c.denoised.get(), mix_of(c.ui.denoise, c.denoised != nullptr), x, y);
    row(c, "Displayed", displayed(c, shown, f.albedo.empty() ? Vec3{0, 0, 0} : f.albedo[i], coverage_of_pixel(f, i)));
    if (!f.albedo.empty()) row(c, "Albedo", triple(f.albedo[i]));
    if (!f.normal.empty())
        row(c, "Normal",
            fmt::format("{}  {}  {}", signed_number(f.normal[i].x, 3), signed_number(f.normal[i].y, 3), signed_number(f.normal[i].z, 3)));
    if (!f.standard_error.empty()) row(c, "Standard error", triple(f.standard_error[i]));
    if (!f.pixel_samples.empty()) row(c, "Samples", fmt::format("{:.0f}", f.pixel_samples[i]));
    if (c.ui.aov.show == ImageView::Show::samples && f.pixel_samples.empty()) row(c, "Samples", fmt::format("{}", f.samples));
    draw_planes(c, f, i);
    if (!f.depth.empty()) row(c, "Distance", f.depth[i] > 0 ? fmt::format("{:.4g} m", f.depth[i]) : "nothing hit");
    if (!f.object_id.empty()) {
        const Node* node = c.scene().nodes.find({f.object_id[i]});
        row(c, "Object", node ? node_name(c.scene(), {f.object_id[i]}, *node) : "none");
    }
    if (!f.material_id.empty()) {
        const Material* material = c.scene().materials.find({f.material_id[i]});
        row(c, "Material", material ? material->name.empty() ? fmt::format("Material {}", f.material_id[i]) : material->name : "none");
    }
}

} // namespace

void draw_pixel_panel(PanelContext& c) {
    if (!c.has_image()) return quiet_text("Waiting for the first render.");
    if (!c.ui.pixel || !ImGui::BeginTable("values", 2)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    const Frame& f = *c.frame;
    draw_values(c, f, std::clamp(int(c.ui.pixel->u * f.width), 0, f.width - 1), std::clamp(int(c.ui.pixel->v * f.height), 0, f.height - 1));
    ImGui::EndTable();
    c.ui.probe.record_last_item("Pixel");
}

void draw_pixel_popup(PanelContext& c) {
    if (!c.ui.pixel) return;
    if (c.ui.pixel->just_opened) ImGui::OpenPopup("pixel");
    c.ui.pixel->just_opened = false;
    if (!ImGui::BeginPopup("pixel")) {
        c.ui.pixel.reset();
        return;
    }
    ImGui::Dummy({ImGui::GetFontSize() * 26, 0}); // fixed width: values that fill the popup would make it as narrow as possible
    draw_pixel_panel(c);
    if (ImGui::IsKeyPressed(key::escape)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace blush
