#include "app/commands/lesson/claims.h"

#include "measure/metrics/bleed_probe.h"
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace blush {
namespace {

constexpr int64_t most_paths = int64_t(1) << 21;
constexpr size_t least_pairs = 8, most_pairs = 64;

ClaimVerdict verdict_of(const LessonClaim& claim, const Interval& value) {
    if (!value.known || !std::isfinite(value.low) || !std::isfinite(value.high)) return ClaimVerdict::undecided;
    if (value.low >= claim.low && value.high <= claim.high) return ClaimVerdict::holds;
    if (value.high < claim.low || value.low > claim.high) return ClaimVerdict::fails;
    return ClaimVerdict::undecided;
}

// A sender that sends nothing has no row.
std::optional<Interval> probed(const LessonClaim& claim, const BleedReport& report) {
    if (claim.quantity == LessonClaim::Quantity::luminance) return report.whole;
    if (claim.name == "direct") return report.direct.share;
    if (claim.name == "indirect") return report.indirect.share;
    const auto row = std::ranges::find(report.senders, claim.name, &BleedShare::name);
    return row == report.senders.end() ? std::nullopt : std::optional(row->share);
}

MeasuredClaim by_probe(const Project& state, const LessonClaim& claim, unsigned threads, const std::function<bool()>& wanted) {
    MeasuredClaim m;
    const auto& [x, y, w, h] = claim.rect;
    const BleedTarget target{.pixels = PixelRect{x, y, x + w, y + h}};
    BleedProbe probe(threads);
    probe.begin(state.scene, state.render, {&target, 1});
    // At doubled numbers of paths: an interval that is looked at after each round would leave its 95 %.
    for (int64_t next = 2 * 16 * bleed_batch_paths; next <= most_paths && m.verdict == ClaimVerdict::undecided; next *= 2) {
        while (probe.paths() < next)
            if (!probe.round(wanted)) return m.note = "interrupted", m;
        const std::optional<Interval> value = probed(claim, probe.report(0));
        m.work = probe.paths();
        m.note = value ? "" : fmt::format("nothing comes from \"{}\"", claim.name);
        m.value = value.value_or(Interval{});
        m.verdict = verdict_of(claim, m.value);
    }
    return m;
}

// Renders a pair of images of independent seeds; empty if stopped.
struct Pair {
    double squared = 0, mean = 0;
};
std::optional<Pair> render_pair(Renderer& renderer, const Scene& scene, RenderSettings settings, uint32_t seed,
                                const std::function<bool()>& wanted) {
    std::vector<float> images[2];
    for (uint32_t k = 0; k < 2; ++k) {
        settings.seed = 2 * seed + k;
        renderer.update(scene, settings);
        if (!renderer.render(0, settings.spp, wanted)) return {};
        images[k] = renderer.resolve().rgba;
    }
    Pair pair;
    const size_t pixels = images[0].size() / 4;
    for (size_t i = 0; i < pixels; ++i) {
        constexpr double luminance[] = {0.2126, 0.7152, 0.0722}; // Rec.709
        for (size_t c = 0; c < 3; ++c) {
            const double a = images[0][4 * i + c], b = images[1][4 * i + c];
            pair.squared += (a - b) * (a - b) / 2;
            pair.mean += luminance[c] * (a + b) / 2;
        }
    }
    pair.squared /= double(3 * pixels);
    pair.mean /= double(pixels);
    return pair;
}

// Of mean(y) / mean(x).
Interval ratio_interval(const std::vector<double>& x, const std::vector<double>& y) {
    double sum_x = 0, sum_y = 0;
    for (size_t i = 0; i < x.size(); ++i) sum_x += x[i], sum_y += y[i];
    if (!(sum_x > 0)) return {};
    const double ratio = sum_y / sum_x, mean_x = sum_x / double(x.size());
    std::vector<double> off;
    for (size_t i = 0; i < x.size(); ++i) off.push_back((y[i] - ratio * x[i]) / mean_x);
    const Interval around = mean_interval(off);
    return {around.known, ratio, ratio + around.low - around.value, ratio + around.high - around.value};
}

Interval root(const Interval& i) { return {i.known, std::sqrt(i.value), std::sqrt(std::max(i.low, 0.0)), std::sqrt(i.high)}; }

MeasuredClaim by_pairs(const LessonStep& step, const Project& state, const LessonClaim& claim, unsigned threads,
                       const std::function<bool()>& wanted) {
    MeasuredClaim m;
    const bool noise = claim.quantity == LessonClaim::Quantity::noise;
    const Result<RenderOptions> changed = options_with(step, claim.setting, claim.value);
    if (!changed) return m.note = changed.error().text(), m;
    RenderSettings other = changed->settings;
    other.width = state.render.width;
    other.height = state.render.height;
    Renderer renderer({.threads = threads}), other_renderer({.threads = threads, .integrator = changed->integrator});
    std::vector<double> x, y;
    for (uint32_t k = 0; k < most_pairs; ++k) {
        const std::optional<Pair> own = render_pair(renderer, state.scene, state.render, 2 * k, wanted);
        const std::optional<Pair> with = render_pair(other_renderer, state.scene, other, 2 * k + 1, wanted);
        if (!own || !with) return m.note = "interrupted", m;
        x.push_back(noise ? own->squared : own->mean);
        y.push_back(noise ? with->squared : with->mean);
        m.work = int64_t(x.size());
        // At doubled numbers, as in by_probe().
        if (x.size() < least_pairs || (x.size() & (x.size() - 1)) != 0) continue;
        const Interval ratio = ratio_interval(x, y);
        m.value = noise ? root(ratio) : ratio;
        if (m.verdict = verdict_of(claim, m.value); m.verdict != ClaimVerdict::undecided) break;
    }
    return m;
}

} // namespace

MeasuredClaim measure_claim(const LessonStep& step, const Project& state, const LessonClaim& claim, unsigned threads,
                            const std::function<bool()>& wanted) {
    return claim.setting.empty() ? by_probe(state, claim, threads, wanted) : by_pairs(step, state, claim, threads, wanted);
}

std::string claim_text(const LessonClaim& claim, const MeasuredClaim& m) {
    constexpr const char* names[] = {"share", "luminance", "noise", "mean"};
    std::string what = names[int(claim.quantity)];
    const auto& [x, y, w, h] = claim.rect;
    if (!claim.name.empty()) what += " of " + claim.name;
    what += claim.setting.empty() ? fmt::format(" at {},{},{},{}", x, y, w, h) : fmt::format(" with {}={}", claim.setting, claim.value);
    if (!m.note.empty()) return what + ": " + m.note;
    return fmt::format("{}: {:.4g} ({:.4g} .. {:.4g}), claimed {:g} .. {:g}", what, m.value.value, m.value.low, m.value.high, claim.low,
                       claim.high);
}

} // namespace blush
