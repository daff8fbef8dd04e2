#include "measure/metrics/bleed_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

// As many decimals as the interval justifies.
std::string with_interval(const Interval& i, double factor, int most_decimals) {
    const double value = i.value * factor, half = (i.high - i.low) / 2 * factor;
    const int decimals = half > 0 ? std::clamp(1 - int(std::floor(std::log10(half))), 0, most_decimals) : std::min(most_decimals, 2);
    return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, half, decimals);
}

const char* noun_of(BleedTarget::Kind kind) { return kind == BleedTarget::Kind::incoming ? "light that arrives here" : "light seen here"; }

} // namespace

std::string percent_text(const Interval& share) { return share.known ? with_interval(share, 100, 3) + " %" : "..."; }

std::string light_text(const Interval& light, BleedTarget::Kind kind) {
    const char* unit = kind == BleedTarget::Kind::incoming ? "lx" : "nits";
    return light.known ? fmt::format("{} {}", with_interval(light, 1, 6), unit) : "...";
}

std::string sentence_of(const BleedShare& row, BleedTarget::Kind kind) {
    const char* verb = row.by == SentBy::itself ? "is" : row.by == SentBy::light ? "gives" : "adds";
    const std::string name = row.by == SentBy::itself ? "What is seen directly" : row.name;
    std::string text = fmt::format("{} {} {} of the {}", name, verb, percent_text(row.share), noun_of(kind));
    if (row.by != SentBy::object) return text + ".";
    const ColorShift& s = row.shift;
    if (!s.length.known) return text + " and does not move its colour measurably.";
    return text + fmt::format(" and moves its colour by {} towards {}.", with_interval(s.length, 1, 5), s.towards);
}

std::string summary_of(const BleedReport& report, BleedTarget::Kind kind) {
    if (!report.lit) return "The scene has no light.";
    if (!report.whole.known) return "No light found yet.";
    if (report.whole.value == 0) return "No light arrives here.";
    const ColorShift& s = report.indirect.shift;
    std::string text = fmt::format("{} of the {} has been scattered by other surfaces", percent_text(report.indirect.share), noun_of(kind));
    if (report.direct.rgb == Vec3d{0, 0, 0}) return text + "; no direct light arrives.";
    if (!s.length.known) return text + ". It does not move the colour measurably.";
    return text + fmt::format(". It moves the colour of direct light by {} towards {} (u'v'): Delta E 2000 {:.1f} by hue alone, {:.1f} "
                              "with its brightness.",
                              with_interval(s.length, 1, 5), s.towards, s.hue.value, s.delta_e.value);
}

std::vector<std::string> limits_of(const BleedReport& report, const RenderSettings& settings) {
    std::vector<std::string> limits;
    if (!report.missing_light.empty()) limits.push_back(report.missing_light);
    if (settings.caustics == CausticStrategy::automatic || settings.caustics == CausticStrategy::light_paths ||
        settings.caustics == CausticStrategy::manifold)
        limits.push_back("Caustics for which the image may use light paths or manifold sampling take the probe longer.");
    if (settings.clamp.limit > 0) limits.push_back("The image is clamped, the probe is not.");
    if (settings.max_bounces != unlimited_bounces)
        limits.push_back(fmt::format("Light that is scattered more than {} is left out, as in the image.",
                                     settings.max_bounces == 1 ? std::string("once") : fmt::format("{} times", settings.max_bounces)));
    if (report.dropped > 0) limits.push_back(fmt::format("{} samples are not valid and were dropped, as in the image.", report.dropped));
    return limits;
}

} // namespace blush
