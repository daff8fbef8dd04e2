// Turns a replayed vertex into plain data (path_record.h).
#pragma once

#include "render/compile/render_scene.h"
#include "render/diagnostics/path_record.h"
#include "render/diagnostics/replay.h"

#include <memory>

namespace blush {

class VertexRecorder {
public:
    // `expanded`: the compiled scene, with expanded area lights; `context`: of the replay, with the tables of the sample. All of them must
    // outlive this.
    VertexRecorder(const Scene& expanded, const RenderScene& compiled, const KernelContext& context);

    // The vertices of a path in order. `before`: the vertex before, null for the first.
    PathVertex record(const ReplayedVertex& replayed, const PathVertex* before);
    Vec3d world(const Vec3& position) const;

private:
    struct Shaded;
    struct Blocker;
    Shaded shade(const ReplayedVertex& replayed) const;
    void record_place(const ReplayedVertex& replayed, PathVertex& v) const;
    void record_emission(const ReplayedVertex& replayed, const PathVertex* before, PathVertex& v) const;
    void record_scattering(const ReplayedVertex& replayed, const Shaded& shaded, PathVertex& v) const;
    NextEvent next_event(const ReplayedVertex& replayed, const Shaded& shaded);
    Blocker find_blocker(const ReplayedVertex& replayed);
    // The step of the same vertex with a throughput of 1 and without roulette.
    Step<float> unit_step(const ReplayedVertex& replayed, Strategy strategy) const;
    std::string name_of(Id<Node> node) const;
    std::string object_name(int32_t object) const { return name_of({uint32_t(object)}); }

    const Scene& scene_;
    const RenderScene& compiled_;
    const KernelContext& context_;
    float far_;                         // metres: length of what is shown of a ray to infinity
    std::unique_ptr<ShadowQueue> rays_; // of the search for a blocker, as the next
    std::unique_ptr<HitColumns> hits_;
    float guided_ = 0; // share of path guiding in the density of the path's direction
};

} // namespace blush
