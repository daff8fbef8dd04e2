#include "tests/render/random_scene.h"

#include "scene/geometry/tangents.h"
#include "scene/reuse_setting.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace blush::test {
namespace {

// The same surface with normals, texture coordinates and tangents.
GeometryPtr textured(const Geometry& shape) {
    Geometry g;
    g.uv.resize(2);
    const bool smooth = !shape.normals.empty();
    for (size_t i = 0; i < shape.indices.size(); i += 3) {
        std::array<Vec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) corners[k] = shape.positions[shape.indices[i + k]];
        const Vec3 face = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
        for (size_t k = 0; k < 3; ++k) {
            const Vec3& p = corners[k];
            g.indices.push_back(uint32_t(g.positions.size()));
            g.positions.push_back(p);
            g.normals.push_back(smooth ? shape.normals[shape.indices[i + k]] : face);
            for (size_t set = 0; set < 2; ++set)
                g.uv[set].push_back({0.4f * p.x + 0.3f * p.y + 0.1f * p.z, 0.5f * p.z - 0.2f * p.y + 0.3f * float(set)});
            g.colors.push_back({std::clamp(0.7f + 0.3f * p.x, 0.f, 1.f), 0.8f, std::clamp(0.7f - 0.3f * p.z, 0.f, 1.f), 1});
        }
    }
    add_tangents(g, 0);
    return std::make_shared<const Geometry>(std::move(g));
}

} // namespace

RandomScene::RandomScene(uint32_t seed) : random_(seed) {
    objects_.push_back(place(scene, floor_quad(2), receiver()));
    if (one_in(3)) objects_.push_back(place(scene, quad({-2, 0, -1.3f}, {2, 0, -1.3f}, {2, 1.6f, -1.3f}, {-2, 1.6f, -1.3f}), receiver()));
    for (const Vec3& center : {Vec3{-0.8f, 0.5f, 0}, {0.7f, 0.5f, 0.2f}, {0, 0.4f, 0.9f}}) {
        if (one_in(4)) continue;
        Transform where = at(center, 0.3f);
        if (one_in(4)) where.scale = {0.45f, 0.2f, 0.3f};
        const GeometryPtr shape = one_in(3) ? cube(false) : one_in(3) ? sphere(false) : round_sphere();
        objects_.push_back(place(scene, shape, caster(), where));
    }
    for (const float height : {1.1f, 1.4f}) {
        if (!one_in(3)) continue;
        const Material material = veil(); // before the place: arguments have no order
        objects_.push_back(place(scene, floor_quad(0.6f, height), material, at({number(-0.6f, 0.6f), 0, number(0, 0.4f)})));
    }
    if (one_in(4))
        objects_.push_back(place(scene, quad({-0.8f, 0.1f, 1.3f}, {0.6f, 0.1f, 1.3f}, {0.6f, 0.8f, 1.3f}, {-0.8f, 0.8f, 1.3f}), veil()));
    const int lights = 1 + int(random_() % 2);
    for (int i = 0; i < lights; ++i) add_light();
    if (one_in(4)) constant_world(scene, 0.3f);
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    if (one_in(4)) scene.view.lens.aperture_radius = 0.1f, scene.view.lens.focus_distance = 4;
    if (one_in(5)) max_bounces = 3 + int(random_() % 4);
}

Material RandomScene::receiver() {
    Material m = one_in(5) ? metal(0.35f) : lambert(color());
    if (one_in(4)) m.specular = 1, m.roughness = one_in(2) ? 0.4f : 0.f;
    if (one_in(6)) m.clearcoat = 0.8f, m.clearcoat_roughness = one_in(2) ? 0.3f : 0.f;
    return m;
}

Material RandomScene::caster() {
    const float roughness = one_in(3) ? 0.2f : 0.f;
    Material m = one_in(3) ? metal(roughness) : one_in(3) ? plastic(roughness) : glass(roughness, 1.4f);
    if (m.transmission > 0 && one_in(3)) m.attenuation_color = color(), m.attenuation_distance = 0.5f;
    if (m.transmission > 0 && one_in(6)) m.dispersion = 4;
    if (one_in(4)) m.base_color = color();
    if (one_in(8)) m.emissive = color(), m.emissive_strength = 2;
    if (one_in(8)) m.clearcoat = 1;
    return m;
}

// A pane or a leaf: blended, cut out or solid.
Material RandomScene::veil() {
    Material m = one_in(2) ? window_glass(color()) : lambert(color());
    m.double_sided = one_in(2);
    if (one_in(3)) m.emissive = color(), m.emissive_strength = 2;
    if (one_in(4)) m.transmission = 0.5f;
    if (one_in(3)) return m;
    m.alpha = one_in(4) ? Material::Alpha::mask : Material::Alpha::blend;
    m.opacity = number(0.2f, 0.9f);
    return m;
}

