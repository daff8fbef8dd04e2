#include "render/pilots/edges/edge_pilot.h"

#include "core/math.h"
#include "render/film/edges/edge_samples.h"
#include "render/pilots/edges/highlight_location.h"
#include "render/pilots/edges/highlight_samples.h"
#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t edge_pilot_seed = 0x3c6ef372u; // any; it only has to differ from those of images
constexpr int tile_side = 32;
constexpr int coarse_divider = 4, coarse_samples = 2;
constexpr int pixel_samples = 16; // of a pixel whose neighbours differ in emission

double luminance_in(const TileScratch& tile, int slot) {
    const double l = luminance(Vec3d{tile.r[slot], tile.g[slot], tile.b[slot]});
    return std::isfinite(l) ? std::max(l, 0.0) : 0.0; // faults are the film's to report
}

// Luminance of all samples of an image, pixel by pixel.
struct Samples {
    int width = 0, height = 0, per_pixel = 1;
    std::vector<double> luminance;

    double at(int x, int y, int s = 0) const { return luminance[(size_t(y) * size_t(width) + size_t(x)) * size_t(per_pixel) + size_t(s)]; }
};

constexpr int first_measured_samples = 32, measured_samples = 128;
constexpr size_t nearest_measured = 256; // that take all of these in any case
constexpr double significant_sigmas = 2; // of what was sighted, beyond what the samples met
constexpr int fewest_measured = 512, most_measured = 2048, pixels_per_measured = 64;

class Pilot {
public:
    Pilot(const KernelContext& context, const EdgeKernels& kernels, double light_path_work, int longest_chain, const Workers& workers,
          std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted)
        : context_(context), kernels_(kernels), workers_(workers), scratch_(scratch), wanted_(wanted) {
        context_.seed = edge_pilot_seed;
        noise_.light_path_work = light_path_work;
        chains_ = context_;
        restrict_to_emission(chains_, tables_, longest_chain);
        emission_ = chains_;
        emission_.settings.max_bounces = 0;
        context_.settings.reuse = {};
        context_.settings.max_bounces = pilot_max_bounces;
        for (auto& s : scratch_)
            if (!s) s = std::make_unique<TileScratch>();
    }

    std::optional<EdgesFound> find(const Sightings& sightings);

private:
    bool render(KernelContext context, const Kernel& kernel, int divider, int per_pixel, Samples& to);
    bool render_coarse();
    // Mean light R of paths that found no emission, near a pixel.
    double other_light(int x, int y) const;
    bool is_edge(int x, int y, TileScratch& scratch) const;
    bool find_edges(EdgePixels& pixels);
    void choose_measured(const std::vector<Sighting>& nearest, double spacing, size_t most);
    bool locate(const Sightings& sightings);
    bool measure_all();
    // Adds samples.
    void measure(MeasuredPixel& pixel, int samples, TileScratch& scratch) const;
    void estimate(MeasuredPixel& pixel) const;
    std::vector<SmallHighlights::Band> unmeasured(const Sightings& sightings) const;
    double unexplained_variance(const Sightings& sightings) const;
    ImageNoise noise_with_highlights(double unexplained) const;
    void measure_cells(const Sightings& sightings, double unexplained);
    bool find_highlights(const Sightings& sightings, EdgesFound& found);
    void add_unmeasured(const Sightings& sightings, SmallHighlights& highlights) const;
    const MeasuredPixel* measured_at(int x, int y) const;
    // Calls take(MeasuredPixel) for those among a pixel and its neighbours.
    template <class Take> void for_each_near(const MeasuredPixel& pixel, const Take& take) const;
    // Of the image's rate of highlights.
    double share_of_sample(const MeasuredPixel& pixel) const { return 1 / (double(place_.size()) * pixel.measured); }

