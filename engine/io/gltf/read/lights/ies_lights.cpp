#include "io/gltf/read/lights/ies_lights.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/object.h"
#include "io/gltf/read/uri.h"
#include "io/image/ies.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

namespace blush {
namespace {

constexpr const char* ies_extension = "EXT_lights_ies";

// Light properties of a node.
struct Instance {
    int node = 0, profile = 0;
    float multiplier = 1;
    Vec3 color{1, 1, 1};
    auto light_key() const { return std::tuple(profile, multiplier, color.x, color.y, color.z); }
};

std::string uri_of(const ParsedGltf& profile) {
    const ParsedGltf& uri = gltf_member(profile, "uri");
    return uri.is_string() ? uri.get<std::string>() : std::string();
}

Result<IesPtr> parse_embedded(const std::string& data_uri) {
    // tinygltf decodes data URIs of known MIME types.
    const size_t comma = data_uri.find(',');
    std::vector<uint8_t> bytes;
    std::string type;
    if (comma == data_uri.npos || !data_uri.substr(0, comma).ends_with(";base64") ||
        !tinygltf::DecodeDataURI(&bytes, type, "data:application/octet-stream;base64," + data_uri.substr(comma + 1), 0, false))
        return Error{"", "a data URI that cannot be decoded", ""};
    return parse_ies({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<IesPtr> read_profile(const GltfContext& context, const ParsedGltf& profile, const std::string& where) {
    if (const std::string uri = uri_of(profile); is_data_uri(uri)) {
        return parse_embedded(uri);
    } else if (!uri.empty()) {
        const Result<std::filesystem::path> file = resolve_uri(context.source.folder, percent_decoded(uri));
        return file ? read_ies(*file) : Result<IesPtr>(file.error());
    }
    const ParsedGltf& view = gltf_member(profile, "bufferView");
    if (!view.is_number_integer()) return Error{"", "neither a URI nor a buffer view", ""};
    const Result<std::span<const uint8_t>> bytes = buffer_view_bytes(context, view.get<int>(), where);
    if (!bytes) return bytes.error();
    return parse_ies({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

Result<std::vector<Instance>> instances_of(const GltfContext& context, const std::vector<int>& nodes, size_t profiles) {
    std::vector<Instance> instances;
    for (const int node : nodes) {
        const std::string where = fmt::format("nodes[{}].extensions", node);
        const GltfObject object = GltfObject(context, context.model().nodes[size_t(node)].extensions, where).object(ies_extension);
        const int profile = object.integer("light").value_or(-1);
        if (profile < 0) continue;
        if (size_t(profile) >= profiles)
            return context.error(fmt::format("IES light {} does not exist; there are {}", profile, profiles), where);
        instances.push_back({node, profile, object.number("multiplier", 1, 0, any_float), object.vector3("color", {1, 1, 1}, 0, 1)});
    }
    std::ranges::stable_sort(instances, {}, &Instance::profile);
    return instances;
}

// Peak candela of the profile, and its data unless a document is being saved.
struct Profile {
    float peak = 0; // 0: not read
    IesPtr ies;
};
Profile profile_of(const GltfContext& context, const ParsedGltf& json, int index, const std::string& where) {
    if (context.known) {
        const auto known = context.known->profile_peaks.find(index);
        return {known == context.known->profile_peaks.end() ? 0 : known->second, nullptr};
    }
    const Result<IesPtr> ies = read_profile(context, json, where);
    if (ies) return {(*ies)->peak, *ies};
    context.warn("ignored: a light whose IES profile cannot be read: " + ies.error().text(), where);
    return {};
}

std::string name_of(const ParsedGltf& profile, int index) {
    const ParsedGltf& name = gltf_member(profile, "name");
    if (name.is_string() && !name.empty() && !name.get_ref<const std::string&>().empty()) return name.get<std::string>();
    const std::string uri = uri_of(profile);
    return uri.empty() || is_data_uri(uri) ? fmt::format("Luminaire {}", index)
                                           : std::filesystem::path(percent_decoded(uri)).stem().string();
}

Light light_of(const GltfContext& context, const ParsedGltf& json, const Profile& profile, const Instance& instance,
               const std::string& where) {
    Light light;
    light.name = name_of(json, instance.profile);
    light.color = instance.color;
    light.intensity = std::min(instance.multiplier * profile.peak, any_float);
    light.ies = profile.ies;
    if (const std::string uri = uri_of(json); !is_data_uri(uri)) light.ies_file = percent_decoded(uri);
    read_extras(context, json, light, where);
    return light;
}

} // namespace

Result<IesLights> read_ies_lights(const GltfContext& context, const std::vector<int>& nodes) {
    IesLights measured;
    const ParsedGltf& list = gltf_member(gltf_member(gltf_member(context.json(), "extensions"), ies_extension), "lights");
    const Result<std::vector<Instance>> instances = instances_of(context, nodes, list.is_array() ? list.size() : 0);
    if (!instances) return instances.error();
    std::map<decltype(Instance().light_key()), size_t> known;
    std::map<int, Profile> profiles;
    for (const Instance& instance : *instances) {
        const auto [light, is_new] = known.try_emplace(instance.light_key(), measured.lights.size());
        measured.by_node[instance.node] = light->second;
        if (!is_new) continue;
        const ParsedGltf& json = gltf_element(list, size_t(instance.profile));
        const std::string where = fmt::format("extensions.{}.lights[{}]", ies_extension, instance.profile);
        const auto profile = profiles.find(instance.profile);
        const Profile& read =
            profile != profiles.end() ? profile->second : profiles[instance.profile] = profile_of(context, json, instance.profile, where);
        measured.profiles.push_back(instance.profile);
        measured.lights.push_back(read.peak > 0 ? std::optional(light_of(context, json, read, instance, where)) : std::nullopt);
        if (read.peak > 0) measured.peaks[instance.profile] = read.peak;
    }
    return measured;
}

} // namespace blush
