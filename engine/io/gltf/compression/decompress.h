// Internal to gltf_*.cpp: decompresses the parsed model, so that its accessors read like those of an uncompressed file. The JSON
// of the document is unchanged, so that saving keeps the compressed data.
#pragma once

#include "io/gltf/read/source.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace blush {

// A document that tinygltf accepts, for a compressed one that it would reject: placeholder buffers get one byte, compressed
// primitives lose their indices, data URIs of images get a known MIME type. None if no change is needed.
std::optional<nlohmann::json> parser_compatible(const nlohmann::json& root);

// Decompresses KHR_draco_mesh_compression and EXT_meshopt_compression.
Result<void> unpack(GltfSource& source, const ImportOptions& options, ImportReport& report);

// Memory limit of decompression. Compressed bytes may be referenced many times, so that a small file could need any amount of
// memory.
class DecompressionLimit {
public:
    // `model` must not be decompressed yet.
    explicit DecompressionLimit(const tinygltf::Model& model);
    // Reserves bytes. Errors: the limit is exceeded.
    Result<void> take(const GltfContext& context, double bytes, const char* where);

private:
    double packed_ = 0, taken_ = 0;
};

// Adds a buffer (or a view of a whole buffer) and returns its index.
int add_decompressed_buffer(GltfSource& source, std::vector<uint8_t> bytes);
int add_decompressed_view(GltfSource& source, std::vector<uint8_t> bytes);

} // namespace blush
