#include "render/session/submission.h"

#include <utility>

namespace blush {
namespace {

// Sets `next.mixing` and returns true if the samples of `last` can be shown as `next`.
bool continues(const Submission& last, Submission& next) {
    if (!last.planes.covers(next.planes)) return false;
    if (!next.changes.affects_image()) {
        next.mixing = last.mixing;
        return true;
    }
    if (!last.groups || !next.changes.only_light()) return false;
    std::optional<Mixing> mixing = mixing_of(*last.groups, next.scene, next.changes);
    if (!mixing) return false;
    next.mixing = *std::move(mixing);
    return true;
}

} // namespace

Changes changes_since(const Submission* last, const SubmissionContent& content) {
    return last ? diff(last->scene, last->settings, content.scene, content.settings) : Changes{};
}

Changes LastContent::changes_to(const SubmissionContent& content) const {
    return is_set_ ? diff(scene_, settings_, content.scene, content.settings) : Changes{};
}

void LastContent::keep(const SubmissionContent& content) {
    is_set_ = true;
    scene_ = content.scene;
    settings_ = content.settings;
}

SubmissionPtr next_submission(const Submission* last, uint64_t revision, const SubmissionContent& content, Changes changes,
                              bool has_loaded_samples) {
    auto next = std::make_shared<Submission>(Submission{.revision = revision,
                                                        .scene = content.scene,
                                                        .settings = content.settings,
                                                        .planes = content.planes,
                                                        .changes = std::move(changes)});
    next->continues_image = last && !has_loaded_samples && continues(*last, *next);
    next->image = (last ? last->image : 0) + !next->continues_image;
    next->look = (last ? last->look : 0) + !(last && (next->continues_image || next->changes.only_view()));

    if (next->continues_image) {
        next->groups = last->groups;
    } else if (next->scene.mix.grouping != LightMix::Grouping::none) {
        next->groups = std::make_shared<const LightGroups>(make_light_groups(next->scene));
        next->mixing = mixing_of(*next->groups, next->scene, {}).value();
    }
    return next;
}

} // namespace blush
