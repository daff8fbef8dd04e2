#include "ui/viewport/viewport.h"

#include "render/light_mix/light_mix.h"
#include "scene/document/subtree_edits.h"
#include "scene/node_name.h"
#include "ui/gl/reuse_buffer.h"
#include "ui/gl/texture_id.h"
#include "ui/lights/light_glyphs.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/look_through_light.h"
#include "ui/lights/multi_edit_apply.h"
#include "ui/snapshots/aov_bar.h"
#include "ui/snapshots/image_pixels.h"
#include "ui/viewport/bleed_marks.h"
#include "ui/viewport/camera_frame_overlay.h"
#include "ui/viewport/environment_dial.h"
#include "ui/viewport/false_color_legend.h"
#include "ui/viewport/meter_marks.h"
#include "ui/viewport/orbit_camera.h"
#include "ui/viewport/path_lines.h"
#include "ui/viewport/picking.h"
#include "ui/viewport/pixel_grid.h"
#include "ui/viewport/two_piles.h"
#include "ui/viewport/view_tools.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/widgets/elided_text.h"
#include "ui/window/theme.h"

namespace blush {
namespace {

// Milliseconds for a UI frame while an image is being drawn: normally; while the user waits for changed view settings; and while
// a light mix is edited, which must be visible in the same frame.
constexpr double default_frame = 16, view_change_frame = 20, mix_edit_frame = 12;

Region window_region() {
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    return {at.x, at.y, size.x, size.y};
}

// Rectangle of the image in the current window; fills the rest of the window.
ImageRect viewport_image_rect(const PanelContext& c) {
    const Region region = window_region();
    const ImageRect image = image_rect(c.ui.zoom, region, std::max(c.render_width, 1), std::max(c.render_height, 1));
    const ImVec2 high{region.x + region.width, region.y + region.height};
    const bool covered = image.x <= region.x && image.y <= region.y && image.x + image.width >= high.x && image.y + image.height >= high.y;
    if (!covered) ImGui::GetWindowDrawList()->AddRectFilled({region.x, region.y}, high, tone::surround);
    return image;
}

// The visible part of the image, where captions are placed.
ImageRect visible_part(const ImageRect& image) {
    const Region r = window_region();
    const float left = std::max(image.x, r.x), top = std::max(image.y, r.y);
    return {left, top, std::min(image.x + image.width, r.x + r.width) - left, std::min(image.y + image.height, r.y + r.height) - top};
}

void zoom_image(PanelContext& c, const NavigationResult& input) {
    const Region region = window_region();
    const int width = std::max(c.render_width, 1), height = std::max(c.render_height, 1);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (input.zoom != 1) c.ui.zoom = zoomed(c.ui.zoom, region, width, height, {mouse.x, mouse.y}, input.zoom);
    if (input.shift_x != 0 || input.shift_y != 0) c.ui.zoom = shifted(c.ui.zoom, region, width, height, input.shift_x, input.shift_y);
}

void draw_centred(const char* text) {
    const ImVec2 at = ImGui::GetWindowPos(), window = ImGui::GetWindowSize(), size = ImGui::CalcTextSize(text);
    ImGui::GetWindowDrawList()->AddText({at.x + (window.x - size.x) / 2, at.y + (window.y - size.y) / 2}, tone::dim_text, text);
}

// A caption at the lower or upper edge of the image, beside the environment dial.
void write_caption(PanelContext& c, const ImageRect& image, const std::string& text, bool above = false) {
    const float em = ImGui::GetFontSize(), margin = em * 0.7f;
    const float left = above ? em : std::max(environment_dial_width(c) + em / 2, em), room = image.width - left - em;
    const ImVec2 size = label_size(text, room);
    const float y = above ? image.y + margin : image.y + image.height - size.y - margin;
    const ImVec2 at{image.x + std::max((image.width - size.x) / 2, left), y};
    draw_label(*ImGui::GetWindowDrawList(), text, at, room, tone::warning);
    c.ui.probe.record("Caption", {at.x, at.y, size.x, size.y});
}

// Mask over node ids: the node and all its descendants.
std::vector<uint8_t> with_descendants(const Scene& scene, Id<Node> root) {
    std::vector<uint8_t> selected(scene.nodes.empty() ? 1 : scene.nodes.entries().back().id.value + 1);
    for (const Id<Node> id : subtree(scene, root)) selected[id.value] = true;
    return selected;
}

void focus_at(PanelContext& c, const Projection& projection, double u, double v) {
    const Picked picked = c.frame ? pick(*c.frame, u, v) : Picked{};
    if (!picked.depth) return c.ui.toasts.note("There is no surface to focus on at this point");
    Lens lens = c.scene().view.lens;
    lens.focus_distance = float(projection.axial_distance(u, v, *picked.depth));
    c.apply(SetLens{lens});
}

void expose(PanelContext& c, float stops, Gesture gesture) {
    ViewSettings v = c.project().view;
    v.exposure_ev = std::clamp(v.exposure_ev + stops, -20.f, 20.f);
    c.apply(SetView{v}, gesture);
}

// The light whose glyph is at this position, else the object in the image.
Picked picked_at(PanelContext& c, const Projection& projection, const ImageRect& image, const ScreenPoint& at) {
    if (c.ui.settings.overlays) {
        if (const Id<Node> light = light_under(c.scene(), projection, image, c.ui, at)) return {light, {}, {}};
    }
    return c.frame ? pick(*c.frame, image.u(at.x), image.v(at.y)) : Picked{};
}

void turn_surroundings(PanelContext& c, double share) {
    Environment e = c.scene().environment;
    if (e.kind != Environment::Kind::image && e.kind != Environment::Kind::sky)
        return c.ui.toasts.note("Only an image or sky environment can be rotated");
    e.rotation_degrees = turned_rotation(e.rotation_degrees, share, c.scene().view.lens);
    c.apply(SetEnvironment{e}, c.ui.gestures.current());
}

void inspect(PanelContext& c, double u, double v) {
    c.ui.pixel = PixelProbe{u, v};
    c.ui.docks.to_front.insert("pixel");
}

// True if the frame, and its denoised image if it is shown, have group planes for these gains.
bool has_planes_for(const PanelContext& c, const Gains& gains, bool denoised) {
    if (!c.frame || gains.empty() || c.frame->groups.size() != gains.size()) return false;
    return !denoised || (c.denoised && c.denoised->groups && c.denoised->groups->planes.size() == gains.size());
}

} // namespace

Result<void> Viewport::set_display_shader(const DisplayShader& shader) {
    shader_changed_ = true;
    compare_.set_shader(shader);
    region_backdrop_.set_shader(shader);
    return display_.set_shader(shader);
}

// Applies the current mix; the session's own mix of the same planes follows later.
void Viewport::upload_frame(const FramePtr& shown, const ImageView& view, const Gains& gains, bool background_as_it_is) {
    const Frame& frame = *shown;
    const bool special = is_special(frame, view), mixes = !gains.empty() && gains.size() == frame.groups.size() && gains != frame.gains;
    if (mixes && !special && !background_as_it_is) {
        mix_rgba(frame, gains, writable_buffer(mixed_), &workers_);
        return display_.upload(frame.width, frame.height, mixed_);
    }
    if (frame.groups.empty()) mixed_.reset();
    if (special) return display_.upload(frame.width, frame.height, pixels_of(frame, view));
    if (!background_as_it_is) return display_.upload(shown);
    display_.upload(frame.width, frame.height, with_coverage(frame, mixes ? mixed_rgba(frame, gains) : frame.rgba));
}

void Viewport::upload_denoised(const DenoisedPtr& denoised, const Gains& gains) {
    if (!denoised->groups) mixed_denoised_.reset();
    const bool mixes = denoised->groups && gains.size() == denoised->groups->planes.size() && gains != denoised->gains;
    if (!mixes) return display_.upload(denoised);
    std::vector<float>& rgb = writable_buffer(mixed_denoised_);
    rgb.resize(size_t(denoised->width) * size_t(denoised->height) * 3);
    mix_rgb(planes_of(*denoised), gains, rgb, &workers_);
    display_.upload_denoised(denoised->width, denoised->height, mixed_denoised_);
}

void Viewport::upload_subsampled(const MixPreviewSource& moved, const Gains& gains, int step) {
    const MixPreview::Preview raw = preview_.raw(moved, gains, step);
    display_.upload(raw.width, raw.height, raw.values);
    if (!moved.shows_denoised) return;
    const MixPreview::Preview denoised = preview_.denoised(moved, gains, step);
    display_.upload_denoised(denoised.width, denoised.height, denoised.values);
}

// The inputs of the image that the viewport should show.
struct Viewport::WantedImage {
    ImageView view;
    DisplayLook look;
    Gains gains;             // of the light groups; empty without a mix
    MixPreviewSource source; // the images, for a preview of the mix
    bool special = false;    // not the beauty

