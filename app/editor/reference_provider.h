// The reference for the live image: found in the cache or rendered, both in the background.
#pragma once

#include "measure/convergence/reference.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "ui/jobs/background_job.h"
#include "ui/views/convergence_view.h"

#include <functional>
#include <memory>

namespace blush {

class ReferenceProvider {
public:
    // The image that a reference belongs to.
    struct Subject {
        Scene scene;
        RenderSettings settings; // size of the film, scale 1
    };

    ReferenceProvider(std::function<void()> wake, unsigned threads) : wake_(std::move(wake)), threads_(threads) {}

    // The image has changed: drops its reference.
    void forget();
    // Searches the cache, once per image.
    void find(const Subject& subject);
    // Renders one with `samples` per pixel, or doubles the samples of the current one. No effect while a job is running.
    void render(const Subject& subject, int64_t samples);
    // Stops; the samples rendered so far are used.
    void stop();

    // Call once per UI frame. True if there is a new reference.
    bool poll();
    bool renders() const { return job_ && rendering_ && !outdated_; }
    const std::shared_ptr<const Reference>& reference() const { return reference_; } // null: none
    ReferenceStatus status() const;

private:
    struct Found {
        std::shared_ptr<const Reference> reference;
        std::string problem;
    };
    void start(std::function<Found(JobProgress&)> work, bool rendering);

    std::function<void()> wake_;
    unsigned threads_;
    std::shared_ptr<const Reference> reference_;
    bool looked_ = false, rendering_ = false;
    bool outdated_ = false; // the running job belongs to a previous image
    std::string problem_;
    std::unique_ptr<BackgroundJob<Found>> job_;
};

} // namespace blush
