#include "io/gltf/compression/meshopt.h"

#include "io/gltf/compression/decompressed_data.h"
#include "io/gltf/compression/extension_names.h"
#include "io/gltf/read/geometry/parallel_read.h"
#include "io/gltf/read/object.h"

#include <meshoptimizer.h>

#include <fmt/format.h>
#include <span>
#include <string_view>

namespace blush {
namespace {

// Highest compression ratio: equal vertices take two bits per sixteen bytes. Higher ratios are rejected before allocation.
constexpr uint64_t max_compression_ratio = 64;

constexpr int64_t large = int64_t(1) << 28; // bytes: decoding needs hardly more

struct Stream {
    std::span<const uint8_t> bytes;
    uint64_t count = 0, stride = 0;
    std::string mode, filter;
    uint64_t decompressed_bytes() const { return count * stride; }
};

struct PackedView {
    size_t index = 0;
    Stream stream;
    std::vector<uint8_t> decompressed;
};

// Names from the specification of the extension ("Specifying compressed views").
bool is_valid(const Stream& s) {
    if (s.mode == "ATTRIBUTES") {
        if (s.stride == 0 || s.stride > 256 || s.stride % 4 != 0) return false;
        if (s.filter == "OCTAHEDRAL") return s.stride == 4 || s.stride == 8;
        if (s.filter == "QUATERNION") return s.stride == 8;
        return s.filter.empty() || s.filter == "NONE" || s.filter == "EXPONENTIAL";
    }
    if (!s.filter.empty() && s.filter != "NONE") return false;
    if (s.stride != 2 && s.stride != 4) return false;
    return s.mode == "INDICES" || (s.mode == "TRIANGLES" && s.count % 3 == 0);
}

bool decode(const Stream& s, std::vector<uint8_t>& out) {
    const auto decoder = s.mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer
                         : s.mode == "TRIANGLES" ? static_cast<decltype(&meshopt_decodeVertexBuffer)>(meshopt_decodeIndexBuffer)
                                                 : static_cast<decltype(&meshopt_decodeVertexBuffer)>(meshopt_decodeIndexSequence);
    if (decoder(out.data(), size_t(s.count), size_t(s.stride), s.bytes.data(), s.bytes.size()) != 0) return false;
    if (s.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), size_t(s.count), size_t(s.stride));
    if (s.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), size_t(s.count), size_t(s.stride));
    if (s.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), size_t(s.count), size_t(s.stride));
    return true;
}

Result<Stream> read_stream(const GltfContext& context, const GltfObject& extension) {
    const auto whole = [&](const char* key, int otherwise) { return int64_t(extension.integer(key).value_or(otherwise)); };
    const int64_t buffer = whole("buffer", -1), offset = whole("byteOffset", 0), length = whole("byteLength", -1);
    const auto& buffers = context.model().buffers;
    if (buffer < 0 || size_t(buffer) >= buffers.size())
        return context.error(fmt::format("buffer {} does not exist; there are {}", buffer, buffers.size()), extension.where());
    const std::span<const uint8_t> bytes = context.source.buffer_bytes(size_t(buffer));
    if (offset < 0 || length < 1 || uint64_t(offset) > bytes.size() || uint64_t(length) > bytes.size() - uint64_t(offset))
        return context.error(fmt::format("offset {} and length {} reach beyond the buffer's {} bytes", offset, length, bytes.size()),
                             extension.where());
    const int64_t count = whole("count", -1), stride = whole("byteStride", -1);
    Stream stream{bytes.subspan(size_t(offset), size_t(length)), uint64_t(count), uint64_t(stride), extension.text("mode"),
                  extension.text("filter")};
    if (count < 0 || stride < 0 || !is_valid(stream))
        return context.error(fmt::format("{} elements of {} bytes, mode '{}', filter '{}' are not valid for the extension", count, stride,
                                         stream.mode.substr(0, 40), stream.filter.substr(0, 40)),
                             extension.where());
    if (stream.decompressed_bytes() > max_compression_ratio * stream.bytes.size())
        return context.error(fmt::format("{} bytes cannot describe {} elements of {} bytes", length, count, stride), extension.where());
    return stream;
}

} // namespace

Result<void> decompress_meshopt(GltfSource& source, const GltfContext& context, DecompressionLimit& room) {
    std::vector<PackedView> views;
    GltfPieces pieces{{}, large, "decompressing", 0, 0.1, context.options.threads};
    for (size_t i = 0; i < source.model.bufferViews.size(); ++i) {
        const std::string where = fmt::format("bufferViews[{}]", i);
        const GltfObject extension =
            GltfObject(context, source.model.bufferViews[i].extensions, where + ".extensions").object(meshopt_extension);
        if (!extension) continue;
        Result<Stream> stream = read_stream(context, extension);
        if (!stream) return stream.error();
        if (const auto ok = room.take(context, double(stream->decompressed_bytes()), "bufferViews"); !ok) return ok;
        pieces.sizes.push_back(int64_t(stream->decompressed_bytes()));
        views.push_back({i, *std::move(stream), {}});
    }
    const auto read = read_in_parallel(context, pieces, [&](const GltfContext& own, size_t i) -> Result<void> {
        PackedView& view = views[i];
        view.decompressed.resize(size_t(view.stream.decompressed_bytes()));
        if (decode(view.stream, view.decompressed)) return {};
        return own.error("the compressed bytes cannot be decoded", fmt::format("bufferViews[{}]", view.index));
    });
    if (!read) return read;
    for (PackedView& packed : views) {
        tinygltf::BufferView& view = source.model.bufferViews[packed.index];
        if (packed.stream.mode == "ATTRIBUTES") view.byteStride = size_t(packed.stream.stride);
        view.byteLength = packed.decompressed.size();
        view.byteOffset = 0;
        view.buffer = add_decompressed_buffer(source, std::move(packed.decompressed));
    }
    return {};
}

} // namespace blush
