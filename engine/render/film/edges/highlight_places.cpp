#include "render/film/edges/highlight_places.h"

#include "render/integrator/camera.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace blush {
namespace {

constexpr double aimed_share = 0.5; // of the samples
constexpr size_t most_places = 32;  // of a pixel: those with the most light

// Offset from the pixel's centre along one axis.
double offset_of(const FilterTable& filter, double u) {
    const double x = u * FilterTable::size;
    const int i = std::min(int(x), FilterTable::size - 1);
    const double a = filter.offset[size_t(i)], b = filter.offset[size_t(i) + 1];
    return a + (b - a) * (x - i);
}

// Density of offset_of.
double filter_pdf(const FilterTable& filter, double offset) {
    const auto& table = filter.offset;
    if (!(offset >= table.front()) || !(offset < table.back())) return 0;
    const auto above = std::ranges::upper_bound(table, float(offset));
    const size_t i = size_t(std::clamp<std::ptrdiff_t>(above - table.begin() - 1, 0, FilterTable::size - 1));
    const double step = double(table[i + 1]) - double(table[i]);
    return step > 0 ? 1 / (step * FilterTable::size) : 0;
}
double filter_pdf(const FilterTable& filter, double x, double y) { return filter_pdf(filter, x) * filter_pdf(filter, y); }

// Share of a place's light that the filter lets a pixel see, at a grid of its points.
double seen_share(const HighlightPlace& p, int x, int y, const FilterTable& filter) {
    constexpr int grid = 5;
    double sum = 0;
    for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
            const double s = (2 * i + 1.0) / grid - 1, t = (2 * j + 1.0) / grid - 1;
            sum += filter_pdf(filter, p.x + s * p.ax + t * p.bx - x - 0.5, p.y + s * p.ay + t * p.by - y - 0.5);
        }
    return sum / (grid * grid);
}

} // namespace

double HighlightPlace::area() const { return 4 * std::abs(ax * by - ay * bx); }

bool HighlightPlace::contains(double at_x, double at_y) const {
    const double dx = at_x - x, dy = at_y - y, det = ax * by - ay * bx;
    return std::abs(dx * by - dy * bx) <= std::abs(det) && std::abs(dy * ax - dx * ay) <= std::abs(det);
}

HighlightPlaces::HighlightPlaces(std::span<const HighlightPlace> places, int width, int height, const FilterTable& filter) {
    std::map<std::pair<int, int>, std::vector<Near>> of_pixel; // by y, then x
    const double reach = std::max(-double(filter.offset.front()), double(filter.offset.back()));
    for (const HighlightPlace& place : places) {
        if (!(place.area() > 0) || !(place.light > 0)) continue;
        const double rx = std::abs(place.ax) + std::abs(place.bx) + reach, ry = std::abs(place.ay) + std::abs(place.by) + reach;
        const auto bound = [](double v, int size) { return int(std::clamp(v, -1.0, double(size))); };
        const int x0 = std::max(0, bound(std::floor(place.x - rx - 0.5), width)),
                  y0 = std::max(0, bound(std::floor(place.y - ry - 0.5), height));
        const int x1 = std::min(width - 1, bound(std::ceil(place.x + rx - 0.5), width));
        const int y1 = std::min(height - 1, bound(std::ceil(place.y + ry - 0.5), height));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x)
                if (const double seen = seen_share(place, x, y, filter); seen > 0)
                    of_pixel[{y, x}].push_back({place, place.light * place.area() * seen, 0});
    }
    for (auto& [at, all] : of_pixel) {
        std::ranges::stable_sort(all, std::ranges::greater{}, &Near::probability);
        if (all.size() > most_places) all.resize(most_places);
        double sum = 0, light = 0, below = 0;
        for (const Near& n : all) sum += n.probability, light = std::max(light, n.place.light);
        for (Near& n : all) {
            n.probability /= sum;
            n.bound = below += n.probability;
        }
        all.back().bound = 1;
        pixels_.push_back({at.second, at.first, light, near_.size(), all.size()});
        near_.insert(near_.end(), all.begin(), all.end());
    }
}

std::span<const HighlightPlaces::Near> HighlightPlaces::near(int x, int y) const {
    const auto at = std::ranges::lower_bound(pixels_, std::pair(y, x), {}, [](const Pixel& p) { return std::pair(p.y, p.x); });
    if (at == pixels_.end() || at->x != x || at->y != y) return {};
    return std::span(near_).subspan(at->first, at->count);
}

HighlightPlaces::Sample HighlightPlaces::sample(int x, int y, double u, double v, const FilterTable& filter) const {
    const std::span<const Near> all = near(x, y);
    const double centre_x = x + 0.5, centre_y = y + 0.5;
    if (all.empty()) return {centre_x, centre_y, -1};
    Sample s{centre_x, centre_y, 0};
    if (u < aimed_share) {
        u /= aimed_share;
        const Near& n = *std::ranges::find_if(all, [&](const Near& near) { return u < near.bound; });
        const double a = 2 * std::clamp((u - n.bound + n.probability) / n.probability, 0.0, 1.0) - 1, b = 2 * v - 1;
        s.x = n.place.x + a * n.place.ax + b * n.place.bx;
        s.y = n.place.y + a * n.place.ay + b * n.place.by;
    } else {
        s.x += offset_of(filter, (u - aimed_share) / (1 - aimed_share));
        s.y += offset_of(filter, v);
    }
    const double f = filter_pdf(filter, s.x - centre_x, s.y - centre_y);
    double aimed = 0;
    for (const Near& n : all)
        if (n.place.contains(s.x, s.y)) aimed += n.probability / n.place.area();
    const double q = (1 - aimed_share) * f + aimed_share * aimed;
    s.weight = f > 0 ? f / q : 0;
    return s;
}

void aim_samples(const HighlightPlaces& places, const FilterTable& filter, int count, const AimedColumns& samples) {
    for (int k = 0; k < count; ++k) {
        const HighlightPlaces::Sample s =
            places.sample(int(samples.pixel_x[k]), int(samples.pixel_y[k]), double(samples.x[k]), double(samples.y[k]), filter);
        samples.x[k] = float(s.x);
        samples.y[k] = float(s.y);
        samples.weight[k] = float(s.weight);
    }
}

} // namespace blush
