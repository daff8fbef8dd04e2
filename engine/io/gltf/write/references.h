// Internal to io/gltf: finds all references by index between objects of a glTF document.
#pragma once

#include "io/project/json_fields.h"

#include <functional>
#include <string_view>

namespace blush {

// Lists whose objects are referenced by index; lists of lights are named by their extensions.
inline constexpr std::string_view gltf_lists[] = {"scenes",
                                                  "nodes",
                                                  "meshes",
                                                  "materials",
                                                  "textures",
                                                  "images",
                                                  "samplers",
                                                  "cameras",
                                                  "accessors",
                                                  "bufferViews",
                                                  "buffers",
                                                  "skins",
                                                  "animations",
                                                  "KHR_lights_punctual",
                                                  "EXT_lights_area",
                                                  "EXT_lights_ies",
                                                  "EXT_lights_image_based"};

// Calls visit(list, index) for each reference in an object of `list_name`. Finds only references of known extensions: see
// finds_all_references.
void visit_references(std::string_view list_name, Json& object, const std::function<void(std::string_view list, Json& index)>& visit);

// True if visit_references finds all references that this extension can add.
bool finds_all_references(std::string_view extension);

} // namespace blush