    KernelContext context_, chains_, emission_;
    SceneTables tables_; // of the emission
    EdgeKernels kernels_;
    const Workers& workers_;
    std::vector<std::unique_ptr<TileScratch>>& scratch_;
    const std::function<bool()>& wanted_;
    Samples seen_;                   // emission of the film
    Samples paths_, emissions_;      // of the coarse image
    ImageNoise noise_, other_noise_; // of all light; of all but emission that delta lobes lead to
    std::vector<MeasuredPixel> measured_;
    std::vector<int32_t> place_;   // by pixel: in `measured_`; -1: none
    std::vector<FaintCell> cells_; // of the sightings
    HighlightPlaces places_;
};

bool Pilot::render(KernelContext context, const Kernel& kernel, int divider, int per_pixel, Samples& to) {
    to.width = std::max(1, int(context.settings.width) / divider);
    to.height = std::max(1, int(context.settings.height) / divider);
    to.per_pixel = per_pixel;
    to.luminance.resize(size_t(to.width) * size_t(to.height) * size_t(per_pixel));
    context.settings.width = float(to.width);
    context.settings.height = float(to.height);
    const int across = (to.width + tile_side - 1) / tile_side, down = (to.height + tile_side - 1) / tile_side;
    return workers_.for_each(int64_t(across) * down, wanted_, [&](int64_t i, unsigned worker) {
        TileJob tile{.x = int(i % across) * tile_side, .y = int(i / across) * tile_side, .samples = per_pixel};
        tile.width = std::min(tile_side, to.width - tile.x);
        tile.height = std::min(tile_side, to.height - tile.y);
        kernel.render(context, tile, *scratch_[worker]);
        const int row = tile.width * per_pixel;
        for (int y = 0; y < tile.height; ++y)
            for (int k = 0; k < row; ++k)
                to.luminance[(size_t(tile.y + y) * size_t(to.width) + size_t(tile.x)) * size_t(per_pixel) + size_t(k)] =
                    luminance_in(*scratch_[worker], y * row + k);
    });
}

bool Pilot::render_coarse() {
    for (const auto& s : scratch_) s->camera_rays = s->bounce_rays = s->shadow_rays = 0;
    if (!render(context_, kernels_.paths, coarse_divider, coarse_samples, paths_)) return false;
    for (const auto& s : scratch_)
        noise_.work += double(s->camera_rays) + double(s->bounce_rays) + shadow_ray_cost * double(s->shadow_rays);
    if (!render(chains_, kernels_.emission, coarse_divider, coarse_samples, emissions_)) return false;
    const double pixels = double(paths_.width) * double(paths_.height);
    noise_.work = noise_.work / (coarse_samples * pixels) + noise_.light_path_work;
    for (int y = 0; y < paths_.height; ++y)
        for (int x = 0; x < paths_.width; ++x) {
            const double a = paths_.at(x, y, 0), b = paths_.at(x, y, 1), scale = (a + b) * (a + b) / 4 + dark_squared;
            const double other = a - emissions_.at(x, y, 0) - b + emissions_.at(x, y, 1);
            noise_.add((a - b) * (a - b) / 2 / pixels, scale);
            other_noise_.add(other * other / 2 / pixels, scale);
        }
    other_noise_.work = noise_.work;
    other_noise_.light_path_work = noise_.light_path_work;
    return true;
}

double Pilot::other_light(int x, int y) const {
    const int near_x = std::min(x / coarse_divider, paths_.width - 1), near_y = std::min(y / coarse_divider, paths_.height - 1);
    double sum = 0;
    int count = 0;
    for (int v = std::max(0, near_y - 1); v <= std::min(paths_.height - 1, near_y + 1); ++v)
        for (int u = std::max(0, near_x - 1); u <= std::min(paths_.width - 1, near_x + 1); ++u)
            for (int s = 0; s < coarse_samples; ++s)
                if (emissions_.at(u, v, s) == 0) {
                    sum += paths_.at(u, v, s);
                    ++count;
                }
    return count > 0 ? sum / count : 0;
}

