#include "measure/stability/weak_points.h"

namespace blush::stability {
namespace {

constexpr WeakPoint spots[] = {
    {1, "self-intersection", "ray origins moved by a bound on their rounding error, then rounded away (Pharr, Jakob, Humphreys 6.8)"},
    {2, "far from the origin", "positions about an origin near the geometry, subtracted in double; Embree's robust mode"},
    {3, "tiny and huge scales", "no absolute epsilon anywhere: every bound is relative to the coordinates at hand"},
    {4, "shadow rays' far end", "ends on the near side of the light's plane by the light's own error bound"},
    {5, "grazing angles", "formulas in x, y, z instead of 1 - cos^2; cosines bounded below at 1e-6"},
    {6, "roughness towards 0", "a delta below roughness 0.01; visible normals, whose weights stay bounded (Heitz 2018)"},
    {7, "index of refraction towards 1", "Fresnel around eta^2 - 1 as a number of its own (Cook and Torrance 1982)"},
    {8, "non-finite samples", "dropped, counted, recorded with pixel, sample and seed; inputs sanitised when compiled"},
    {9, "clamping", "off by default; its loss of energy is reported"},
    {10, "long accumulation", "sums of a path and of a pixel in double, counts in 64 bits"},
    {11, "correlated random numbers", "Owen-scrambled Sobol points keyed on pixel and seed (Burley 2020)"},
    {12, "densities of zero", "MIS weights test for a density above 0 before they divide (Veach 1997)"},
    {13, "emitters without area", "an emitter without area has no power and is never sampled"},
    {14, "degenerate frames", "bases without a singular direction (Duff et al. 2017); normals by cofactors"},
    {15, "closed rooms", "roulette by throughput without a cap (Arvo and Kirk 1990); a bounce limit whose hits are counted"},
    {16, "dynamic range of lights", "probabilities from powers in double, with a minimum for every light (Hesterberg 1995)"},
    {17, "solid-angle sampling of small triangles", "areas are sampled, never spherical triangles"},
    {18, "importance maps", "cells between texel centres with exact probabilities; densities above 0 wherever the filtered map is"},
    {19, "stacks of transparency",
     "opacity decided inside the traversal, each triangle a dimension of the sampler; transmittances add up as integer logarithms"},
    {20, "nested and thin solids", "inside and outside by the geometric normal; absorption on the segment within"},
    {21, "total internal reflection", "g^2 = eta^2 - 1 + c^2 clamped at 0"},
    {22, "range of the output", "single precision all the way to the file"},
    {23, "denormals", "flushed to zero in every worker"},
    {24, "determinism", "tile-owned sums, seeds from pixel and sample alone"},
};
constexpr WeakPoint nothing{0, "", ""};

} // namespace

std::span<const WeakPoint> weak_points() { return spots; }

const WeakPoint& weak_point(int number) {
    for (const WeakPoint& s : spots)
        if (s.number == number) return s;
    return nothing;
}

} // namespace blush::stability