    // True if the gains can be applied to the group planes of all images that are shown.
    bool can_be_mixed(const PanelContext& c) const {
        return has_planes_for(c, gains, source.shows_denoised) && !special && !look.numbers.background_as_it_is;
    }
};

Viewport::WantedImage Viewport::wanted_image(PanelContext& c) {
    const ViewSettings v = c.shown_view();
    WantedImage w;
    w.view = c.ui.image_view(c.frame ? int(c.frame->bounces.size()) : 0);
    if (w.view.show == ImageView::Show::beauty && v.false_color.of == FalseColor::Of::lux) w.view.show = ImageView::Show::illuminance;
    w.special = c.frame && is_special(*c.frame, w.view);
    w.look.numbers = display_parameters_of(v);
    if (w.special && is_map(w.view)) w.look.numbers.false_color = {};            // it has colours of its own
    if (w.special && is_data(w.view)) w.look.numbers.background_as_it_is = true; // all its pixels count as background
    w.look.mix = w.special ? ImageMix{} : mix_of(c.ui.denoise, c.denoised != nullptr);
    w.look.over_checker = !w.special && c.frame && c.frame->transparent;
    if (c.mixing) w.gains = c.mixing->gains;
    w.source = {c.frame, c.denoised, w.look.mix.raw_weight != 0, w.look.mix.denoised_weight != 0};
    return w;
}

ImageInputs Viewport::image_inputs(const PanelContext& c, const WantedImage& w, const FrameBudget& pace) {
    const auto now = FrameBudget::Clock::now();
    ImageInputs in;
    in.has_frame = c.frame && c.frame->width > 0;
    in.has_image = uploaded_frame_ != nullptr;
    in.new_frame =
        c.frame != uploaded_frame_ || w.view != uploaded_view_ || w.look.numbers.background_as_it_is != look_.numbers.background_as_it_is;
    in.shows_denoised = w.source.shows_denoised;
    in.new_denoised = c.denoised != uploaded_denoised_;
    in.new_gains = w.gains != uploaded_gains_;
    in.edits_mix = in.new_gains && w.can_be_mixed(c);
    if (in.edits_mix) {
        mix_edited_at_ = now;
        const auto drawing = [&](double pixels) { return display_.expected_milliseconds(pixels, in.shows_denoised ? 2 : 1); };
        in.preview_step = preview_.step_in_time(w.source, pace.left(mix_edit_frame, now), drawing);
    }
    in.new_look = w.look != look_;
    in.switched_to_one = w.look.mix != look_.mix && (w.look.mix.raw_weight == 0 || w.look.mix.denoised_weight == 0);
    in.new_shader = shader_changed_;
    in.since_mix_edit = now - mix_edited_at_;
    return in;
}

void Viewport::upload(const PanelContext& c, const WantedImage& w, const ImageStep& step) {
    if (step.preview_step > 1)
        upload_subsampled(w.source, w.gains, step.preview_step);
    else if (step.takes_frame)
        upload_frame(c.frame, w.view, w.gains, w.look.numbers.background_as_it_is);
    if (step.takes_denoised && step.preview_step == 1) upload_denoised(c.denoised, w.gains);
    if (step.takes_frame) uploaded_frame_ = c.frame, uploaded_view_ = w.view;
    if (step.takes_denoised) uploaded_denoised_ = c.denoised;
    if (step.preview_step == 1) preview_.forget();
    uploaded_gains_ = w.gains;
    shader_changed_ = false;
}

// Carries out the step that next() decides.
void Viewport::take_frame(PanelContext& c, const FrameBudget& pace) {
    using Seconds = std::chrono::duration<double>;
    const WantedImage wanted = wanted_image(c);
    const ImageStep step = next(state_, image_inputs(c, wanted, pace));
    if (step.pause_in) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, Seconds(*step.pause_in).count());
    if (step.begins) upload(c, wanted, step);
    if (step.begins || step.restarts) display_.begin(look_ = wanted.look);
    state_ = step.state;
    drew_display_ = display_.busy();
    display_.advance(pace.left(step.awaited ? view_change_frame : default_frame, FrameBudget::Clock::now()));
    if (display_.busy()) {
        c.ui.seconds_to_next_frame = 0;
    } else if (is_drawing(state_)) {
        state_ = drawn(state_);
        shown_frame_ = uploaded_frame_;
        shown_gains_ = uploaded_gains_;
        shows_preview_ = is_preview(state_);
        // the next one may be ready
        c.ui.seconds_to_next_frame = shows_preview_ ? std::min(c.ui.seconds_to_next_frame, Seconds(mix_pause_after).count()) : 0;
    }
}

