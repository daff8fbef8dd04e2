#include "render/session/scheduler.h"

#include "render/session/error_cadence.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Exponent of relmse as a function of samples: independent samples have -1, well distributed ones do better in smooth images.
constexpr double fastest_error_exponent = -1.5;
// Time of a sample with kept seeds over one as the pilots decided, until it has been measured: 1.3 in the pool, 3.6 in the metal ring and
// 6 in the wine glass, where light paths save walks. Too coarse a first image is better than one that is late.
constexpr double seeded_over_decided = 6;
constexpr double trust_in_whole = 0.5; // in the time of the last samples at full resolution, over those before

} // namespace

void Scheduler::restart(const RenderSettings& settings, bool interactive) {
    settings_ = settings;
    interactive_ = interactive;
    seeded_ = false;
    film_divider_ = 0;
    next_sample_ = settings.first_sample;
    seconds_ = last_publish_ = 0;
    error_ = -1;
    error_samples_ = 0;
}

void Scheduler::resume(int64_t samples, double seconds) {
    film_divider_ = 1;
    next_sample_ = settings_.first_sample + samples;
    seconds_ = last_publish_ = seconds;
}

// The finest resolution at which an image that takes `full_seconds` at full size takes at most `budget`.
int Scheduler::divider_within(double budget, double full_seconds) const {
    const int long_side = std::max(settings_.width, settings_.height);
    const auto too_slow = [&](int divider, double seconds) {
        return divider < coarsest_divider && full_seconds / (divider * divider) > seconds && long_side / (divider + 1) >= min_long_side;
    };
    // A series of edits keeps one resolution although timings vary: changes of it are visible as flicker.
    const int last = last_first_divider_;
    if (last > 0 && !too_slow(last, budget * timing_tolerance) && (last == 1 || too_slow(last - 1, budget / timing_tolerance))) return last;
    int divider = 1;
    while (too_slow(divider, budget)) ++divider;
    return divider;
}

// Expected; 0: unknown.
double Scheduler::first_sample_seconds() const {
    if (!seeded_) return timings_.first_sample_seconds;
    if (timings_.seeded_first_sample_seconds > 0) return timings_.seeded_first_sample_seconds;
    return seeded_over_decided * std::max(timings_.first_sample_seconds, timings_.sample_seconds);
}

int Scheduler::first_divider() const {
    if (!interactive_) return 1;
    // Without measurements, assume two million full paths per second.
    const double pixels = double(settings_.width) * double(settings_.height);
    const double measured = first_sample_seconds(), full = measured > 0 ? measured : pixels / 2e6;
    const int raw = divider_within(first_image_seconds, full);
    if (raw == 1 || denoising_.coarse == 0) return raw;
    // At least half of the time is left, so that a slow machine does not get images that are too coarse to be mixed with history.
    const double left = std::max(first_denoised_seconds - denoising_.finishing, first_denoised_seconds / 2);
    const int denoised = divider_within(left, full + pixels * denoising_.coarse);
    return denoised <= 2 * raw ? std::max(raw, denoised) : raw;
}

// True if the film is coarse, and as many samples again take little of the time of one at full resolution.
bool Scheduler::coarse_image_is_worth_more() const {
    if (film_divider_ <= 1) return false;
    if (settings_.spp > 0 && settings_.first_sample + 2 * coarse_samples_ > settings_.spp) return false;
    const double more = double(coarse_samples_) * first_sample_seconds() / (double(film_divider_) * double(film_divider_));
    return seconds_ + more <= coarse_share * first_sample_seconds();
}

// Of the second coarse image; 0: none, as it would be hardly finer than the first.
int Scheduler::refined_divider() const {
    if (film_divider_ <= 1 || denoising_.coarse == 0 || denoising_.whole == 0) return 0;
    if (settings_.spp > 0 && settings_.first_sample + refined_samples > settings_.spp) return 0;
    const double sample = first_sample_seconds();
    const double denoising = double(settings_.width) * double(settings_.height) * denoising_.whole;
    const double seconds = refined_share * (sample + denoising);
    int divider = 2;
    while (double(refined_samples) * sample + denoising > seconds * divider * divider) ++divider;
    return least_refinement * divider <= film_divider_ ? divider : 0;
}

double Scheduler::publish_interval() const {
    if (seconds_ < 1) return 0.1;
    if (seconds_ < 4) return 0.25;
    if (seconds_ < 15) return 0.5;
    return 1;
}

