#include "app/editor/editor_display.h"

#include "app/commands/render/command_feature_report.h"

#include <chrono>

namespace blush {

void EditorDisplay::update_shader(const ViewSettings& view, const FramePtr& frame, Viewport& viewport, ThumbnailSheet& thumbnails,
                                  Toasts& toasts) {
    using Clock = std::chrono::steady_clock;
    const DisplayTransform wanted = transform_of(view);
    // No OCIO processor and no lookup tables before the first image.
    if (!frame || (shader_ready_ && wanted == transform_)) return;
    shader_ready_ = true;
    transform_ = wanted;
    const auto begin = Clock::now();
    const auto shader = color_.display_shader(wanted);
    if (!shader) return toasts.fail(shader.error().text());
    thumbnails.set_shader(*shader);
    strategies_.set_shader(*shader);
    integrators_.set_shader(*shader);
    if (const auto set = viewport.set_display_shader(*shader); !set) toasts.fail(set.error().text());
    int64_t bytes = 0;
    for (const DisplayShader::Lut& lut : shader->luts) bytes += int64_t(lut.values.size() * sizeof(float));
    view_transform_ = {"display", "view transform",
                       true,      "the image is shown through it",
                       bytes,     std::chrono::duration<double>(Clock::now() - begin).count()};
    feature_report_.clear();
}

ImTextureID EditorDisplay::strategies(UiState& ui, const ViewSettings& view) {
    const StrategiesView& v = ui.strategies;
    const auto& report = v.state.output;
    if (!v.open || !report) {
        strategies_.clear();
        return {};
    }
    const SheetSource source{report, int(v.show)};
    if (v.show != StrategiesView::Show::image) {
        strategies_.show_texels(source, report->width, [&] { return strategy_texels(*report, v.show); });
        return strategies_.texture();
    }
    const auto images = [&] {
        return std::vector<std::span<const Vec3>>{report->sides[0].image, report->sides[1].image, report->mis().image};
    };
    if (!strategies_.show_images(source, report->width, report->height, images, display_parameters_of(view))) ui.seconds_to_next_frame = 0;
    return strategies_.texture();
}

ImTextureID EditorDisplay::integrators(UiState& ui, const ViewSettings& view) {
    const IntegratorsView& v = ui.integrators;
    const auto& report = v.state.output;
    if (!v.open || !report) {
        integrators_.clear();
        return {};
    }
    const bool difference = v.show == IntegratorsView::Show::difference;
    const SheetSource source{report, int(difference)};
    if (difference) {
        integrators_.show_texels(source, report->width, [&] { return difference_texels(*report); });
        return integrators_.texture();
    }
    const auto images = [&] { return std::vector<std::span<const Vec3>>{report->path.image, report->biased.image}; };
    if (!integrators_.show_images(source, report->width, report->height, images, display_parameters_of(view))) ui.seconds_to_next_frame = 0;
    return integrators_.texture();
}

void EditorDisplay::meter(AutoExposure rule, const FramePtr& frame) {
    if (rule == metered_by_ && (rule == AutoExposure::off || frame == metered_)) return;
    metered_by_ = rule;
    metered_ = rule == AutoExposure::off ? nullptr : frame;
    metered_ev_ = metered_ ? metered_exposure(rule, metered_->rgba, 4) : 0;
}

void EditorDisplay::update_feature_report(const SessionStatus& status) {
    const FeatureUse image_library = image_library_use();
    if (!feature_report_.empty() && status.denoised_with == denoised_with_ && feature_report_.front().used == image_library.used) return;
    denoised_with_ = status.denoised_with;
    feature_report_ = denoiser_feature_report(weights_, denoised_with_);
    feature_report_.insert(feature_report_.begin(), {image_library, view_transform_});
}

} // namespace blush