bool Pilot::is_edge(int x, int y, TileScratch& scratch) const {
    double low = seen_.at(x, y), high = low;
    for (int v = std::max(0, y - 1); v <= std::min(seen_.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(seen_.width - 1, x + 1); ++u) {
            low = std::min(low, seen_.at(u, v));
            high = std::max(high, seen_.at(u, v));
        }
    if (low == high) return false;
    const double other = other_light(x, y);
    // No more variance than this is possible: half of the pixel each.
    constexpr double rays = edge_samples + 1;
    if (!noise_.is_worth((high - low) * (high - low) / 4, low + other, rays)) return false;
    kernels_.emission.render(emission_, {.x = x, .y = y, .width = 1, .height = 1, .first_sample = 2, .samples = pixel_samples}, scratch);
    // Both sides count once more than they were found (rule of succession): samples easily miss a side of low coverage.
    double sum = low + high, squares = low * low + high * high;
    for (int k = 0; k < pixel_samples; ++k) {
        const double l = luminance_in(scratch, k);
        sum += l;
        squares += l * l;
    }
    const double mean = sum / (pixel_samples + 2), variance = squares / (pixel_samples + 2) - mean * mean;
    return noise_.is_worth(variance * (1 - 1.0 / edge_samples - 2 * other / (high - low)), mean + other, rays);
}

bool Pilot::find_edges(EdgePixels& pixels) {
    std::vector<uint8_t> found(seen_.luminance.size()); // EdgePixels counts its pixels, so threads cannot share it
    const bool all = workers_.for_each(seen_.height, wanted_, [&](int64_t y, unsigned worker) {
        for (int x = 0; x < seen_.width; ++x) found[size_t(y) * size_t(seen_.width) + size_t(x)] = is_edge(x, int(y), *scratch_[worker]);
    });
    for (int y = 0; y < seen_.height; ++y)
        for (int x = 0; x < seen_.width; ++x)
            if (found[size_t(y) * size_t(seen_.width) + size_t(x)]) pixels.add(x, y);
    return all;
}

const MeasuredPixel* Pilot::measured_at(int x, int y) const {
    if (x < 0 || y < 0 || x >= seen_.width || y >= seen_.height) return nullptr;
    const int32_t place = place_[size_t(y) * size_t(seen_.width) + size_t(x)];
    return place < 0 ? nullptr : &measured_[size_t(place)];
}

template <class Take> void Pilot::for_each_near(const MeasuredPixel& pixel, const Take& take) const {
    for (int y = pixel.y - 1; y <= pixel.y + 1; ++y)
        for (int x = pixel.x - 1; x <= pixel.x + 1; ++x)
            if (const MeasuredPixel* near = measured_at(x, y)) take(*near);
}

// The pixels in which highlights were located, and those around each sighting without, as far as the next path that looked for them:
// nearest lamps first, while there are not too many pixels.
void Pilot::choose_measured(const std::vector<Sighting>& nearest, double spacing, size_t most) {
    place_.assign(size_t(seen_.width) * size_t(seen_.height), -1);
    const auto add = [&](int x, int y, double sighted) {
        int32_t& place = place_[size_t(y) * size_t(seen_.width) + size_t(x)];
        if (place < 0) {
            if (measured_.size() == most) return;
            place = int32_t(measured_.size());
            measured_.push_back({.x = x, .y = y});
        }
        MeasuredPixel& pixel = measured_[size_t(place)];
        pixel.sighted = std::min(pixel.sighted, sighted);
    };
    places_.for_each_pixel(add);
    const int reach = int(std::ceil(spacing));
    for (const Sighting& s : nearest)
        for (int y = std::max(0, s.y - reach); y <= std::min(seen_.height - 1, s.y + reach); ++y)
            for (int x = std::max(0, s.x - reach); x <= std::min(seen_.width - 1, s.x + reach); ++x) add(x, y, s.luminance);
}

// Most pixels near a sighting do not have the highlight: all take a few samples, and the nearest ones and those at which a highlight was
// met take the others. A few are enough where samples aim at it.
bool Pilot::measure_all() {
    const auto measure_some = [&](const std::vector<size_t>& places, int samples) {
        for (auto& s : scratch_) {
            s->bounces = std::make_unique<BounceColumns>(1); // to tell emission that is seen directly
            if (!s->chains) s->chains = std::make_unique<ChainColumns>();
            s->chains->places = places_.empty() ? nullptr : &places_;
        }
        const bool all = workers_.for_each(int64_t(places.size()), wanted_, [&](int64_t i, unsigned worker) {
            measure(measured_[places[size_t(i)]], samples, *scratch_[worker]);
        });
        for (auto& s : scratch_) {
            s->bounces.reset();
            s->chains->places = nullptr;
        }
        return all;
    };
    std::vector<size_t> places(measured_.size());
    std::iota(places.begin(), places.end(), size_t(0));
    if (!measure_some(places, first_measured_samples)) return false;
    std::vector<uint8_t> is_near(measured_.size());
    std::erase_if(places, [&](size_t place) { return places_.aims(measured_[place].x, measured_[place].y); });
    for (size_t k = 0; k < std::min(places.size(), nearest_measured); ++k) is_near[places[k]] = true;
    for (const MeasuredPixel& pixel : measured_)
        if (pixel.has_highlight())
            for_each_near(pixel, [&](const MeasuredPixel& near) { is_near[size_t(&near - measured_.data())] = true; });
    std::erase_if(places, [&](size_t place) { return !is_near[place]; });
    return measure_some(places, measured_samples - first_measured_samples);
}

void Pilot::measure(MeasuredPixel& pixel, int samples, TileScratch& scratch) const {
    const int64_t before = scratch.camera_rays + scratch.bounce_rays;
    const TileJob job{.x = pixel.x, .y = pixel.y, .width = 1, .height = 1, .first_sample = pixel.measured, .samples = samples};
    kernels_.emission.trace_chains(chains_, job, scratch);
    pixel.rays += double(scratch.camera_rays + scratch.bounce_rays - before);
    pixel.measured += samples;
    const RadianceColumns& seen = scratch.bounces->after[0];
    for (int k = 0; k < samples; ++k) {
        const double l = luminance_in(scratch, k);
        pixel.sum += l;
        pixel.squares += l * l;
        pixel.low = std::min(pixel.low, l);
        pixel.high = std::max(pixel.high, l);
        const double path_squares = l > 0 ? std::max(l * l, scratch.chains->path_squares[k]) : 0;
        pixel.path_squares += path_squares;
        pixel.path_high = std::max(pixel.path_high, path_squares);
        const double direct = luminance(Vec3d{seen.r[k], seen.g[k], seen.b[k]}), behind = path_squares - direct * direct;
        const Vec3d light{scratch.r[k] - seen.r[k], scratch.g[k] - seen.g[k], scratch.b[k] - seen.b[k]};
        if (const double met = luminance(light); met > 0 && std::isfinite(behind) && behind > 0)
            pixel.met.push_back({met, behind / met, met * met / behind, light});
    }
}

// Once all are measured.
void Pilot::estimate(MeasuredPixel& pixel) const {
    double low = pixel.low, high = pixel.high, path_high = pixel.path_high;
    for_each_near(pixel, [&](const MeasuredPixel& near) {
        low = std::min(low, near.low);
        high = std::max(high, near.high);
        path_high = std::max(path_high, near.path_high);
    });
    const double other = other_light(pixel.x, pixel.y), n = pixel.measured + 2, mean = (pixel.sum + low + high) / n;
    pixel.mean = mean + other;
    if (path_high == 0) return;
    pixel.variance = std::max(0.0, (pixel.squares + low * low + high * high) / n - mean * mean);
    pixel.path_variance = std::max(pixel.variance, (pixel.path_squares + low * low + path_high) / n - mean * mean);
    pixel.cancelled = 2 * mean * other;
}

// Sightings that the samples of the measured pixels do not explain, by octave: as far as their rate is significantly larger than that of
// what the samples met. Light of a sighting may be met an octave brighter or darker.
std::vector<SmallHighlights::Band> Pilot::unmeasured(const Sightings& sightings) const {
    constexpr size_t octaves = SmallHighlights::num_bands;
    const SmallHighlights sighted = highlights_of(sightings);
    std::array<double, octaves> squares{}, met{};
    for (const Sighting& s : sightings.all) squares[SmallHighlights::octave_of(s.luminance)] += s.band.rate * s.band.rate;
    for (const MeasuredPixel& pixel : measured_)
        for (const MetLight& m : pixel.met) met[SmallHighlights::octave_of(m.path_luminance)] += share_of_sample(pixel) * m.path_rate;
    std::vector<SmallHighlights::Band> result(octaves);
    for (size_t k = 0; k < octaves; ++k) {
        const SmallHighlights::Band& band = sighted.bands[k];
        const double near = met[k] + (k > 0 ? met[k - 1] : 0) + (k + 1 < octaves ? met[k + 1] : 0);
        const double left = band.rate - near - significant_sigmas * std::sqrt(squares[k]);
        if (left > 0) result[k] = {left, band.sum * (left / band.rate)};
    }
    return result;
}

// Of highlights: what was sighted, beyond what the samples of the measured pixels met.
double Pilot::unexplained_variance(const Sightings& sightings) const {
    double variance = 0;
    for (const Sighting& s : sightings.all) variance += s.band.rate * s.luminance * s.luminance;
    for (const MeasuredPixel& pixel : measured_)
        for (const MetLight& m : pixel.met) variance -= share_of_sample(pixel) * m.luminance * m.path_luminance;
    return std::max(0.0, variance);
}

// Of the image if no pixel takes more samples.
ImageNoise Pilot::noise_with_highlights(double unexplained) const {
    double highlights = unexplained;
    for (const MeasuredPixel& pixel : measured_) highlights += pixel.path_variance / double(place_.size());
    return {other_noise_.mse + highlights, other_noise_.relmse + highlights * relative_to_variance(measured_), other_noise_.work,
            other_noise_.light_path_work};
}

// Variances of the cells of the sightings, each as a mean over the cells around it: few samples look for the lamps of one. Their sum is at
// most what the measured pixels leave unexplained.
void Pilot::measure_cells(const Sightings& sightings, double unexplained) {
    const size_t count = sightings.cells.size();
    const double share = 1 / double(place_.size());
    std::vector<FaintCell> own(count);
    for (const Sighting& s : sightings.all) {
        FaintCell& cell = own[s.cell];
        const double squares = s.band.rate * s.luminance * s.luminance;
        cell.path_variance += squares;
        cell.variance += squares * s.share;
    }
    std::map<std::pair<int, int>, size_t> at;
    for (size_t k = 0; k < count; ++k) {
        const PixelRect& in = sightings.cells[k];
        at[{in.x0 / sightings.side, in.y0 / sightings.side}] = k;
        own[k].pixels = double(in.x1 - in.x0) * double(in.y1 - in.y0);
    }
    cells_.assign(count, {});
    double sum = 0;
    for (const auto& [place, k] : at) {
        FaintCell& cell = cells_[k];
        double pixels = 0;
        for (int y = place.second - 1; y <= place.second + 1; ++y)
            for (int x = place.first - 1; x <= place.first + 1; ++x)
                if (const auto near = at.find({x, y}); near != at.end()) {
                    const FaintCell& of = own[near->second];
                    cell.path_variance += of.path_variance;
                    cell.variance += of.variance;
                    pixels += of.pixels;
                }
        for (double* of : {&cell.path_variance, &cell.variance}) *of *= own[k].pixels / pixels;
        const PixelRect& in = sightings.cells[k];
        cell.pixels = own[k].pixels;
        cell.rays = sightings.rays;
        for (int y = in.y0; y < in.y1; ++y)
            for (int x = in.x0; x < in.x1; ++x)
                if (const MeasuredPixel* pixel = measured_at(x, y)) {
                    cell.path_variance -= share * pixel->path_variance;
                    cell.variance -= share * pixel->variance;
                    --cell.pixels;
                }
        sum += std::max(0.0, cell.path_variance);
    }
    for (FaintCell& cell : cells_) {
        const double part = sum > unexplained ? unexplained / sum : 1;
        cell.path_variance = std::max(0.0, cell.path_variance) * part;
        cell.variance = std::clamp(cell.variance * part, 0.0, cell.path_variance);
    }
}

// Finds the places of highlights and the pixels to measure. False if not wanted any more.
bool Pilot::locate(const Sightings& sightings) {
    const auto pixels = seen_.luminance.size();
    const auto most = size_t(std::clamp(int(pixels) / pixels_per_measured, fewest_measured, most_measured));
    const std::vector<Sighting> nearest = small_highlights(sightings, double(most), double(pixels));
    auto located = locate_highlights(chains_, kernels_.emission, nearest, sightings.spacing, workers_, scratch_, wanted_);
    if (!located) return false;
    places_ = HighlightPlaces(located->places, seen_.width, seen_.height, *context_.settings.filter);
    std::vector<Sighting> others;
    for (size_t k = 0; k < nearest.size(); ++k)
        if (!located->by_sighting[k]) others.push_back(nearest[k]);
    choose_measured(others, sightings.spacing, most);
    return true;
}

bool Pilot::find_highlights(const Sightings& sightings, EdgesFound& found) {
    if (!locate(sightings) || !measure_all()) return false;
    for (MeasuredPixel& pixel : measured_) estimate(pixel);
    const double unexplained = unexplained_variance(sightings);
    measure_cells(sightings, unexplained);
    choose_highlight_samples(measured_, cells_, double(place_.size()), noise_with_highlights(unexplained));
    for (const MeasuredPixel& pixel : measured_) {
        const double share = share_of_sample(pixel);
        if (pixel.samples > 0) found.pixels.add(pixel.x, pixel.y, pixel.samples);
        for (const MetLight& m : pixel.met)
            if (pixel.samples > 0)
                found.highlights.add(m.luminance, {share, m.light * share}, pixel.samples);
            else
                found.highlights.add(m.path_luminance, {share * m.path_rate, m.light * share});
    }
    for (size_t k = 0; k < cells_.size(); ++k) {
        if (!cells_[k].taken) continue;
        const PixelRect& in = sightings.cells[k];
        for (int y = in.y0; y < in.y1; ++y)
            for (int x = in.x0; x < in.x1; ++x)
                if (!measured_at(x, y)) found.pixels.add(x, y, faint_highlight_samples);
    }
    add_unmeasured(sightings, found.highlights);
    if (!found.pixels.empty()) found.pixels.aim_at(std::move(places_));
    return true;
}

// Sightings beyond what the measured pixels explain, by the samples that their cells take.
void Pilot::add_unmeasured(const Sightings& sightings, SmallHighlights& highlights) const {
    const std::vector<SmallHighlights::Band> left = unmeasured(sightings);
    const SmallHighlights sighted = highlights_of(sightings);
    for (const Sighting& s : sightings.all) {
        const size_t octave = SmallHighlights::octave_of(s.luminance);
        if (!(left[octave].rate > 0)) continue;
        const double part = left[octave].rate / sighted.bands[octave].rate;
        const SmallHighlights::Band band{s.band.rate * part, s.band.sum * part};
        if (cells_[s.cell].taken)
            highlights.add(s.luminance * s.share, {band.rate / s.share, band.sum}, faint_highlight_samples);
        else
            highlights.add(s.luminance, band);
    }
}

std::optional<EdgesFound> Pilot::find(const Sightings& sightings) {
    if (!render(emission_, kernels_.emission, 1, 1, seen_)) return std::nullopt;
    const bool may_have_edges = !std::ranges::all_of(seen_.luminance, [&](double l) { return l == seen_.luminance[0]; });
    if (!may_have_edges && sightings.all.empty()) return EdgesFound{};
    if (!render_coarse()) return std::nullopt;
    EdgesFound found{EdgePixels(seen_.width, seen_.height, int(chains_.settings.max_bounces)), {}};
    if (may_have_edges && !find_edges(found.pixels)) return std::nullopt;
    if (!find_highlights(sightings, found)) return std::nullopt;
    return found;
}

} // namespace

std::optional<EdgesFound> find_edge_pixels(const KernelContext& context, const EdgeKernels& kernels, double light_path_work,
                                           int longest_chain, const Sightings& sightings, const Workers& workers,
                                           std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    return Pilot(context, kernels, light_path_work, longest_chain, workers, scratch, wanted).find(sightings);
}

} // namespace blush
