#include "ui/views/subject_exposure.h"

#include "core/math.h"
#include "io/image/display_image.h"
#include "render/film/coverage.h"
#include "scene/affine.h"
#include "scene/document/subtree_edits.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace blush {
namespace {

constexpr int cells_across = 40, cells_down = 24;
constexpr double min_subject_area = 0.005; // minimum area of the selection, or of the objects in focus, to be the subject
constexpr double sharp_blur = 0.01;        // diameter of the circle of confusion divided by the height of the image
constexpr double darkest = 1.0 / 256;      // of the mean: darker cells are clamped to this
constexpr double max_clipped = 0.03;       // of the subject, and of the image
constexpr double max_mean_display = 0.55;  // mean display luminance
constexpr float max_lowered = 6, max_lowered_for_background = 1.5f, step = 0.25f; // stops
constexpr float display_white = 0.995f;

struct Cell {
    Vec3d sum{0, 0, 0};
    double pixels = 0;
};

// Means of the selected pixels per cell; cells without any are skipped.
struct Cells {
    std::vector<Vec3> means;
    std::vector<double> shares; // fraction of the image's pixels
    double share = 0;
};

template <class Belongs> Cells cells_of(const Frame& f, const Belongs& belongs) {
    std::vector<Cell> cells(cells_across * cells_down);
    for (int y = 0; y < f.height; ++y)
        for (int x = 0; x < f.width; ++x) {
            const size_t i = size_t(y) * size_t(f.width) + size_t(x);
            const Vec3d rgb{f.rgba[4 * i], f.rgba[4 * i + 1], f.rgba[4 * i + 2]};
            if (!std::isfinite(rgb.x + rgb.y + rgb.z) || !belongs(i)) continue;
            Cell& cell = cells[size_t(y * cells_down / f.height * cells_across + x * cells_across / f.width)];
            cell.sum = cell.sum + rgb;
            ++cell.pixels;
        }
    Cells found;
    const double all = double(f.width) * f.height;
    for (const Cell& cell : cells) {
        if (cell.pixels == 0) continue;
        found.means.push_back(to_float(cell.sum / cell.pixels));
        found.shares.push_back(cell.pixels / all);
        found.share += cell.pixels / all;
    }
    return found;
}

// Blur of a point at `depth` metres, as a fraction of the image's height (thin lens).
double blur(const Lens& lens, double depth) {
    return lens.aperture_radius * std::abs(depth - lens.focus_distance) / (depth * lens.focus_distance * std::tan(lens.yfov_radians / 2));
}

Cells subject_of(const Frame& f, const Scene& scene, std::span<const Id<Node>> selected) {
    const std::vector<float> covered = coverage_of(f);
    const auto is_object = [&](size_t i) { return covered[i] > 0.5f; };
    if (!selected.empty() && !f.object_id.empty()) {
        std::vector<uint32_t> ids;
        for (const Id<Node> root : selected)
            for (const Id<Node> id : subtree(scene, root))
                if (scene.nodes.find(id)->mesh) ids.push_back(id.value); // only objects: the emission of a light is not its subject
        std::ranges::sort(ids);
        Cells cells = cells_of(f, [&](size_t i) { return is_object(i) && std::ranges::binary_search(ids, f.object_id[i]); });
        if (cells.share >= min_subject_area) return cells;
    }
    const Lens& lens = scene.view.lens;
    if (lens.aperture_radius > 0 && !lens.orthographic && !f.depth.empty()) {
        Cells cells = cells_of(f, [&](size_t i) { return is_object(i) && f.depth[i] > 0 && blur(lens, double(f.depth[i])) < sharp_blur; });
        if (cells.share >= min_subject_area) return cells;
    }
    return cells_of(f, is_object);
}

// log2 of the geometric mean of luminance; nullopt if all is black.
std::optional<double> log_average(const Cells& cells) {
    double mean = 0;
    for (size_t i = 0; i < cells.means.size(); ++i) mean += cells.shares[i] * std::max(0.0, double(luminance(cells.means[i])));
    if (!(mean > 0)) return {};
    const double floor = darkest * mean / cells.share;
    double stops = 0;
    for (size_t i = 0; i < cells.means.size(); ++i)
        stops += cells.shares[i] * std::log2(std::max(floor, double(luminance(cells.means[i]))));
    return stops / cells.share;
}

struct Shown {
    double clipped = 0; // fraction of the cells with a channel at display white
    double mean = 0;    // mean display luminance
};
Shown shown_as(const Cells& cells, const ViewSettings& view, const ColorManagement& color) {
    std::vector<float> shown;
    shown.reserve(3 * cells.means.size());
    for (const Vec3& mean : cells.means) shown.insert(shown.end(), {mean.x, mean.y, mean.z});
    Shown s;
    if (!show(color, view, shown)) return s;
    for (size_t i = 0; i < cells.means.size(); ++i) {
        const Vec3 rgb{shown[3 * i], shown[3 * i + 1], shown[3 * i + 2]};
        if (std::max({rgb.x, rgb.y, rgb.z}) >= display_white) s.clipped += cells.shares[i] / cells.share;
        s.mean += double(luminance(rgb)) * cells.shares[i] / cells.share;
    }
    return s;
}

} // namespace

std::optional<float> subject_exposure(const Frame& frame, const Scene& scene, std::span<const Id<Node>> selected, const ViewSettings& view,
                                      const ColorManagement& color) {
    if (frame.width <= 0) return {};
    const Cells subject = subject_of(frame, scene, selected);
    const std::optional<double> average = log_average(subject);
    if (!average) return {};
    ViewSettings shown = view;
    shown.auto_exposure = AutoExposure::off;
    shown.false_color = {};
    const float wanted = std::clamp(float(std::log2(0.18) - *average), -20.f, 20.f);
    const auto lowered = [&](const Cells& cells, float from, float most, double brightest_mean) {
        for (shown.exposure_ev = from; shown.exposure_ev > from - most; shown.exposure_ev -= step) {
            const Shown s = shown_as(cells, shown, color);
            if (s.clipped <= max_clipped && s.mean <= brightest_mean) break;
        }
        return shown.exposure_ev;
    };
    const float for_subject = lowered(subject, wanted, max_lowered, 1);
    // A dark subject in front of a bright background: limits the exposure so that the whole image is not too bright.
    const float for_image =
        lowered(cells_of(frame, [](size_t) { return true; }), for_subject, max_lowered_for_background, max_mean_display);
    return std::clamp(for_image, -20.f, 20.f);
}

} // namespace blush
