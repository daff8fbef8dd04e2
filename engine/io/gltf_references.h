// Internal to gltf_*.cpp: where the objects of a glTF document name each other by index.
#pragma once

#include "io/json_fields.h"

#include <functional>
#include <string_view>

namespace blush {

// The lists whose objects are named by index; lights go by the names of their extensions.
inline constexpr std::string_view gltf_lists[] = {"scenes",  "nodes",    "meshes",     "materials",           "textures",
                                                  "images",  "samplers", "cameras",    "accessors",           "bufferViews",
                                                  "buffers", "skins",    "animations", "KHR_lights_punctual", "EXT_lights_area",
                                                  "EXT_lights_ies", "EXT_lights_image_based"};

// Calls visit(list, index) for each reference that an object of `list_name` holds. Only those of extensions that are known
// are found: see knows_references.
void visit_references(std::string_view list_name, Json& object, const std::function<void(std::string_view list, Json& index)>& visit);

// True if no object that this extension adds to a document names others in a way that visit_references does not see.
bool knows_references(std::string_view extension);

} // namespace blush