// For a render region.
void Viewport::draw_surroundings(PanelContext& c, const ImageRect& image, const FrameBudget& pace) {
    const ImageRegion& region = c.project().render.region;
    if (shown_frame_->whole) region_backdrop_.remember(shown_frame_, uploaded_denoised_);
    if (region == ImageRegion{}) return;
    if (!region_backdrop_.update(look_, uploaded_view_, pace)) c.ui.seconds_to_next_frame = 0;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (region_backdrop_.ready()) region_backdrop_.draw(draw, image, region);
    draw_rendered_region(draw, image, region, !region_backdrop_.ready());
}

// A layer of its own over the image: blending a full layer would cost as much as the image.
void Viewport::draw_outline(const PanelContext& c, const ImageRect& image) {
    const Outlined wanted{shown_frame_, c.ui.selected};
    // Not in the same UI frame as the display pass, which has used the time budget.
    const bool later = drew_display_ && outlined_.frame && outlined_.selected == wanted.selected;
    if (outlined_ != wanted && !later) {
        outline_.upload(*shown_frame_, with_descendants(c.scene(), c.ui.selected));
        outlined_ = wanted;
    }
    outline_.draw(int(image.width), int(image.height), std::max(1.5f, ImGui::GetFontSize() / 8));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float width = float(outline_.frame_width()), height = float(outline_.frame_height());
    for (const PixelRect& edge : outline_.edges()) {
        const ImVec2 low{float(edge.x0) / width, float(edge.y0) / height}, high{float(edge.x1) / width, float(edge.y1) / height};
        const auto on_screen = [&](const ImVec2& uv) { return ImVec2{image.x + uv.x * image.width, image.y + uv.y * image.height}; };
        draw.AddImage(texture_id(outline_.texture()), on_screen(low), on_screen(high), low, high);
    }
}

