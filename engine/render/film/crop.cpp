#include "render/film/crop.h"

namespace blush {

Frame cropped(const Frame& frame, const PixelRect& rect) {
    Frame part = frame;
    part.width = rect.x1 - rect.x0;
    part.height = rect.y1 - rect.y0;
    const auto crop = [&](auto& plane) { plane = cropped(plane, frame.width, rect); };
    part.rgba = cropped(frame.rgba, frame.width, rect, 4);
    for (auto* plane : {&part.pixel_samples, &part.depth, &part.path_length, &part.survival}) crop(*plane);
    for (auto* plane : {&part.albedo, &part.normal, &part.standard_error, &part.half_difference}) crop(*plane);
    for (auto* plane : {&part.object_id, &part.material_id, &part.health.dropped_map}) crop(*plane);
    for (auto& plane : part.bounces) crop(plane);
    for (auto& plane : part.strategies) crop(plane);
    for (auto& plane : part.groups) crop(plane);
    for (auto& plane : part.group_half_differences) crop(plane);
    part.error = {};
    part.group_shares.clear();
    return part;
}

DenoisedPtr cropped(const DenoisedPtr& image, const PixelRect& rect) {
    if (!image) return nullptr;
    auto part = std::make_shared<DenoisedImage>(*image);
    part->width = rect.x1 - rect.x0;
    part->height = rect.y1 - rect.y0;
    part->denoised.rgb = cropped(image->denoised.rgb, image->width, rect, 3);
    part->with_history = {};
    part->groups.reset();
    part->gains.clear();
    return part;
}

} // namespace blush
