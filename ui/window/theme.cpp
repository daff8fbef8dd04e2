#include "ui/window/theme.h"

#include "core/srgb.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

namespace blush {
namespace {

constexpr float text_size = 15; // pixels at scale 1

ImFont* load_font(const std::filesystem::path& assets, std::initializer_list<const char*> names, float size) {
    static const ImWchar ranges[] = {0x20,   0x17f,  0x2010, 0x2026, 0x2070, 0x209c, 0x2190, 0x2193, 0x2212,
                                     0x2212, 0x221a, 0x221a, 0x221e, 0x221e, 0x2248, 0x2248, 0};
    const std::filesystem::path folders[] = {assets / "fonts",
                                             "/usr/share/fonts/opentype/inter",
                                             "/usr/share/fonts/truetype/inter",
                                             "/usr/share/fonts/truetype/dejavu",
                                             "/usr/share/fonts/dejavu",
                                             "/usr/share/fonts/TTF"};
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    for (const char* name : names) {
        for (const auto& folder : folders) {
            std::error_code unreadable;
            const std::filesystem::path file = folder / name;
            if (!std::filesystem::is_regular_file(file, unreadable)) continue;
            return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), size, &config, ranges);
        }
    }
    return ImGui::GetIO().Fonts->AddFontDefault();
}

ImVec4 grey(float value, float alpha = 1) { return {value, value, value, alpha}; }

} // namespace

void load_fonts(const std::filesystem::path& assets, float scale) {
    const float size = std::round(text_size * scale);
    load_font(assets, {"Inter-Regular.otf", "Inter-Regular.ttf", "DejaVuSans.ttf"}, size);
    load_font(assets, {"Inter-SemiBold.otf", "Inter-SemiBold.ttf", "DejaVuSans-Bold.ttf"}, size);
}

ImFont* heading_font() { return ImGui::GetIO().Fonts->Fonts.back(); }

void apply_theme(float scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 3};
    style.ItemSpacing = {6, 5};
    style.ItemInnerSpacing = {5, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 10;
    style.GrabMinSize = 8;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    style.FrameRounding = 3;
    style.PopupRounding = 4;
    style.ScrollbarRounding = 5;
    style.GrabRounding = 3;
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.DisabledAlpha = 0.45f;
    style.ScaleAllSizes(scale);

    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = grey(0.84f);
    c[ImGuiCol_TextDisabled] = grey(0.55f);
    c[ImGuiCol_WindowBg] = grey(0.165f);
    c[ImGuiCol_ChildBg] = grey(0, 0);
    c[ImGuiCol_PopupBg] = grey(0.14f, 0.98f);
    c[ImGuiCol_Border] = grey(0.3f);
    c[ImGuiCol_FrameBg] = grey(0.227f);
    c[ImGuiCol_FrameBgHovered] = grey(0.27f);
    c[ImGuiCol_FrameBgActive] = grey(0.30f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgCollapsed] = grey(0.13f);
    c[ImGuiCol_TitleBgActive] = grey(0.2f);
    c[ImGuiCol_MenuBarBg] = grey(0.14f);
    c[ImGuiCol_ScrollbarBg] = grey(0, 0);
    c[ImGuiCol_ScrollbarGrab] = grey(0.32f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.42f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.5f);
    c[ImGuiCol_CheckMark] = grey(0.9f);
    c[ImGuiCol_SliderGrab] = grey(0.55f);
    c[ImGuiCol_SliderGrabActive] = grey(0.7f);
    c[ImGuiCol_Button] = grey(0.26f);
    c[ImGuiCol_ButtonHovered] = grey(0.33f);
    c[ImGuiCol_ButtonActive] = grey(0.40f);
    c[ImGuiCol_Header] = grey(0.30f);
    c[ImGuiCol_HeaderHovered] = grey(0.26f);
    c[ImGuiCol_HeaderActive] = grey(0.34f);
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = grey(0.13f);
    c[ImGuiCol_TabHovered] = grey(0.3f);
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = grey(0.25f);
    c[ImGuiCol_Separator] = grey(0.11f);
    c[ImGuiCol_SeparatorHovered] = grey(0.4f);
    c[ImGuiCol_SeparatorActive] = grey(0.5f);
    c[ImGuiCol_ResizeGrip] = c[ImGuiCol_ResizeGripHovered] = c[ImGuiCol_ResizeGripActive] = grey(0.4f, 0.4f);
    c[ImGuiCol_PlotHistogram] = grey(0.65f);
    c[ImGuiCol_TextSelectedBg] = grey(0.42f);
    c[ImGuiCol_DragDropTarget] = grey(0.9f);
    c[ImGuiCol_NavHighlight] = grey(0.6f);
    c[ImGuiCol_ModalWindowDimBg] = grey(0.05f, 0.5f);
    c[ImGuiCol_TableRowBgAlt] = grey(1, 0.02f);
    ImGui::GetStyle() = style;
}

ImU32 hue_of(const Vec3& linear, int alpha) {
    const float brightest = std::max({linear.x, linear.y, linear.z, 1e-6f});
    const auto encoded = [&](float c) { return int(255 * srgb_from_linear(std::clamp(c / brightest, 0.f, 1.f))); };
    return IM_COL32(encoded(linear.x), encoded(linear.y), encoded(linear.z), alpha);
}

} // namespace blush
