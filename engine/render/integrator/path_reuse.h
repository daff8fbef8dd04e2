// Path reuse: the pixels of a small group share the second vertices of their paths (Bekaert, Sbert and Halton 2002,
// "Accelerating Path Tracing by Re-Using Paths").
//
// Pixel k of a group sees a Lambertian point x_k of reflectance rho_k, whose path continues
// to a point y_k. If y_k is Lambertian too, it sends the same radiance L_k in all directions
// on its side, and every x_i that sees y_k could have sampled it. With the density
//   G_i(y) = max(0, cos theta_i) cos theta_y / (pi d^2)
// per area with which x_i samples y, and V its visibility, the balance heuristic (Veach 1997, section 9.2) over all members as
// strategies for y gives pixel i
//   rho_i sum_k [ V_ik G_i(y_k) / sum_j V_jk G_j(y_k) ] L_k.
// With path guiding (path_guiding.h), x samples y with a density D_i(y) >= G_i(y) / 2: then D replaces G in the sum, and L_k is D_k /
// G_k times the radiance of a path that was sampled with D_k.
// The shares of a vertex sum to one, so reuse creates no outliers. L_k is any unbiased estimate of the radiance scattered by y_k,
// so Russian roulette does not matter. Emission of y_k itself stays with pixel k, where the pdf for its MIS weight is known.
//
// Whether x_j takes part depends on x_j alone, and whether it can have y depends on these two points alone, never on sampled
// directions: the shared and unshared paths partition path space. In scenes with blended surfaces V is the transmittance along the
// connection: x_j continues to y with the density V_j G_j, because its own rays meet such surfaces by chance. Then the path's own
// segment is asked too.
#pragma once

#include "render/integrator/estimator.h"
#include "render/kernels/kernel.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace blush::inline BLUSH_ISA {

// Smaller reflectances count as black: too small to divide by.
constexpr float min_reflectance = 1e-6f;

// Limit of shared radiance, so that dividing by the reflectance does not overflow.
constexpr float max_shared_radiance = min_reflectance * std::numeric_limits<float>::max();

// Valid range of densities per square metre: sums and quotients within it neither overflow nor vanish.
constexpr float min_density = 0x1p-100f, max_density = 0x1p100f;

// Stores the vertices of paths k, k + 1, ... of the queue at bounce 0
// or 1. At bounce 0 there is no compaction: the k-th path is slot k.
template <class F> void store_reuse_vertex(ReuseColumns& reuse, const PathQueue& now, int k, int bounce, const ReuseVertex<F>& j) {
    ReuseVertexColumns& c = bounce == 0 ? reuse.first : reuse.second;
    store(c.px + k, j.position.x);
    store(c.py + k, j.position.y);
    store(c.pz + k, j.position.z);
    store(c.clearance + k, j.clearance);
    store(c.gx + k, j.ng.x);
    store(c.gy + k, j.ng.y);
    store(c.gz + k, j.ng.z);
    store(c.sx + k, j.ns.x);
    store(c.sy + k, j.ns.y);
    store(c.sz + k, j.ns.z);
    store(c.takes_part + k, select(j.lambertian, Int<F>(1), Int<F>(0)));
    if (bounce == 0) {
        store(reuse.rho_r + k, j.reflectance.x);
        store(reuse.rho_g + k, j.reflectance.y);
        store(reuse.rho_b + k, j.reflectance.z);
        store(reuse.second_of + k, Int<F>(-1));
    } else {
        for (int i = 0; i < width<F> && k + i < now.size; ++i) reuse.second_of[now.slot[k + i]] = k + i;
    }
}

// Call when a path's radiance holds exactly its unshared part (light arriving
// at x, and emission hit from x): later contributions can be shared.
inline void stash_unshared_radiance(ReuseColumns& reuse, TileScratch& scratch, int paths) {
    const auto stash = [&](double* r, double* g, double* b, RadianceColumns& unshared) {
        copy_radiance(r, g, b, paths, unshared);
        for (double* c : {r, g, b}) std::fill_n(c, paths, 0.0);
    };
    stash(scratch.r, scratch.g, scratch.b, reuse.unshared);
    reuse.hold_groups(scratch.groups ? scratch.groups->all.size() : 0);
    for (size_t k = 0; k < reuse.unshared_groups.size(); ++k) {
        RadianceColumns& group = scratch.groups->all[k];
        stash(group.r, group.g, group.b, reuse.unshared_groups[k]);
    }
    for (size_t k = 0; scratch.strategies && k < scratch.strategies->unshared.size(); ++k) {
        RadianceColumns& light = scratch.strategies->light.all[k];
        stash(light.r, light.g, light.b, scratch.strategies->unshared[k]);
    }
}

