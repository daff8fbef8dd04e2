#include "render/pilots/guiding_pilot.h"

#include "render/integrator/light_sampling.h"
#include "render/pilots/pilot_tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush {
namespace {

// Any; they only have to differ from each other and from those of images.
constexpr uint32_t photon_seed = 0x9a1d0000, path_seed = 0x9a1d0001;
// Photons: four for each pixel of the image, in tiles of tile_capacity; at least and at most so many tiles.
constexpr int64_t pixels_per_photon_tile = tile_capacity / 4, min_photon_tiles = 8, max_photon_tiles = 64;
constexpr int photon_tile = 64; // photons along a side
static_assert(photon_tile * photon_tile == tile_capacity);
constexpr int path_pixels = 1 << 14; // of the image whose paths are measured,
constexpr int path_samples = 2;      // and samples of a pixel
// Photons of lights at infinity begin so many radii before their caster.
constexpr float far_radii = 64;

enum PhotonDimension : uint32_t { caster_dimension, photon_light_dimension, target_dimension };

// Luminance that arrives at `to` from the sampled light, over its density: nits sr.
float irradiance_of(const SceneTables& scene, const LightPoint<float>& light, const Vec3& to) {
    if (!light.valid) return 0;
    const Vec3 to_light = light.infinite ? light.position : light.position - to;
    const IncidentLight<float> in = incident_light<all_features, float>(scene, light, normalize(to_light), dot(to_light, to_light));
    return in.pdf > 0 ? luminance(in.radiance) / in.pdf : 0;
}

// Emission of photons from lights towards the casters.
struct PhotonSource {
    const SceneTables& scene;
    bool from_inside = false; // some light is within the sphere of a caster, as in a bulb

    const CausticCasterTables& casters() const { return scene.casters; }

    // From outside: towards the disk that the caster shows to the light, of which it has nearly the irradiance of its centre.
    EmittedPhoton from_outside(const CasterSphere& caster, const Sampler<float>& sampler) const {
        const Receiver<float> center{caster.center, {0, 0, 0}};
        const LightPoint<float> light = sample_light_point<all_features, float>(scene, sampler.pair(photon_light_dimension), center, true);
        const Vec3 to_light = light.infinite ? light.position : light.position - caster.center;
        const float irradiance = irradiance_of(scene, light, caster.center), area = float(pi) * caster.radius * caster.radius;
        if (!(irradiance > 0) || (!light.infinite && dot(to_light, to_light) <= caster.radius * caster.radius)) return {};
        const Pair<float> target = sampler.pair(target_dimension);
        const Vec2T<float> disk = sample_disk(target.x(), target.y());
        const Vec3 wi = normalize(to_light), to = caster.center + basis_around(wi).to_world(Vec3{disk.x, disk.y, 0}) * caster.radius;
        if (light.infinite) return {to + wi * (far_radii * caster.radius), -wi, irradiance * area, light.light};
        return {offset_origin(light.position, light.error, light.normal, true), normalize(to - light.position), irradiance * area,
                light.light};
    }
    // From inside: towards a point of the sphere.
    EmittedPhoton from_within(const CasterSphere& caster, const Sampler<float>& sampler) const {
        const Pair<float> target = sampler.pair(target_dimension);
        const Vec3 outward = sample_cone(2.f, target.x(), target.y()), to = caster.center + outward * caster.radius;
        const LightPoint<float> light =
            sample_light_point<all_features, float>(scene, sampler.pair(photon_light_dimension), {to, {0, 0, 0}}, true);
        const Vec3 from_center = light.position - caster.center;
        if (light.infinite || dot(from_center, from_center) > caster.radius * caster.radius) return {};
        const Vec3 direction = normalize(to - light.position);
        const float area = 4 * float(pi) * caster.radius * caster.radius;
        const float flux = irradiance_of(scene, light, to) * max(0.f, dot(outward, direction)) * area;
        return {offset_origin(light.position, light.error, light.normal, true), direction, flux, light.light};
    }
    EmittedPhoton emit(uint32_t number) const {
        const Sampler<float> sampler{pcg_hash(photon_seed), number};
        const Pair<float> choice = sampler.pair(caster_dimension);
        const int chosen = std::min(int(choice.x() * float(casters().count)), casters().count - 1);
        const bool within = from_inside && choice.y() < 0.5f;
        EmittedPhoton photon = within ? from_within(casters().spheres[chosen], sampler) : from_outside(casters().spheres[chosen], sampler);
        photon.flux *= float(casters().count) * (from_inside ? 2.f : 1.f);
        return photon;
    }
};
PhotonSource photon_source(const SceneTables& scene) {
    PhotonSource source{scene};
    constexpr uint32_t trials = 64; // of a caster
    for (int k = 0; k < source.casters().count; ++k)
        for (uint32_t i = 0; i < trials && !source.from_inside; ++i)
            source.from_inside = source.from_within(source.casters().spheres[k], {pcg_hash(photon_seed), i}).flux > 0;
    return source;
}

KernelContext pilot_context(KernelContext context) {
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    return context;
}

template <class T> std::vector<T> joined(const std::vector<std::vector<T>>& of_tile) {
    std::vector<T> all;
    for (const auto& some : of_tile) all.insert(all.end(), some.begin(), some.end());
    return all;
}

} // namespace

