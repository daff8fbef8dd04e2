#include "render/session/background_denoiser.h"

#include "render/session/halved_frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <utility>

namespace blush {
namespace {

// A third of a stop: an edit that changes the exposure scale by less
// keeps it, so that brightness does not flicker while dragging.
constexpr float scale_tolerance = 1.26f;
constexpr double correction_growth = 1.5; // of the samples: then the bias is corrected again

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Its result, or why it threw.
template <class Make> auto attempt(const Make& make) -> decltype(make()) {
    try {
        return make();
    } catch (const std::bad_alloc&) { return {nullptr, "not enough memory to denoise"}; } catch (const std::exception& e) {
        return {nullptr, e.what()};
    }
}

DenoiseCadence::Source source_of(uint64_t image, const Frame& frame) {
    // Each light group is denoised separately.
    const double planes = double(std::max<size_t>(1, frame.groups.size()));
    const double megapixels = planes * double(frame.width) * double(frame.height) * 1e-6;
    return {image, frame.samples, frame.divider, frame.complete, megapixels, frame.light_path_share};
}

} // namespace

DenoiserMaker denoiser_maker(std::filesystem::path weights, unsigned threads, bool low_priority) {
    return [=]() -> DenoiseFunction {
        return [denoiser = std::make_shared<Denoiser>(weights, threads, low_priority)](
                   const DenoiseInput& input, const DenoiseOptions& options, const std::function<bool()>& wanted) {
            return denoiser->denoise(input, options, wanted);
        };
    };
}

BackgroundDenoiser::BackgroundDenoiser(DenoiserMaker maker, unsigned threads, bool low_priority, double grace_seconds, PauseGate& gate,
                                       OnAnswer on_answer, OnRelease on_release)
    : maker_(std::move(maker)), threads_(threads), low_priority_(low_priority), grace_seconds_(grace_seconds), gate_(gate),
      on_answer_(std::move(on_answer)), on_release_(std::move(on_release)) {
    if (maker_) thread_ = std::thread([this] { run(); });
}

BackgroundDenoiser::~BackgroundDenoiser() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    gate_.notify();
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
}

void BackgroundDenoiser::want(bool wanted) {
    {
        const std::lock_guard lock(mutex_);
        if (wanted_ && !wanted) unwanted_since_ = now();
        wanted_ = wanted;
        update_pause();
    }
    gate_.notify();
    wake_.notify_one();
}

bool BackgroundDenoiser::offer(uint64_t image, FramePtr frame) {
    bool promised = false;
    {
        const std::lock_guard lock(mutex_);
        cadence_.offer(source_of(image, *frame), now());
        promised = wanted_ && maker_ && failure_.empty() && cadence_.answers_within_a_frame();
        newest_ = {image, std::move(frame), promised};
        // A later frame of an image that is being replaced changes nothing.
        newest_image_ = promised ? image : std::max<uint64_t>(newest_image_, image);
        update_pause();
    }
    gate_.notify();
    wake_.notify_one();
    return promised;
}

double BackgroundDenoiser::coarse_speed() const {
    const std::lock_guard lock(mutex_);
    return wanted_ && failure_.empty() ? cadence_.coarse_speed() : 0;
}

double BackgroundDenoiser::speed() const {
    const std::lock_guard lock(mutex_);
    return wanted_ && failure_.empty() ? cadence_.speed() : 0;
}

double BackgroundDenoiser::finishing_seconds(bool enlarges, uint64_t look) const {
    const std::lock_guard lock(mutex_);
    if (enlarges) return enlarging_seconds_;
    return history_look_ == look ? history_seconds_ : 0;
}

void BackgroundDenoiser::supersede(uint64_t image) {
    {
        const std::lock_guard lock(mutex_);
        newest_image_ = image;
        update_pause();
    }
    gate_.notify();
}

bool BackgroundDenoiser::is_on() const {
    const std::lock_guard lock(mutex_);
    return wanted_ && maker_ && failure_.empty();
}

std::string BackgroundDenoiser::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

bool BackgroundDenoiser::is_wanted(const Task& task) const { return !quit_ && wanted_ && (task.promised || newest_image_ == task.image); }

bool BackgroundDenoiser::is_wanted_by_now(const Task& task) const {
    gate_.wait_while_closed([&] { return task.promised || !is_wanted(task); });
    return is_wanted(task);
}

DenoiseOptions BackgroundDenoiser::options_for(const Task& task, DenoiseQuality quality, size_t group) const {
    DenoiseOptions options;
    options.quality = quality;
    if (group < scales_.size()) options.exposure_scale = scales_[group];
    if (scale_image_ != task.image) options.exposure_tolerance = scale_tolerance;
    return options;
}

// One input for the whole image, or one for each light group.
Result<std::vector<Denoised>> BackgroundDenoiser::denoise_all(const Task& task, const Frame& frame, DenoiseQuality quality) const {
    std::vector<Denoised> all;
    for (const DenoiseInput& input : denoise_inputs(frame)) {
        Result<std::optional<Denoised>> result =
            denoise_(input, options_for(task, quality, all.size()), [&] { return is_wanted_by_now(task); });
        if (!result) return result.error();
        if (!*result) return std::vector<Denoised>();
        all.push_back(**std::move(result));
    }
    return all;
}