// The image, darker to the left and right of the frame.
void Viewport::draw_texture(const ImageRect& image, const std::optional<ImageRect>& frame) const {
    // clipped to the window: coordinates far outside lose precision
    const ImageRect seen = visible_part(image);
    const float right = seen.x + seen.width, bottom = seen.y + seen.height;
    const auto uv = [&](const ImVec2& at) { return ImVec2{float(image.u(at.x)), float(image.v(at.y))}; };
    const auto part = [&](float from, float to, ImU32 color) {
        const ImVec2 low{std::max(from, seen.x), seen.y}, high{std::min(to, right), bottom};
        if (low.x < high.x) ImGui::GetWindowDrawList()->AddImage(texture_id(display_.texture()), low, high, uv(low), uv(high), color);
    };
    constexpr int dim = brightness_outside_frame;
    const float begin = frame ? frame->x : seen.x, end = frame ? frame->x + frame->width : right;
    part(seen.x, begin, IM_COL32(dim, dim, dim, 255));
    part(begin, end, IM_COL32_WHITE);
    part(end, right, IM_COL32(dim, dim, dim, 255));
}

void Viewport::draw_image(PanelContext& c, const ImageRect& image, bool outlined, const std::optional<ImageRect>& frame) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    // At 1:1 the nearest filter gives the same as the linear filter, and costs less.
    const bool one_to_one = image.width == float(shown_frame_->width) && image.height == float(shown_frame_->height) &&
                            image.x == std::floor(image.x) && image.y == std::floor(image.y);
    const bool sharp = one_to_one || (c.ui.zoom.scale >= 1 && shown_frame_->divider == 1);
    set_filter(display_.texture(), sharp && !shows_preview_ ? GL_NEAREST : GL_LINEAR);
    // opaque: blending would only cost time
    draw.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); }, nullptr);
    draw_texture(image, frame);
    draw.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
    // The outline is drawn at the image's size on the screen; skipped if that is far larger than the window.
    const Region region = window_region();
    const bool fits = image.width <= region.width && image.height <= region.height;
    if (outlined && fits) draw_outline(c, image);
}

