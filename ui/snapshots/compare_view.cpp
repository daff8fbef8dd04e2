#include "ui/snapshots/compare_view.h"

#include "ui/gl/texture_id.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/layout.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

using Mode = Comparison::Mode;

constexpr double default_frame = 16; // milliseconds per window frame, as for the live image

std::shared_ptr<const Difference> compute_difference(const DifferenceInput& input) {
    return std::make_shared<const Difference>(difference_of(input));
}

ImageMix mix_of_side(const PanelContext& c, const ComparedSide& side) { return mix_of(c.ui.denoise, side.images.denoised != nullptr); }

} // namespace

bool drag_wipe(UiState& ui, const char* name, float x, const ImageRect& seen) {
    const float grab = std::max(8.f, ImGui::GetFontSize() * 0.8f);
    ImGui::SetNextWindowPos({x - grab / 2, seen.y});
    ImGui::SetNextWindowSize({grab, seen.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::InvisibleButton("bar", {grab, seen.height});
    ui.probe.record_last_item(name);
    const bool active = ImGui::IsItemActive();
    if (active || ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = seen.y + seen.height / 2, grip = grab * 0.4f;
    draw.AddLine({x, seen.y}, {x, seen.y + seen.height}, active ? tone::text : tone::dim_text);
    draw.AddRectFilled({x - grip / 2, middle - grip * 3}, {x + grip / 2, middle + grip * 3}, active ? tone::text : tone::dim_text,
                       grip / 2);
    ImGui::End();
    ImGui::PopStyleVar(2);
    return active;
}

void name_image(const std::string& text, const ImageRect& seen) {
    const float em = ImGui::GetFontSize();
    draw_label(*ImGui::GetWindowDrawList(), text, {seen.x + em, seen.y + em}, seen.width - 2 * em, tone::text);
}

void name_sides(const std::string& a, const std::string& b, const ImageRect& seen) {
    const float em = ImGui::GetFontSize(), room = (seen.width - 3 * em) / 2;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw_label(draw, "A   " + a, {seen.x + em, seen.y + em}, room, tone::text);
    const std::string right = "B   " + b;
    draw_label(draw, right, {seen.x + seen.width - em - label_size(right, room).x, seen.y + em}, room, tone::text);
}

ComparedSide compared_side(const PanelContext& c, uint64_t id) {
    if (id == live_image) return {id, "live", {c.frame, c.denoised}};
    const SnapshotPtr s = c.ui.snapshots.find(id);
    return s ? ComparedSide{id, s->name, s->images} : ComparedSide{id, {}, {}};
}

void CompareView::set_shader(const DisplayShader& shader) {
    shader_ = shader;
    shader_changed_ = true;
}

void CompareView::update_difference(PanelContext& c, const ComparedSide& a, const ComparedSide& b) {
    const Comparison& compare = c.ui.snapshots.compare;
    if (compare.mode != Mode::difference) return;
    const bool denoised = c.ui.denoise.wants_denoised();
    const DifferenceInput input{
        a.images.frame, b.images.frame, denoised ? a.images.denoised : nullptr, denoised ? b.images.denoised : nullptr,
        c.ui.denoise,   compare.kind};
    if (difference_.update(input, compute_difference)) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.05);
    if (difference_.output()) result_ = *difference_.output();
    c.ui.difference = result_;
}

// Uploads the sides that are not live, one above the other.
void CompareView::upload_sides(const PanelContext& c, const ComparedSide& a, const ComparedSide& b) {
    int width = 1, height = 0;
    const ComparedSide* sides[] = {&a, &b};
    for (const ComparedSide* side : sides) {
        if (side->id == live_image) continue;
        width = std::max(width, side->images.frame->width);
        height += side->images.frame->height;
    }
    std::vector<float> rgba(size_t(width) * size_t(height) * 4, 1.f);
    int top = 0;
    for (int i = 0; i < 2; ++i) {
        parts_[i] = {};
        if (sides[i]->id == live_image) continue;
        const Frame& f = *sides[i]->images.frame;
        const ImageMix mix = mix_of_side(c, *sides[i]);
        for (int y = 0; y < f.height; ++y)
            for (int x = 0; x < f.width; ++x) {
                float* to = &rgba[4 * (size_t(top + y) * size_t(width) + size_t(x))];
                const Vec3 p = mixed_pixel(f, sides[i]->images.denoised.get(), mix, x, y);
                to[0] = p.x;
                to[1] = p.y;
                to[2] = p.z;
                to[3] = f.rgba[4 * (size_t(y) * size_t(f.width) + size_t(x)) + 3];
            }
        parts_[i].u = float(f.width) / float(width);
        parts_[i].aspect = float(f.width) / float(f.height);
        parts_[i].v0 = float(top) / float(height);
        parts_[i].v1 = float(top + f.height) / float(height);
        top += f.height;
    }
    pass_.upload(width, height, std::move(rgba));
}

void CompareView::update(PanelContext& c, const ComparedSide& a, const ComparedSide& b, const DisplayLook& look, const FrameBudget& pace) {
    if (shader_changed_ && shader_) {
        if (const auto set = pass_.set_shader(*shader_); !set) c.ui.toasts.fail(set.error().text());
    }
    const Comparison& compare = c.ui.snapshots.compare;
    const bool difference = compare.mode == Mode::difference;
    Shown wanted{difference ? Mode::difference : Mode::wipe, {}, {}, {}, {}, nullptr};
    if (difference) {
        wanted.difference = result_.get();
    } else {
        if (a.id != live_image) wanted.a = a.images.frame, wanted.mix_a = mix_of_side(c, a);
        if (b.id != live_image) wanted.b = b.images.frame, wanted.mix_b = mix_of_side(c, b);
    }
    DisplayLook plain = look;
    plain.mix = {};
    if (difference && compare.kind != DifferenceKind::absolute) plain.numbers.false_color = {};
    const bool other_image = !pass_.busy() && shown_ != wanted;
    if (other_image) {
        shown_ = wanted;
        if (difference && result_ && result_->problem.empty())
            pass_.upload(result_->width, result_->height, result_->rgba);
        else if (!difference)
            upload_sides(c, a, b);
        drawn_ = false;
    }
    if (other_image || shader_changed_ || look_ != plain) {
        look_ = plain;
        pass_.begin(plain);
    }
    shader_changed_ = false;
    pass_.advance(pace.left(default_frame, FrameBudget::Clock::now()));
    if (pass_.busy()) {
        c.ui.seconds_to_next_frame = 0;
    } else if (!drawn_) {
        drawn_ = true;
        c.ui.seconds_to_next_frame = 0;
    }
}

// An image with another aspect ratio than the live one keeps its own.
void CompareView::draw_part(const Part& part, const ImageRect& whole, const ImageRect& clip) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRect({clip.x, clip.y}, {clip.x + clip.width, clip.y + clip.height}, true);
    ImageRect image = whole;
    if (part.aspect > 0 && std::abs(part.aspect * whole.height / whole.width - 1) > 0.01f) {
        draw.AddRectFilled({whole.x, whole.y}, {whole.x + whole.width, whole.y + whole.height}, tone::surround);
        const Region fitted = fit_aspect({whole.x, whole.y, whole.width, whole.height}, part.aspect);
        image = {fitted.x, fitted.y, fitted.width, fitted.height};
    }
    draw.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); }, nullptr);
    draw.AddImage(texture_id(part.texture), {image.x, image.y}, {image.x + image.width, image.y + image.height}, {0, part.v0},
                  {part.u, part.v1});
    draw.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
    draw.PopClipRect();
}

