#include "io/gltf/read/geometry/accessors.h"

#include "core/for_ranges.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace blush {
namespace {

// An accessor without a buffer view is all zeros (before sparse values). Its count needs no bytes in the file, so it is limited.
constexpr uint64_t max_count_without_bytes = uint64_t(1) << 24;

struct ComponentType {
    size_t size = 0;
    double scale = 1; // for normalised values
    double low = 0;
};

ComponentType component_type(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return {1, 1.0 / 127, -1};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return {1, 1.0 / 255, 0};
    case TINYGLTF_COMPONENT_TYPE_SHORT: return {2, 1.0 / 32767, -1};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return {2, 1.0 / 65535, 0};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return {4, 1.0 / 4294967295.0, 0};
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return {4, 1, 0};
    default: return {};
    }
}

int component_count(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    case TINYGLTF_TYPE_MAT4: return 16; // only matrices whose columns need no padding
    default: return 0;
    }
}

template <class T> T load(const uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

double load_number(const uint8_t* bytes, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return load<int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return load<int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return load<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return load<uint32_t>(bytes);
    default: return load<float>(bytes);
    }
}

// `count` elements of `element` bytes each, `stride` apart, all inside the view.
struct Elements {
    const uint8_t* data = nullptr;
    size_t stride = 0;
    const uint8_t* operator[](size_t i) const { return data + i * stride; }
};

Result<Elements> elements(const GltfContext& context, int view_index, uint64_t offset, uint64_t count, uint64_t element,
                          const std::string& where) {
    const auto view = buffer_view_bytes(context, view_index, where);
    if (!view) return view.error();
    const uint64_t given_stride = context.model().bufferViews[size_t(view_index)].byteStride;
    const uint64_t stride = given_stride ? given_stride : element;
    if (stride < element) return context.error(fmt::format("byteStride {} is less than an element's {} bytes", stride, element), where);
    // By division, so that no product can overflow.
    const uint64_t size = view->size();
    if (offset > size || (count > 0 && (size - offset < element || (size - offset - element) / stride < count - 1)))
        return context.error(
            fmt::format("{} elements of {} bytes at offset {} reach beyond the buffer view's {} bytes", count, element, offset, size),
            where);
    return Elements{view->data() + offset, size_t(stride)};
}

Result<const tinygltf::Accessor*> find_accessor(const GltfContext& context, int index, const std::string& where) {
    const auto& accessors = context.model().accessors;
    if (index < 0 || size_t(index) >= accessors.size())
        return context.error(fmt::format("accessor {} does not exist; there are {}", index, accessors.size()), where);
    const tinygltf::Accessor& accessor = accessors[size_t(index)];
    if (component_type(accessor.componentType).size == 0)
        return context.error(fmt::format("component type {} is not one of glTF's", accessor.componentType), where);
    return &accessor;
}

// Calls set_dense(elements, begin, end) for ranges of the elements of the buffer view, on several threads, or clear() if there is no
// view, then set(i, bytes) for each sparse value.
template <class SetDense, class Set, class Clear>
Result<void> for_each_element(const GltfContext& context, const tinygltf::Accessor& accessor, const std::string& where,
                              const SetDense& set_dense, const Set& set, const Clear& clear) {
    const uint64_t element = component_type(accessor.componentType).size * uint64_t(component_count(accessor.type));
    if (accessor.bufferView >= 0) {
        const auto dense = elements(context, accessor.bufferView, accessor.byteOffset, accessor.count, element, where);
        if (!dense) return dense.error();
        for_ranges(accessor.count, context.options.threads, [&](size_t begin, size_t end) { set_dense(*dense, begin, end); });
    } else {
        clear();
    }
    if (!accessor.sparse.isSparse) return {};

    const auto& sparse = accessor.sparse;
    const std::string sparse_where = where + ".sparse";
    const int index_type = sparse.indices.componentType;
    if (index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        return context.error(fmt::format("component type {} cannot be an index", index_type), sparse_where);
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        return context.error("negative count or offset", sparse_where);
    const auto indices = elements(context, sparse.indices.bufferView, uint64_t(sparse.indices.byteOffset), uint64_t(sparse.count),
                                  component_type(index_type).size, sparse_where + ".indices");
    if (!indices) return indices.error();
    const auto values = elements(context, sparse.values.bufferView, uint64_t(sparse.values.byteOffset), uint64_t(sparse.count), element,
                                 sparse_where + ".values");
    if (!values) return values.error();
    for (size_t i = 0; i < size_t(sparse.count); ++i) {
        const auto target = uint64_t(load_number((*indices)[i], index_type));
        if (target >= accessor.count)
            return context.error(fmt::format("index {} is not below the count {}", target, accessor.count), sparse_where);
        set(size_t(target), (*values)[i]);
    }
    return {};
}

// Checked before allocation: the buffer must hold the bytes of all elements.
Result<void> check_count(const GltfContext& context, const tinygltf::Accessor& accessor, const std::string& where) {
    if (accessor.bufferView < 0)
        return accessor.count <= max_count_without_bytes
                   ? Result<void>()
                   : context.error(fmt::format("{} elements without a buffer view", accessor.count), where);
    const uint64_t element = component_type(accessor.componentType).size * uint64_t(component_count(accessor.type));
    const auto checked = elements(context, accessor.bufferView, accessor.byteOffset, accessor.count, element, where);
    return checked ? Result<void>() : Result<void>(checked.error());
}

} // namespace