// The caption of a special view.
void Viewport::draw_caption(PanelContext& c, const ImageRect& image) const {
    if (!is_special(*shown_frame_, uploaded_view_)) {
        // Frames from before the request do not have the plane.
        const AovView& wanted = c.ui.aov;
        const bool lacks =
            wanted.show != ImageView::Show::beauty && uploaded_view_ == image_view(wanted, int(shown_frame_->bounces.size()));
        if (lacks) write_caption(c, image, name_of(wanted, shown_frame_.get()) + " is not rendered yet");
        return;
    }
    if (uploaded_view_.show == ImageView::Show::illuminance) return;
    write_caption(c, image, caption_of(*shown_frame_, uploaded_view_));
}

void Viewport::handle_requests(PanelContext& c, const NavigationResult& input, const Projection& projection, const ImageRect& image) {
    if (input.view) {
        const bool was_home = is_at_home(c.scene(), c.ui.home);
        c.document.navigate(*input.view);
        move_light_to_view(c);
        if (was_home) move_camera_to_view(c);
    }
    if (input.begins_exposure) {
        exposure_gesture_ = c.ui.gestures.begin();
        c.ui.gestures.end();
    }
    if (input.brighter != 0) expose(c, input.brighter, exposure_gesture_);
    zoom_image(c, input);
    if (input.turned != 0) turn_surroundings(c, input.turned);
    if (input.flying) c.ui.seconds_to_next_frame = 0;
    if (input.focus) focus_at(c, projection, image.u(input.focus->x), image.v(input.focus->y));
    if (input.inspect && image.contains(input.inspect->x, input.inspect->y))
        inspect(c, image.u(input.inspect->x), image.v(input.inspect->y));
    if (input.select) {
        const Picked picked = picked_at(c, projection, image, *input.select);
        c.ui.select(picked.node, picked.material);
    }
    if (input.toggle) {
        const Picked picked = picked_at(c, projection, image, *input.toggle);
        if (picked.node && !toggle_link(c, picked.node, &Light::lit_objects)) c.ui.toggle(picked.node);
    }
    if (input.toggle_shadow) {
        const Picked picked = picked_at(c, projection, image, *input.toggle_shadow);
        if (picked.node && !toggle_link(c, picked.node, &Light::shadow_casters))
            c.ui.toasts.note("Select a light first, to edit its shadow linking");
    }
}

