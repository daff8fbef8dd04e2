#include "render/bvh/accel.h"

#include "core/math.h"
#include "core/memory_limit.h"
#include "core/tsan_annotations.h"
#include "render/bvh/compact_bvh.h"
#include "render/bvh/opacity_filter.h"
#include "render/bvh/packets.h"
#include "render/bvh/small_scene.h"
#include "render/bvh/transmittance.h"
#include "render/compile/scene_tables.h"
#include "scene/affine.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

namespace blush {
namespace {

struct SceneHandle {
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<AlphaPart>> alpha_parts;
    std::vector<std::shared_ptr<const void>> owners;
    uint32_t next_id = 0;         // of the next geometry
    size_t compact_triangles = 0; // all of them if the leaves store indices; 0 if the leaves store vertices

    SceneHandle() = default;
    explicit SceneHandle(RTCDevice device, size_t compact = 0) : scene(rtcNewScene(device)), compact_triangles(compact) {
        // Watertight at shared edges: a leak of one ray in 1e5 would show in closed rooms.
        rtcSetSceneFlags(scene, compact > 0 ? RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT) : RTC_SCENE_FLAG_ROBUST);
        // Without spatial splits (RTC_BUILD_QUALITY_HIGH): they store a triangle in several leaves, each of which may report its hit, and
        // Accel::transmittance must count it once. Embree 3.13 splits no triangles that have a filter, but does not promise it.
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    }
    SceneHandle(SceneHandle&& other) noexcept
        : scene(std::exchange(other.scene, nullptr)), alpha_parts(std::move(other.alpha_parts)), owners(std::move(other.owners)),
          next_id(other.next_id), compact_triangles(other.compact_triangles) {}
    SceneHandle& operator=(SceneHandle&& other) noexcept {
        std::swap(scene, other.scene);
        std::swap(alpha_parts, other.alpha_parts);
        std::swap(owners, other.owners);
        std::swap(next_id, other.next_id);
        std::swap(compact_triangles, other.compact_triangles);
        return *this;
    }
    ~SceneHandle() {
        if (scene) rtcReleaseScene(scene);
    }

    void add_triangles(RTCDevice device, const AccelTriangles& triangles, const SceneTables* tables) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        const auto set = [&](RTCBufferType type, RTCFormat format, const void* items, size_t size, size_t count) {
            if (triangles.owner) return rtcSetSharedGeometryBuffer(geometry, type, 0, format, items, 0, size, count);
            void* copy = rtcSetNewGeometryBuffer(geometry, type, 0, format, size, count);
            if (!copy) throw std::runtime_error("not enough memory for the scene's triangles");
            std::memcpy(copy, items, size * count);
        };
        set(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, triangles.positions, sizeof(Vec3), triangles.vertex_count);
        set(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.indices, 3 * sizeof(uint32_t), triangles.triangle_count);
        if (triangles.owner) owners.push_back(triangles.owner);
        if (triangles.alpha) {
            alpha_parts.push_back(std::make_unique<AlphaPart>(AlphaPart{tables, triangles.part}));
            rtcSetGeometryUserData(geometry, alpha_parts.back().get());
            rtcSetGeometryIntersectFilterFunction(geometry, opacity_filter);
            rtcSetGeometryOccludedFilterFunction(geometry, opacity_filter);
        }
        attach(geometry, triangles.mask);
    }
    void add_spheres(RTCDevice device, std::span<const AccelSphere> spheres) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        auto* vertices = static_cast<Vec4*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(Vec4), spheres.size()));
        if (!vertices) throw std::runtime_error("not enough memory for the scene's spheres");
        for (size_t i = 0; i < spheres.size(); ++i)
            vertices[i] = {spheres[i].center.x, spheres[i].center.y, spheres[i].center.z, spheres[i].radius};
        attach(geometry, spheres.front().mask);
    }
    void add_instance(RTCDevice device, RTCScene bottom, const Affine& world_from_object, uint32_t mask) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, bottom);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &world_from_object);
        attach(geometry, mask);
    }
    void attach(RTCGeometry geometry, uint32_t mask) {
        rtcSetGeometryMask(geometry, mask);
        if (mask == 0) rtcDisableGeometry(geometry); // it keeps its number and is not part of the BVH
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, next_id++);
        rtcReleaseGeometry(geometry);
    }
    void commit(const Workers& workers) {
        workers.run([&] { rtcCommitScene(scene); });
    }
};

// Key of a bottom-level BVH: instances with equal keys share one.
using BottomKey = std::vector<std::pair<uint64_t, int32_t>>;

