// Internal to io/gltf: writes records into objects of a document, as far as glTF and its extensions can express them. Writes
// only values that differ from the object. write_extras.h adds the rest.
#pragma once

#include "io/gltf/write/document.h"

namespace blush {

// KHR_lights_punctual; kinds that the extension lacks are approximated.
void write_punctual_light(Json& object, const Light& light);
// EXT_lights_area.
void write_area_light(Json& object, const Light& light);
// EXT_lights_ies: the file of a profile; an embedded profile is kept.
void write_profile(Json& object, const Light& light);
// Node properties of a light with an IES profile of the given peak candela.
void write_ies_instance(Json& extension, const Light& light, float peak);
// The list for lights of this kind without an IES profile.
GltfLight::List list_for(Light::Kind kind);
// Colour including the temperature, scaled to [0, 1], and intensity (0 if disabled), as other programs expect them.
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

// Writes the references of nodes. Adds missing nodes in the order of their ids and removes nodes that the scene lacks from the
// tree.
void write_tree(GltfDocument& document, const Scene& scene);

} // namespace blush
