// Learned portals: the directions in which a region of the scene sees the environment. Light sampling in a room then samples the sky
// through its windows, without portals marked by hand. By cell of a grid over the receivers there is a distribution over bins of equal
// solid angle; within a bin, directions are uniform.
#pragma once

#include "core/math.h"
#include "shading/receiver_grid.h"

#include <cstdint>

namespace blush {

constexpr int portal_side = 16, portal_bins = portal_side * portal_side; // equal steps of height and azimuth

// An entry of the alias table of a cell's distribution over bins (Walker 1977). Column k holds bin k below its cut and another above.
struct PortalBin {
    float pdf;          // of the bin's directions, 1/sr
    uint32_t cut_alias; // cut: 24 bits, of 2^24; alias: 8 bits
    bool operator==(const PortalBin&) const = default;
};

struct PortalTables {
    const int32_t* rows = nullptr;   // by cell: its row of bins, -1: no portal; null: nothing has been learned
    const PortalBin* bins = nullptr; // rows of portal_bins
    ReceiverGrid grid;
    int32_t alone = 0; // light sampling has no other lights; else half of its samples take the portal

    bool operator==(const PortalTables&) const = default;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// A receiver's portal. `share`: of its light samples, 0 without a portal.
template <class F> struct Portal {
    Int<F> first; // of its bins
    F share;
};
template <class F> Portal<F> portal_at(const PortalTables& portals, const Vec<F>& position) {
    const Int<F> row = gather(portals.rows, receiver_cell<F>(portals.grid, position));
    const Mask<F> open = as_mask(row >= 0);
    return {select(open, Int<F>(row * portal_bins), Int<F>(0)), select(open, F(portals.alone ? 1.f : 0.5f), F(0.f))};
}

template <class F> Int<F> portal_bin(const Vec<F>& direction) {
    constexpr auto n = float(portal_side);
    const auto step = [&](const F& x) { return to_int(min(max(F(x * n), F(0.f)), F(n - 1))); };
    return step(0.5f * direction.y + 0.5f) * portal_side + step(atan2_turns(direction.x, direction.z) + 0.5f);
}
// The pdf of sample_portal, 1/sr.
template <class F> F portal_pdf(const PortalTables& portals, const Portal<F>& portal, const Vec<F>& direction) {
    return gather_field(portals.bins, &PortalBin::pdf, Int<F>(portal.first + portal_bin<F>(direction)));
}

// A unit direction; `bits`: all 32 uniform; `v` in [0, 1).
template <class F> Vec<F> sample_portal(const PortalTables& portals, const Portal<F>& portal, const UInt<F>& bits, const F& v) {
    const Int<F> column = to_signed(UInt<F>(bits >> 24));
    const UInt<F> cut_alias = gather_field(portals.bins, &PortalBin::cut_alias, Int<F>(portal.first + column));
    const F cut = to_float(to_signed(UInt<F>(cut_alias >> 8))), at = to_float(to_signed(UInt<F>(bits & 0xffffffu)));
    const Mask<F> below = at < cut;
    const Int<F> bin = select(below, column, to_signed(UInt<F>(cut_alias & 255u)));
    const F u = select(below, at, at - cut) / max(F(1.f), select(below, cut, 0x1p24f - cut));
    const F row = to_float(Int<F>(bin >> 4)), azimuth_step = to_float(Int<F>(bin & (portal_side - 1)));
    const F height = (row + u) * (2.f / portal_side) - 1.f;
    const F radius = sqrt(max(F(0.f), F(1.f - height * height)));
    const SinCos<F> azimuth = sincos_turns(F((azimuth_step + v) * (1.f / portal_side) - 0.5f));
    return {radius * azimuth.sin, height, radius * azimuth.cos};
}

} // namespace blush::inline BLUSH_ISA
