#include "scene/changes.h"

#include "scene/lights/ies_profile.h"

#include <algorithm>
#include <unordered_map>

namespace blush {
namespace {

template <class T> bool same_payload(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) {
    return a == b || (a && b && a->serial == b->serial);
}

// same_to_image: true if two records with the same id render the same.

template <class T> bool equal_except_name(T before, const T& after) {
    before.name = after.name;
    return before == after;
}

bool same_to_image(const Material& a, const Material& b) { return equal_except_name(a, b); }
bool same_to_image(Light before, const Light& after) {
    if (!same_payload(before.ies, after.ies)) return false;
    before.ies = after.ies;
    before.ies_file = after.ies_file;
    before.unit = after.unit;
    before.keep_power = after.keep_power;
    before.group = after.group; // diff_mix
    return equal_except_name(std::move(before), after);
}

bool same_to_image(Texture before, const Texture& after) {
    if (!same_payload(before.image, after.image)) return false;
    before.image = after.image;
    before.source = after.source;
    return equal_except_name(std::move(before), after);
}

bool same_to_image(const Mesh& a, const Mesh& b) {
    return std::ranges::equal(a.parts, b.parts, [](const MeshPart& p, const MeshPart& q) {
        return p.material == q.material && same_payload(p.geometry, q.geometry);
    });
}

template <class T> std::vector<Id<T>> changes_of_image(const Table<T>& before, const Table<T>& after) {
    std::vector<Id<T>> ids = Table<T>::changed(before, after);
    std::erase_if(ids, [&](Id<T> id) {
        const T* a = before.find(id);
        const T* b = after.find(id);
        return a && b && same_to_image(*a, *b);
    });
    return ids;
}

void diff_nodes(const Scene& before, const Scene& after, Changes& changes) {
    for (const Id<Node> id : Table<Node>::changed(before.nodes, after.nodes)) {
        const Node* a = before.nodes.find(id);
        const Node* b = after.nodes.find(id);
        if (!a || !b) {
            changes.structure.push_back(id);
            continue;
        }
        const bool moved_in_tree = a->parent != b->parent;
        if (moved_in_tree || a->local != b->local) changes.transforms.push_back(id);
        const bool shown_or_hidden = a->visible != b->visible || (moved_in_tree && is_visible(before, id) != is_visible(after, id));
        const bool same_shape =
            a->mesh == b->mesh && a->skin == b->skin && a->morph_weights == b->morph_weights && same_payload(a->instances, b->instances);
        if (shown_or_hidden || !same_shape || a->light != b->light || a->only_in_scenes != b->only_in_scenes ||
            a->shadow_catcher != b->shadow_catcher)
            changes.structure.push_back(id);
    }
}

// Tells whether nodes are, or are below, one of some moved nodes. Visits each node once, however deep the hierarchy is.
class MovedSubtrees {
public:
    // `moved` in id order.
    MovedSubtrees(const Scene& scene, const std::vector<Id<Node>>& moved) : scene_(scene), moved_(moved) {}

