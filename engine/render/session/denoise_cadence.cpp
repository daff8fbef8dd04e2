#include "render/session/denoise_cadence.h"

#include <algorithm>

namespace blush {
namespace {

// Cost of the qualities relative to the small network: 124 GFLOP per megapixel, then 251, then three times 251.
constexpr std::array<double, 3> relative_cost{1, 2, 6};

constexpr double half_share = 0.25; // of the pixels, and so of the time

DenoiseCadence::Decision wait_for(double seconds) { return {std::nullopt, false, false, seconds}; }

} // namespace

void DenoiseCadence::offer(const Source& source, double now) {
    if (!newest_ || newest_->image != source.image) {
        image_begun_ = now;
        spent_ = 0;
        done_.reset();
    }
    newest_ = source;
}

double DenoiseCadence::coarse_speed() const {
    return coarse_seconds_per_megapixel_ > 0 ? coarse_seconds_per_megapixel_ : seconds_per_megapixel_[size_t(DenoiseQuality::fast)];
}

double DenoiseCadence::predicted(DenoiseQuality quality) const {
    // Larger coarse frames take the time of a part of the whole one, and what these took besides.
    if (newest_->divider > 1) {
        const double beside = std::max(0.0, coarse_speed() - speed()) * std::min(coarse_megapixels_, newest_->megapixels);
        return speed() > 0 && coarse_megapixels_ > 0 ? speed() * newest_->megapixels + beside : coarse_speed() * newest_->megapixels;
    }
    const double measured = seconds_per_megapixel_[size_t(quality)];
    const double speed = measured > 0 ? measured : seconds_per_megapixel_[size_t(DenoiseQuality::fast)] * relative_cost[size_t(quality)];
    return speed * newest_->megapixels;
}

bool DenoiseCadence::halves(DenoiseQuality quality) const {
    if (quality != DenoiseQuality::fast || newest_->divider > 1 || newest_->complete || newest_->amount() >= quick_samples) return false;
    const double known = predicted(quality);
    return (known > 0 ? known : assumed_speed * newest_->megapixels) > quick_seconds;
}

double DenoiseCadence::predicted_run(DenoiseQuality quality) const { return predicted(quality) * (halves(quality) ? half_share : 1); }

bool DenoiseCadence::fits_a_frame() const {
    const double seconds = predicted(DenoiseQuality::fast);
    return seconds > 0 && seconds <= frame_seconds;
}

// True for a coarse image that is finer than the denoised one before, or as fine, with more samples.
bool DenoiseCadence::refines() const {
    return done_ && newest_->divider <= done_->divider && predicted(DenoiseQuality::fast) <= refining_seconds;
}

bool DenoiseCadence::answers_within_a_frame() const { return newest_ && !done_ && fits_a_frame(); }

bool DenoiseCadence::is_done(DenoiseQuality quality) const {
    return done_ && done_->divider == newest_->divider && done_->amount == newest_->amount() && done_->quality >= quality &&
           (!done_->halved || halves(quality));
}

DenoiseCadence::Decision DenoiseCadence::now_with(DenoiseQuality quality) const {
    const bool half = halves(quality);
    const double known = predicted_run(quality),
                 seconds = known > 0 ? known : assumed_speed * newest_->megapixels * (half ? half_share : 1);
    return {quality, half, quality == DenoiseQuality::fast && seconds <= max_pause, 0};
}

DenoiseCadence::Decision DenoiseCadence::next(double now) const {
    if (!newest_) return {};
    if (newest_->divider > 1) {
        if ((fits_a_frame() || refines()) && !is_done(DenoiseQuality::fast)) return now_with(DenoiseQuality::fast);
        return {};
    }
    if (!done_ || done_->divider > 1) return now_with(DenoiseQuality::fast);
    if (done_->halved && newest_->amount() >= quick_samples) return now_with(DenoiseQuality::fast);
    if (newest_->complete) {
        if (is_done(DenoiseQuality::high)) return {};
        return now_with(DenoiseQuality::high);
    }
    const auto affordable_at = [&](DenoiseQuality quality, double share) {
        return image_begun_ + (spent_ + predicted_run(quality)) / share;
    };
    const double rests_at = std::max(image_begun_ + idle_seconds, affordable_at(DenoiseQuality::base, idle_share));
    const DenoiseQuality quality = now >= rests_at ? DenoiseQuality::base : DenoiseQuality::fast;
    if (is_done(quality)) return wait_for(quality == DenoiseQuality::base ? std::numeric_limits<double>::infinity() : rests_at - now);
    const bool renews = newest_->amount() >= double(renewal_growth) * done_->amount;
    const double due_at =
        renews ? affordable_at(quality, renewal_share) : std::max(done_->begun + min_interval, affordable_at(quality, time_share));
    if (now >= due_at) return now_with(quality);
    return wait_for(due_at - now);
}

void DenoiseCadence::record(const Source& source, const Decision& run, double begun, double seconds, bool finished) {
    const DenoiseQuality quality = run.quality.value_or(DenoiseQuality::fast);
    const bool same_image = newest_ && newest_->image == source.image;
    if (same_image) spent_ += seconds;
    if (!finished) return;
    // The first run of a network touches its memory for the first time, and long runs compete with rendering for the processor. So
    // take the fastest run, and let slower runs raise the estimate only gradually.
    const bool refined = same_image && done_ && source.divider > 1 && source.divider < done_->divider;
    if (same_image) done_ = Done{source.amount(), source.divider, quality, run.halves, begun};
    if (refined) return;
    if (source.divider > 1) coarse_megapixels_ = source.megapixels;
    double& speed = source.divider > 1 ? coarse_seconds_per_megapixel_ : seconds_per_megapixel_[size_t(quality)];
    const double measured = seconds / std::max(source.megapixels * (run.halves ? half_share : 1), 1e-6);
    speed = speed == 0 || measured < speed ? measured : 0.75 * speed + 0.25 * measured;
}

} // namespace blush
