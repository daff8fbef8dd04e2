#include "scene/lights/sun_position.h"

#include "core/math.h"

#include <cmath>
#include <numbers>

namespace blush {
namespace {

double sin_deg(double x) { return std::sin(x / degrees_per_radian); }
double cos_deg(double x) { return std::cos(x / degrees_per_radian); }

// Gregorian calendar.
double julian_date(int year, int month, int day, double hours) {
    if (month <= 2) {
        --year;
        month += 12;
    }
    const int century = year / 100, leap = 2 - century + century / 4;
    return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + leap - 1524.5 + hours / 24;
}

} // namespace

SunPosition sun_position(double latitude, double longitude, int year, int month, int day, double utc_hours) {
    const double days = julian_date(year, month, day, utc_hours) - 2451545, t = days / 36525;
    // Geometric longitude: mean longitude and the equation of the centre; then aberration and nutation.
    const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032), anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
    const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * sin_deg(anomaly) + (0.019993 - t * 0.000101) * sin_deg(2 * anomaly) +
                          0.000289 * sin_deg(3 * anomaly);
    const double node = 125.04 - 1934.136 * t;
    const double apparent = mean_longitude + center - 0.00569 - 0.00478 * sin_deg(node);
    const double obliquity = 23.4392911 - t * (0.0130042 + t * (1.64e-7 - t * 5.04e-7)) + 0.00256 * cos_deg(node);
    const double right_ascension = std::atan2(cos_deg(obliquity) * sin_deg(apparent), cos_deg(apparent)) * degrees_per_radian;
    const double declination = std::asin(sin_deg(obliquity) * sin_deg(apparent)) * degrees_per_radian;

    const double sidereal = 280.46061837 + 360.98564736629 * days + t * t * 0.000387933;
    const double hour_angle = sidereal + longitude - right_ascension;
    const double sine = sin_deg(latitude) * sin_deg(declination) + cos_deg(latitude) * cos_deg(declination) * cos_deg(hour_angle);
    // Meeus measures azimuth from the south.
    const double south =
        std::atan2(sin_deg(hour_angle) * cos_deg(declination),
                   cos_deg(hour_angle) * sin_deg(latitude) * cos_deg(declination) - sin_deg(declination) * cos_deg(latitude));
    return {std::asin(std::fmin(1, std::fmax(-1, sine))) * degrees_per_radian, std::fmod(south * degrees_per_radian + 180 + 360, 360)};
}

SunPosition sun_position(const Sky& s) {
    if (!s.by_place_and_time) return {double(s.elevation_degrees), double(s.azimuth_degrees)};
    return sun_position(double(s.latitude_degrees), double(s.longitude_degrees), s.year, s.month, s.day, double(s.utc_hours));
}

Vec3d direction_of(const SunPosition& p) {
    return {cos_deg(p.elevation) * sin_deg(p.azimuth), sin_deg(p.elevation), -cos_deg(p.elevation) * cos_deg(p.azimuth)};
}

} // namespace blush