BottomKey key_of(const AccelInstances& instances) {
    BottomKey key;
    for (const AccelTriangles& g : instances.geometries) key.emplace_back(g.serial, g.alpha ? g.part : -1);
    return key;
}

size_t triangle_count(const AccelInstances& instances) {
    size_t n = 0;
    for (const AccelTriangles& g : instances.geometries) n += g.triangle_count;
    return n;
}

// For small meshes, reading the free memory takes longer than building the BVH.
bool needs_compact_bvh_for(size_t triangles, uint64_t memory_left) {
    constexpr size_t min_checked_triangles = size_t(1) << 16;
    if (memory_left == 0 && triangles < min_checked_triangles) return false;
    return needs_compact_bvh(triangles, memory_left ? memory_left : memory_limit().left);
}

// Largest ray coordinate that Embree accepts, in world space and in the space of each instance.
constexpr float embree_range = 1.8e18f;

// Largest sum of coordinates of a world-space ray that also keeps it within
// embree_range inside the instance; 0 if the transform is not invertible.
float max_ray_extent(const Affine& world_from_object) {
    const Affined m = to_double(world_from_object), c = cofactor(m);
    const double norm = std::sqrt(dot(c.x, c.x) + dot(c.y, c.y) + dot(c.z, c.z)) / std::abs(determinant(m)); // of the inverse
    const double reach = 0.99 * embree_range / norm - length(m.t);
    return reach > 0 ? float(std::min(reach, double(embree_range))) : 0.f;
}

// Memory of an Embree device and its first thread, with a margin.
constexpr uint64_t min_memory_of_embree = uint64_t(128) << 20;
// Memory that must be left after that: TBB, which Embree uses to
// build BVHs, crashes if an allocation fails in one of its threads.
constexpr uint64_t min_memory_to_build = uint64_t(128) << 20;

// Embree's threads count into it. They begin after its construction, which ThreadSanitizer cannot see.
struct MemoryCounter {
    std::atomic<int64_t> bytes{0};
    HappensBefore constructed, counted;

    MemoryCounter() { constructed.release(); }
    ~MemoryCounter() { counted.acquire(); }
};

bool count_memory(void* user, ssize_t bytes, bool) {
    MemoryCounter& counter = *static_cast<MemoryCounter*>(user);
    counter.constructed.acquire();
    counter.bytes.fetch_add(bytes, std::memory_order_relaxed);
    counter.counted.release();
    return true;
}

// Null: see why_no_device. Embree's threads read its settings, which are strings, while they build; ThreadSanitizer can see neither why
// they come later, nor that it is Embree that reads.
RTCDevice make_device() {
    const IgnoredWrites ignored;
    return rtcNewDevice("start_threads=0,set_affinity=0");
}

std::string why_no_device(RTCError error) {
    if (error == RTC_ERROR_UNSUPPORTED_CPU) return "Embree cannot start on this processor";
    const MemoryLimit room = memory_limit();
    if (error == RTC_ERROR_OUT_OF_MEMORY || room.left < min_memory_of_embree)
        return fmt::format("Embree needs {} MB of memory to start: {}", min_memory_of_embree >> 20, room.text());
    return fmt::format("Embree cannot start (error code {})", int(error));
}

std::string why_not_built(RTCError error, int64_t held) {
    if (error != RTC_ERROR_OUT_OF_MEMORY) return "Embree could not build the scene";
    return fmt::format("not enough memory to build the scene's BVHs, which used {:.2g} GB so far: {}", double(held) / 1e9,
                       memory_limit().text());
}

} // namespace

struct Accel::State {
    MemoryCounter memory;
    RTCDevice device = nullptr;
    int packet = 4;
    std::map<BottomKey, SceneHandle> bottoms;
    bool own_area_lights = false;   // they have a scene of their own
    SceneHandle top, area_lights;   // area_lights.scene: null if the top level holds them, or if there are none
    uint32_t first_area_light = 0;  // number of the first mesh of an area light in the top level
    uint32_t area_light_meshes = 0; // in the scene of the area lights
    uint32_t first_instance = 0;    // Embree id of the first instance in the top level
    uint32_t first_sphere = 0;      // Embree id of the first sphere geometry, after the instances
    std::vector<MeshInstances> instances;
    std::vector<int32_t> sphere_indices; // index of the first sphere of each sphere geometry
    std::optional<SmallScene> small;
    float reach = embree_range; // largest sum of coordinates of a ray that is traced

