// Radiance of a tile's paths, in total and by light group.
#pragma once

#include "render/kernels/column.h"

#include <algorithm>
#include <vector>

namespace blush {

struct RadianceColumns {
    Column<double> r, g, b;

    void clear(int paths) {
        for (double* c : {r.data, g.data, b.data}) std::fill_n(c, paths, 0.0);
    }
};

inline void copy_radiance(const double* r, const double* g, const double* b, int paths, RadianceColumns& to) {
    std::copy_n(r, paths, to.r.data);
    std::copy_n(g, paths, to.g.data);
    std::copy_n(b, paths, to.b.data);
}

// One radiance column per group.
struct GroupColumns {
    explicit GroupColumns(int count, bool keeps_direct) : all(size_t(count)), direct(keeps_direct ? size_t(count) : 0) {}

    std::vector<RadianceColumns> all;
    std::vector<RadianceColumns> direct; // of at most one scattering, which clamping excludes; empty: not needed
    // `direct` was written; false if all paths ended earlier: then `direct` would equal `all`
    bool has_direct = false;

    int count() const { return int(all.size()); }
    void clear(int paths) {
        has_direct = false;
        for (RadianceColumns& group : all) group.clear(paths);
    }
    void add(int group, int slot, double red, double green, double blue) {
        RadianceColumns& c = all[size_t(group)];
        c.r[slot] += red;
        c.g[slot] += green;
        c.b[slot] += blue;
    }
    void note_direct(int paths) {
        for (size_t k = 0; k < direct.size(); ++k) copy_radiance(all[k].r, all[k].g, all[k].b, paths, direct[k]);
        has_direct = true;
    }
};

} // namespace blush
