// Sums with the same bits for any order and any grouping of the summands, so that an image that was rendered in parts equals one
// that was rendered at once: indexed summation (Demmel and Nguyen 2013, "Fast reproducible floating-point summation") with two bins
// of 28 bits. Each summand is rounded to the units of a high and a low bin, and the bins are summed without rounding. The units
// follow the largest summand: when a larger one comes, the low bin is dropped and the high one takes its place. What is kept of a
// summand then is what would have been kept of it afterwards, so the order does not matter.
#pragma once

#include "core/vec.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace blush {

// A summand keeps at least 27 bits relative to the largest summand, 50 if that is between 3e-8 and 8. For up to 2^24 summands.
class ExactSum {
public:
    // From high() and biased_low(). Others, such as of a damaged file, give the sum of `high` alone.
    static ExactSum of(double high, double biased_low) {
        ExactSum sum;
        if (!is_bias(biased_low)) {
            sum.add(high);
            return sum;
        }
        sum.high_ = high;
        sum.low_ = biased_low;
        return sum;
    }
    static ExactSum of(double value) {
        ExactSum sum;
        sum.add(value);
        return sum;
    }

    void add(double x) {
        if (!(std::abs(x) < limit()) && !make_room(x)) [[unlikely]] {
            high_ += x;
            return;
        }
        const double low_bias = bias(), high_bias = low_bias * bin;
        // Adding the bias moves the last bit to the place of the unit: rounds to nearest.
        const double high = (x + high_bias) - high_bias;
        high_ += high;
        low_ += ((x - high) + low_bias) - low_bias;
    }
    void add(ExactSum other) {
        const int steps = (exponent_bits(other.low_) - exponent_bits(low_)) / bin_bits;
        if (steps > 0) raise(steps);
        if (steps < 0) other.raise(-steps);
        high_ += other.high_;
        low_ += other.low_ - bias();
    }
    // Rounded once.
    double value() const { return high_ + (low_ - bias()); }

    double high() const { return high_; }
    // The low bin plus 1.5 times a power of two, which tells the units.
    double biased_low() const { return low_; }
    bool operator==(const ExactSum&) const = default;

private:
    static constexpr int bin_bits = 28;
    static constexpr double bin = 0x1p28;
    static constexpr int first_exponent = -20 * bin_bits; // of the bias at first: far below all radiance

    static int exponent_bits(double x) { return int(std::bit_cast<uint64_t>(x) >> 52 & 0x7ff); }
    static bool is_bias(double x) {
        const int above = exponent_bits(x) - 1023 - first_exponent;
        return x > 0 && above >= 0 && above % bin_bits == 0 && std::isfinite(x * bin);
    }
    // 2^p for a low bin whose unit is 2^(p - 52).
    double power() const { return std::bit_cast<double>(std::bit_cast<uint64_t>(low_) & 0x7ff0000000000000u); }
    double bias() const { return 1.5 * power(); }
    // Half the unit of the bin above the high one: smaller summands leave nothing there.
    double limit() const { return 8 * power(); }
    // For a summand beyond the limit. False for one that is not finite. Out of line: a sum rarely needs it more than once.
    [[gnu::noinline]] bool make_room(double x) {
        if (!std::isfinite(x)) return false;
        const int needed = std::ilogb(x) + 1 - 3 - (exponent_bits(low_) - 1023); // |x| < 2^(ilogb + 1)
        raise((needed + bin_bits - 1) / bin_bits);
        return true;
    }
    void raise(int steps) {
        const double power_above = std::ldexp(power(), steps * bin_bits);
        low_ = 1.5 * power_above + (steps == 1 ? high_ : 0);
        high_ = 0;
    }

    double high_ = 0, low_ = 0x1.8p-560;
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
