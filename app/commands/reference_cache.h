// References on disk: one layered EXR each, under a name made of what it is a reference of.
#pragma once

#include "measure/reference.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace blush {

// $XDG_CACHE_HOME/blush/references, or ~/.cache/...; empty if neither is known, and then nothing is cached.
std::filesystem::path reference_folder();

// Everything that tells one reference from another, as text: what the scene holds, the view, and the settings that an expectation depends
// on.
std::string reference_key(const Scene& scene, const RenderSettings& settings);

// The cached reference of that key, if there is one, whole, whose seed is none of those compared.
std::optional<Reference> cached_reference(const std::filesystem::path& folder, const std::string& key, std::span<const uint32_t> compared);

// Writes it, then removes those not used for longest until all together are no more than `max_bytes`.
Result<void> cache_reference(const std::filesystem::path& folder, const std::string& key, const Reference& reference,
                             uint64_t max_bytes = uint64_t(2) << 30);

// Any scene-linear EXR with R, G and B as a reference; error.{R,G,B}, samples and seed if it has them. Errors name the file: unreadable, of
// another size, not finite.
Result<Reference> read_reference_file(const std::filesystem::path& file, int width, int height);

} // namespace blush