void RandomScene::add_light() {
    if (one_in(3)) {
        Material lamp = emitter(10, one_in(2) ? 0.8f : 0.f);
        lamp.double_sided = one_in(2);
        if (one_in(4)) lamp.alpha = Material::Alpha::blend, lamp.opacity = 0.6f;
        if (one_in(4)) lamp.clearcoat = 1;
        const GeometryPtr shape = ceiling_quad(0.6f, number(1.6f, 2.5f));
        place(scene, shape, lamp, at({number(-0.4f, 0.4f), 0, number(-0.3f, 0.5f)}));
        return;
    }
    Light light = caustic_light(Light::Kind::point, 20, 0.45f);
    Transform where = at({number(-0.6f, 0.6f), number(1.9f, 2.5f), number(0, 0.6f)});
    if (one_in(3)) {
        light = caustic_light(Light::Kind::sun, 3);
        light.angle_radians = number(0.4f, 0.7f);
        where = aimed({0, 5, 0}, {number(-0.4f, 0.4f), -1, number(-0.3f, 0.3f)});
    } else if (one_in(3)) {
        light = caustic_light(one_in(2) ? Light::Kind::rectangle : Light::Kind::disk, 12);
        light.radius = 0.5f;
        light.two_sided = one_in(3);
        if (one_in(3)) light.spread_radians = 2;
        where = aimed(where.translation, {number(-0.2f, 0.2f), -1, number(-0.2f, 0.2f)});
    } else if (one_in(3)) {
        light.kind = Light::Kind::spot;
        light.outer_cone_radians = 1;
        where = aimed(where.translation, {number(-0.2f, 0.2f), -1, number(-0.2f, 0.2f)});
    }
    light.color = color();
    if (one_in(5)) light.lit_objects = some_objects();
    if (one_in(5)) light.shadow_casters = some_objects();
    place_light(scene, light, where);
}

void RandomScene::enrich() {
    for (const auto& entry : Table<Mesh>(scene.meshes)) {
        Mesh mesh = entry.value;
        for (MeshPart& part : mesh.parts)
            if (one_in(2)) part.geometry = textured(*part.geometry);
        scene.meshes.set(entry.id, std::move(mesh));
    }
    for (const auto& entry : Table<Material>(scene.materials)) {
        Material m = entry.value;
        if (one_in(2)) add_textures(m);
        if (one_in(3)) add_lobes(m);
        scene.materials.set(entry.id, std::move(m));
    }
    for (const auto& entry : Table<Light>(scene.lights)) {
        Light light = entry.value;
        if (one_in(3)) light.visible_to_camera = false;
        if (one_in(5)) light.use_temperature = true, light.kelvin = number(2500, 9000);
        scene.lights.set(entry.id, std::move(light));
    }
    if (one_in(3)) add_copies();
    if (one_in(2)) add_environment();
    if (one_in(4)) {
        scene.view.lens.orthographic = true;
        scene.view.lens.ymag = 1.3f;
    }
}

TextureRef RandomScene::texture() {
    Image image;
    const bool whole = one_in(3);
    image.width = whole ? 1 : 4;
    image.height = whole ? 1 : 8;
    image.channels = 4;
    for (int i = 0; i < image.width * image.height * image.channels; ++i) image.bytes.push_back(uint8_t(90 + random_() % 166));
    const Id<Texture> id =
        add_texture(scene, std::make_shared<const Image>(std::move(image)), one_in(2) ? Texture::Filter::nearest : Texture::Filter::linear);
    TextureRef ref{id};
    if (one_in(3)) ref.uv_set = 1;
    if (one_in(3)) ref.scale = {number(0.5f, 3), number(0.5f, 3)}, ref.rotation_radians = number(0, 3), ref.offset = {0.3f, 0.1f};
    return ref;
}

void RandomScene::add_textures(Material& m) {
    for (TextureRef* ref :
         {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emissive_texture, &m.specular_texture,
          &m.transmission_texture, &m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture})
        if (one_in(4)) *ref = texture();
    if (m.normal_texture.texture) m.normal_texture.uv_set = 0;
    if (m.clearcoat_normal_texture.texture) m.clearcoat_normal_texture.uv_set = 0;
    m.normal_scale = m.clearcoat_normal_scale = 0.3f;
}

void RandomScene::add_lobes(Material& m) {
    if (one_in(3)) m.sheen_color = color(), m.sheen_roughness = number(0.2f, 1);
    if (one_in(3)) m.anisotropy = number(0.1f, 0.9f), m.anisotropy_rotation_radians = number(0, 3);
    if (one_in(3)) m.iridescence = number(0.2f, 1);
    if (one_in(3)) m.diffuse_transmission = number(0.1f, 0.9f), m.diffuse_transmission_color = color();
    if (one_in(3)) m.clearcoat = number(0.2f, 1), m.clearcoat_roughness = one_in(2) ? 0.f : 0.2f;
    if (one_in(4)) m.metallic = 0.5f;
    if (one_in(6)) m.unlit = true;
}