Result<std::span<const uint8_t>> buffer_view_bytes(const GltfContext& context, int index, const std::string& where) {
    const tinygltf::Model& model = context.model();
    if (index < 0 || size_t(index) >= model.bufferViews.size())
        return context.error(fmt::format("buffer view {} does not exist; there are {}", index, model.bufferViews.size()), where);
    const tinygltf::BufferView& view = model.bufferViews[size_t(index)];
    if (view.buffer < 0 || size_t(view.buffer) >= model.buffers.size())
        return context.error(fmt::format("buffer {} does not exist; there are {}", view.buffer, model.buffers.size()),
                             fmt::format("bufferViews[{}]", index));
    const std::span<const uint8_t> data = context.source.buffer_bytes(size_t(view.buffer));
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        return context.error(
            fmt::format("offset {} and length {} reach beyond the buffer's {} bytes", view.byteOffset, view.byteLength, data.size()),
            fmt::format("bufferViews[{}]", index));
    return data.subspan(view.byteOffset, view.byteLength);
}

Result<void> read_floats(const GltfContext& context, int index, int min_components, int max_components, const std::string& where,
                         const MakeFloatRoom& make_room) {
    const auto found = find_accessor(context, index, where);
    if (!found) return found.error();
    const tinygltf::Accessor& accessor = **found;
    const std::string accessor_where = fmt::format("accessors[{}]", index);
    const int components = component_count(accessor.type);
    if (components < min_components || components > max_components)
        return context.error(fmt::format("accessor {} has the wrong number of components", index), where);
    if (const auto ok = check_count(context, accessor, accessor_where); !ok) return ok.error();

    const ComponentType type = component_type(accessor.componentType);
    const FloatRoom room = make_room(accessor.count, components);
    const auto n = size_t(components);
    const bool plain = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const auto set = [&](size_t i, const uint8_t* bytes) {
        float* out = room.values + i * room.stride;
        if (plain) {
            std::memcpy(out, bytes, n * sizeof(float));
            return;
        }
        for (size_t c = 0; c < n; ++c) {
            const double value = load_number(bytes + c * type.size, accessor.componentType);
            out[c] = float(accessor.normalized ? std::max(value * type.scale, type.low) : value);
        }
    };
    const auto set_dense = [&](const Elements& dense, size_t begin, size_t end) {
        if (plain && room.stride == n && dense.stride == n * sizeof(float))
            std::memcpy(room.values + begin * n, dense[begin], (end - begin) * dense.stride);
        else
            for (size_t i = begin; i < end; ++i) set(i, dense[i]);
    };
    const auto clear = [&] {
        for (size_t i = 0; i < accessor.count; ++i) std::fill_n(room.values + i * room.stride, n, 0.f);
    };
    return for_each_element(context, accessor, accessor_where, set_dense, set, clear);
}

Result<FloatArray> read_floats(const GltfContext& context, int index, int min_components, int max_components, const std::string& where) {
    FloatArray array;
    const auto done = read_floats(context, index, min_components, max_components, where, [&](size_t count, int components) {
        array.components = components;
        array.values.resize(count * size_t(components));
        return FloatRoom{array.values.data(), size_t(components)};
    });
    return done ? Result<FloatArray>(std::move(array)) : done.error();
}

Result<void> read_indices(const GltfContext& context, int index, const std::string& where, const MakeIndexRoom& make_room) {
    const auto found = find_accessor(context, index, where);
    if (!found) return found.error();
    const tinygltf::Accessor& accessor = **found;
    const int type = accessor.componentType;
    if (accessor.type != TINYGLTF_TYPE_SCALAR ||
        (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
        return context.error(fmt::format("accessor {} does not hold unsigned scalars", index), where);
    const std::string accessor_where = fmt::format("accessors[{}]", index);
    if (const auto ok = check_count(context, accessor, accessor_where); !ok) return ok.error();
    uint32_t* const indices = make_room(accessor.count);
    const auto set = [&](size_t i, const uint8_t* bytes) {
        indices[i] = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? load<uint8_t>(bytes)
                     : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<uint16_t>(bytes)
                                                                      : load<uint32_t>(bytes);
    };
    const auto set_dense = [&](const Elements& dense, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) set(i, dense[i]);
    };
    return for_each_element(context, accessor, accessor_where, set_dense, set, [&] { std::fill_n(indices, accessor.count, 0u); });
}

uint64_t accessor_count(const GltfContext& context, int index) {
    const auto& accessors = context.model().accessors;
    return index >= 0 && size_t(index) < accessors.size() ? accessors[size_t(index)].count : 0;
}

} // namespace blush
