#include "app/editor/reference_provider.h"

#include "app/commands/converge/reference_cache.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

namespace blush {

void ReferenceProvider::forget() {
    reference_.reset();
    looked_ = false;
    problem_.clear();
    if (!job_) return;
    // Do not block: a batch of samples can take a second.
    job_->cancel();
    outdated_ = true;
}

void ReferenceProvider::start(std::function<Found(JobProgress&)> work, bool rendering) {
    rendering_ = rendering;
    outdated_ = false;
    problem_.clear();
    job_ =
        std::make_unique<BackgroundJob<Found>>(rendering ? "Rendering the reference" : "Searching for a reference", std::move(work), wake_);
}

void ReferenceProvider::find(const Subject& subject) {
    if (looked_ || job_) return;
    looked_ = true;
    start(
        [subject](JobProgress&) -> Found {
            const uint32_t seeds[]{subject.settings.seed};
            auto found = cached_reference(reference_folder(), reference_key(subject.scene, subject.settings), seeds);
            if (!found) return {};
            return {std::make_shared<const Reference>(*std::move(found)), ""};
        },
        false);
}

void ReferenceProvider::render(const Subject& subject, int64_t samples) {
    if (job_) return;
    Reference begun;
    const uint32_t seeds[]{subject.settings.seed};
    begun.seed = reference_seed(seeds);
    if (reference_) begun = *reference_;
    const ReferenceBudget budget{std::max(samples, 2 * begun.measured.samples), 0};
    start(
        [subject, budget, begun = std::move(begun), threads = threads_](JobProgress& progress) mutable -> Found {
            Found found;
            try {
                Renderer renderer({.threads = threads, .low_priority = true, .planes = {}});
                extend_reference(
                    begun, renderer, subject.scene, subject.settings, budget, [&] { return !progress.cancel; },
                    [&](double fraction) { progress.report(fraction, ""); });
            } catch (const std::bad_alloc&) { found.problem = "Not enough memory for the reference."; } catch (const std::exception& e) {
                found.problem = e.what();
            }
            if (begun.measured.samples == 0) return found;
            found.reference = std::make_shared<const Reference>(std::move(begun));
            // Without the cache the next run only takes longer.
            if (const auto kept = cache_reference(reference_folder(), reference_key(subject.scene, subject.settings), *found.reference);
                !kept)
                found.problem = "The reference could not be stored: " + kept.error().text();
            return found;
        },
        true);
}

void ReferenceProvider::stop() {
    if (job_) job_->cancel();
}

bool ReferenceProvider::poll() {
    if (!job_) return false;
    auto found = job_->take();
    if (!found) return false;
    job_.reset();
    if (outdated_) return false;
    problem_ = found->problem;
    if (!found->reference) return false;
    reference_ = found->reference;
    return true;
}

ReferenceStatus ReferenceProvider::status() const {
    using State = ReferenceStatus::State;
    ReferenceStatus n;
    n.problem = problem_;
    if (job_) {
        n.state = job_->cancelled() ? State::stopping : rendering_ ? State::rendering : State::looking;
        n.progress = job_->progress().read().first;
    } else if (reference_) {
        n.state = State::there;
        n.spp = reference_->measured.samples;
        n.rmse = std::sqrt(mean_square_error(reference_->measured));
    } else if (looked_) {
        n.state = State::absent;
    }
    return n;
}

} // namespace blush