// Instances of one of the objects, small, beside each other.
void RandomScene::add_copies() {
    Node node = *scene.nodes.find(objects_.back());
    if (!node.mesh) return;
    Instances instances;
    for (int k = 0; k < 3; ++k) {
        const float s = number(0.15f, 0.35f);
        instances.node_from_copy.push_back({{s, 0, 0}, {0, s, 0}, {0, 0, s}, {float(k) - 1, 0.3f, 1.4f}});
    }
    node.local = {};
    node.instances = std::make_shared<const Instances>(std::move(instances));
    objects_.push_back(scene.nodes.add(node));
}

void RandomScene::add_environment() {
    Environment& e = scene.environment;
    e = {};
    e.rotation_degrees = number(0, 360);
    e.visible_to_camera = !one_in(3);
    e.intensity = 0.5f;
    if (one_in(2)) {
        e.kind = Environment::Kind::image;
        std::vector<Vec3> texels;
        for (int i = 0; i < 16 * 8; ++i) texels.push_back(color());
        for (int k = 0; k < 3; ++k) texels[random_() % 64] = {20, 18, 12};
        e.image = float_image(16, 8, texels);
    } else {
        e.kind = Environment::Kind::sky;
        e.intensity = 1e-4f;
        e.sky.sun_disk = false;
        e.sky.elevation_degrees = number(5, 80);
    }
}

void RandomScene::harden() {
    for (const auto& entry : Table<Light>(scene.lights)) {
        Light light = entry.value;
        if (one_in(3)) light.radius = 0, light.angle_radians = 0;
        if (light.kind == Light::Kind::rectangle || light.kind == Light::Kind::disk) light.radius = 0.5f;
        scene.lights.set(entry.id, std::move(light));
    }
    if (scene.environment.kind == Environment::Kind::sky) scene.environment.sky.sun_disk = one_in(2);
    if (one_in(6)) {
        Node node = *scene.nodes.find(objects_.front());
        node.shadow_catcher = true;
        scene.nodes.set(objects_.front(), node);
        if (one_in(2)) scene.environment.visible_to_camera = false;
    }
}

RenderSettings random_unbiased_settings(uint32_t seed) {
    std::mt19937 random(seed);
    const auto one_in = [&](uint32_t n) { return random() % n == 0; };
    const auto one_of = [&](const auto& values) { return values[random() % values.size()]; };
    RenderSettings s;
    s.roulette.rule = one_of(std::array{Roulette::Rule::automatic, Roulette::Rule::off, Roulette::Rule::max, Roulette::Rule::luminance,
                                        Roulette::Rule::sqrt, Roulette::Rule::constant, Roulette::Rule::adjoint, Roulette::Rule::efficiency,
                                        Roulette::Rule::splitting});
    s.roulette.start = int(random() % 4);
    s.strategy = one_in(6) ? Strategy::bsdf : Strategy::mis;
    if (s.strategy == Strategy::mis && one_in(5)) s.heuristic = *parse_heuristic(one_of(std::array{"balance", "cutoff=0.1", "maximum"}));
    s.caustics = one_of(std::array{CausticStrategy::automatic, CausticStrategy::automatic, CausticStrategy::off, CausticStrategy::guiding,
                                   CausticStrategy::light_paths, CausticStrategy::manifold});
    s.filter = PixelFilter::box; // others move light between pixels
    s.sampler = one_in(5) ? SamplerType::random : SamplerType::sobol;
    s.mis_compensation = s.strategy == Strategy::mis && one_in(2);
    s.adaptive = one_in(3);
    s.smooth_edges = one_in(2);
    s.reuse = one_of(std::array{1, 4, 8, 16, reuse_auto, reuse_auto});
    return s;
}

std::string text_of(const RenderSettings& s) {
    return fmt::format("roulette {}, strategy {}, heuristic {}, caustics {}, reuse {}, clamp {}, {} bounces, {}, {}{}{}{}{}",
                       to_string(s.roulette), to_string(s.strategy), to_string(s.heuristic), to_string(s.caustics), reuse_text(s.reuse),
                       to_string(s.clamp), max_bounces_text(s.max_bounces), to_string(s.filter), to_string(s.sampler),
                       s.adaptive ? ", adaptive" : "", s.smooth_edges ? ", smooth edges" : "",
                       s.mis_compensation ? ", MIS compensation" : "", s.energy_compensation ? ", energy compensation" : "");
}

} // namespace blush::test
