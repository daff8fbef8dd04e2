#include "render/lights/hull_triangles.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace blush {
namespace {

// Height above a plane that counts as rounding, in units of the largest coordinate: 16 steps of single precision.
constexpr double max_relative_height = 0x1p-20;

// The vertices in a binary tree of boxes.
class VertexTree {
public:
    explicit VertexTree(std::vector<Vec3> vertices) : vertices_(std::move(vertices)) { build(0, int32_t(vertices_.size())); }

    // A vertex v with dot(normal, v) > limit; null: there is none.
    const Vec3* beyond(const Vec3d& normal, double limit) const {
        int32_t stack[max_depth], size = 0;
        stack[size++] = 0;
        while (size > 0) {
            const int32_t i = stack[--size];
            const Node& node = nodes_[size_t(i)];
            const Vec3d farthest{normal.x > 0 ? node.high.x : node.low.x, normal.y > 0 ? node.high.y : node.low.y,
                                 normal.z > 0 ? node.high.z : node.low.z};
            if (!(dot(normal, farthest) > limit)) continue;
            if (node.right) {
                stack[size++] = i + 1;
                stack[size++] = node.right;
                continue;
            }
            for (int32_t k = node.begin; k < node.end; ++k)
                if (dot(normal, to_double(vertices_[size_t(k)])) > limit) return &vertices_[size_t(k)];
        }
        return nullptr;
    }

private:
    static constexpr int32_t leaf_size = 8, max_depth = 64;
    struct Node {
        Vec3 low, high;
        int32_t begin = 0, end = 0, right = 0; // the left child is the next node; 0: a leaf
    };

    void build(int32_t begin, int32_t end) {
        const std::span<Vec3> here(vertices_.data() + begin, size_t(end - begin));
        Node node{here[0], here[0], begin, end};
        for (const Vec3& v : here) {
            node.low = {std::min(node.low.x, v.x), std::min(node.low.y, v.y), std::min(node.low.z, v.z)};
            node.high = {std::max(node.high.x, v.x), std::max(node.high.y, v.y), std::max(node.high.z, v.z)};
        }
        const size_t index = nodes_.size();
        nodes_.push_back(node);
        if (end - begin <= leaf_size) return;
        const Vec3 size = node.high - node.low;
        const auto axis = size.x >= size.y && size.x >= size.z ? &Vec3::x : size.y >= size.z ? &Vec3::y : &Vec3::z;
        const int32_t middle = begin + (end - begin) / 2;
        std::ranges::nth_element(here, here.begin() + (middle - begin), {}, axis);
        build(begin, middle);
        nodes_[index].right = int32_t(nodes_.size());
        build(middle, end);
    }

    std::vector<Vec3> vertices_;
    std::vector<Node> nodes_; // depth first
};

// The vertices of triangles.
std::vector<Vec3> used_vertices(const Geometry& mesh) {
    std::vector<bool> used(mesh.positions.size());
    for (const uint32_t i : mesh.indices) used[i] = true;
    std::vector<Vec3> vertices;
    for (size_t i = 0; i < used.size(); ++i)
        if (used[i]) vertices.push_back(mesh.positions[i]);
    return vertices;
}

} // namespace

std::vector<uint8_t> hull_triangles(const Geometry& mesh, const Workers& workers) {
    std::vector<uint8_t> on_hull(mesh.triangle_count());
    std::vector<Vec3> vertices = used_vertices(mesh);
    double largest = 0;
    for (const Vec3& v : vertices) {
        if (!std::isfinite(v.x + v.y + v.z)) return on_hull;
        largest = std::max(largest, double(max_component(abs(v))));
    }
    if (vertices.empty()) return on_hull;
    const VertexTree tree(std::move(vertices));
    constexpr size_t batch = 4096;
    workers.for_each(int64_t((on_hull.size() + batch - 1) / batch), {}, [&](int64_t i, unsigned) {
        const Vec3* last = nullptr; // a vertex in front of a triangle is often in front of the next, too
        for (size_t t = size_t(i) * batch; t < std::min(on_hull.size(), (size_t(i) + 1) * batch); ++t) {
            const uint32_t* corner = &mesh.indices[3 * t];
            const Vec3d a = to_double(mesh.positions[corner[0]]);
            const Vec3d normal = cross(to_double(mesh.positions[corner[1]]) - a, to_double(mesh.positions[corner[2]]) - a);
            const double size = length(normal), limit = dot(normal, a) + max_relative_height * largest * size;
            if (!(size > 0) || (last && dot(normal, to_double(*last)) > limit)) continue;
            const Vec3* in_front = tree.beyond(normal, limit);
            on_hull[t] = !in_front;
            if (in_front) last = in_front;
        }
    });
    return on_hull;
}

} // namespace blush
