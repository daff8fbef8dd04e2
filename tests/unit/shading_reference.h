// The model a second time, in double precision, as its sources print it and without a thought for numerics: glTF 2.0 Appendix B,
// KHR_materials_specular and _transmission, and Walter et al. 2007 for refraction. What the lanes compute is compared with it.
#pragma once

#include "shading_materials.h"
#include "statistics.h"

namespace blush::reference {

constexpr double pi = std::numbers::pi;

inline Vec3d to_double(const Vec3& v) { return {v.x, v.y, v.z}; }
inline double sqr(double x) { return x * x; }
inline double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

inline double distribution(double alpha, const Vec3d& h) { return sqr(alpha) / (pi * sqr(sqr(h.z) * (sqr(alpha) - 1) + 1)); }
inline double masking(double alpha, double cos) {
    return 2 * std::abs(cos) / (std::abs(cos) + std::sqrt(sqr(alpha) + (1 - sqr(alpha)) * sqr(cos)));
}

// Unpolarised Fresnel reflectance for light from index n1 to n2; 1 under total internal reflection.
inline double fresnel(double n1, double n2, double cos1) {
    const double sin2 = n1 / n2 * std::sqrt(std::max(0.0, 1 - sqr(cos1)));
    if (sin2 >= 1) return 1;
    const double cos2 = std::sqrt(1 - sqr(sin2));
    return 0.5 * (sqr((n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2)) + sqr((n1 * cos2 - n2 * cos1) / (n1 * cos2 + n2 * cos1)));
}

inline Vec3d mix(const Vec3d& a, const Vec3d& b, double t) { return a * (1 - t) + b * t; }
inline Vec3d schlick(const Vec3d& f0, double cos) { return f0 + (Vec3d{1, 1, 1} - f0) * std::pow(1 - std::abs(cos), 5); }

// The dielectric's reflectance, specular weight included.
inline Vec3d dielectric_fresnel(const Params& p, double cos, bool inside) {
    const double n = p.ior, normal = sqr((1 - n) / (1 + n));
    const Vec3d f0{std::min(normal * p.specular_color.x, 1.0), std::min(normal * p.specular_color.y, 1.0),
                   std::min(normal * p.specular_color.z, 1.0)};
    if (!is_solid(p)) return schlick(f0, cos) * double(p.specular);
    const double exact = inside ? fresnel(n, 1, cos) : fresnel(1, n, cos);
    if (exact == 1) return {1, 1, 1};
    return (f0 + (Vec3d{1, 1, 1} - f0) * ((exact - normal) / (1 - normal))) * double(p.specular);
}

// f |wi.z| for radiance; roughness above that of a delta.
inline Vec3d f_cos(const Params& p, Vec3d wo, Vec3d wi) {
    wo = normalize(wo);
    wi = normalize(wi);
    const bool inside = is_solid(p) && wo.z < 0;
    if (inside) wo.z = -wo.z, wi.z = -wi.z;
    const double alpha = sqr(p.roughness), g = masking(alpha, wo.z) * masking(alpha, wi.z);
    const Vec3d color = to_double(p.base_color);
    const double metallic = p.metallic, transmission = p.transmission;
    const Vec3d none{0, 0, 0};

    if (wi.z > 0) {
        const Vec3d h = normalize(wo + wi);
        const double cos = dot(wo, h);
        const double specular = distribution(alpha, h) * g / (4 * wo.z * wi.z);
        const Vec3d fresnel = dielectric_fresnel(p, cos, inside);
        const Vec3d diffuse = color * ((1 - transmission) / pi);
        const Vec3d dielectric = diffuse * (1 - largest(fresnel)) + fresnel * specular;
        return mix(dielectric, schlick(color, cos) * specular, metallic) * wi.z;
    }
    if (!(transmission > 0) || wi.z == 0) return none;
    if (!is_solid(p)) {
        const Vec3d h = normalize(wo + Vec3d{wi.x, wi.y, -wi.z});
        const double btdf = distribution(alpha, h) * g / (4 * wo.z * -wi.z);
        return color * ((1 - metallic) * transmission * btdf * (1 - largest(dielectric_fresnel(p, dot(wo, h), inside))) * -wi.z);
    }
    const double n_o = inside ? p.ior : 1.0, n_i = inside ? 1.0 : p.ior;
    Vec3d h = normalize(wo * n_o + wi * n_i);
    if (h.z < 0) h = h * -1.0;
    if (dot(wo, h) <= 0 || dot(wi, h) >= 0) return none;
    // Walter et al. 2007, equation 21, the side of wi as the transmitted one; then radiance: times (n_o / n_i)^2.
    const double btdf = std::abs(dot(wi, h)) * dot(wo, h) / (std::abs(wi.z) * wo.z) * sqr(n_i) * distribution(alpha, h) * g /
                        sqr(n_o * dot(wo, h) + n_i * dot(wi, h));
    const double share = 1 - largest(dielectric_fresnel(p, dot(wo, h), inside));
    return color * ((1 - metallic) * transmission * share * btdf * sqr(n_o / n_i) * -wi.z);
}

// A facet normal on a grid over (0, 1)^2 that is fine where the GGX distribution is narrow, and its solid angle per unit.
struct FacetPoint {
    Vec3d h;
    double solid_angle;
};
inline FacetPoint facet_at(double alpha, double s, double t) {
    const double k = std::asinh(pi / 2 / alpha);
    const double theta = alpha * std::sinh(s * k), phi = 2 * pi * (t - 0.5);
    const double sin = std::sin(theta);
    return {{sin * std::cos(phi), sin * std::sin(phi), std::cos(theta)}, 2 * pi * sin * alpha * k * std::cosh(s * k)};
}
inline std::array<double, 2> facet_coordinates(double alpha, const Vec3d& h) {
    const double theta = std::atan2(std::hypot(h.x, h.y), h.z);
    return {std::asinh(theta / alpha) / std::asinh(pi / 2 / alpha), std::atan2(h.y, h.x) / (2 * pi) + 0.5};
}

// The facet normals themselves.
inline statistics::Chart facet_normals_chart(double alpha) {
    return {[=](double s, double t) -> std::optional<statistics::Chart::Point> {
                const FacetPoint f = facet_at(alpha, s, t);
                return statistics::Chart::Point{f.h, f.solid_angle};
            },
            [=](const Vec3d& h) { return std::optional(facet_coordinates(alpha, h)); }};
}

// wi as a function of the facet between it and wo: by reflection, or `through` the surface: by refraction into the index ratio
// eta, or through a thin wall (eta 0). On these charts every lobe is as wide as its distribution of facets: easy to integrate.
inline statistics::Chart facet_chart(double alpha, const Vec3& wo_surface, bool through, double eta) {
    const double side = wo_surface.z < 0 ? -1 : 1;
    const Vec3d wo = normalize(Vec3d{wo_surface.x, wo_surface.y, wo_surface.z * side});
    const bool refracts = through && eta > 0;
    const auto at = [=](double s, double t) -> std::optional<statistics::Chart::Point> {
        const FacetPoint f = facet_at(alpha, s, t);
        const double c = dot(wo, f.h);
        Vec3d wi = f.h * (2 * c) - wo;
        double jacobian = 4 * c; // |d wi / d h|
        if (refracts) {
            const double k = 1 - (1 - c * c) / (eta * eta);
            if (k <= 0) return std::nullopt;
            wi = f.h * (c / eta - std::sqrt(k)) - wo / eta;
            jacobian = sqr(dot(wi, f.h) + c / eta) / std::abs(dot(wi, f.h));
        } else if (through) {
            wi.z = -wi.z;
        }
        if (c <= 0 || (through ? wi.z >= 0 : wi.z <= 0)) return std::nullopt;
        return statistics::Chart::Point{{wi.x, wi.y, wi.z * side}, f.solid_angle * jacobian};
    };
    const auto coordinates = [=](const Vec3d& wi_surface) -> std::optional<std::array<double, 2>> {
        Vec3d wi{wi_surface.x, wi_surface.y, wi_surface.z * side};
        if (through ? wi.z >= 0 : wi.z <= 0) return std::nullopt;
        if (through && !refracts) wi.z = -wi.z;
        Vec3d h = refracts ? normalize(wo + wi * eta) : normalize(wo + wi);
        if (h.z < 0) h = h * -1.0;
        return facet_coordinates(alpha, h);
    };
    return {at, coordinates};
}

// Charts of all directions a material with facets scatters to.
inline std::vector<statistics::Chart> facet_charts(const Params& p, const Vec3& wo) {
    const double alpha = sqr(std::max(p.roughness, smooth_roughness)), ior = std::max(p.ior, 1.f);
    std::vector<statistics::Chart> charts = {facet_chart(alpha, wo, false, 0)};
    if (p.transmission > 0 && (p.thin || ior > 1)) charts.push_back(facet_chart(alpha, wo, true, p.thin ? 0 : wo.z < 0 ? 1 / ior : ior));
    return charts;
}

// Directional albedo of a rough mirror that loses nothing but what is masked: the integral over facets.
inline double mirror_albedo(double alpha, double cos) {
    const Vec3d wo{std::sqrt(1 - sqr(cos)), 0, cos};
    constexpr int rows = 600, columns = 120;
    constexpr double gauss = 0.28867513459481287; // two points per row
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const FacetPoint f = facet_at(alpha, (i / 2 * 2 + 1 + (i % 2 ? 2 : -2) * gauss) / rows, (j + 0.5) / columns);
            const double c = dot(wo, f.h), z = 2 * c * f.h.z - wo.z;
            if (c > 0 && z > 0) sum += distribution(alpha, f.h) * masking(alpha, z) * c * f.solid_angle;
        }
    return sum * masking(alpha, cos) / cos / (rows * columns);
}

} // namespace blush::reference