template <class F> Vec<F> gather_columns(const float* x, const float* y, const float* z, const Int<F>& i) {
    return {gather(x, i), gather(y, i), gather(z, i)};
}

// Computes G for every member and vertex of the batch, and queues
// visibility rays from vertex to member where visibility is unknown.
template <class F>
void queue_connections(const SceneTables& scene, const ReuseColumns& reuse, ReuseBatch& batch, int group_size, ShadowQueue& q) {
    const int pairs = batch.vertices * group_size, last_member = group_size - 1, shift = std::countr_zero(unsigned(group_size));
    const ReuseVertexColumns &a = reuse.first, &b = reuse.second;
    const GuideTables& guides = scene.guides;
    q.size = 0;
    for (int k = 0; k < pairs; k += width<F>) {
        const Int<F> pair = min(Int<F>(iota<F>() + k), Int<F>(pairs - 1));
        const Int<F> vertex = pair >> shift, member = pair & last_member;
        const Int<F> own_seat = gather(batch.own_seat.data, vertex), y = gather(batch.place.data, vertex);
        const Int<F> seat = (own_seat & ~last_member) + member;
        const Int<F> slot = gather(batch.slot.data, seat);
        const Mask<F> own = as_mask(seat == own_seat), present = as_mask(slot >= 0) && as_mask(iota<F>() + k < pairs);
        const Int<F> x = max(slot, Int<F>(0));

        const Vec<F> at_x = gather_columns<F>(a.px, a.py, a.pz, x), at_y = gather_columns<F>(b.px, b.py, b.pz, y);
        const Vec<F> ng_x = gather_columns<F>(a.gx, a.gy, a.gz, x), ng_y = gather_columns<F>(b.gx, b.gy, b.gz, y);
        const Vec<F> ns_x = gather_columns<F>(a.sx, a.sy, a.sz, x), ns_y = gather_columns<F>(b.sx, b.sy, b.sz, y);
        const Vec<F> to = at_y - at_x;
        const F d2 = dot(to, to);
        const F cos_x = dot(ns_x, to), cos_y = -dot(ng_y, to); // times d
        // False where sampling at x would reject the direction, or y would
        // look different from there. Not tested for the path's own pixel.
        const Mask<F> possible = dot(ng_x, to) > F(0.f) && -dot(ns_y, to) >= F(min_facing) * sqrt(d2);
        F density = max(cos_x, F(0.f)) * max(cos_y, F(0.f)) / (d2 * d2);
        density = select(present && (own || possible) && density >= F(min_density) && density <= F(max_density), density, F(0.f));
        store(batch.density + k, density);
        F drawn = density;
        if (!guides.empty()) {
            const F distance = sqrt(d2), cosine = cosine_hemisphere_pdf(F(cos_x / distance));
            const Mask<F> sampled = density > F(0.f);
            const DirectionGuide<F> from_x = direction_guide_at<F>(guides, at_x, ns_x, sampled);
            const F mixed = guided_pdf<F>(guides, from_x, Vec<F>(to / distance), cosine);
            drawn = select(sampled, density * (mixed / select(sampled, cosine, F(1.f))), F(0.f));
        }
        store(batch.drawn + k, drawn);

        const Mask<F> asks = (!own || Mask<F>(scene.blends)) && density > F(0.f);
        if (!any(asks)) continue;
        // Both ends are offset to the side of their surface that faces the other.
        const Vec<F> from = offset_origin(at_y, ng_y * gather(b.clearance.data, y));
        const Vec<F> ray = offset_origin(at_x, ng_x * gather(a.clearance.data, x)) - from;
        const F distance = length(ray);
        const unsigned lanes = bits(asks);
        const int n = q.size;
        compress(q.ox + n, from.x, lanes);
        compress(q.oy + n, from.y, lanes);
        compress(q.oz + n, from.z, lanes);
        compress(q.dx + n, F(ray.x / distance), lanes);
        compress(q.dy + n, F(ray.y / distance), lanes);
        compress(q.dz + n, F(ray.z / distance), lanes);
        compress(q.distance + n, F(distance * (1.f - 4e-7f)), lanes);
        compress(q.slot + n, Int<F>(iota<F>() + k), lanes);
        q.size += count(asks);
    }
}

// Multiplies the densities of connections by their visibility. Not coherent: rays of one vertex form a narrow fan, but packets mix
// several vertices.
template <class F> void dim_connections(const KernelContext& context, TileScratch& scratch, ReuseBatch& batch) {
    const ShadowQueue& q = scratch.shadows;
    const RayArrays rays{q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, q.distance, nullptr};
    if (!context.scene->blends) {
        trace_any<F>(*context.accel, rays, q.size, false, scratch.blocked);
        for (int k = 0; k < q.size; ++k)
            if (scratch.blocked[k]) batch.density[q.slot[k]] = batch.drawn[q.slot[k]] = 0;
        return;
    }
    const float* share = scratch.hits.t; // free: all paths have ended
    context.accel->transmittance(rays, q.size, false, scratch.hits.t);
    for (int k = 0; k < q.size; ++k)
        for (float* density : {&batch.density[q.slot[k]], &batch.drawn[q.slot[k]]}) *density *= share[k];
}

