// A submitted scene and the identity of its image. "Is it the same image?" is decided here, once per edit: the session, the
// renderer and the convergence chart compare identities. Pure computation, testable without rendering.
#pragma once

#include "render/film/film_size.h"
#include "render/light_mix/light_groups.h"
#include "scene/changes.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace blush {

struct Submission {
    uint64_t revision = 0;
    // Equal for submissions that share samples: these differ at most in the light mix, stop rules and what does not reach the image.
    uint64_t image = 0;
    // Equal for submissions whose images differ at most in the view.
    uint64_t look = 0;

    Scene scene;
    RenderSettings settings;
    PlaneSet planes; // in addition to the first-hit planes
    Changes changes; // since the submission before; of the first one: none
    // True if the image of the previous submission continues with its samples.
    bool continues_image = false;
    LightGroupsPtr groups = nullptr; // of the scene that began the image; null: no light mix
    Mixing mixing = {};              // the mix of `scene` for planes of `groups`; empty without groups

    // The scene whose emission the film's planes hold.
    const Scene& base() const { return groups ? groups->base : scene; }
};
using SubmissionPtr = std::shared_ptr<const Submission>;

// The submitted scene and settings. Valid as long as the caller's values.
struct SubmissionContent {
    const Scene& scene;
    const RenderSettings& settings;
    PlaneSet planes = {};
};

// The submission after `last`, from its differences `changes`. `last` null: the first one. Loaded samples always begin an image.
SubmissionPtr next_submission(const Submission* last, uint64_t revision, const SubmissionContent& content, Changes changes,
                              bool has_loaded_samples);
// Differences from `last` to `content`; none if `last` is null.
Changes changes_since(const Submission* last, const SubmissionContent& content);

// What the next content is compared with: the content before, submitted or not. A window asks in every frame, and its scenes share storage
// with the one before. A submission would not share it with scenes after an edit that does not reach the image, such as a name: each
// frame would compare all nodes again.
class LastContent {
public:
    // None for the first content.
    Changes changes_to(const SubmissionContent& content) const;
    void keep(const SubmissionContent& content);
    const Scene& scene() const { return scene_; }

private:
    bool is_set_ = false;
    Scene scene_;
    RenderSettings settings_;
};

} // namespace blush
