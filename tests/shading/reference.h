// Reference implementation of the material model in double precision, as published: glTF 2.0 Appendix B,
// KHR_materials_specular and _transmission, and Walter et al. 2007 for refraction. Tests compare the lanes with it.
#pragma once

#include "tests/shading/materials.h"
#include "tests/support/statistics.h"

namespace blush::reference {

constexpr double pi = std::numbers::pi;

inline Vec3d to_double(const Vec3& v) { return {v.x, v.y, v.z}; }
inline double sqr(double x) { return x * x; }
inline double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

inline double distribution(double alpha, const Vec3d& h) { return sqr(alpha) / (pi * sqr(sqr(h.z) * (sqr(alpha) - 1) + 1)); }
inline double masking(double alpha, double cos) {
    return 2 * std::abs(cos) / (std::abs(cos) + std::sqrt(sqr(alpha) + (1 - sqr(alpha)) * sqr(cos)));
}

// Stretched GGX, Heitz 2014.
inline double distribution(double ax, double ay, const Vec3d& h) {
    return 1 / (pi * ax * ay * sqr(sqr(h.x / ax) + sqr(h.y / ay) + sqr(h.z)));
}
inline double masking(double ax, double ay, const Vec3d& w) { return 2 / (1 + std::sqrt(1 + (sqr(ax * w.x) + sqr(ay * w.y)) / sqr(w.z))); }

// Unpolarised Fresnel reflectance for light from index n1 to n2; 1 under total internal reflection.
inline double fresnel(double n1, double n2, double cos1) {
    const double sin2 = n1 / n2 * std::sqrt(std::max(0.0, 1 - sqr(cos1)));
    if (sin2 >= 1) return 1;
    const double cos2 = std::sqrt(1 - sqr(sin2));
    return 0.5 * (sqr((n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2)) + sqr((n1 * cos2 - n2 * cos1) / (n1 * cos2 + n2 * cos1)));
}

inline Vec3d mix(const Vec3d& a, const Vec3d& b, double t) { return a * (1 - t) + b * t; }
inline Vec3d schlick(const Vec3d& f0, double cos) { return f0 + (Vec3d{1, 1, 1} - f0) * std::pow(1 - std::abs(cos), 5); }

// The listing of KHR_materials_iridescence, with one difference: each colour channel has its own sign of interference. The listing uses
// the sign of the red base for X and that of the green base for Y. `cos`: in air.
inline Vec3d film_reflectance(double film_ior, double thickness_nm, double cos, const Vec3d& f0) {
    const double cos2 = std::sqrt(1 - (1 - sqr(cos)) / sqr(film_ior));
    const double r0 = sqr((film_ior - 1) / (film_ior + 1)), r12 = r0 + (1 - r0) * std::pow(1 - cos, 5), t121 = 1 - r12;
    const double opd = 2 * film_ior * thickness_nm * cos2;
    const auto channel = [&](double f, const std::array<double, 3>& row) {
        const double base_ior = (1 + std::sqrt(std::min(f, 0.9999))) / (1 - std::sqrt(std::min(f, 0.9999)));
        const double r1 = sqr((base_ior - film_ior) / (base_ior + film_ior)), r23 = r1 + (1 - r1) * std::pow(1 - cos2, 5);
        const double phi = base_ior < film_ior ? 2 * pi : pi;
        const double r123 = std::min(r12 * r23, 0.9999), rs = sqr(t121) * r23 / (1 - r123);
        double sum = r12 + rs, cm = rs - t121;
        for (int m = 1; m <= 2; ++m) {
            const double phase = 2 * pi * m * opd * 1e-9, shift = m * phi;
            const auto gaussian = [&](double value, double position, double variance) {
                return value * std::sqrt(2 * pi * variance) * std::cos(position * phase + shift) * std::exp(-sqr(phase) * variance) /
                       1.0685e-7;
            };
            const double x = gaussian(5.4856e-13, 1.6810e6, 4.3278e9) + gaussian(9.7470e-14, 2.2399e6, 4.5282e9);
            const double y = gaussian(4.4201e-13, 1.7953e6, 9.3046e9), z = gaussian(5.2481e-13, 2.2084e6, 6.6121e9);
            cm *= std::sqrt(r123);
            sum += cm * 2 * (row[0] * x + row[1] * y + row[2] * z);
        }
        return std::clamp(sum, 0.0, 1.0);
    };
    return {channel(f0.x, {3.2404542, -1.5371385, -0.4985314}), channel(f0.y, {-0.9692660, 1.8760108, 0.0415560}),
            channel(f0.z, {0.0556434, -0.2040259, 1.0572252})};
}
// Reflectance with an iridescent film of a surface that reflects `bare` without it. `cos`: on the viewer's side; refracted to air inside.
inline Vec3d film_over(const Vec3d& bare, const Params& p, double cos, bool inside, const Vec3d& f0, double weight) {
    if (p.layers.iridescence == 0) return bare;
    const double sin_air = inside ? p.ior * std::sqrt(1 - sqr(cos)) : std::sqrt(1 - sqr(cos));
    const Vec3d film =
        film_reflectance(p.layers.film_ior, p.layers.film_thickness, std::sqrt(std::max(0.0, 1 - sqr(sin_air))), f0) * weight;
    return mix(bare, film, p.layers.iridescence);
}

// The dielectric's reflectance, specular weight included.
inline Vec3d dielectric_fresnel(const Params& p, double cos, bool inside) {
    const double n = p.ior, normal = sqr((1 - n) / (1 + n));
    const Vec3d f0{std::min(normal * p.specular_color.x, 1.0), std::min(normal * p.specular_color.y, 1.0),
                   std::min(normal * p.specular_color.z, 1.0)};
    if (!is_solid(p)) return film_over(schlick(f0, cos) * double(p.specular), p, cos, false, f0, p.specular);
    const double exact = inside ? fresnel(n, 1, cos) : fresnel(1, n, cos);
    if (exact == 1) return {1, 1, 1};
    const Vec3d bare = (f0 + (Vec3d{1, 1, 1} - f0) * ((exact - normal) / (1 - normal))) * double(p.specular);
    return film_over(bare, p, cos, inside, f0, p.specular);
}

// f |wi.z| of the base, for radiance; roughness above that of a delta.
inline Vec3d f_cos_of_base(const Params& p, Vec3d wo, Vec3d wi) {
    wo = normalize(wo);
    wi = normalize(wi);
    const bool inside = is_solid(p) && wo.z < 0;
    if (inside) wo.z = -wo.z, wi.z = -wi.z;
    const double ay = sqr(p.roughness), ax = ay + (1 - ay) * sqr(p.layers.anisotropy), g = masking(ax, ay, wo) * masking(ax, ay, wi);
    const double translucency = p.layers.diffuse_transmission,
                 leaves = is_solid(p) && (p.specular > 0 || p.transmission > 0) ? 1 / sqr(p.ior) : 1;
    const Vec3d crossing = to_double(p.layers.diffuse_transmission_color) * translucency;
    const Vec3d color = to_double(p.base_color);
    const double metallic = p.metallic, transmission = p.transmission;
    const Vec3d none{0, 0, 0};

    if (wi.z > 0) {
        const Vec3d h = normalize(wo + wi);
        const double cos = dot(wo, h);
        const double specular = distribution(ax, ay, h) * g / (4 * wo.z * wi.z);
        const Vec3d fresnel = dielectric_fresnel(p, cos, inside);
        const Vec3d diffuse = (color * (1 - translucency) + crossing * (inside ? 1 - leaves : 0)) * ((1 - transmission) / pi);
        const Vec3d dielectric = diffuse * (1 - largest(fresnel)) + fresnel * specular;
        return mix(dielectric, film_over(schlick(color, cos), p, cos, inside, color, 1) * specular, metallic) * wi.z;
    }
    if (wi.z == 0) return none;
    const Vec3d mirrored = normalize(wo + Vec3d{wi.x, wi.y, -wi.z});
    const double unreflected = 1 - largest(dielectric_fresnel(p, dot(wo, mirrored), inside));
    const Vec3d diffuse = crossing * ((1 - metallic) * (1 - transmission) * unreflected * (inside ? 1 : leaves) * -wi.z / pi);
    if (!(transmission > 0)) return diffuse;
    if (!is_solid(p)) {
        const Vec3d h = normalize(wo + Vec3d{wi.x, wi.y, -wi.z});
        const double btdf = distribution(ax, ay, h) * g / (4 * wo.z * -wi.z);
        return diffuse + color * ((1 - metallic) * transmission * btdf * (1 - largest(dielectric_fresnel(p, dot(wo, h), inside))) * -wi.z);
    }
    const double n_o = inside ? p.ior : 1.0, n_i = inside ? 1.0 : p.ior;
    Vec3d h = normalize(wo * n_o + wi * n_i);
    if (h.z < 0) h = h * -1.0;
    if (dot(wo, h) <= 0 || dot(wi, h) >= 0) return diffuse;
    // Walter et al. 2007, equation 21, the side of wi as the transmitted one; then radiance: times (n_o / n_i)^2.
    const double btdf = std::abs(dot(wi, h)) * dot(wo, h) / (std::abs(wi.z) * wo.z) * sqr(n_i) * distribution(ax, ay, h) * g /
                        sqr(n_o * dot(wo, h) + n_i * dot(wi, h));
    const double share = 1 - largest(dielectric_fresnel(p, dot(wo, h), inside));
    return diffuse + color * ((1 - metallic) * transmission * share * btdf * sqr(n_o / n_i) * -wi.z);
}

// A frame around a unit normal that is not -z.
struct Frame {
    Vec3d s, t, n;
    explicit Frame(const Vec3d& normal) : n(normalize(normal)) {
        s = normalize(Vec3d{1 - n.x * n.x / (1 + n.z), -n.x * n.y / (1 + n.z), -n.x});
        t = cross(n, s);
    }
    Vec3d to_local(const Vec3d& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
    Vec3d to_world(const Vec3d& v) const { return s * v.x + t * v.y + n * v.z; }
};

// KHR_materials_clearcoat: mix(base, specular_brdf(coat's alpha and normal), clearcoat * Schlick(0.04, N_coat V)). The back of the
// coat reflects like its front. `base`: f |wi.z| of the layers below.
inline Vec3d coat_over(const Vec3d& base, const Params& p, Vec3d wo, Vec3d wi) {
    if (p.layers.clearcoat == 0) return base;
    Vec3d n = to_double(p.layers.clearcoat_normal);
    if (is_solid(p) && wo.z < 0) wo.z = -wo.z, wi.z = -wi.z, n.x = -n.x, n.y = -n.y;
    if (dot(n, wo) <= double(min_facing)) n = {0, 0, 1}; // tilted normals must face the viewer
    const Frame frame(n);
    const Vec3d o = frame.to_local(wo), i = frame.to_local(wi);
    const double share = p.layers.clearcoat * (0.04 + 0.96 * std::pow(1 - o.z, 5));
    double layer = 0;
    if (i.z > 0 && wi.z > 0 && p.layers.clearcoat_roughness >= smooth_roughness) {
        const double alpha = sqr(p.layers.clearcoat_roughness);
        layer = distribution(alpha, normalize(o + i)) * masking(alpha, o.z) * masking(alpha, i.z) / (4 * o.z);
    }
    return base * (1 - share) + Vec3d{1, 1, 1} * (share * layer);
}

// KHR_materials_sheen's listings.
inline double charlie_lambda(double alpha, double cos) {
    const double t = sqr(1 - alpha);
    const auto between = [&](double rough, double smooth) { return rough * (1 - t) + smooth * t; };
    const auto l = [&](double x) {
        return between(21.5473, 25.3245) / (1 + between(3.82987, 3.32435) * std::pow(x, between(0.19823, 0.16801))) +
               between(-1.97760, -1.27393) * x + between(-4.32054, -4.85967);
    };
    return cos < 0.5 ? std::exp(l(cos)) : std::exp(2 * l(0.5) - l(1 - cos));
}
inline double charlie_f_cos(double alpha, const Vec3d& wo, const Vec3d& wi) {
    const Vec3d h = normalize(wo + wi);
    const double d = (2 + 1 / alpha) * std::pow(std::hypot(h.x, h.y), 1 / alpha) / (2 * pi);
    return d / ((1 + charlie_lambda(alpha, wo.z) + charlie_lambda(alpha, wi.z)) * 4 * wo.z);
}
// Directional albedo of the sheen, by the midpoint rule.
inline double charlie_albedo(double alpha, double cos) {
    constexpr int rows = 300, columns = 90;
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double w = (i + 0.5) / rows, z = w * w, r = std::sqrt(1 - z * z), phi = pi * (j + 0.5) / columns;
            sum += 2 * w * charlie_f_cos(alpha, {std::sqrt(1 - cos * cos), 0, cos}, {r * std::cos(phi), r * std::sin(phi), z});
        }
    return sum * 2 * pi / (rows * columns);
}
// f |wi.z| with sheen. Albedos are from the table, which has its own test.
inline Vec3d sheen_over(const Vec3d& base, const Params& p, Vec3d wo, Vec3d wi) {
    const Vec3d color = to_double(p.layers.sheen_color);
    if (largest(color) == 0) return base;
    if (is_solid(p) && wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
    const double roughness = std::max(p.layers.sheen_roughness, min_sheen_roughness);
    const auto albedo = [&](double cos) { return double(sheen_albedo(sheen_table(), float(roughness), float(std::abs(cos)))); };
    const double larger = std::max(albedo(wo.z), albedo(wi.z));
    const Vec3d below = base * (1 - largest(color) * std::min(larger, 1.0));
    return wi.z > 0 ? below + color * (charlie_f_cos(sqr(roughness), wo, wi) / std::max(larger, 1.0)) : below;
}

// f |wi.z| of all layers.
inline Vec3d f_cos(const Params& p, const Vec3d& wo, const Vec3d& wi) {
    const Vec3d o = normalize(wo), i = normalize(wi);
    return coat_over(sheen_over(f_cos_of_base(p, o, i), p, o, i), p, o, i);
}

// Relative bound of the rounding error of f_cos: that of some dozen operations, and that of the facet normal, which moves when the two
// directions are rounded. The latter is multiplied by the relative slope of the facet distribution (at most 4 / alpha) and of the cosines
// between facet and directions. Near the critical angle, the transmitted light varies like the root of (eta cos)^2.
inline double relative_bound(const Params& p, const Vec3& wo, const Vec3& wi) {
    const float min_roughness =
        p.layers.clearcoat > 0 ? std::min(p.roughness, std::max(p.layers.clearcoat_roughness, smooth_roughness)) : p.roughness;
    const double alpha = std::max(sqr(min_roughness), 1e-4);
    const double eta = wo.z < 0 ? 1 / p.ior : p.ior;
    const bool through = wo.z * wi.z < 0;
    const Vec3d a = to_double(wo), b = to_double(wi);
    const Vec3d sum = a + (!through ? b : p.thin ? Vec3d{b.x, b.y, -b.z} : b * eta);
    const double span = length(sum), cosine = std::min(std::abs(dot(a, sum)), std::abs(dot(b, sum))) / span;
    const double refraction = through && !p.thin ? 1 / sqr(eta * cosine) : 0;
    // For diffuse transmission: the cosine at the facet that would reflect wo to the mirrored wi.
    const double mirrored = 0.5 + 0.5 * dot(a, Vec3d{b.x, b.y, through ? -b.z : b.z});
    const double crossing = p.layers.diffuse_transmission > 0 && !p.thin ? 1 / std::max(std::abs(eta * eta - 1 + mirrored), 1e-6) : 0;
    return statistics::float_rounding * (1 + (4 / alpha + 4 / cosine) / span + refraction + crossing);
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

// Maps microfacet normals to wi, for a fixed wo: by reflection; with `through` by refraction with the index ratio eta, or through a thin
// wall (eta 0). On such a chart a lobe is as wide as its distribution of normals, so that it is easy to integrate.
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
    const bool coated = p.layers.clearcoat > 0 && p.layers.clearcoat_roughness >= smooth_roughness;
    const float min_roughness = coated ? std::min(p.roughness, p.layers.clearcoat_roughness) : p.roughness;
    const double alpha = sqr(std::max(min_roughness, smooth_roughness)), ior = std::max(p.ior, 1.f);
    std::vector<statistics::Chart> charts = {facet_chart(alpha, wo, false, 0)};
    if (p.layers.diffuse_transmission > 0) {
        // One chart for all transmitted directions, diffuse and refracted: a refraction chart would not cover all of them.
        charts.push_back(facet_chart(alpha, wo, true, 0));
        return charts;
    }
    if (p.transmission > 0 && (p.thin || ior > 1)) charts.push_back(facet_chart(alpha, wo, true, p.thin ? 0 : wo.z < 0 ? 1 / ior : ior));
    return charts;
}

// Directional albedo of a rough mirror that loses only masked light: the integral over facet normals.
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