std::shared_ptr<const CausticPhotons> trace_caustic_photons(KernelContext context, const Kernel& kernel, const Workers& workers,
                                                            std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                            const std::function<bool()>& wanted) {
    if (context.scene->lights.count == 0) return std::make_shared<const CausticPhotons>();
    SceneTables emission = *context.scene;
    emission.lights.portals = {};
    SceneTables tables = emission;
    tables.lights.count = 0; // photons meet no NEE
    tables.guides = {};
    const PhotonSource source = photon_source(emission);
    context = pilot_context(context);
    context.scene = &tables;
    context.settings.mis.strategy = Strategy::bsdf;
    context.seed = photon_seed;
    const auto pixels = int64_t(double(context.settings.width) * double(context.settings.height));
    const int64_t tiles = std::clamp(pixels / pixels_per_photon_tile, min_photon_tiles, max_photon_tiles);
    std::vector<std::vector<GuidingTrial>> of_tile((size_t(tiles)));
    std::vector<std::vector<ChainPhoton>> chains_of_tile((size_t(tiles)));
    const bool traced = TileRunner{workers, scratch, wanted}.for_each(of_tile.size(), [&](size_t i, TileScratch& tile) {
        tile.photons = std::make_unique<PhotonTrials>();
        for (uint32_t k = 0; k < uint32_t(tile_capacity); ++k)
            tile.photons->emitted.push_back(source.emit(uint32_t(i) * uint32_t(tile_capacity) + k));
        tile.photons->events.assign(tile.photons->emitted.size(), 0);
        kernel.render(context, {.x = int(i) * photon_tile, .y = 0, .width = photon_tile, .height = photon_tile}, tile);
        chains_of_tile[i] = std::move(tile.photons->chains);
        of_tile[i] = std::move(std::exchange(tile.photons, nullptr)->arrived);
    });
    if (!traced) return nullptr;
    return std::make_shared<const CausticPhotons>(CausticPhotons{joined(of_tile), joined(chains_of_tile), tiles * tile_capacity});
}

std::optional<GuidingField> learn_path_guiding(KernelContext context, const CausticPhotons& photons, const Kernel& kernel,
                                               const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
                                               const std::function<bool()>& wanted) {
    if (photons.arrived.empty()) return GuidingField();
    context = pilot_context(context);
    const PilotImage image = pilot_image(context.settings, path_pixels, path_samples);
    context.settings.width = float(image.width);
    context.settings.height = float(image.height);
    context.seed = path_seed;
    std::vector<std::vector<GuidingTrial>> of_tile(image.tiles.size());
    const bool measured = TileRunner{workers, scratch, wanted}.for_each(image.tiles.size(), [&](size_t i, TileScratch& tile) {
        tile.guiding = std::make_unique<GuidingTrials>();
        kernel.render(context, image.tiles[i], tile);
        of_tile[i] = std::move(std::exchange(tile.guiding, nullptr)->all);
    });
    if (!measured) return std::nullopt;
    return GuidingField::learn(photons.arrived, photons.emitted, joined(of_tile), context.scene->guides.casters, workers, wanted);
}

} // namespace blush
