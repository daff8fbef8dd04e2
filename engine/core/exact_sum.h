// Exact sums: the same bits for any order and any grouping of the summands, so that an image that was rendered in parts equals one
// that was rendered at once. Two doubles hold a fixed-point number: integers up to 2^53 and a fraction in units of 2^-52. Summands
// are rounded to that unit (2.2e-16) when they are added. The rounding adds and subtracts a large constant (error-free extraction:
// Rump, Ogita and Oishi 2008; Demmel and Nguyen 2013, "Fast reproducible floating-point summation").
#pragma once

#include "core/vec.h"

namespace blush {

class ExactSum {
public:
    // Beyond this magnitude sums are rounded like sums of doubles, so that their last bit may depend on the order.
    static constexpr double max_exact = 0x1p53;
    // Summands are multiples of this.
    static constexpr double unit = 0x1p-52;
    // From whole() and fraction(), or from a number and 0.
    static ExactSum of(double whole, double fraction) {
        ExactSum sum;
        sum.add(whole);
        sum.add(fraction);
        return sum;
    }

    // Finite numbers only.
    void add(double x) {
        const double integer = rounded_to_integer(x);
        fraction_ += rounded_to_unit(x - integer);
        whole_ += integer;
        carry();
    }
    void add(const ExactSum& other) {
        fraction_ += other.fraction_;
        whole_ += other.whole_;
        carry();
    }
    // Rounded once.
    double value() const { return whole_ + fraction_; }

    // The sum as an integer and a fraction in (-1/2, 1/2]: one form for each sum.
    double whole() const { return whole_; }
    double fraction() const { return fraction_; }
    bool operator==(const ExactSum&) const = default;

private:
    // Both to nearest: adding the constant moves the last bit of x to the unit's place.
    static double rounded_to_integer(double x) { return (x + 0x1.8p52) - 0x1.8p52; }
    static double rounded_to_unit(double x) { return (x + 1.5) - 1.5; }
    void carry() {
        // Half a unit away from ties, so that -1/2 becomes 1/2: one form for each number.
        const double integer = rounded_to_integer(fraction_ - 0x1p-53);
        fraction_ -= integer;
        whole_ += integer;
    }

    double whole_ = 0, fraction_ = 0;
};

// Three sums, for RGB.
struct ExactSum3 {
    ExactSum x, y, z;
    void add(const Vec3d& v) {
        x.add(v.x);
        y.add(v.y);
        z.add(v.z);
    }
    void add(const ExactSum3& other) {
        x.add(other.x);
        y.add(other.y);
        z.add(other.z);
    }
    Vec3d value() const { return {x.value(), y.value(), z.value()}; }
    bool operator==(const ExactSum3&) const = default;
};

// Rounds to a multiple of 2^-32 (2.3e-10): sums of numbers of magnitude 1 are then exact for up to 2^21 of them, in one double.
// For |x| < 2^18.
inline double rounded_for_sums(double x) { return (x + 0x1.8p20) - 0x1.8p20; }

} // namespace blush
