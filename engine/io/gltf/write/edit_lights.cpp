#include "io/gltf/write/edit_lights.h"

#include "io/gltf/write/write.h"
#include "io/gltf/write/write_extras.h"
#include "scene/lights/ies_profile.h"

#include <algorithm>
#include <optional>
#include <set>

namespace blush {
namespace {

using List = GltfLight::List;

// The light as read from the document alone, without the data of its IES profile.
bool has_changed(const Scene& read, Id<Light> id, Light light) {
    light.ies = nullptr;
    const Light* before = read.lights.find(id);
    return !before || !(*before == light);
}

Json& object_at(GltfDocument& document, const GltfLight& at) { return document.object(list_name(at.list), at.index); }

void append_profile(GltfDocument& document, Id<Light> id, Json profile, float peak) {
    const int index = document.append(list_name(List::measured), std::move(profile));
    document.indices.lights[id] = {List::measured, index};
    document.indices.profile_peaks[index] = peak;
}

// Lights that differ only in values stored at their nodes share a profile entry. After an edit of one, each gets its own entry.
void part_profiles(GltfDocument& document, const Scene& read, const Scene& scene, const UsedRecords& used) {
    const auto is_measured = [](const auto& entry) { return entry.second.list == List::measured; };
    const bool edited = std::ranges::any_of(document.indices.lights, [&](const auto& entry) {
        const Light* light = scene.lights.find(entry.first);
        return is_measured(entry) && (!used.lights.contains(entry.first) || has_changed(read, entry.first, *light));
    });
    if (!edited) return;
    std::set<int> taken;
    const std::map<Id<Light>, GltfLight> before = document.indices.lights;
    for (const auto& entry : before) {
        if (!is_measured(entry) || !used.lights.contains(entry.first) || taken.insert(entry.second.index).second) continue;
        append_profile(document, entry.first, object_at(document, entry.second), document.indices.profile_peaks.at(entry.second.index));
    }
}

// Entry of a light's profile: by its file, or the entry of another light with the same profile.
std::optional<Json> profile_entry(GltfDocument& document, const Scene& scene, const Light& light) {
    Json entry{{"name", light.name}};
    if (!light.ies_file.empty()) return entry;
    for (const auto& [id, at] : document.indices.lights) {
        const Light* other = scene.lights.find(id);
        if (at.list != List::measured || !other || other->ies != light.ies) continue;
        for (const char* key : {"uri", "bufferView", "mimeType"})
            if (const Json& value = child_or_null(object_at(document, at), key); !value.is_null()) entry[key] = value;
        return entry;
    }
    return std::nullopt;
}

// Index of the light in its list, appended if missing.
GltfLight place(GltfDocument& document, const Scene& scene, Id<Light> id, const Light& light, std::vector<Diagnostic>& lost) {
    const auto now = document.indices.lights.find(id);
    const auto there = [&](List list) { return now != document.indices.lights.end() && now->second.list == list; };
    if (light.kind == Light::Kind::point && light.ies) {
        if (there(List::measured)) return now->second;
        if (std::optional<Json> entry = profile_entry(document, scene, light)) {
            append_profile(document, id, *std::move(entry), light.ies->peak);
            return document.indices.lights.at(id);
        }
    }
    if (light.ies && light.ies_file.empty())
        lost.push_back({Diagnostic::Severity::warning,
                        fmt::format("the IES profile of light \"{}\" is not saved: it was embedded in another document", light.name), ""});
    const List list = list_for(light.kind);
    if (there(list)) return now->second;
    return document.indices.lights[id] = {list, document.append(list_name(list), Json{{"name", light.name}})};
}

} // namespace

void write_lights(GltfDocument& document, const Scene& read, const Scene& scene, const UsedRecords& used, std::vector<Diagnostic>& lost) {
    part_profiles(document, read, scene, used);
    // IES lights exist only through the nodes that use them.
    std::erase_if(document.indices.lights,
                  [&](const auto& entry) { return entry.second.list == List::measured && !used.lights.contains(entry.first); });
    for (const auto& [id, light] : scene.lights) {
        const bool known = document.indices.lights.contains(id);
        if (known ? !has_changed(read, id, light) : !used.lights.contains(id)) continue;
        const GltfLight at = place(document, scene, id, light, lost);
        Json& object = object_at(document, at);
        clear_extras(object);
        switch (at.list) {
        case List::punctual: write_punctual_light(object, light); break;
        case List::area: write_area_light(object, light); break;
        case List::measured: write_profile(object, light); break;
        }
    }
}

} // namespace blush