void CompareView::draw_wipe(PanelContext& c, const ComparedSide& a, const ComparedSide& b, const ImageRect& image, const ImageRect& seen) {
    Comparison& compare = c.ui.snapshots.compare;
    const float x = std::round(seen.x + compare.wipe * seen.width);
    if (a.id != live_image) draw_part(parts_[0], image, {seen.x, seen.y, x - seen.x, seen.height});
    if (b.id != live_image) draw_part(parts_[1], image, {x, seen.y, seen.x + seen.width - x, seen.height});
    left_name_ = a.label;
    right_name_ = b.label;
    if (drag_wipe(c.ui, "Compare/Wipe", x, seen))
        compare.wipe = std::clamp((ImGui::GetIO().MousePos.x - seen.x) / std::max(seen.width, 1.f), 0.f, 1.f);
}

void CompareView::draw(PanelContext& c, const ImageRect& image, const ImageRect& seen, const DisplayLook& look, const FrameBudget& pace) {
    Comparison& compare = c.ui.snapshots.compare;
    left_name_.clear();
    right_name_.clear();
    if (compare.mode == Mode::off) {
        c.ui.difference.reset();
        return;
    }
    const ComparedSide a = compared_side(c, compare.a), b = compared_side(c, compare.b);
    if (a.id == b.id || !a.images.frame || !b.images.frame) return;
    update_difference(c, a, b);
    update(c, a, b, look, pace);
    for (Part& part : parts_) part.texture = pass_.texture();
    if (compare.mode == Mode::wipe && drawn_) return draw_wipe(c, a, b, image, seen);
    if (compare.mode == Mode::flicker && drawn_) {
        const ComparedSide& side = compare.shows_b ? b : a;
        if (side.id != live_image) draw_part(parts_[compare.shows_b], image, seen);
        left_name_ = (compare.shows_b ? "B   " : "A   ") + side.label;
        return;
    }
    if (compare.mode != Mode::difference || !result_ || !result_->problem.empty() || !drawn_) return;
    draw_part({pass_.texture()}, image, seen);
    left_name_ = std::string("A - B   ") + caption_of(compare.kind);
}

void CompareView::draw_names(const ImageRect& seen) const {
    if (!right_name_.empty())
        name_sides(left_name_, right_name_, seen);
    else if (!left_name_.empty())
        name_image(left_name_, seen);
}

} // namespace blush