// Turns the densities of each vertex into the members' shares, ignoring black reflectances.
inline void weigh(ReuseBatch& batch, int group_size, Vec3* share) {
    for (int v = 0; v < batch.vertices; ++v) {
        const int own = batch.own_seat[v], first = own / group_size * group_size;
        const float* drawn = &batch.drawn[v * group_size];
        Vec3 sum{0, 0, 0};
        for (int m = 0; m < group_size; ++m) {
            sum.x += drawn[m] * batch.reflects_r[first + m];
            sum.y += drawn[m] * batch.reflects_g[first + m];
            sum.z += drawn[m] * batch.reflects_b[first + m];
        }
        // Rounding may hide a vertex from its own pixel; then the pixel keeps its own radiance.
        const bool seen = drawn[own - first] > 0;
        batch.shared[own] = seen;
        const float more = seen ? drawn[own - first] / batch.density[v * group_size + own - first] : 1.f;
        const auto inverse = [&](float s) { return seen && s > 0 ? more / s : 0.f; };
        share[v] = {inverse(sum.x), inverse(sum.y), inverse(sum.z)};
    }
}

// Three columns by slot.
struct SharedRadiance {
    double *r, *g, *b;
};

// Distributes the radiance of the batch's paths among all members.
template <class F>
void distribute(const ReuseColumns& reuse, ReuseBatch& batch, int group_size, const Vec3* share, const SharedRadiance& radiance) {
    const int seats = batch.groups * group_size;
    for (float* sum : {batch.sum_r.data, batch.sum_g.data, batch.sum_b.data}) std::fill_n(sum, seats, 0.f);
    for (int v = 0; v < batch.vertices; ++v) {
        const int own = batch.own_seat[v], first = own / group_size * group_size, slot = batch.slot[own];
        const auto relative = [](double value, float rho) { return rho >= min_reflectance ? float(value) / rho : 0.f; };
        const float r = relative(radiance.r[slot], reuse.rho_r[slot]);
        const float g = relative(radiance.g[slot], reuse.rho_g[slot]);
        const float b = relative(radiance.b[slot], reuse.rho_b[slot]);
        for (int m = 0; m < group_size; m += width<F>) {
            const int seat = first + m;
            const F density = select(as_mask(iota<F>() + m < group_size), load<F>(&batch.density[v * group_size + m]), F(0.f));
            store(batch.sum_r + seat, load<F>(batch.sum_r + seat) + density * share[v].x * r);
            store(batch.sum_g + seat, load<F>(batch.sum_g + seat) + density * share[v].y * g);
            store(batch.sum_b + seat, load<F>(batch.sum_b + seat) + density * share[v].z * b);
        }
    }
    for (int seat = 0; seat < seats; ++seat) {
        const int slot = batch.slot[seat];
        if (slot < 0) continue;
        const bool shared = batch.shared[seat];
        const auto settle = [&](double& value, float sum, float rho) {
            if (rho < min_reflectance) return;
            value = (shared ? 0.0 : value) + double(sum * rho);
        };
        settle(radiance.r[slot], batch.sum_r[seat], reuse.rho_r[slot]);
        settle(radiance.g[slot], batch.sum_g[seat], reuse.rho_g[slot]);
        settle(radiance.b[slot], batch.sum_b[seat], reuse.rho_b[slot]);
    }
}

// Tile slot of a pixel of the block whose first pixel is (x, y) of the tile; -1 if outside the film.
inline int slot_in_block(const TileJob& job, int x, int y, const BlockGroups::Pixel& pixel, int sample) {
    const int px = x + pixel.x, py = y + pixel.y;
    return px < job.width && py < job.height ? (py * job.width + px) * job.samples + sample : -1;
}

