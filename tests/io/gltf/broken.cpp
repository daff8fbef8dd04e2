#include "tests/io/gltf/broken.h"

#include "io/image/image_io.h"

#include <functional>
#include <limits>

namespace blush::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

// Accessors of the valid file.
enum Accessor : int { positions, normals, tangents, uvs, corners, joints, weights, binds, times, turns };

// One triangle with a texture, a skin, an animation, a camera and a light.
GltfBuilder valid() {
    GltfBuilder b;
    b.triangle_positions();
    b.json["accessors"][positions]["min"] = {0, 0, 0};
    b.json["accessors"][positions]["max"] = {1, 1, 0};
    b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    b.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    b.accessor<uint16_t>({0, 1, 2}, "SCALAR");
    b.accessor<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    b.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "VEC4");
    b.json["accessors"][binds]["type"] = "MAT4";
    b.json["accessors"][binds]["count"] = 1;
    b.accessor<float>({0, 1}, "SCALAR");
    b.json["accessors"][times]["min"] = {0};
    b.json["accessors"][times]["max"] = {1};
    b.accessor<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    std::vector<float> pixels;
    for (int i = 0; i < 16; ++i) pixels.insert(pixels.end(), {0.5f, 0.5f, 1.0f});
    const auto png = encode_png(4, 4, pixels);
    b.add("images", {{"bufferView", b.buffer_view({reinterpret_cast<const char*>(png->data()), png->size()})}, {"mimeType", "image/png"}});
    b.add("samplers", {{"wrapS", 10497}, {"minFilter", 9987}, {"magFilter", 9729}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    b.add("materials", {{"normalTexture", {{"index", 0}}}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    const Json attributes{{"POSITION", positions}, {"NORMAL", normals},  {"TANGENT", tangents},
                          {"TEXCOORD_0", uvs},     {"JOINTS_0", joints}, {"WEIGHTS_0", weights}};
    b.show({{"attributes", attributes}, {"indices", corners}, {"material", 0}});
    b.json["nodes"][0]["skin"] = 0;
    b.add("nodes", {{"name", "bone"}});
    b.add("skins", {{"joints", {1}}, {"inverseBindMatrices", binds}});
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 10}}}});
    b.add("nodes", {{"camera", 0}, {"translation", {0, 0, 3}}});
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "spot"}, {"intensity", 100}, {"spot", {{"outerConeAngle", 0.5}}}}});
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const Json channel{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}};
    b.add("animations", {{"samplers", Json::array({{{"input", times}, {"output", turns}}})}, {"channels", Json::array({channel})}});
    b.add("scenes", {{"nodes", {0, 1, 2, 3}}});
    b.json["scene"] = 0;
    constexpr int for_vertices = 34962, for_corners = 34963;
    for (const Accessor a : {positions, normals, tangents, uvs, corners, joints, weights})
        b.json["bufferViews"][b.json["accessors"][a]["bufferView"].get<size_t>()]["target"] = a == corners ? for_corners : for_vertices;
    return b;
}

template <class T> void put(GltfBuilder& b, Accessor accessor, size_t at, T value) {
    const size_t view = b.json["accessors"][accessor]["bufferView"];
    const size_t offset = b.json["bufferViews"][view]["byteOffset"];
    std::memcpy(b.buffer.data() + offset + at * sizeof value, &value, sizeof value);
}

Json& primitive(GltfBuilder& b) { return b.json["meshes"][0]["primitives"][0]; }
Json& attributes(GltfBuilder& b) { return primitive(b)["attributes"]; }

