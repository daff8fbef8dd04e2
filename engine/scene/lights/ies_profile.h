// IES profile: luminous intensity distribution of a luminaire, measured with a goniophotometer (ANSI/IES LM-63).
#pragma once

#include "scene/scene.h"

#include <vector>

namespace blush {

// Candela over two angles, interpolated linearly in both. Directions are in the light's space: it emits along -Z, X is to its
// side, Y up. Immutable once shared.
//   Type C (polar axis along the light): vertical is the angle from -Z, 0 .. 180; horizontal turns about it from +X towards +Y, 0 .. 360.
//   Type B (polar axis X): horizontal is the angle towards +X, -90 .. 90; vertical turns about X from -Z towards +Y, -90 .. 90.
// The intensity is 0 outside the vertical angles and, for type B, outside the horizontal angles. A single horizontal angle means
// rotational symmetry.
struct IesProfile {
    enum class Type : uint8_t { b, c };
    uint64_t serial = next_payload_serial();
    Type type = Type::c;
    std::vector<float> vertical, horizontal; // degrees, ascending, symmetries unfolded
    std::vector<float> candela;              // vertical.size() for each horizontal angle
    float peak = 0;                          // the largest candela
};

// Candela at two angles of the profile, in degrees.
double candela_at(const IesProfile& profile, double vertical, double horizontal);
// Candela in a direction (of any length) in the light's space.
double candela_towards(const IesProfile& profile, const Vec3d& direction);
// Lumens: the integral of candela over all directions, by Gauss quadrature in each cell of the table.
double luminous_flux(const IesProfile& profile);

} // namespace blush