    bool contains(Id<Node> id) {
        path_.clear();
        bool below = false;
        // The depth is at most the number of nodes: ends if the hierarchy has a cycle.
        for (Id<Node> up = id; up && !below && path_.size() <= scene_.nodes.size();) {
            if (const auto found = known_.find(up.value); found != known_.end()) {
                below = found->second;
                break;
            }
            below = std::ranges::binary_search(moved_, up);
            const Node* node = scene_.nodes.find(up);
            path_.push_back(up.value);
            up = node ? node->parent : Id<Node>{};
        }
        // Leaves need not be known.
        for (size_t i = 1; i < path_.size(); ++i) known_[path_[i]] = below;
        return below;
    }

private:
    const Scene& scene_;
    const std::vector<Id<Node>>& moved_;
    std::unordered_map<uint32_t, bool> known_; // nodes with children
    std::vector<uint32_t> path_;
};

// Meshes move with their node, or with the joints of their skin.
void diff_moved_meshes(const Scene& after, Changes& changes) {
    if (changes.transforms.empty()) return;
    MovedSubtrees moved(after, changes.transforms);
    const auto has_moved = [&](Id<Node> id) { return moved.contains(id); };
    for (const auto& [id, node] : after.nodes) {
        if (!node.mesh) continue;
        const Skin* skin = node.skin ? after.skins.find(node.skin) : nullptr;
        if (moved.contains(id) || (skin && std::ranges::any_of(skin->joints, has_moved))) changes.moved_meshes.push_back(id);
    }
}

bool same_moment(const Scene& a, const Scene& b) {
    const SceneSelection &before = a.scene_selection, &after = b.scene_selection;
    if (before.scene != after.scene || before.clip != after.clip) return false;
    if (!before.clip) return true;
    const Clip *x = a.clips.find(before.clip), *y = b.clips.find(after.clip);
    return before.seconds == after.seconds && x && y && x->channels == y->channels;
}

void diff_environment(const Environment& a, const Environment& b, Changes& changes) {
    const bool other_sky = b.kind == Environment::Kind::sky && a.sky != b.sky;
    changes.environment_image = a.kind != b.kind || !same_payload(a.image, b.image) || other_sky;
    changes.environment_parameters = a.color != b.color || a.intensity != b.intensity || a.rotation_degrees != b.rotation_degrees ||
                                     a.visible_to_camera != b.visible_to_camera || a.lights_scene != b.lights_scene || a.solo != b.solo;
}

// Names that light groups can be made from.
template <class T> bool same_names(const Table<T>& before, const Table<T>& after) {
    return std::ranges::none_of(Table<T>::changed(before, after), [&](Id<T> id) {
        const T *a = before.find(id), *b = after.find(id);
        if (!a || !b) return false;
        if constexpr (requires { a->group; }) return a->name != b->name || a->group != b->group;
        return a->name != b->name;
    });
}

void diff_mix(const Scene& before, const Scene& after, Changes& changes) {
    changes.mix = before.mix != after.mix;
    if (after.mix.grouping == LightMix::Grouping::none) return;
    changes.mix |= before.environment.group != after.environment.group || !same_names(before.nodes, after.nodes) ||
                   !same_names(before.lights, after.lights) || !same_names(before.materials, after.materials);
}

void diff_settings(const RenderSettings& a, const RenderSettings& b, Changes& changes) {
    changes.resolution = a.width != b.width || a.height != b.height || a.resolution_scale != b.resolution_scale;
    const auto compensates = [](const RenderSettings& s) { return s.strategy == Strategy::mis && s.mis_compensation; };
    changes.nee_changed = (a.strategy == Strategy::bsdf) != (b.strategy == Strategy::bsdf) || compensates(a) != compensates(b);
    changes.stop_rules = a.spp != b.spp || a.seconds != b.seconds || a.error != b.error;
    RenderSettings sized_alike = a;
    sized_alike.width = b.width;
    sized_alike.height = b.height;
    sized_alike.resolution_scale = b.resolution_scale;
    changes.integrator = !same_image(sized_alike, b);
}

} // namespace

bool Changes::any() const { return stop_rules || affects_image(); }

bool Changes::affects_image() const {
    return view || resolution || integrator || environment_parameters || environment_image || !transforms.empty() || !structure.empty() ||
           motion || !meshes.empty() || !materials.empty() || !textures.empty() || !lights.empty() || mix;
}

bool Changes::only_view() const {
    Changes others = *this;
    others.view = false;
    return view && !others.affects_image();
}

bool Changes::only_light() const {
    return !view && !resolution && !integrator && !environment_image && transforms.empty() && structure.empty() && !motion &&
           meshes.empty() && textures.empty();
}

Changes diff(const Scene& before, const RenderSettings& before_settings, const Scene& after, const RenderSettings& after_settings) {
    Changes changes;
    // The pivot is only used for orbiting; rays do not depend on it.
    View view = before.view;
    view.pivot_distance = after.view.pivot_distance;
    // The focus distance has no effect on a pinhole.
    if (view.lens.aperture_radius == 0 && after.view.lens.aperture_radius == 0) view.lens.focus_distance = after.view.lens.focus_distance;
    changes.view = view != after.view;
    diff_settings(before_settings, after_settings, changes);
    diff_environment(before.environment, after.environment, changes);
    diff_nodes(before, after, changes);
    diff_moved_meshes(after, changes);
    diff_mix(before, after, changes);
    changes.motion = !same_moment(before, after) || !(before.skins == after.skins);
    changes.meshes = changes_of_image(before.meshes, after.meshes);
    changes.materials = changes_of_image(before.materials, after.materials);
    changes.textures = changes_of_image(before.textures, after.textures);
    changes.lights = changes_of_image(before.lights, after.lights);
    return changes;
}

} // namespace blush
