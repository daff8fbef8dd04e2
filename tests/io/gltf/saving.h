// Helpers of the save tests: scenes to save, and iteration over every field of a record.
#pragma once

#include "core/files.h"
#include "io/gltf/read/import.h"
#include "io/image/image_io.h"
#include "io/project/scene_fields.h"
#include "scene/validate.h"
#include "tests/io/gltf/builder.h"
#include "tests/support/sample_project.h"

#include <fmt/format.h>

#include <stdexcept>

namespace blush::test {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* shipped_scenes[] = {"bulb", "card-and-mug", "cornell",     "corridor",  "furnace",   "metal-ring",
                                          "pool", "prism",        "two-bounces", "veach-mis", "wine-glass"};

inline std::filesystem::path shipped(const std::string& name) { return std::filesystem::path(BLUSH_ASSETS) / "scenes" / (name + ".gltf"); }

inline ImportedScene load(const std::filesystem::path& file) {
    Result<ImportedScene> imported = import_gltf(file);
    if (!imported) throw std::runtime_error(imported.error().text());
    return *std::move(imported);
}

inline std::string text_of(const std::filesystem::path& file) {
    const auto bytes = read_file(file, 1 << 20);
    return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().text();
}

// A scene with all kinds of records and unknown extensions, in an unusual order: a light, a camera, a textured triangle whose
// buffer and image are files beside it.
inline std::filesystem::path rich_gltf(const TempFolder& folder) {
    constexpr std::string_view text = R"({
  "scenes": [{"extras": {"author": "somebody", "blush": {"environment": {"kind": "constant", "color": [0.5, 0.25, 1]}}}, "nodes": [1, 0]}],
  "extras": {"z": 1, "a": [true, null, 1e-9]},
  "nodes": [
    {"extensions": {"ACME_tag": {"tags": ["lamp"]}, "KHR_lights_punctual": {"light": 0}}, "name": "lamp", "translation": [0, 2, 0]},
    {"rotation": [0, 0.6, 0, 0.8], "children": [2], "name": "group"},
    {"mesh": 0, "camera": 0, "name": "triangle", "extras": "a mere string"}
  ],
  "extensionsUsed": ["ACME_tag", "KHR_lights_punctual"],
  "extensions": {
    "ACME_tag": {"version": 3.0, "b": {}, "a": {}},
    "KHR_lights_punctual": {"lights": [{"extensions": {"ACME_tag": {}}, "type": "spot", "range": 5, "intensity": 12, "name": "key",
      "spot": {"outerConeAngle": 0.5, "innerConeAngle": 0.25}}]}
  },
  "materials": [{"name": "paint", "emissiveFactor": [0.5, 0, 0],
    "pbrMetallicRoughness": {"roughnessFactor": 0.30000001192092896, "baseColorTexture": {"index": 0, "extras": [1]}, "metallicFactor": 0}}],
  "textures": [{"source": 0, "name": "checks"}],
  "images": [{"uri": "images/two%20by%20two.png"}],
  "cameras": [{"type": "perspective", "perspective": {"znear": 0.1, "yfov": 0.75, "aspectRatio": 1.5}, "name": "eye"}],
  "meshes": [{"primitives": [{"material": 0, "attributes": {"TEXCOORD_0": 1, "POSITION": 0}}], "name": "triangle"}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "max": [1, 1, 0], "min": [0, 0, 0]},
    {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC2"}
  ],
  "bufferViews": [{"buffer": 0, "byteLength": 60}],
  "buffers": [{"byteLength": 60, "uri": "triangle.bin"}],
  "asset": {"generator": "by hand", "version": "2.0"}
}
)";
    constexpr float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    const auto png = encode_png(*byte_image(2, 2, 3, 77));
    std::filesystem::create_directories(folder / "rich/images");
    write_bytes(folder / "rich/scene.gltf", text);
    write_bytes(folder / "rich/triangle.bin", {reinterpret_cast<const char*>(corners), sizeof corners});
    write_bytes(folder / "rich/images/two by two.png", {reinterpret_cast<const char*>(png->data()), png->size()});
    return folder / "rich/scene.gltf";
}

// --- every field ----------------------------------------------------------------------------------------------------

// Another value of the same type; unchanged for references.
template <class T> void change(T& value) {
    if constexpr (std::same_as<T, bool>)
        value = !value;
    else if constexpr (std::same_as<T, std::string>)
        value += " 2";
    else if constexpr (std::is_enum_v<T>)
        value = T((size_t(value) + 1) % enum_words<T>.size());
    else if constexpr (std::floating_point<T>)
        value = value * T(0.5) + T(0.123);
    else if constexpr (std::integral<T>)
        value = value == 0 ? T(1) : T(value - 1);
    else if constexpr (std::same_as<T, Vec2>)
        change(value.x), change(value.y);
    else if constexpr (std::same_as<T, Vec3>)
        change(value.x), change(value.y), change(value.z);
    else if constexpr (std::same_as<T, Quat>)
        value = {0.36f, 0.48f, 0.64f, 0.48f};
    else if constexpr (std::same_as<T, std::optional<Affine>>)
        value = Affine{{1, 0.5f, 0}, {0, 1, 0}, {0, 0, 1}, {3, 4, 5}};
    else if constexpr (std::same_as<T, std::vector<Id<Node>>>)
        value.push_back(Id<Node>{1});
}

// Calls visit("lens.ymag", copy) with a copy of the record for each of its fields, that one changed.
template <Fielded Record, class Visit> void each_changed_field(const Record& record, const Visit& visit) {
    visit_fields(record, [&]<class Field>(std::string_view name, const Field&) {
        const auto with = [&](const auto& edit) {
            Record copy = record;
            visit_fields(copy, [&]<class Other>(std::string_view other, Other& field) {
                if constexpr (std::same_as<Other, Field>)
                    if (other == name) edit(field);
            });
            return copy;
        };
        if constexpr (Fielded<Field>) {
            Field inner;
            with([&](Field& field) { inner = field; });
            each_changed_field(inner, [&](const std::string& inner_name, const Field& changed) {
                visit(fmt::format("{}.{}", name, inner_name), with([&](Field& field) { field = changed; }));
            });
        } else {
            visit(std::string(name), with([](Field& field) { change(field); }));
        }
    });
}

} // namespace blush::test
