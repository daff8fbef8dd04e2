#include "render/comparison/metropolis.h"

#include "render/comparison/primary_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush {
namespace {

// Independent paths that begin the chains of a pass, as a share of the mutations.
constexpr int64_t mutations_per_start = 4;
constexpr int64_t min_starts = 256, starts_per_task = 1024;
// A dimension behind those of the paths.
constexpr uint32_t pixel_dimension = 1u << 30;

// What one state of the chain adds to the image.
struct Contribution {
    std::vector<Splat> splats;
    double amount = 0; // luminance, of all pixels
};

class MutatedPaths {
public:
    MutatedPaths(const KernelContext& context, const LightPathEmission& emission, std::vector<Splat>& bad)
        : paths_(context, emission), width_(context.settings.width), height_(context.settings.height), bad_(bad) {}

    // Splats that are not finite go to the film, which reports them.
    void evaluate(PrimarySamples& numbers, Contribution& c) {
        c.splats.clear();
        c.amount = 0;
        const Pair<float> where = numbers.pair(pixel_dimension), path = numbers.pair(PrimarySamples::fixed_dimension);
        CameraSample camera;
        camera.on_lens = numbers.pair(1);
        camera.x = along(where.bits_x, width_, camera.in_pixel.bits_x);
        camera.y = along(where.bits_y, height_, camera.in_pixel.bits_y);
        paths_.trace(numbers, camera, {path.bits_x, path.bits_y}, c.splats);
        std::erase_if(c.splats, [&](const Splat& splat) {
            const bool good = std::isfinite(splat.radiance.x + splat.radiance.y + splat.radiance.z);
            if (!good) bad_.push_back(splat);
            return !good;
        });
        for (const Splat& splat : c.splats) c.amount += std::max(double(luminance(splat.radiance)), 0.0);
    }

private:
    // The pixel at this place of an axis; what is left is uniform in the pixel.
    static int along(uint32_t place, float size, uint32_t& left) {
        const uint64_t scaled = uint64_t(place) * uint64_t(size);
        left = uint32_t(scaled);
        return int(scaled >> 32);
    }

    BidirectionalPaths paths_;
    float width_, height_;
    std::vector<Splat>& bad_;
};

void add_scaled(const Contribution& c, double scale, std::vector<Splat>& out) {
    if (!(scale > 0)) return;
    for (Splat splat : c.splats) {
        splat.radiance = splat.radiance * float(scale);
        out.push_back(splat);
    }
}

// The chain from the path of `seed`. `scale`: what a state adds per luminance.
void run_chain(MutatedPaths& paths, uint64_t seed, int64_t mutations, double large_steps, double scale, std::vector<Splat>& out) {
    PrimarySamples numbers(seed);
    Contribution now, next;
    paths.evaluate(numbers, now);
    double weight = 0; // of `now`, in states
    for (int64_t i = 0; i < mutations; ++i) {
        numbers.mutate(numbers.random() < large_steps);
        paths.evaluate(numbers, next);
        const double acceptance = std::min(1.0, next.amount / now.amount);
        // Both states count, with their expected share of the decision (Veach 1997, section 11.5).
        weight += 1 - acceptance;
        if (numbers.random() < acceptance) {
            add_scaled(now, weight * scale / now.amount, out);
            std::swap(now, next);
            weight = acceptance;
        } else {
            if (acceptance > 0) add_scaled(next, acceptance * scale / next.amount, out);
            numbers.reject();
        }
    }
    add_scaled(now, weight * scale / now.amount, out);
}

} // namespace

bool Metropolis::prepare(const PreparationContext& context) {
    scene_.prepare(context);
    return true;
}

bool Metropolis::trace_pass(int64_t sample, const PreparationContext& whole, std::vector<std::vector<Splat>>& tiles) {
    SceneTables tables;
    const KernelContext context = scene_.context(whole.kernel, tables);
    const int64_t mutations = int64_t(context.settings.width) * int64_t(context.settings.height);
    const int64_t starts = std::max(min_starts, mutations / mutations_per_start);
    const uint64_t first_seed = (uint64_t(pcg_hash(context.seed ^ 0x3e7909u)) << 32) + uint64_t(sample) * 0x9e3779b97f4a7c15u;
    const int64_t tasks = (starts + starts_per_task - 1) / starts_per_task;
    const int64_t chains = std::max<int64_t>(1, mutations / options_.chain);
    tiles.assign(size_t(tasks + chains), {});

    std::vector<double> amounts(size_t(starts), 0.0);
    const bool began = whole.workers.for_each(tasks, whole.wanted, [&](int64_t task, unsigned) {
        MutatedPaths paths(context, scene_.emission(), tiles[size_t(task)]);
        Contribution c;
        for (int64_t i = task * starts_per_task; i < std::min(starts, (task + 1) * starts_per_task); ++i) {
            PrimarySamples numbers(first_seed + uint64_t(i));
            paths.evaluate(numbers, c);
            amounts[size_t(i)] = c.amount;
        }
    });
    if (!began) return false;
    std::vector<double> sums;
    double sum = 0;
    for (const double amount : amounts) sums.push_back(sum += amount);
    if (!(sum > 0)) return true;

    // One random number chooses the beginnings of all chains, evenly over the sum.
    const double offset = PrimarySamples(first_seed + uint64_t(starts)).random();
    return whole.workers.for_each(chains, whole.wanted, [&](int64_t chain, unsigned) {
        const double at = (double(chain) + offset) / double(chains) * sum;
        const auto start = std::min<int64_t>(std::ranges::upper_bound(sums, at) - sums.begin(), starts - 1);
        std::vector<Splat>& out = tiles[size_t(tasks + chain)];
        MutatedPaths paths(context, scene_.emission(), out);
        const int64_t first = chain * mutations / chains, end = (chain + 1) * mutations / chains;
        run_chain(paths, first_seed + uint64_t(start), end - first, double(options_.large_steps), sum / double(starts), out);
    });
}

} // namespace blush