    State() : device(make_device()) {
        if (!device) throw std::runtime_error(why_no_device(rtcGetDeviceError(nullptr)));
        if (const MemoryLimit room = memory_limit(); room.left < min_memory_to_build) {
            rtcReleaseDevice(device);
            throw std::runtime_error(fmt::format("Embree needs {} MB of memory to build BVHs: {}", min_memory_to_build >> 20, room.text()));
        }
        rtcSetDeviceMemoryMonitorFunction(device, count_memory, &memory);
        if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED))
            packet = 16;
        else if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED))
            packet = 8;
    }
    ~State() {
        top = {};
        area_lights = {};
        bottoms.clear();
        rtcReleaseDevice(device);
    }
    void add_spheres(SceneHandle& to, std::span<const AccelSphere> spheres);
    void trace(const RayArrays& rays, int count, bool coherent, Blended blended, const HitArrays& hits, float* share = nullptr) const;
    void check_for_errors() const {
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
            throw std::runtime_error(why_not_built(error, memory.bytes));
    }
    TracedScenes scenes() const { return {top.scene, area_lights.scene, area_light_meshes, first_area_light, first_sphere, reach}; }
};

// Embree masks apply to whole geometries: consecutive spheres with equal masks share one.
void Accel::State::add_spheres(SceneHandle& to, std::span<const AccelSphere> spheres) {
    sphere_indices.clear();
    for (size_t begin = 0, end = 0; begin < spheres.size(); begin = end) {
        while (end < spheres.size() && spheres[end].mask == spheres[begin].mask) ++end;
        to.add_spheres(device, spheres.subspan(begin, end - begin));
        sphere_indices.push_back(int32_t(begin));
    }
}

Accel::Accel() : state_(std::make_unique<State>()) {}
Accel::~Accel() = default;

bool Accel::has_area_light_bvh() const { return state_->own_area_lights; }

void Accel::commit_area_lights(std::span<const AccelTriangles> meshes, std::span<const AccelSphere> spheres, const SceneTables* tables,
                               const Workers& workers) {
    State& s = *state_;
    s.area_lights = {};
    s.sphere_indices.clear();
    s.area_light_meshes = uint32_t(meshes.size());
    if (meshes.empty() && spheres.empty()) return;
    SceneHandle area_lights(s.device);
    for (const AccelTriangles& triangles : meshes) area_lights.add_triangles(s.device, triangles, tables);
    s.add_spheres(area_lights, spheres);
    area_lights.commit(workers);
    s.check_for_errors();
    s.area_lights = std::move(area_lights);
}

void Accel::commit(const AccelScene& scene, const SceneTables* tables, const Workers& workers) {
    State& s = *state_;
    std::map<BottomKey, SceneHandle> kept;
    float reach = embree_range;

    size_t copies = 0;
    for (const AccelInstances& instances : scene.instances) copies += instances.places.size();
    s.area_lights = {};
    s.own_area_lights = copies >= min_instances_for_area_light_bvh;
    s.first_area_light = uint32_t(s.own_area_lights ? std::min(scene.first_area_light, scene.flat.size()) : scene.flat.size());
    SceneHandle top(s.device);
    for (size_t i = 0; i < s.first_area_light; ++i) top.add_triangles(s.device, scene.flat[i], tables);
    // Geometry ids are the same whether the area lights have their own scene or not: stochastic opacity is a function of the instance's id.
    top.next_id = s.first_instance = uint32_t(scene.flat.size());
    uint32_t instance_count = 0;
    std::vector<MeshInstances> instances_of_meshes;
    for (const AccelInstances& instances : scene.instances) {
        const BottomKey key = key_of(instances);
        auto it = kept.find(key);
        if (it == kept.end()) {
            SceneHandle bottom;
            if (const auto old = s.bottoms.find(key); old != s.bottoms.end()) bottom = std::move(old->second);
            if (!bottom.scene) {
                const size_t count = triangle_count(instances);
                bottom = SceneHandle(s.device, needs_compact_bvh_for(count, scene.memory_left) ? count : 0);
                for (const AccelTriangles& triangles : instances.geometries) bottom.add_triangles(s.device, triangles, tables);
                bottom.commit(workers);
            }
            it = kept.emplace(key, std::move(bottom)).first;
        }
        for (const InstanceRecord& place : instances.places) {
            top.add_instance(s.device, it->second.scene, place.world_from_object, instances.mask);
            reach = std::min(reach, max_ray_extent(place.world_from_object));
        }
        instance_count += uint32_t(instances.places.size());
        instances_of_meshes.push_back({it->second.scene, instances.places.size()});
    }
    s.first_sphere = s.first_instance + instance_count;
    if (s.own_area_lights)
        commit_area_lights(std::span(scene.flat).subspan(s.first_area_light), scene.spheres, tables, workers);
    else
        s.add_spheres(top, scene.spheres);
    top.commit(workers);
    s.check_for_errors();
    s.top = std::move(top);
    s.bottoms = std::move(kept);
    s.instances = std::move(instances_of_meshes);
    s.reach = reach;
    s.small = make_small_scene(scene);
}

