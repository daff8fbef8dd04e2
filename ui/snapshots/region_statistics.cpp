#include "ui/snapshots/region_statistics.h"

#include "core/math.h"
#include "io/image/display_image.h"
#include "render/film/coverage.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

std::array<ValueStatistics, 3> by_channel(const std::vector<float>& rgb) {
    std::array<std::vector<float>, 3> channels;
    for (size_t i = 0; i < rgb.size(); ++i) channels[i % 3].push_back(rgb[i]);
    return {value_statistics(channels[0]), value_statistics(channels[1]), value_statistics(channels[2])};
}

} // namespace

RegionStatistics region_statistics(const ShownImage& image) {
    const Frame& frame = *image.frame;
    const ViewSettings& view = image.view;
    const ImageRegion region = view.measured.value_or(ImageRegion{});
    RegionStatistics s;
    s.x = std::clamp(int(region.x * float(frame.width)), 0, frame.width - 1);
    s.y = std::clamp(int(region.y * float(frame.height)), 0, frame.height - 1);
    s.width = std::clamp(int(std::ceil((region.x + region.width) * float(frame.width))) - s.x, 1, frame.width - s.x);
    s.height = std::clamp(int(std::ceil((region.y + region.height) * float(frame.height))) - s.y, 1, frame.height - s.y);
    const DisplayParameters numbers = display_parameters_of(view);
    std::vector<float> rgb, nits, ev, ev100;
    std::vector<Vec3> albedo;
    std::vector<float> coverage;
    for (int y = s.y; y < s.y + s.height; ++y) {
        for (int x = s.x; x < s.x + s.width; ++x) {
            const Vec3 c = mixed_pixel(frame, image.denoised.get(), image.mix, x, y);
            rgb.insert(rgb.end(), {c.x, c.y, c.z});
            nits.push_back(luminance(c));
            // log2(0) is not finite: black pixels are skipped
            ev.push_back(stops_from_grey(numbers, c));
            ev100.push_back(std::log2(nits.back() / 0.125f));
            const size_t pixel = size_t(y) * size_t(frame.width) + size_t(x);
            if (!frame.albedo.empty()) albedo.push_back(frame.albedo[pixel]);
            coverage.push_back(coverage_of_pixel(frame, pixel));
        }
    }
    s.linear = by_channel(rgb);
    s.nits = value_statistics(nits);
    s.ev = value_statistics(ev);
    s.ev100 = value_statistics(ev100);
    if (show(*image.color, view, rgb, {albedo, coverage})) s.displayed = by_channel(rgb);
    return s;
}

} // namespace blush
