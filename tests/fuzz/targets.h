// What a fuzzer feeds. Each takes any bytes at all and ends the process where a promise about them is broken: readers return a result or an
// error, and what they return is valid.
#pragma once

#include <cstdint>
#include <span>

namespace blush::fuzz {

using Target = void(std::span<const uint8_t>);

// A scene file, .gltf or .glb; beside it lie the files of corpus/beside.
void importer(std::span<const uint8_t> bytes);
// A photometric profile, LM-63.
void ies(std::span<const uint8_t> bytes);
// Render settings, view settings and the edits of a scene, as snapshots and saved scenes carry them.
void settings(std::span<const uint8_t> bytes);
// The denoiser's weights.
void weights(std::span<const uint8_t> bytes);

} // namespace blush::fuzz
