// The reference of the picture in the window: found among the stored ones, or rendered, both in the background.
#pragma once

#include "measure/reference.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "ui/background_job.h"
#include "ui/convergence_view.h"

#include <functional>
#include <memory>

namespace blush {

class ReferenceKeeper {
public:
    // What a reference is one of.
    struct Subject {
        Scene scene;
        RenderSettings settings; // of the film's size, scale 1
    };

    ReferenceKeeper(std::function<void()> wake, unsigned threads) : wake_(std::move(wake)), threads_(threads) {}

    // Another picture: what there is is no reference of it.
    void forget();
    // Looks among the stored ones, once for each picture.
    void look(const Subject& subject);
    // Renders one with `samples` per pixel, or twice as many as there are. Nothing while something else is going on.
    void render(const Subject& subject, int64_t samples);
    // What was rendered until then is a reference too.
    void stop();

    // Once per frame of the window. True if there is a new one.
    bool poll();
    bool renders() const { return job_ && rendering_ && !outdated_; }
    const std::shared_ptr<const Reference>& reference() const { return reference_; } // null: none
    ReferenceNews news() const;

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
    bool outdated_ = false; // the job's answer is one to what nobody asks any more
    std::string problem_;
    std::unique_ptr<BackgroundJob<Found>> job_;
};

} // namespace blush
