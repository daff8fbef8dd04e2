// Shape section: weights of a mesh's morph targets.
#include "scene/animation/pose.h"
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

size_t target_count(const Mesh& mesh) {
    size_t count = 0;
    for (const MeshPart& part : mesh.parts) count = std::max(count, part.geometry ? part.geometry->targets.size() : 0);
    return count;
}

} // namespace

void draw_morph_weights_panel(PanelContext& c, Id<Node> id) {
    const Node* record = c.scene().nodes.find(id);
    const Mesh* mesh = record ? c.scene().meshes.find(record->mesh) : nullptr;
    const size_t count = mesh ? target_count(*mesh) : 0;
    if (count == 0 || !section(c.ui, "Shape")) return;
    if (is_animated(c.scene(), id, Channel::Property::morph_weights)) {
        quiet_text("Animated. Select the rest pose in the timeline to edit the weights.");
        return;
    }
    Node node = *record;
    node.morph_weights.resize(count);
    Fields f(c.ui, "Shape");
    for (size_t i = 0; i < count; ++i) {
        const bool named = i < mesh->target_names.size() && !mesh->target_names[i].empty();
        const std::string name = named ? mesh->target_names[i] : fmt::format("Target {}", i);
        f.number(
            name.c_str(), node.morph_weights[i],
            {.min = -10, .max = 10, .reset = 0, .step = 0.005f, .tip = "Weight of this morph target: 0 none, 1 full.", .format = "%.3f"});
    }
    if (f.changed()) c.apply(SetNode{id, node}, f.gesture());
}

} // namespace blush
