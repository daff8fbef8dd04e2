#include "io/gltf/compression/decompressed_data.h"

#include <utility>

namespace blush {

int add_decompressed_buffer(GltfSource& source, std::vector<uint8_t> bytes) {
    tinygltf::Buffer buffer;
    buffer.data = std::move(bytes);
    source.model.buffers.push_back(std::move(buffer));
    return int(source.model.buffers.size()) - 1;
}

int add_decompressed_view(GltfSource& source, std::vector<uint8_t> bytes) {
    tinygltf::BufferView view;
    view.byteLength = bytes.size();
    view.buffer = add_decompressed_buffer(source, std::move(bytes));
    source.model.bufferViews.push_back(std::move(view));
    return int(source.model.bufferViews.size()) - 1;
}

} // namespace blush
