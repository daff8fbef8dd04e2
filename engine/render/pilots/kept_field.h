// The field of path guiding that an edit leaves over: the first sample after the edit uses it, until the pilots have run.
#pragma once

#include "render/compile/feature_report.h"
#include "render/lights/guiding_field.h"
#include "scene/changes.h"
#include "scene/scene.h"
#include "shading/caustic_guiding.h"

#include <optional>
#include <vector>

namespace blush {

// What an edit does to directions learned before it. No field biases an image, whatever it was learned from: the effect is only a guess
// of how useful it still is.
struct FieldEffect {
    int edits = 0;
    bool dropped = false;        // nothing is kept
    double factor = 1;           // of the shares of learned directions, in [0, 1]
    std::vector<Bounds> cleared; // world space: learned directions are forgotten there
    bool same_chains = false;    // the same lights shine through the same mirrors and glass, some of them moved
    bool operator==(const FieldEffect&) const = default;
};

// `before` and `after`: expanded scenes (expand_area_lights.h), with their difference. `casters`: of the scene after the edit, relative to
// `origin`.
//
//   view, intensity, colour, switches, mix, factors and textures of materials, settings   kept
//   light moved, sun or environment turned: by an angle as seen from the casters           decays by half every 4 degrees
//   kind, size, cone or profile of a light changed                                         decays by half
//   object moved, added, removed or changed                                                its cells are cleared, before and after
//   the same of a caster of caustics                                                       and decays by half every eighth of its radius
//   clip, time, skin; another image of the environment; more than 32 objects or lights     dropped
FieldEffect effect_on_field(const Scene& before, const Scene& after, const Changes& changes, const CausticCasterTables& casters,
                            const Vec3d& origin);

class KeptField {
public:
    // `field`, which pays, relative to `origin`.
    KeptField(GuidingField field, const Vec3d& origin) : field_(std::move(field)), origin_(origin) {}

    // False if nothing is left. `origin`: of the scene after it.
    bool follow(const FieldEffect& effect, const Vec3d& origin);

    GuidingTables tables() const { return field_.tables(); }
    // Since it was learned.
    int edits() const { return edits_; }
    int64_t memory_bytes() const { return field_.memory_bytes(); }
    // As measured when it was learned.
    const std::optional<PilotFigures>& figures() const { return field_.figures(); }

private:
    GuidingField field_;
    Vec3d origin_{0, 0, 0};
    int edits_ = 0;
};

} // namespace blush
