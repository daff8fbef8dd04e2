#include "render/lights/light_links.h"

#include "render/compile/expanded_lights.h"
#include "render/compile/geometry_pool.h"

#include <algorithm>

namespace blush {
namespace {

// The light of a table record; null: an emissive surface, or the environment.
const Light* light_of(const Scene& expanded, const LightRecord& record, Id<Node> node) {
    if (record.kind == int32_t(LightKind::environment)) return nullptr;
    if (record.kind == int32_t(LightKind::triangle)) return light_of_expanded_mesh(expanded, node);
    const Node* found = expanded.nodes.find(node);
    return found ? expanded.lights.find(found->light) : nullptr;
}

// The distinct sets, with one bit per member part.
class LitSets {
public:
    LitSets(const Scene& scene, const GeometryPool& geometry, const LightLinks& last)
        : scene_(scene), geometry_(geometry), last_(last), words_(int32_t((geometry.parts().size() + 31) / 32)) {}

    int32_t index_of(const ObjectSet& set) {
        const auto it = std::ranges::find(sets_, set);
        if (it != sets_.end()) return int32_t(it - sets_.begin());
        sets_.push_back(set);
        if (const auto known = std::ranges::find(last_.sets, set); known != last_.sets.end()) {
            const auto words = last_.lit_parts.begin() + (known - last_.sets.begin()) * words_;
            bits_.insert(bits_.end(), words, words + words_);
        } else
            add_bits(set);
        return int32_t(sets_.size()) - 1;
    }
    // Moves the sets and their bits to `links`.
    void give(LightLinks& links) && {
        links.words = words_;
        links.sets = std::move(sets_);
        links.lit_parts = std::move(bits_);
    }

private:
    void add_bits(const ObjectSet& set) {
        const size_t first = bits_.size();
        bits_.resize(first + size_t(words_));
        const std::vector<PartRecord>& parts = geometry_.parts();
        bool in_set = false; // consecutive parts mostly belong to one object
        for (size_t part = 0; part < parts.size(); ++part) {
            if (part == 0 || parts[part].object != parts[part - 1].object)
                in_set = contains(set, scene_, Id<Node>{uint32_t(parts[part].object)});
            if (in_set) bits_[first + part / 32] |= 1u << part % 32;
        }
    }

    const Scene& scene_;
    const GeometryPool& geometry_;
    const LightLinks& last_;
    int32_t words_;
    std::vector<ObjectSet> sets_;
    std::vector<uint32_t> bits_;
};

constexpr int first_caster_bit = 2;

// The node itself or its nearest ancestor that is listed in the set.
Id<Node> named_above(const ObjectSet& set, const Scene& scene, Id<Node> node) {
    // The depth is at most the number of nodes: ends if the hierarchy has a cycle.
    size_t steps = scene.nodes.size() + 1;
    for (Id<Node> up = node; up && steps > 0; --steps) {
        // The mesh of an area light belongs to the light's node.
        const Id<Node> id{up.value & ~expanded_id_bit};
        if (std::ranges::find(set.nodes, id) != set.nodes.end()) return id;
        const Node* found = scene.nodes.find(id);
        up = found ? found->parent : Id<Node>{};
    }
    return {};
}

} // namespace

bool contains(const ObjectSet& set, const Scene& scene, Id<Node> node) {
    return set.nodes.empty() ? set.all_but : bool(named_above(set, scene, node)) != set.all_but;
}

void toggle(ObjectSet& set, const Scene& scene, Id<Node> node) {
    if (const Id<Node> named = named_above(set, scene, node))
        std::erase(set.nodes, named);
    else
        set.nodes.push_back(node);
}

bool leaves_out(const ObjectSet& set, const Scene& scene) {
    return !set.all_but || std::ranges::any_of(set.nodes, [&](Id<Node> id) { return scene.nodes.contains(id); });
}

bool has_links(const Scene& scene) {
    return std::ranges::any_of(scene.lights, [&](const auto& entry) {
        return leaves_out(entry.value.lit_objects, scene) || leaves_out(entry.value.shadow_casters, scene);
    });
}

CasterSets::CasterSets(const Scene& scene) : CasterSets(scene, nodes_with_lights(scene)) {}

CasterSets::CasterSets(const Scene& scene, const std::vector<Id<Node>>& nodes) {
    for (const Id<Node> id : nodes) {
        const Light* light = scene.lights.find(scene.nodes.find(id)->light);
        if (!light->enabled || !leaves_out(light->shadow_casters, scene)) continue;
        if (std::ranges::find(sets_, light->shadow_casters) != sets_.end()) continue;
        if (sets_.size() < size_t(max_caster_sets))
            sets_.push_back(light->shadow_casters);
        else
            ++left_out_;
    }
}

uint32_t CasterSets::mask_of(const Scene& scene, Id<Node> object) const {
    uint32_t mask = 0;
    for (size_t k = 0; k < sets_.size(); ++k)
        if (contains(sets_[k], scene, object)) mask |= 1u << (first_caster_bit + k);
    return mask;
}

uint32_t CasterSets::ray_mask(const Scene& scene, const Light& light) const {
    if (!leaves_out(light.shadow_casters, scene)) return other_ray_mask;
    const auto it = std::ranges::find(sets_, light.shadow_casters);
    return it == sets_.end() ? other_ray_mask : 1u << (first_caster_bit + (it - sets_.begin()));
}

LightLinks build_light_links(const Scene& expanded, const LightTable& lights, const GeometryPool& geometry, const CasterSets& casters,
                             const LightLinks& last) {
    if (!has_links(expanded)) return {};
    LightLinks links;
    LitSets lit(expanded, geometry, last);
    bool any = false;
    for (size_t i = 0; i < lights.records.size(); ++i) {
        const Light* light = light_of(expanded, lights.records[i], i < lights.nodes.size() ? lights.nodes[i] : Id<Node>{});
        const int32_t set = light && leaves_out(light->lit_objects, expanded) ? lit.index_of(light->lit_objects) : -1;
        const uint32_t mask = light ? casters.ray_mask(expanded, *light) : other_ray_mask;
        any |= set >= 0 || mask != other_ray_mask;
        links.lit_sets.push_back(set);
        links.shadow_masks.push_back(mask);
    }
    if (!any) return {};
    std::move(lit).give(links);
    if (links.lit_parts.empty()) links.lit_parts.push_back(0); // kernels read before they apply masks
    return links;
}

} // namespace blush
