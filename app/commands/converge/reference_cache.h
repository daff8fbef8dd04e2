// Disk cache of references: one layered EXR each, named by a hash of its key.
#pragma once

#include "measure/convergence/reference.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace blush {

// $XDG_CACHE_HOME/blush/references, or ~/.cache/blush/references; empty if neither variable is set: then nothing is cached.
std::filesystem::path reference_folder();

// The cache key as text: scene content, view, and all settings that the expected value depends on.
std::string reference_key(const Scene& scene, const RenderSettings& settings);

// The cached reference with this key, if it exists, is complete, and its seed is not one of the compared runs'.
std::optional<Reference> cached_reference(const std::filesystem::path& folder, const std::string& key, std::span<const uint32_t> compared);

// Writes it, then removes the least recently used ones until the total is at most `max_bytes`.
Result<void> cache_reference(const std::filesystem::path& folder, const std::string& key, const Reference& reference,
                             uint64_t max_bytes = uint64_t(2) << 30);

// Loads any scene-linear EXR with R, G and B as a reference; also reads error.{R,G,B}, samples and seed if present. Errors name
// the file: unreadable, wrong size, non-finite values.
Result<Reference> read_reference_file(const std::filesystem::path& file, int width, int height);

} // namespace blush
