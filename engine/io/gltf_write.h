// Internal to gltf_*.cpp: records into objects of a document, as far as glTF and its extensions can say them. Only values that differ
// from what the object says are written. Whatever a record has beyond that, gltf_write_extras.h adds.
#pragma once

#include "io/gltf_document.h"

namespace blush {

// KHR_lights_punctual; what shines on a surface like it, for a kind that the extension lacks.
void write_punctual_light(Json& object, const Light& light);
// EXT_lights_area.
void write_area_light(Json& object, const Light& light);
// EXT_lights_ies: the file of a profile; of one that came inside of a document, what that says stays.
void write_profile(Json& object, const Light& light);
// What a node says of a light that shines with a profile of so many candela.
void write_measured_instance(Json& extension, const Light& light, float peak);
// The list in which lights of this kind are, if they have no measured distribution.
GltfLight::List list_for(Light::Kind kind);
// Its colour with the temperature in it, and its intensity, 0 if it is off, as other programs want them: the colour within [0, 1].
struct PlainEmission {
    Vec3 color;
    float intensity;
};
PlainEmission plain_emission(const Light& light);

void write_camera(Json& object, const Camera& camera);
void write_material(GltfDocument& document, Json& object, const Material& material);
// Transform and visibility.
void write_node(Json& object, const Node& node);
// Wrap modes and filter, in a sampler that may be shared or new.
void write_sampler(GltfDocument& document, Json& object, const Texture& texture);

// References between nodes, and from them to what they carry. Nodes that the document lacks are added, in the order of their ids;
// those that the scene lacks are taken out of the tree.
void write_tree(GltfDocument& document, const Scene& scene);

} // namespace blush