const SmallScene* Accel::small_scene() const { return state_->small ? &*state_->small : nullptr; }
size_t Accel::compact_triangles() const {
    size_t n = 0;
    for (const auto& [key, bottom] : state_->bottoms) n += bottom.compact_triangles;
    return n;
}
size_t Accel::memory_bytes() const { return size_t(std::max<int64_t>(0, state_->memory.bytes)); }

namespace {
// Embree 3.13's traversal of coherent packets is a thousand times slower through instances (a mesh of a million triangles,
// packets of 16 rays). Without instances it is twice as fast for camera rays.
TraceContext make_context(bool coherent, bool instances, Blended blended) {
    TraceContext context;
    rtcInitIntersectContext(&context.embree);
    if (coherent && !instances) context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.blended = blended;
    context.chosen = nullptr;
    return context;
}

// Calls trace(N) with the size of packets as a compile-time constant.
template <class Trace> void by_packet_size(int size, const Trace& trace) {
    switch (size) {
    case 16: return trace(std::integral_constant<int, 16>());
    case 8: return trace(std::integral_constant<int, 8>());
    default: return trace(std::integral_constant<int, 4>());
    }
}
} // namespace

void Accel::State::trace(const RayArrays& rays, int count, bool coherent, Blended blended, const HitArrays& hits, float* share) const {
    TraceContext context = make_context(coherent, !bottoms.empty(), blended);
    ChosenHits chosen;
    if (blended == Blended::both) context.chosen = &chosen;
    by_packet_size(packet, [&](auto n) { intersect_packets<n>(scenes(), context, rays, count, hits, share); });
    // Embree numbers instances after the flat geometries
    const auto first = int32_t(first_instance), sphere = int32_t(first_sphere);
    if (first > 0)
        for (int i = 0; i < count; ++i)
            if (hits.instance[i] >= 0) hits.instance[i] -= first;
    // and spheres after the instances.
    if (!sphere_indices.empty())
        for (int i = 0; i < count; ++i)
            if (hits.instance[i] < 0 && hits.geometry[i] >= sphere) {
                hits.triangle[i] += sphere_indices[size_t(hits.geometry[i] - sphere)];
                hits.instance[i] = sphere_instance;
            }
}

void Accel::intersect(const RayArrays& rays, int count, bool coherent, const HitArrays& hits) const {
    state_->trace(rays, count, coherent, Blended::by_chance, hits);
}

void Accel::intersect_unblended(const RayArrays& rays, int count, bool coherent, const HitArrays& hits) const {
    state_->trace(rays, count, coherent, Blended::ignored, hits);
}

void Accel::intersect_blended(const RayArrays& rays, int count, const HitArrays& hits, float* share) const {
    // Not as coherent packets: Embree 3.13 reports any-hits of those more than once (trace_occluded() in packets.h). Of closest hits
    // this was not seen, but each must count once.
    state_->trace(rays, count, false, Blended::both, hits, share);
}

void Accel::occluded(const RayArrays& rays, int count, bool coherent, uint8_t* blocked) const {
    TraceContext context = make_context(coherent, !state_->bottoms.empty(), Blended::by_chance);
    by_packet_size(state_->packet, [&](auto n) {
        occluded_packets<n>(state_->scenes(), context, rays, count, [&](int i, int, bool is_blocked) { blocked[i] = is_blocked; });
    });
}

void Accel::transmittance(const RayArrays& rays, int count, bool coherent, float* share) const {
    TraceContext context = make_context(coherent, !state_->bottoms.empty(), Blended::attenuating);
    by_packet_size(state_->packet, [&](auto n) {
        occluded_packets<n>(state_->scenes(), context, rays, count, [&](int i, int lane, bool is_blocked) {
            const uint32_t depth = context.depth[lane];
            share[i] = is_blocked ? 0.f : transmittance_of(rays.random ? std::min(depth, roulette_depth) : depth);
        });
    });
}

void Accel::visit_near(const Vec3& center, float radius, const InstanceRecord* places, const NearVisitor& visit) const {
    const State& s = *state_;
    blush::visit_near({s.top.scene, s.area_lights.scene, s.first_area_light, s.area_light_meshes, s.first_instance, s.instances, places},
                      center, radius, visit);
}

} // namespace blush
