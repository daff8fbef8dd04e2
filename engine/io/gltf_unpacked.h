// Internal to gltf_*.cpp: compressed files. What is packed is unpacked in the parsed model, whose accessors then read like those of any
// file; the document's JSON stays as it is, so that saving keeps what is packed.
#pragma once

#include "io/gltf_source.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace blush {

// What the parser is given in place of a document that it would refuse for being compressed: buffers that stand for nothing but their
// unpacked form have a byte, packed primitives no indices, and data URIs of images no kind that it does not know. None if it takes it as it
// is.
std::optional<nlohmann::json> parsable(const nlohmann::json& root);

// KHR_draco_mesh_compression and EXT_meshopt_compression.
Result<void> unpack(GltfSource& source, const ImportOptions& options, ImportReport& report);

// What the packed bytes of a file may become. They may be named again and again, so that a small file could ask for all the memory there
// is.
class UnpackingRoom {
public:
    // Of a model of which nothing is unpacked yet.
    explicit UnpackingRoom(const tinygltf::Model& model);
    // Errors: more than is left.
    Result<void> take(const GltfContext& context, double bytes, const char* where);

private:
    double packed_ = 0, taken_ = 0;
};

// Indices of what is added: a buffer, or a view of the whole of one.
int add_unpacked_buffer(GltfSource& source, std::vector<uint8_t> bytes);
int add_unpacked_view(GltfSource& source, std::vector<uint8_t> bytes);

} // namespace blush
