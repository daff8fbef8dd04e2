// Fuzz targets. Each takes arbitrary bytes and aborts the process if an invariant is violated: readers return an error or a valid
// result.
#pragma once

#include <cstdint>
#include <span>

namespace blush::fuzz {

using Target = void(std::span<const uint8_t>);

// A scene file, .gltf or .glb, with the files of corpus/beside in its folder.
void importer(std::span<const uint8_t> bytes);
// An IES profile (LM-63).
void ies(std::span<const uint8_t> bytes);
// Render settings, view settings and scene edits, as in snapshots and saved scenes.
void settings(std::span<const uint8_t> bytes);
// Weights of the denoiser.
void weights(std::span<const uint8_t> bytes);

} // namespace blush::fuzz
