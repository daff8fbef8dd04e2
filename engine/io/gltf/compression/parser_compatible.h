// Internal to the import: changes compressed documents so that the parser, which knows no compression, accepts them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace blush {

// Gives a buffer of the document one byte, so that the parser accepts it without the bytes that it is to have.
void set_placeholder(nlohmann::json& buffer);

// A document that tinygltf accepts, for a compressed one that it would reject: placeholder buffers get one byte, compressed
// primitives lose their indices, data URIs of images get a known MIME type. None if no change is needed.
std::optional<nlohmann::json> parser_compatible(const nlohmann::json& root);

} // namespace blush
