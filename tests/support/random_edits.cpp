#include "tests/support/random_edits.h"

#include "render/light_mix/bake_mix.h"
#include "render/light_mix/light_groups.h"
#include "scene/lights/ies_profile.h"
#include "scene/reuse_setting.h"
#include "tests/support/sample_project.h"

#include <array>
#include <numbers>
#include <type_traits>

namespace blush::test {
namespace {

float uniform(Rng& rng, float low, float high) { return std::uniform_real_distribution<float>(low, high)(rng); }
int whole(Rng& rng, int low, int high) { return std::uniform_int_distribution<int>(low, high)(rng); }
bool coin(Rng& rng) { return whole(rng, 0, 1) == 1; }
Vec3 color(Rng& rng) { return {uniform(rng, 0, 1), uniform(rng, 0, 1), uniform(rng, 0, 1)}; }
Vec3 place(Rng& rng) { return {uniform(rng, -2, 2), uniform(rng, -2, 2), uniform(rng, -2, 2)}; }
Quat turn(Rng& rng) { return {uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, 0.1f, 1)}; }

template <class T> const typename Table<T>::Entry* pick(Rng& rng, const Table<T>& table) {
    return table.empty() ? nullptr : &table.entries()[size_t(whole(rng, 0, int(table.size()) - 1))];
}
template <class T> Id<T> pick_id(Rng& rng, const Table<T>& table) {
    const auto* entry = pick(rng, table);
    return entry ? entry->id : Id<T>{};
}

// One of two IES profiles, the same object on each call.
IesPtr lamp_profile(bool type_b) {
    const auto make = [](IesProfile::Type type, float first_horizontal, float last_horizontal, float first_vertical, float last_vertical) {
        IesProfile p;
        p.type = type;
        p.vertical = {first_vertical, 0.5f * (first_vertical + last_vertical), last_vertical};
        p.horizontal = {first_horizontal, last_horizontal};
        p.candela = {100, 40, 10, 60, 90, 5};
        p.peak = 100;
        return std::make_shared<const IesProfile>(std::move(p));
    };
    static const IesPtr b = make(IesProfile::Type::b, -90, 90, -80, 80), c = make(IesProfile::Type::c, 0, 360, 0, 120);
    return type_b ? b : c;
}

Light light(Rng& rng) {
    Light l;
    l.kind = Light::Kind(whole(rng, 0, 5));
    l.color = color(rng);
    l.use_temperature = coin(rng);
    l.kelvin = uniform(rng, 1500, 10000);
    l.intensity = uniform(rng, 0, 50);
    const bool needs_radius = l.kind == Light::Kind::disk || l.kind == Light::Kind::sphere;
    l.radius = needs_radius || coin(rng) ? uniform(rng, 0.01f, 0.3f) : 0;
    l.angle_radians = coin(rng) ? uniform(rng, 0.001f, 0.2f) : 0;
    l.outer_cone_radians = uniform(rng, 0.2f, 1.5f);
    l.inner_cone_radians = l.outer_cone_radians * uniform(rng, 0, 1);
    l.width = uniform(rng, 0.1f, 2);
    l.height = uniform(rng, 0.1f, 2);
    l.two_sided = coin(rng);
    l.spread_radians = coin(rng) ? uniform(rng, 0.1f, 3) : std::numbers::pi_v<float>;
    l.visible_to_camera = coin(rng);
    l.green_tint = uniform(rng, -0.05f, 0.05f);
    if (whole(rng, 0, 3) == 0) l.ies = lamp_profile(coin(rng));
    l.enabled = whole(rng, 0, 4) > 0;
    l.solo = whole(rng, 0, 7) == 0;
    return l;
}

// Changes only what a light mix can express.
Light dimmed(Rng& rng, Light l) {
    l.intensity *= uniform(rng, 0.1f, 2);
    if (coin(rng)) l.color = color(rng);
    if (whole(rng, 0, 4) == 0) l.enabled = !l.enabled;
    if (whole(rng, 0, 4) == 0) l.group = coin(rng) ? "Warm" : "";
    if (whole(rng, 0, 9) == 0) l.lit_objects = {coin(rng), {Id<Node>{uint32_t(whole(rng, 1, 12))}}};
    if (whole(rng, 0, 9) == 0) l.shadow_casters = {coin(rng), {Id<Node>{uint32_t(whole(rng, 1, 12))}}};
    if (whole(rng, 0, 4) == 0) l.name = coin(rng) ? "Key" : "Fill";
    return l;
}

// Nothing that needs tangents: the importer makes them for such materials, so a saved mesh would return with more attributes.
void add_layers(Rng& rng, const Scene& scene, Material& m) {
    if (coin(rng)) m.clearcoat = uniform(rng, 0, 1);
    if (coin(rng)) m.clearcoat_roughness = uniform(rng, 0, 1);
    if (coin(rng)) m.clearcoat_texture.texture = pick_id(rng, scene.textures);
    if (coin(rng)) m.sheen_color = color(rng);
    m.sheen_roughness = uniform(rng, 0, 1);
    if (coin(rng)) m.iridescence = uniform(rng, 0, 1);
    m.iridescence_thickness_maximum = uniform(rng, 0, 1000);
    if (coin(rng)) m.dispersion = uniform(rng, 0, 2);
    if (coin(rng)) m.diffuse_transmission = uniform(rng, 0, 1);
    if (coin(rng)) m.diffuse_transmission_color = color(rng);
}

Material material(Rng& rng, const Scene& scene) {
    Material m;
    m.base_color = color(rng);
    m.opacity = uniform(rng, 0.2f, 1);
    m.metallic = uniform(rng, 0, 1);
    m.roughness = uniform(rng, 0, 1);
    if (whole(rng, 0, 3) == 0) m.emissive = color(rng);
    m.emissive_strength = uniform(rng, 0, 5);
    m.alpha = Material::Alpha(whole(rng, 0, 2));
    m.double_sided = coin(rng);
    m.unlit = whole(rng, 0, 9) == 0;
    m.ior = uniform(rng, 1, 2);
    m.specular = uniform(rng, 0, 1);
    m.transmission = coin(rng) ? uniform(rng, 0, 1) : 0;
    m.thickness = coin(rng) ? 1.f : 0.f;
    if (coin(rng)) m.base_color_texture.texture = pick_id(rng, scene.textures);
    if (whole(rng, 0, 3) == 0) add_layers(rng, scene, m);
    return m;
}

// Never a descendant of the node.
Id<Node> new_parent(Rng& rng, const Scene& scene, Id<Node> id) {
    const Id<Node> candidate = pick_id(rng, scene.nodes);
    for (Id<Node> up = candidate; up; up = scene.nodes.find(up)->parent)
        if (up == id) return {};
    return candidate;
}

std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetNode>) {
    const auto* entry = pick(rng, p.scene.nodes);
    if (!entry) return {};
    Node node = entry->value;
    switch (whole(rng, 0, node.morph_weights.empty() ? 4 : 5)) {
    case 0: node.local.translation = place(rng); break;
    case 1: node.local.rotation = turn(rng); break;
    case 2: node.local.scale = {uniform(rng, 0.3f, 2), uniform(rng, 0.3f, 2), uniform(rng, -2, -0.3f)}; break;
    case 3: node.visible = !node.visible; break;
    case 4: node.parent = new_parent(rng, p.scene, entry->id); break;
    case 5: node.morph_weights.front() = uniform(rng, -1, 2); break;
    }
    return SetNode{entry->id, node};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetMaterial>) {
    const auto* entry = pick(rng, p.scene.materials);
    if (!entry) return {};
    Material dimmed = entry->value;
    dimmed.emissive_strength *= uniform(rng, 0.1f, 2);
    return SetMaterial{entry->id, coin(rng) ? dimmed : material(rng, p.scene)};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetLight>) {
    const auto* entry = pick(rng, p.scene.lights);
    if (!entry) return {};
    return SetLight{entry->id, coin(rng) ? dimmed(rng, entry->value) : light(rng)};
}
Lens lens(Rng& rng) {
    Lens l;
    l.orthographic = whole(rng, 0, 3) == 0;
    l.yfov_radians = uniform(rng, 0.2f, 2);
    l.ymag = uniform(rng, 0.5f, 3);
    l.aperture_radius = coin(rng) ? uniform(rng, 0.01f, 0.2f) : 0;
    l.focus_distance = uniform(rng, 1, 5);
    return l;
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetCamera>) {
    const Id<Camera> id = pick_id(rng, p.scene.cameras);
    if (!id) return {};
    return SetCamera{id, {"Camera", lens(rng)}};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetTexture>) {
    const auto* entry = pick(rng, p.scene.textures);
    if (!entry) return {};
    Texture texture = entry->value;
    texture.wrap_u = Texture::Wrap(whole(rng, 0, 2));
    texture.filter = Texture::Filter(whole(rng, 0, 1));
    if (coin(rng)) texture.image = byte_image(whole(rng, 1, 4), whole(rng, 1, 4), whole(rng, 1, 4), uint8_t(whole(rng, 0, 255)));
    return SetTexture{entry->id, texture};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<AssignMaterial>) {
    const auto* entry = pick(rng, p.scene.meshes);
    if (!entry || entry->value.parts.empty()) return {};
    return AssignMaterial{entry->id, whole(rng, 0, int(entry->value.parts.size()) - 1), pick_id(rng, p.scene.materials)};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<MakeEmissive>) {
    const auto* entry = pick(rng, p.scene.nodes);
    if (!entry || !p.scene.meshes.contains(entry->value.mesh)) return {};
    return MakeEmissive{entry->id, uniform(rng, 0, 5)};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetEnvironment>) {
    Environment e = p.scene.environment;
    if (coin(rng)) {
        e.intensity *= uniform(rng, 0.1f, 2);
        return SetEnvironment{e};
    }
    e.kind = Environment::Kind(whole(rng, 0, 3));
    e.color = color(rng);
    e.intensity = uniform(rng, 0, 3);
    e.rotation_degrees = uniform(rng, -180, 180);
    e.sky.turbidity = uniform(rng, 2, 9);
    e.sky.elevation_degrees = uniform(rng, -20, 90);
    e.sky.sun_disk = coin(rng);
    e.sky.by_place_and_time = coin(rng);
    e.visible_to_camera = coin(rng);
    e.lights_scene = coin(rng);
    if (e.kind == Environment::Kind::image && (!e.image || coin(rng))) e.image = uniform_image(8, 4, 3, uniform(rng, 0.1f, 2));
    return SetEnvironment{e};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetMix>) {
    LightMix mix = p.scene.mix;
    if (whole(rng, 0, 3) == 0) mix.grouping = LightMix::Grouping(whole(rng, 0, 4));
    const std::vector<LightGroup> groups = make_light_groups(p.scene).groups;
    if (groups.empty()) return SetMix{mix};
    const std::string& group = groups[size_t(whole(rng, 0, int(groups.size()) - 1))].name;
    std::erase_if(mix.channels, [&](const MixChannel& c) { return c.group == group; });
    mix.channels.push_back({.group = group,
                            .enabled = coin(rng),
                            .intensity = uniform(rng, 0, 2),
                            .color = color(rng),
                            .use_temperature = coin(rng),
                            .kelvin = uniform(rng, 1500, 10000)});
    return SetMix{mix};
}
std::optional<Edit> make(Rng&, const Project& p, std::type_identity<BakeMix>) {
    if (p.scene.mix.channels.empty()) return {};
    return bake_mix(p.scene);
}
std::optional<Edit> make(Rng& rng, const Project&, std::type_identity<SetLens>) { return SetLens{lens(rng)}; }
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetSceneSelection>) {
    SceneSelection scene_selection = p.scene.scene_selection;
    switch (whole(rng, 0, 3)) {
    case 0: scene_selection.clip = coin(rng) ? pick_id(rng, p.scene.clips) : Id<Clip>{}; break;
    case 1: scene_selection.seconds = uniform(rng, 0, 3); break;
    case 2: scene_selection.variant = whole(rng, -1, int(p.scene.variants.size()) - 1); break;
    case 3: scene_selection.scene = whole(rng, 0, std::max(0, int(p.scene.scene_names.size()) - 1)); break;
    }
    return SetSceneSelection{scene_selection};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetRender>) {
    RenderSettings r = p.render;
    switch (whole(rng, 0, 13)) {
    case 0: r.max_bounces = whole(rng, 0, 6); break;
    case 1: r.roulette.rule = Roulette::Rule(whole(rng, 0, 8)); break;
    case 2: r.strategy = Strategy(whole(rng, 0, 2)); break;
    case 3: r.filter = PixelFilter(whole(rng, 0, 1)); break;
    case 4: r.seed = uint32_t(whole(rng, 0, 1000)); break;
    case 5: r.energy_compensation = !r.energy_compensation; break;
    case 6: r.adaptive = !r.adaptive; break;
    case 7: r.reuse = std::array{reuse_auto, 1, 4, 8, 16}[size_t(whole(rng, 0, 4))]; break;
    case 8: r.sampler = SamplerType(whole(rng, 0, 1)); break;
    case 9: r.clamp = {uniform(rng, 0, 2), whole(rng, 0, 1) == 1}; break;
    case 10: r.mis_compensation = !r.mis_compensation; break;
    case 11: r.smooth_edges = !r.smooth_edges; break;
    case 12: r.caustics = CausticStrategy(whole(rng, 0, 4)); break;
    case 13:
        r.heuristic = *parse_heuristic(std::array{"power=2", "balance", "power=5", "cutoff=0.25", "maximum"}[size_t(whole(rng, 0, 4))]);
        break;
    }
    return SetRender{r};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<SetView>) {
    ViewSettings v = p.view;
    v.exposure_ev = uniform(rng, -3, 3);
    v.gamma = uniform(rng, 0.5f, 2);
    return SetView{v};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<AddLight>) {
    AddLight add;
    add.node.name = add.light.name = "New light";
    add.light = light(rng);
    add.node.local.translation = place(rng);
    add.node.local.rotation = turn(rng);
    add.node.parent = coin(rng) ? pick_id(rng, p.scene.nodes) : Id<Node>{};
    return add;
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<DuplicateNode>) {
    const Id<Node> id = pick_id(rng, p.scene.nodes);
    // Repeated duplication would grow without limit.
    if (!id || p.scene.nodes.size() > 60) return {};
    return DuplicateNode{id};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<RemoveNode>) {
    const Id<Node> id = pick_id(rng, p.scene.nodes);
    // Later edits need nodes to edit.
    if (!id || p.scene.nodes.size() < 4) return {};
    return RemoveNode{id};
}
std::optional<Edit> make(Rng&, const Project& p, std::type_identity<Import>) {
    if (p.scene.nodes.size() > 60) return {};
    return Import{sample_project().project.scene, "sample"};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<LookThrough>) {
    std::vector<Id<Node>> cameras;
    for (const auto& [id, node] : p.scene.nodes)
        if (node.camera) cameras.push_back(id);
    if (cameras.empty()) return {};
    return LookThrough{cameras[size_t(whole(rng, 0, int(cameras.size()) - 1))]};
}
std::optional<Edit> make(Rng& rng, const Project& p, std::type_identity<Restore>) {
    Project kept = p;
    kept.scene.environment.intensity = uniform(rng, 0.1f, 3);
    kept.scene.view.position = place(rng);
    return Restore{kept, "kept"};
}

template <size_t... kinds> std::optional<Edit> make_kind(Rng& rng, const Project& project, size_t kind, std::index_sequence<kinds...>) {
    std::optional<Edit> edit;
    ((kind == kinds ? void(edit = make(rng, project, std::type_identity<std::variant_alternative_t<kinds, Edit>>{})) : void()), ...);
    return edit;
}

} // namespace

std::optional<Edit> random_edit(Rng& rng, const Project& project, size_t kind) {
    return make_kind(rng, project, kind, std::make_index_sequence<std::variant_size_v<Edit>>{});
}

Edit random_edit(Rng& rng, const Project& project) {
    for (;;)
        if (std::optional<Edit> edit = random_edit(rng, project, size_t(whole(rng, 0, int(std::variant_size_v<Edit>) - 1)))) return *edit;
}

} // namespace blush::test