Work Scheduler::next(bool lacks_light_paths) const {
    Work work;
    work.publish = true;
    work.completes = lacks_light_paths;
    if (lacks_light_paths) return work;
    work.first_sample = settings_.first_sample;
    work.count = 1;
    if (film_divider_ == 0) {
        work.divider = first_divider();
        work.clear = true;
        work.always_finish = true;
        return work;
    }
    if (const int divider = refined_divider()) {
        work.count = refined_samples;
        work.divider = divider;
        work.clear = true;
        if (coarse_samples_ >= refined_samples) return work;
        work.first_sample += coarse_samples_;
        work.count -= coarse_samples_;
        work.divider = film_divider_;
        work.clear = false;
        return work;
    }
    if (coarse_image_is_worth_more()) {
        work.divider = film_divider_;
        work.first_sample += coarse_samples_;
        work.count = coarse_samples_;
        return work;
    }
    if (film_divider_ > 1) {
        // Full resolution is next. An intermediate size would show one sample, with a higher error than the several of the coarse image.
        // Where pilots would discard a slow first sample with seeds, they run before it. An image of one sample has no pilots.
        work.clear = true;
        work.decides = seeded_ && settings_.spp != settings_.first_sample + 1;
        return work;
    }
    work.first_sample = next_sample_;
    work.decides = next_sample_ > 0;
    const double sample = std::max(timings_.sample_seconds, 1e-6);
    // Doubling keeps the number of resolves logarithmic at first;
    // later the remaining interval bounds the wait for the next frame.
    const double left = publish_interval() - (seconds_ - last_publish_);
    int64_t count = std::max<int64_t>(1, std::min<int64_t>(samples(), int64_t(left / sample)));
    if (settings_.spp > 0) count = std::min(count, settings_.spp - next_sample_);
    if (settings_.seconds > 0) count = std::min(count, std::max<int64_t>(1, int64_t((settings_.seconds - seconds_) / sample)));
    // The error estimate needs both halves: an even number of samples keeps them equal.
    if (count > 1 && settings_.spp <= 0) count &= ~int64_t(1);
    work.count = std::min<int64_t>(count, 1024);
    const double after = seconds_ + double(work.count) * sample;
    const bool last = settings_.spp > 0 && next_sample_ + work.count >= settings_.spp;
    work.publish = last || samples() < 8 || after - last_publish_ >= 0.9 * publish_interval() ||
                   error_may_be_reached(samples() + work.count) || (settings_.seconds > 0 && after >= settings_.seconds);
    return work;
}

void Scheduler::record_render(const Work& work, double seconds) {
    seconds_ += seconds;
    if (work.completes) {
        // As if the sample that they belong to had taken so much longer.
        timings_.sample_seconds += trust_in_whole * seconds;
        return;
    }
    const double pixels_share = 1.0 / (double(work.divider) * double(work.divider));
    const double per_sample = seconds / (double(work.count) * pixels_share);
    const auto follow = [&](double& seconds_per_sample, double trust) {
        seconds_per_sample = seconds_per_sample > 0 ? (1 - trust) * seconds_per_sample + trust * per_sample : per_sample;
    };
    // Small films have idle lanes and cold caches, so they predict full-size timings less well.
    const bool whole = work.divider == 1;
    follow(timings_.sample_seconds, whole ? trust_in_whole : 0.25);
    // An image has at most one whole sample of these, which must do to follow a scene that became slower.
    if (!whole || (work.first_sample == settings_.first_sample && !work.decides))
        follow(seeded_ ? timings_.seeded_first_sample_seconds : timings_.first_sample_seconds, whole ? 0.75 : 0.25);

    if (work.always_finish) last_first_divider_ = work.divider;
    film_divider_ = work.divider;
    coarse_samples_ = work.first_sample + work.count - settings_.first_sample;
    if (work.divider == 1) next_sample_ = work.first_sample + work.count;
}

void Scheduler::record_error(double error) {
    error_ = error;
    error_samples_ = samples();
}

bool Scheduler::error_may_be_reached(int64_t samples) const {
    if (settings_.error <= 0 || film_divider_ != 1 || !(error_ >= 0)) return false;
    const double grown = double(samples) / double(std::max<int64_t>(1, error_samples_));
    return grown >= ErrorCadence::growth && error_ * std::pow(grown, fastest_error_exponent) <= settings_.error;
}

bool Scheduler::finished() const {
    if (film_divider_ != 1) return false;
    if (settings_.spp > 0 && next_sample_ >= settings_.spp) return true;
    if (settings_.seconds > 0 && seconds_ >= settings_.seconds) return true;
    return settings_.error > 0 && error_ >= 0 && error_ <= settings_.error;
}

double Scheduler::progress() const {
    if (finished()) return 1;
    double p = 0;
    if (settings_.spp > settings_.first_sample) p = std::max(p, double(samples()) / double(settings_.spp - settings_.first_sample));
    if (settings_.seconds > 0) p = std::max(p, seconds_ / settings_.seconds);
    // The error falls as 1 / samples, so this is the completed share of the needed samples.
    if (settings_.error > 0 && error_ > 0) p = std::max(p, settings_.error / error_);
    return std::min(p, 0.999);
}

} // namespace blush