// A change to one value of the JSON, by its pointer.
std::function<void(GltfBuilder&)> set(const char* pointer, Json value) {
    return [=](GltfBuilder& b) { b.json[Json::json_pointer(pointer)] = value; };
}
std::function<void(GltfBuilder&)> without(const char* parent, const char* key) {
    return [=](GltfBuilder& b) { b.json[Json::json_pointer(parent)].erase(key); };
}
template <class T> std::function<void(GltfBuilder&)> number(Accessor accessor, size_t at, T value) {
    return [=](GltfBuilder& b) { put(b, accessor, at, value); };
}
std::function<void(GltfBuilder&)> extension(const char* name, Json value) {
    return [=](GltfBuilder& b) {
        b.json["extensionsUsed"].push_back(name);
        b.json["materials"][0]["extensions"][name] = value;
    };
}

using Faults = std::map<std::string, std::function<void(GltfBuilder&)>>;

Faults faults_of_buffers() {
    return {
        // Numbers in buffers.
        {"corner beyond the vertices", number<uint16_t>(corners, 1, 7)},
        {"corner that restarts primitives", number<uint16_t>(corners, 1, 65535)},
        {"position that is no number", number(positions, 0, nan)},
        {"position at infinity", number(positions, 4, inf)},
        {"normal that is no number", number(normals, 0, nan)},
        {"normals of length 2", number(normals, 2, 2.f)},
        {"normals of length 0.99", number(normals, 2, 0.99f)},
        {"normals of length 0", number(normals, 2, 0.f)},
        {"tangent that is no number", number(tangents, 0, nan)},
        {"tangents of length 3", number(tangents, 0, 3.f)},
        {"tangent without handedness", number(tangents, 3, 0.f)},
        {"texture coordinate that is no number", number(uvs, 1, nan)},
        {"joint that is none", number<uint8_t>(joints, 0, 3)},
        {"weights that sum to 3", number(weights, 0, 3.f)},
        {"weight below zero", number(weights, 1, -0.5f)},
        {"weight that is no number", number(weights, 0, nan)},
        {"bind matrix that is not affine", number(binds, 3, 0.5f)},
        {"bind matrix that is no number", number(binds, 0, nan)},
        {"time that is no number", number(times, 1, nan)},
        {"time before zero", number(times, 0, -1.f)},
        {"times that do not grow", number(times, 0, 1.f)},
        {"turn that is no rotation", number(turns, 3, 5.f)},
        {"triangle without area", number<uint16_t>(corners, 1, 0)},
        // Accessors, buffer views and buffers.
        {"accessor beyond its view", set("/accessors/0/count", 1000)},
        {"accessor of nothing", set("/accessors/0/count", 0)},
        {"fewer normals than positions", set("/accessors/1/count", 2)},
        {"fewer texture coordinates than positions", set("/accessors/3/count", 2)},
        {"corners in part", set("/accessors/4/count", 2)},
        {"component type of no kind", set("/accessors/0/componentType", 5124)},
        {"accessor type of no kind", set("/accessors/0/type", "VEC9")},
        {"positions of two components", set("/accessors/0/type", "VEC2")},
        {"normals of two components", set("/accessors/1/type", "VEC2")},
        {"corners that are floats", set("/accessors/4/componentType", 5126)},
        {"texture coordinates as plain bytes", set("/accessors/3/componentType", 5121)},
        {"offset of half a float", set("/accessors/0/byteOffset", 2)},
        {"offset below zero", set("/accessors/0/byteOffset", -4)},
        {"bounds that are not there", without("/accessors/0", "min")},
        {"bounds that are others", set("/accessors/0/max", {5, 5, 5})},
        {"sparse corners that do not grow",
         [](GltfBuilder& b) {
             const int indices = b.buffer_view(std::string_view("\2\1", 2)),
                       values = b.buffer_view(std::string_view("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 24));
             b.json["accessors"][positions]["sparse"] = {
                 {"count", 2}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
         }},
        {"sparse corner beyond the vertices",
         [](GltfBuilder& b) {
             const int indices = b.buffer_view(std::string_view("\11", 1)),
                       values = b.buffer_view(std::string_view("\0\0\0\0\0\0\0\0\0\0\0\0", 12));
             b.json["accessors"][positions]["sparse"] = {
                 {"count", 1}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
         }},
        {"view beyond its buffer", set("/bufferViews/0/byteLength", 100000)},
    };
}

Faults faults_of_structure() {
    return {
        {"view of no buffer", set("/bufferViews/0/buffer", 4)},
        {"accessor of no view", set("/accessors/0/bufferView", 44)},
        {"stride of three", set("/bufferViews/0/byteStride", 3)},
        {"view for corners that holds positions", set("/bufferViews/0/target", 34963)},
        {"buffer that is not there",
         [](GltfBuilder& b) {
             b.json["buffers"] = Json::array({{{"byteLength", b.buffer.size()}, {"uri", "nowhere.bin"}}});
         }},
        {"buffer of fewer bytes than it says",
         [](GltfBuilder& b) {
             b.json["buffers"] =
                 Json::array({{{"byteLength", b.buffer.size() + 64}, {"uri", "data:application/octet-stream;base64," + base64(b.buffer)}}});
         }},
        {"buffer of no length",
         [](GltfBuilder& b) {
             b.json["buffers"] = Json::array({{{"uri", "data:application/octet-stream;base64," + base64(b.buffer)}}});
         }},
        // References.
        {"child that does not exist", set("/nodes/0/children", {9})},
        {"mesh that does not exist", set("/nodes/0/mesh", 9)},
        {"camera that does not exist", set("/nodes/2/camera", 9)},
        {"skin that does not exist", set("/nodes/0/skin", 9)},
        {"joint that does not exist", set("/skins/0/joints", {9})},
        {"light that does not exist", set("/nodes/3/extensions/KHR_lights_punctual/light", 9)},
        {"material that does not exist", set("/meshes/0/primitives/0/material", 9)},
        {"texture that does not exist", set("/materials/0/normalTexture/index", 9)},
        {"image that does not exist", set("/textures/0/source", 9)},
        {"sampler that does not exist", set("/textures/0/sampler", 9)},
        {"scene that does not exist", set("/scene", 9)},
        {"root that does not exist", set("/scenes/0/nodes", {0, 1, 2, 3, 9})},
        {"root that is listed twice", set("/scenes/0/nodes", {0, 1, 2, 3, 3})},
        {"root that is a child", set("/nodes/3/children", {2})},
        {"attribute that does not exist", set("/meshes/0/primitives/0/attributes/NORMAL", 99)},
        {"corners that do not exist", set("/meshes/0/primitives/0/indices", 99)},
        {"animation of a node that does not exist", set("/animations/0/channels/0/target/node", 9)},
        {"animation by a sampler that does not exist", set("/animations/0/channels/0/sampler", 9)},
        {"animation of the wrong size", set("/animations/0/samplers/0/output", normals)},
        {"animation along no path", set("/animations/0/channels/0/target/path", "colour")},
        {"interpolation of no kind", set("/animations/0/samplers/0/interpolation", "WOBBLE")},
        {"nodes in a circle",
         [](GltfBuilder& b) {
             b.json["nodes"][1]["children"] = {3};
             b.json["nodes"][3]["children"] = {1};
             b.json["scenes"][0]["nodes"] = {0, 2};
         }},
        {"node with two parents",
         [](GltfBuilder& b) {
             b.json["nodes"][1]["children"] = {3};
             b.json["nodes"][2]["children"] = {3};
             b.json["scenes"][0]["nodes"] = {0, 1, 2};
         }},
        // Attributes.
        {"no positions", [](GltfBuilder& b) { attributes(b).erase("POSITION"); }},
        {"no attributes", [](GltfBuilder& b) { attributes(b) = Json::object(); }},
        {"no primitives", set("/meshes/0/primitives", Json::array())},
    };
}

Faults faults_of_meshes_and_nodes() {
    return {
        {"joints without weights", [](GltfBuilder& b) { attributes(b).erase("WEIGHTS_0"); }},
        {"tangents without normals", [](GltfBuilder& b) { attributes(b).erase("NORMAL"); }},
        {"second texture coordinates without the first",
         [](GltfBuilder& b) {
             attributes(b).erase("TEXCOORD_0");
             attributes(b)["TEXCOORD_1"] = uvs;
             b.json["materials"][0]["normalTexture"]["texCoord"] = 1;
         }},
        {"texture on coordinates that are not there", set("/materials/0/normalTexture/texCoord", 5)},
        {"attribute of no kind", set("/meshes/0/primitives/0/attributes/WEATHER", uvs)},
        {"primitive of no kind", set("/meshes/0/primitives/0/mode", 9)},
        {"weights of no targets", set("/meshes/0/weights", {1, 2})},
        {"skin without vertices that follow it",
         [](GltfBuilder& b) {
             attributes(b).erase("JOINTS_0");
             attributes(b).erase("WEIGHTS_0");
         }},
        // Values.
        {"version of the future", set("/asset/version", "3.0")},
        {"no version", without("/asset", "version")},
        {"least version of the future", set("/asset/minVersion", "2.9")},
        {"unknown extension is required",
         [](GltfBuilder& b) {
             b.json["extensionsUsed"].push_back("ACME_rocket");
             b.json["extensionsRequired"] = {"ACME_rocket"};
         }},
        {"extension that is not declared", without("", "extensionsUsed")},
        {"rotation of length 2", set("/nodes/0/rotation", {0, 0, 0, 2})},
        {"rotation of three numbers", set("/nodes/0/rotation", {0, 0, 1})},
        {"matrix and translation", [](GltfBuilder& b) { b.json["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
        {"matrix that shears", set("/nodes/1/matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})},
        {"matrix that is not affine", set("/nodes/1/matrix", {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})},
        {"wrap mode of no kind", set("/samplers/0/wrapS", 5)},
        {"minification of no kind", set("/samplers/0/minFilter", 5)},
        {"magnification of no kind", set("/samplers/0/magFilter", 9987)},
        {"metallic of 2", set("/materials/0/pbrMetallicRoughness/metallicFactor", 2)},
        {"roughness that is a word", set("/materials/0/pbrMetallicRoughness/roughnessFactor", "rough")},
        {"base colour of three numbers", set("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1})},
        {"base colour below zero", set("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, -1, 1})},
        {"emission above 1", set("/materials/0/emissiveFactor", {1, 1, 7})},
        {"alpha mode of no kind", set("/materials/0/alphaMode", "GLASS")},
        {"cutoff below zero",
         [](GltfBuilder& b) {
             b.json["materials"][0]["alphaMode"] = "MASK";
             b.json["materials"][0]["alphaCutoff"] = -1;
         }},
        {"two sides in words", set("/materials/0/doubleSided", "yes")},
        {"index of refraction of a half", extension("KHR_materials_ior", {{"ior", 0.5}})},
        {"coat above 1", extension("KHR_materials_clearcoat", {{"clearcoatFactor", 3}})},
        {"sheen below zero", extension("KHR_materials_sheen", {{"sheenColorFactor", {0, -1, 0}}})},
        {"transmission above 1", extension("KHR_materials_transmission", {{"transmissionFactor", 3}})},
        {"attenuation distance of zero", extension("KHR_materials_volume", {{"attenuationDistance", 0}})},
        {"anisotropy above 1", extension("KHR_materials_anisotropy", {{"anisotropyStrength", 3}})},
        {"film whose index is a half", extension("KHR_materials_iridescence", {{"iridescenceIor", 0.5}})},
        {"dispersion below zero", extension("KHR_materials_dispersion", {{"dispersion", -1}})},
    };
}

Faults faults_of_extensions() {
    return {
        {"emissive strength below zero", extension("KHR_materials_emissive_strength", {{"emissiveStrength", -1}})},
        {"specular above 1", extension("KHR_materials_specular", {{"specularFactor", 3}})},
        {"field of view of zero", set("/cameras/0/perspective/yfov", 0)},
        {"far plane before the near one", set("/cameras/0/perspective/zfar", 0.01)},
        {"camera of no kind", set("/cameras/0/type", "pinhole")},
        {"light of no kind", set("/extensions/KHR_lights_punctual/lights/0/type", "candle")},
        {"intensity below zero", set("/extensions/KHR_lights_punctual/lights/0/intensity", -1)},
        {"inner cone outside the outer one", set("/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 1)},
        {"light of range zero", set("/extensions/KHR_lights_punctual/lights/0/range", 0)},
        {"spot without a cone", without("/extensions/KHR_lights_punctual/lights/0", "spot")},
        {"image that is none",
         [](GltfBuilder& b) {
             b.json["images"][0] = {{"bufferView", b.buffer_view("no image, but words")}, {"mimeType", "image/png"}};
         }},
        {"image of another kind", set("/images/0/mimeType", "image/jpeg")},
        {"image without a kind", without("/images/0", "mimeType")},
        {"image that is nowhere", set("/images/0", Json::object())},
        {"image that is in two places", set("/images/0/uri", "beside.png")},
        {"image that is not there", set("/images/0", {{"uri", "nowhere.png"}})},
        {"name that is a number", set("/nodes/0/name", 7)},
        {"children that are none", set("/nodes/0/children", Json::array())},
        {"unknown property", set("/nodes/0/colour", "red")},
        {"skin of no node", without("/nodes/0", "skin")},
    };
}

const Faults& faults() {
    static const Faults all = [] {
        Faults merged;
        for (const auto& part : {faults_of_buffers(), faults_of_structure(), faults_of_meshes_and_nodes(), faults_of_extensions()})
            merged.insert(part.begin(), part.end());
        return merged;
    }();
    return all;
}

} // namespace

GltfFiles valid_files() {
    const auto plain = [](const std::function<void(GltfBuilder&)>& change) {
        GltfBuilder b = valid();
        change(b);
        return b.gltf();
    };
    return {
        {"all.gltf", valid().gltf()},
        {"all.glb", valid().glb()},
        {"coat.gltf", plain(extension("KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.5}}))},
        {"glass.gltf", plain(extension("KHR_materials_transmission", {{"transmissionFactor", 1}}))},
        {"index.gltf", plain(extension("KHR_materials_ior", {{"ior", 1.3}}))},
        {"lamp.gltf", plain([](GltfBuilder& b) {
             extension("KHR_materials_emissive_strength", {{"emissiveStrength", 5}})(b);
             b.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
         })},
        {"points.gltf", plain([](GltfBuilder& b) {
             primitive(b) = {{"attributes", {{"POSITION", positions}}}, {"mode", 0}};
             b.json["nodes"][0].erase("skin");
         })},
        {"bare.gltf", plain([](GltfBuilder& b) {
             for (const char* name : {"TANGENT", "JOINTS_0", "WEIGHTS_0"}) attributes(b).erase(name);
             b.json["nodes"][0].erase("skin");
             b.json.erase("skins");
             b.json["materials"][0].erase("normalTexture");
         })},
        {"orthographic.gltf",
         plain(set("/cameras/0", {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 10}}}}))},
    };
}

GltfFiles broken_files() {
    GltfFiles files;
    for (const auto& [name, change] : faults()) {
        GltfBuilder b = valid();
        change(b);
        files[name + ".gltf"] = b.gltf();
    }
    const std::string whole = valid().glb(), text = valid().gltf();
    files["cut.glb"] = whole.substr(0, whole.size() / 2);
    files["of no chunk.glb"] = whole.substr(0, 12);
    files["longer than it says.glb"] = whole + "and more";
    files["of another version.glb"] = std::string(whole).replace(4, 1, "\3");
    files["cut.gltf"] = text.substr(0, text.size() / 2);
    files["empty.gltf"] = "";
    files["a list.gltf"] = "[]";
    return files;
}

} // namespace blush::test