ImageRect Viewport::draw(PanelContext& c, const FrameBudget& pace) {
    take_frame(c, pace);
    const ImageRect image = viewport_image_rect(c);
    ImGui::SetCursorPos({0, 0});
    ImGui::InvisibleButton("image", ImGui::GetWindowSize(),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    c.ui.cursor.reset();
    if (hovered && image.contains(mouse.x, mouse.y)) c.ui.cursor = ImagePosition{image.u(mouse.x), image.v(mouse.y)};
    if (!c.frame) {
        shown_frame_ = uploaded_frame_ = nullptr; // nothing is displayed any more
        region_backdrop_.forget();
    }
    if (!shown_frame_) {
        transformer_.cancel(c);
        using State = SessionStatus::State;
        const bool nothing_open = (c.status.state == State::idle || c.status.state == State::complete) && c.scene().nodes.empty();
        draw_centred(nothing_open ? "Drop a glTF scene here, or press Ctrl+O" : "Preparing the first image");
        return image;
    }
    // A comparison and the surroundings of a region are drawn over the image and dimmed with it.
    const bool alone = c.ui.snapshots.compare.mode == Comparison::Mode::off && c.project().render.region == ImageRegion{};
    draw_image(c, image, c.ui.settings.overlays && c.scene().nodes.contains(c.ui.selected),
               alone ? passepartout_of(c, image) : std::nullopt);
    move_view_to_light(c);
    compare_.draw(c, image, visible_part(image), look_, pace);
    const View view = c.scene().view;
    const Projection projection(view, double(image.width) / image.height);
    const ImageRect seen = visible_part(image);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw_surroundings(c, image, pace);
    draw_camera_frame(c, draw, image, seen, alone);
    compare_.draw_names(seen);
    follow_paths(c);
    bool taken = use_tool(c, projection, image, hovered && !navigation_.busy());
    if (c.ui.tool == ViewTool::none) taken |= draw_overlays(c, projection, image, hovered && !navigation_.busy());
    const bool special = is_special(*shown_frame_, uploaded_view_), map = special && is_map(uploaded_view_);
    if (!special) draw_pixel_grid(draw, image, window_region(), *shown_frame_); // the values are those of the beauty
    draw_false_color_legend(draw, seen, map ? ViewSettings{} : c.project().view);
    if (c.ui.settings.overlays) {
        draw_measured_region(draw, image, c.project().view);
        draw_meters(draw, image, projection, c.scene(), c.project().view, c.ui.meters);
        draw_bleed(draw, image, projection, c.scene(), c.ui.bleed, c.render_width, c.render_height);
    }
    if (c.ui.paths.open) {
        draw.PushClipRect({seen.x, seen.y}, {seen.x + seen.width, seen.y + seen.height}, true);
        draw_path_lines(draw, image, projection, c.ui.paths);
        draw.PopClipRect();
    }
    if (c.ui.pixel) draw_read_pixel(draw, image, c.ui.pixel->u, c.ui.pixel->v);
    draw_map_scale(draw, seen, *shown_frame_, uploaded_view_);
    draw_caption(c, seen);
    if (uploaded_view_.show == ImageView::Show::two_piles && special) draw_two_piles(c, image, seen);
    // the hint of an active transform is at the toolbar's position
    if (c.ui.settings.overlays && !transformer_.is_active()) draw_aov_bar(c, seen);
    navigate(c, projection, image, hovered, taken);
    return image;
}

ImageRect Viewport::draw_alone(PanelContext& c, const FrameBudget& pace, const char* caption) {
    transformer_.cancel(c);
    take_frame(c, pace);
    const ImageRect image = viewport_image_rect(c);
    if (!shown_frame_) {
        draw_centred("Preparing the first image");
        return image;
    }
    region_backdrop_.forget(); // they belong to the previous scene
    draw_image(c, image, false, {});
    write_caption(c, visible_part(image), caption, true); // below is the progress of the job
    return image;
}

// True if the handles or a tool use the left button. Tools are shown even while overlays are off, because the user started them.
bool Viewport::draw_overlays(PanelContext& c, const Projection& projection, const ImageRect& image, bool hovered) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImageRect seen = visible_part(image);
    draw.PushClipRect({seen.x, seen.y}, {seen.x + seen.width, seen.y + seen.height}, true);
    bool taken = false;
    if (c.ui.settings.overlays) {
        draw_light_glyphs(draw, c.scene(), projection, image, c.ui);
        const bool by_hand = c.ui.placing_by == PlacingBy::hand && !(c.ui.light_camera && c.ui.light_camera->node == c.ui.selected);
        if (by_hand) taken = handles_.update(c, draw, projection, image, hovered);
        taken |= draw_environment_dial(c, draw, projection, seen, hovered && !taken);
    }
    if (light_camera_light(c) && c.ui.placing_by == PlacingBy::hand) {
        const Id<Node> id = c.ui.light_camera->node;
        const std::string name = elided(node_name(c.scene(), id, *c.scene().nodes.find(id)), max_name_width());
        draw_hint(draw, "Looking through " + name + ": moving the view moves the light.  L or Esc: back");
    }
    taken |= place_tool_.update(c, draw, projection, image, hovered);
    taken |= transformer_.update(c, draw, projection, image);
    draw.PopClipRect();
    return taken;
}

void Viewport::navigate(PanelContext& c, const Projection& projection, const ImageRect& image, bool hovered, bool on_handle) {
    const NavigationResult input = navigation_.update(c.scene().view, image, hovered, !on_handle);
    if (navigation_.busy() && !navigating_) c.ui.gestures.begin();
    handle_requests(c, input, projection, image);
    if (!navigation_.busy() && navigating_) c.ui.gestures.end();
    navigating_ = navigation_.busy();
}

} // namespace blush