BackgroundDenoiser::Outcome BackgroundDenoiser::finish(const FramePtr& frame, DenoiseQuality quality, std::vector<Denoised> planes) {
    const double begun = now();
    std::shared_ptr<DenoisedImage> denoised = denoised_image(*frame, quality, std::move(planes), &*workers_);
    output_.samples = frame->samples;
    output_.is_corrected = denoised->denoised.bias_corrected;
    const double made = now();
    history_.follow(frame, *denoised, &*workers_);
    return {std::move(denoised), {}, now() - begun, made - begun, now() - made};
}

BackgroundDenoiser::Outcome BackgroundDenoiser::denoise(const Task& task, const DenoiseCadence::Decision& decision) {
    return attempt([&]() -> Outcome {
        if (!denoise_) denoise_ = maker_();
        if (!workers_) workers_.emplace(threads_, low_priority_);
        const DenoiseQuality quality = *decision.quality;
        const FramePtr frame = decision.halves ? halved(task.frame, &*workers_) : task.frame;
        Result<std::vector<Denoised>> all = denoise_all(task, *frame, quality);
        if (!all) return {nullptr, all.error().text()};
        if (all->empty()) return {};
        scales_.clear();
        for (const Denoised& d : *all) scales_.push_back(d.exposure_scale);
        scale_image_ = task.image;
        output_ = frame->divider == 1 ? NetworkOutput{task.image, quality, *all} : NetworkOutput();
        const double preparing = all->front().seconds_of_preparation;
        Outcome outcome = finish(frame, quality, *std::move(all));
        outcome.seconds_not_denoising += preparing;
        return outcome;
    });
}

bool BackgroundDenoiser::may_correct_again() const {
    if (!wanted_ || !failure_.empty() || !newest_.frame || newest_.image != output_.image || newest_.image != newest_image_) return false;
    const Frame& frame = *newest_.frame;
    if (frame.divider > 1 || frame.half_difference.empty() || std::max<size_t>(1, frame.groups.size()) != output_.planes.size())
        return false;
    return !output_.is_corrected || double(frame.samples) >= correction_growth * double(output_.samples);
}

void BackgroundDenoiser::correct_again(std::unique_lock<std::mutex>& lock) {
    const Task task = newest_;
    lock.unlock();
    Outcome outcome;
    if (is_wanted_by_now(task)) outcome = attempt([&] { return finish(task.frame, output_.quality, output_.planes); });
    lock.lock();
    failure_ = std::move(outcome.failure);
    history_look_ = history_.look();
    lock.unlock();
    on_answer_(task.image, task.frame, std::move(outcome.denoised));
    lock.lock();
}

// Infinite while denoised images are wanted, or if there is nothing to free.
double BackgroundDenoiser::seconds_to_release() const {
    if (wanted_ || !denoise_) return std::numeric_limits<double>::infinity();
    return std::max(0.0, unwanted_since_ + grace_seconds_ - now());
}

void BackgroundDenoiser::release(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    denoise_ = {};
    history_.forget();
    output_ = {};
    on_release_();
    lock.lock();
}

DenoiseCadence::Decision BackgroundDenoiser::due() const {
    const bool outdated = newest_.image != newest_image_ && !newest_.promised;
    return wanted_ && maker_ && failure_.empty() && !outdated ? cadence_.next(now()) : DenoiseCadence::Decision{};
}

// Before the thread that offers a frame continues to render.
void BackgroundDenoiser::update_pause() { pauses_rendering_ = (running_.quality ? running_ : due()).pauses_rendering; }

void BackgroundDenoiser::run() {
    std::unique_lock lock(mutex_);
    while (!quit_) {
        if (seconds_to_release() == 0) {
            release(lock);
            continue;
        }
        const DenoiseCadence::Decision decision = due();
        // A run of the large network does not pause rendering, and takes long.
        if (!decision.pauses_rendering && may_correct_again()) {
            correct_again(lock);
            continue;
        }
        if (!decision.quality) {
            const double wait = std::min(decision.wait, seconds_to_release());
            if (std::isinf(wait))
                wake_.wait(lock);
            else
                wake_.wait_for(lock, std::chrono::duration<double>(wait));
            continue;
        }
        const Task task = newest_;
        running_ = decision;
        update_pause();
        lock.unlock();
        const double begun = now(), shut_before = gate_.closed_seconds();
        Outcome outcome = denoise(task, decision);
        const double seconds = now() - begun - (gate_.closed_seconds() - shut_before) - outcome.seconds_not_denoising;
        lock.lock();
        cadence_.record(source_of(task.image, *task.frame), decision, begun, seconds, outcome.denoised != nullptr);
        failure_ = std::move(outcome.failure);
        history_look_ = history_.look();
        if (outcome.denoised && outcome.denoised->is_enlarged)
            enlarging_seconds_ = outcome.seconds_of_enlarging;
        else if (outcome.denoised && outcome.denoised->has_history())
            history_seconds_ = outcome.seconds_of_history;
        running_ = {};
        update_pause();
        lock.unlock();
        on_answer_(task.image, task.frame, std::move(outcome.denoised));
        lock.lock();
    }
}

} // namespace blush
