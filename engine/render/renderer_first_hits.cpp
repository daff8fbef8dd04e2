// Traces first hits alone, to enlarge coarse images by them.
#include "render/film/film_columns.h"
#include "render/integrator/camera.h"
#include "render/renderer_state.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int tile_width = 64, tile_height = 32;
constexpr FilterTable pixel_centre{}; // no offsets: edges neither waver nor fray

struct Planes {
    explicit Planes(size_t pixels) : albedo(pixels), normal(pixels), depth(pixels) {}
    std::vector<Vec3> albedo, normal;
    std::vector<float> depth;
};

// As the film stores it.
float in_range(float albedo) { return std::isfinite(albedo) ? std::clamp(albedo, 0.f, 1.f) : 0.f; }

void store(const FirstHitColumns& hits, const TileJob& job, int width, Planes& planes) {
    for (int i = 0; i < job.paths(); ++i) {
        const size_t pixel = size_t(job.y + i / job.width) * size_t(width) + size_t(job.x + i % job.width);
        planes.albedo[pixel] = {in_range(hits.albedo_r[i]), in_range(hits.albedo_g[i]), in_range(hits.albedo_b[i])};
        planes.normal[pixel] = {hits.normal_x[i], hits.normal_y[i], hits.normal_z[i]};
        planes.depth[pixel] = hits.depth[i];
    }
}

} // namespace

FirstHitPlanesPtr Renderer::first_hits() const { return state_->first_hits; }
void Renderer::keep_first_hits(FirstHitPlanesPtr planes) { state_->first_hits = std::move(planes); }

bool Renderer::has_sharp_first_hits() const {
    const State& s = *state_;
    return s.expanded && s.expanded->view.lens.aperture_radius == 0 && !s.transparent() && !s.catches();
}

WorldCamera Renderer::world_camera() const {
    const CameraRecord& c = state_->scene.tables().camera;
    return {state_->scene.origin() + to_double(c.position), c.right, c.up, c.forward, c.orthographic != 0};
}

FirstHitPlanesPtr Renderer::trace_first_hits() {
    State& s = *state_;
    const int width = s.settings.width, height = s.settings.height;
    const auto planes = std::make_shared<Planes>(size_t(width) * size_t(height));
    KernelContext context = s.context_for(s.scene.tables(), width, height);
    context.seed = s.settings.seed;
    context.settings.reuse = {};
    context.settings.max_bounces = 0;
    context.settings.filter = &pixel_centre;
    const int across = (width + tile_width - 1) / tile_width, down = (height + tile_height - 1) / tile_height;
    s.workers.for_each(int64_t(across) * down, {}, [&](int64_t tile, unsigned worker) {
        TileJob job{.x = int(tile % across) * tile_width, .y = int(tile / across) * tile_height};
        job.width = std::min(tile_width, width - job.x);
        job.height = std::min(tile_height, height - job.y);
        // Not the memory of samples: these are no paths, and are not counted.
        if (!s.replays[worker]) s.replays[worker] = std::make_unique<TileScratch>();
        TileScratch& scratch = *s.replays[worker];
        if (!scratch.first) scratch.first = std::make_unique<FirstHitColumns>();
        s.kernel->render(context, job, scratch);
        store(*scratch.first, job, width, *planes);
    });
    s.first_hits = std::make_shared<const FirstHitPlanes>(
        FirstHitPlanes{width, height, planes->albedo, planes->normal, planes->depth, planes, world_camera()});
    return s.first_hits;
}

} // namespace blush