// Adds the next group to the batch, and lists its vertices to share.
inline void seat_group(const ReuseColumns& reuse, const TileScratch& scratch, ReuseBatch& batch, const int* slots, int group_size) {
    const int first = batch.groups++ * group_size;
    int members = 0;
    for (int m = 0; m < group_size; ++m) {
        const int seat = first + m, slot = slots[m];
        const bool takes_part = slot >= 0 && reuse.first.takes_part[slot];
        members += takes_part;
        batch.slot[seat] = takes_part ? slot : -1;
        batch.shared[seat] = 0;
        batch.reflects_r[seat] = takes_part && reuse.rho_r[slot] >= min_reflectance;
        batch.reflects_g[seat] = takes_part && reuse.rho_g[slot] >= min_reflectance;
        batch.reflects_b[seat] = takes_part && reuse.rho_b[slot] >= min_reflectance;
    }
    if (members < 2) return;
    for (int seat = first; seat < first + group_size; ++seat) {
        const int slot = batch.slot[seat];
        if (slot < 0) continue;
        const int place = reuse.second_of[slot];
        if (place < 0 || !reuse.second.takes_part[place]) continue;
        // Black or invalid radiance is not shared: it stays in this pixel, where the film counts it.
        const double r = scratch.r[slot], g = scratch.g[slot], b = scratch.b[slot];
        if (!(r >= 0 && g >= 0 && b >= 0 && r + g + b > 0 && r + g + b <= double(max_shared_radiance))) continue;
        batch.place[batch.vertices] = place;
        batch.own_seat[batch.vertices++] = seat;
    }
}

template <class F> [[gnu::flatten]] void share_batch(const KernelContext& context, TileScratch& scratch, ReuseBatch& batch) {
    ReuseColumns& reuse = *scratch.reuse;
    const int group_size = context.settings.reuse.size();
    if (batch.vertices > 0) {
        ShadowQueue& q = scratch.shadows;
        queue_connections<F>(*context.scene, reuse, batch, group_size, q);
        dim_connections<F>(context, scratch, batch);
        scratch.shadow_rays += q.size;
        Vec3 share[ReuseBatch::max_seats];
        weigh(batch, group_size, share);
        distribute<F>(reuse, batch, group_size, share, {scratch.r, scratch.g, scratch.b});
        // Bounce planes are shared like the total radiance.
        for (int k = 2; scratch.bounces && k < scratch.bounces->recorded; ++k) {
            RadianceColumns& after = scratch.bounces->after[size_t(k)];
            distribute<F>(reuse, batch, group_size, share, {after.r, after.g, after.b});
        }
        // Planes of light groups and of strategies are shared in the same way.
        if (scratch.groups)
            for (RadianceColumns& group : scratch.groups->all) distribute<F>(reuse, batch, group_size, share, {group.r, group.g, group.b});
        if (scratch.strategies)
            for (RadianceColumns& light : scratch.strategies->light.all)
                distribute<F>(reuse, batch, group_size, share, {light.r, light.g, light.b});
    }
    batch.groups = batch.vertices = 0;
}

// After all paths of the tile have ended and their unshared radiance
// was stored: connects, shares, and adds the unshared part again.
template <class F> void reuse_paths(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    const ReuseGroups& groups = context.settings.reuse;
    ReuseColumns& reuse = *scratch.reuse;
    ReuseBatch& batch = reuse.batch;
    const int max_groups = tile_capacity / (groups.size() * groups.size());
    for (int y = 0; y < job.height; y += groups.block_height)
        for (int x = 0; x < job.width; x += groups.block_width)
            for (int sample = 0; sample < job.samples; ++sample) {
                const BlockGroups in_block(groups, job.x + x, job.y + y, job.sample(sample));
                for (int group = 0; group < groups.per_block(); ++group) {
                    int slots[ReuseGroups::max_size];
                    for (int m = 0; m < groups.size(); ++m) slots[m] = slot_in_block(job, x, y, in_block.pixel(group, m), sample);
                    seat_group(reuse, scratch, batch, slots, groups.size());
                    if (batch.groups == max_groups) share_batch<F>(context, scratch, batch);
                }
            }
    share_batch<F>(context, scratch, batch);

    const auto add_unshared = [&](const RadianceColumns& unshared, const SharedRadiance& to) {
        for (int k = 0; k < job.paths(); ++k) {
            to.r[k] += unshared.r[k];
            to.g[k] += unshared.g[k];
            to.b[k] += unshared.b[k];
        }
    };
    add_unshared(reuse.unshared, {scratch.r, scratch.g, scratch.b});
    for (int k = 2; scratch.bounces && k < scratch.bounces->recorded; ++k) {
        RadianceColumns& after = scratch.bounces->after[size_t(k)];
        add_unshared(reuse.unshared, {after.r, after.g, after.b});
    }
    for (size_t k = 0; k < reuse.unshared_groups.size(); ++k) {
        RadianceColumns& group = scratch.groups->all[k];
        add_unshared(reuse.unshared_groups[k], {group.r, group.g, group.b});
    }
    for (size_t k = 0; scratch.strategies && k < scratch.strategies->unshared.size(); ++k) {
        RadianceColumns& light = scratch.strategies->light.all[k];
        add_unshared(scratch.strategies->unshared[k], {light.r, light.g, light.b});
    }
}

} // namespace blush::inline BLUSH_ISA
