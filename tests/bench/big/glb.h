// Writes GLB files for benchmark scenes.
#pragma once

#include "tests/bench/bench.h"

#include "io/gltf/read/json.h"

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace blush::bench {

struct Glb {
    Json json{{"asset", {{"version", "2.0"}}}};
    std::vector<uint8_t> bytes;

    size_t view(const void* data, size_t size) {
        const size_t offset = (bytes.size() + 3) / 4 * 4;
        bytes.resize(offset + size);
        std::memcpy(bytes.data() + offset, data, size);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
        return json["bufferViews"].size() - 1;
    }
    // `type`: "VEC3", ...; 5126 are floats, 5125 unsigned integers.
    template <class T> size_t accessor(const std::vector<T>& values, size_t components, const char* type) {
        const size_t at = view(values.data(), values.size() * sizeof(T)); // first: a new member moves the others
        json["accessors"].push_back({{"bufferView", at},
                                     {"componentType", std::is_same_v<T, float> ? 5126 : 5125},
                                     {"count", values.size() / components},
                                     {"type", type}});
        return json["accessors"].size() - 1;
    }
    // A grid of n x n squares over [-1, 1]^2 as a landscape, with normals and texture coordinates. `material`: -1 for none.
    size_t landscape(uint32_t n, int material = -1);
    // With a sun.
    Result<void> write(const std::string& file);
};

} // namespace blush::bench
