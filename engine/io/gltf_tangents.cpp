#include "io/gltf_tangents.h"

#include "io/mikktspace.h"

namespace blush {
namespace {

template <class T> void append_copies(std::vector<T>& values, const std::vector<uint32_t>& of) {
    if (values.empty()) return;
    values.reserve(values.size() + of.size());
    for (const uint32_t i : of) values.push_back(values[i]);
}

} // namespace

std::vector<uint32_t> add_tangents(Geometry& g, int uv_set) {
    const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[size_t(uv_set)]);
    const auto count = uint32_t(g.positions.size());
    constexpr uint32_t nobody = UINT32_MAX;
    g.tangents.assign(count, Vec4{0, 0, 0, 0}); // a length of 0: not spoken for
    std::vector<uint32_t> next(count, nobody);  // by vertex, another one that differs in its tangent alone
    std::vector<uint32_t> copied;
    for (size_t i = 0; i < corners.size(); ++i) {
        const bool is_free = g.tangents[g.indices[i]] == Vec4{0, 0, 0, 0};
        uint32_t vertex = g.indices[i];
        if (is_free) g.tangents[vertex] = corners[i];
        while (g.tangents[vertex] != corners[i] && next[vertex] != nobody) vertex = next[vertex];
        if (g.tangents[vertex] != corners[i]) {
            next[vertex] = count + uint32_t(copied.size());
            vertex = next[vertex];
            next.push_back(nobody);
            copied.push_back(g.indices[i]);
            g.tangents.push_back(corners[i]);
        }
        g.indices[i] = vertex;
    }
    for (Vec4& t : g.tangents)
        if (t == Vec4{0, 0, 0, 0}) t = {1, 0, 0, 1}; // of vertices that no triangle uses
    append_copies(g.positions, copied);
    append_copies(g.normals, copied);
    append_copies(g.colors, copied);
    for (std::vector<Vec2>& uv : g.uv) append_copies(uv, copied);
    return copied;
}

} // namespace blush
