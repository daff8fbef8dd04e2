#include "scene/validate.h"

#include "scene/affine.h"
#include "scene/texture_slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace blush {
namespace {

// Keeps the first error of a record.
class Check {
public:
    explicit Check(std::string where) : where_(std::move(where)) {}
    Check(std::string_view kind, const std::string& name) : where_(fmt::format("{} \"{}\"", kind, name)) {}

    void is(bool good, std::string what) {
        if (!good && !error_) error_ = Error{.what = std::move(what), .where = where_};
    }
    void between(std::string_view field, double value, double low, double high) {
        if (!(value >= low && value <= high)) is(false, fmt::format("{} must be from {} to {}, not {}", field, low, high, value));
    }
    void not_negative(std::string_view field, double value) {
        if (!(value >= 0 && std::isfinite(value))) is(false, fmt::format("{} must be a number from 0, not {}", field, value));
    }
    void positive(std::string_view field, double value) {
        if (!(value > 0 && std::isfinite(value))) is(false, fmt::format("{} must be above 0, not {}", field, value));
    }
    void finite(std::string_view field, double value) {
        if (!std::isfinite(value)) is(false, fmt::format("{} must be a finite number, not {}", field, value));
    }
    void finite(std::string_view field, const Vec3& v) {
        for (const float c : {v.x, v.y, v.z}) finite(field, c);
    }
    void color(std::string_view field, const Vec3& v) {
        for (const float c : {v.x, v.y, v.z}) not_negative(field, c);
    }
    void texture(std::string_view field, const TextureRef& ref) {
        for (const float c : {ref.offset.x, ref.offset.y, ref.scale.x, ref.scale.y, ref.rotation_radians}) finite(field, c);
    }
    void region(std::string_view field, const ImageRegion& r) {
        is(r.x >= 0 && r.y >= 0 && r.width > 0 && r.height > 0 && r.x + r.width <= 1 + 1e-6f && r.y + r.height <= 1 + 1e-6f,
           fmt::format("{} must be a rectangle within the image", field));
    }
    void lens(const Lens& lens) {
        is(lens.yfov_radians > 0 && lens.yfov_radians < pi,
           fmt::format("field of view must be above 0 and below pi radians, not {}", lens.yfov_radians));
        positive("orthographic height", lens.ymag);
        not_negative("aperture radius", lens.aperture_radius);
        positive("focus distance", lens.focus_distance);
    }

    Result<void> done() && {
        if (error_) return std::move(*error_);
        return {};
    }

private:
    std::string where_;
    std::optional<Error> error_;
};

} // namespace

Result<void> validate(const Node& node) {
    Check check("node", node.name);
    const Transform& local = node.local;
    check.finite("translation", local.translation);
    check.finite("scale", local.scale);
    const Quat& q = local.rotation;
    const double norm = std::sqrt(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w);
    check.is(norm > 1e-6 && std::isfinite(norm), "rotation must be a quaternion of finite length above 0");
    check.is(!local.matrix || is_finite(to_double(*local.matrix)), "matrix must hold finite numbers");
    for (const float weight : node.morph_weights) check.finite("morph weight", weight);
    return std::move(check).done();
}

Result<void> validate(const Material& material) {
    Check check("material", material.name);
    check.color("base colour", material.base_color);
    check.between("opacity", material.opacity, 0, 1);
    check.between("metallic", material.metallic, 0, 1);
    check.between("roughness", material.roughness, 0, 1);
    check.color("emissive colour", material.emissive);
    check.not_negative("emissive strength", material.emissive_strength);
    check.finite("normal scale", material.normal_scale);
    check.not_negative("alpha cutoff", material.alpha_cutoff);
    // KHR_materials_ior: 0 means an infinite index; other values are at least 1 (vacuum).
    if (material.ior != 0) check.between("index of refraction", material.ior, 1, 1000);
    check.between("specular", material.specular, 0, 1);
    check.color("specular colour", material.specular_color);
    check.between("transmission", material.transmission, 0, 1);
    check.not_negative("thickness", material.thickness);
    check.color("attenuation colour", material.attenuation_color);
    check.not_negative("attenuation distance", material.attenuation_distance);
    check.between("clear coat", material.clearcoat, 0, 1);
    check.between("clear coat roughness", material.clearcoat_roughness, 0, 1);
    check.finite("clear coat normal scale", material.clearcoat_normal_scale);
    for (const float c : {material.sheen_color.x, material.sheen_color.y, material.sheen_color.z}) check.between("sheen colour", c, 0, 1);
    check.between("sheen roughness", material.sheen_roughness, 0, 1);
    check.between("anisotropy", material.anisotropy, 0, 1);
    check.finite("anisotropy rotation", material.anisotropy_rotation_radians);
    check.between("iridescence", material.iridescence, 0, 1);
    check.between("iridescence index of refraction", material.iridescence_ior, 1, 1000);
    check.not_negative("minimum iridescence thickness", material.iridescence_thickness_minimum);
    check.not_negative("maximum iridescence thickness", material.iridescence_thickness_maximum);
    check.not_negative("dispersion", material.dispersion);
    check.between("diffuse transmission", material.diffuse_transmission, 0, 1);
    check.color("diffuse transmission colour", material.diffuse_transmission_color);
    for (const TextureSlot& slot : texture_slots) check.texture(slot.name, material.*slot.ref);
    return std::move(check).done();
}

Result<void> validate(const Light& light) {
    Check check("light", light.name);
    check.color("colour", light.color);
    check.between("temperature", light.kelvin, 1000, 40000);
    check.not_negative("intensity", light.intensity);
    check.not_negative("radius", light.radius);
    check.between("angle", light.angle_radians, 0, pi);
    check.between("outer cone", light.outer_cone_radians, 0, pi / 2);
    check.between("inner cone", light.inner_cone_radians, 0, light.outer_cone_radians);
    check.between("green tint", light.green_tint, -0.05, 0.05);
    check.between("spread", light.spread_radians, 0.001, pi);
    if (light.kind == Light::Kind::disk || light.kind == Light::Kind::sphere) check.positive("radius", light.radius);
    check.positive("width", light.width);
    check.positive("height", light.height);
    return std::move(check).done();
}

Result<void> validate(const Texture& texture) {
    Check check("texture", texture.name);
    if (const Image* image = texture.image.get()) {
        check.is(image->width > 0 && image->height > 0 && image->channels >= 1 && image->channels <= 4,
                 "image must have pixels in 1 to 4 channels");
        const size_t values = size_t(std::max(image->width, 0)) * size_t(std::max(image->height, 0)) * size_t(std::max(image->channels, 0));
        check.is(std::max(image->bytes.size(), image->floats.size()) == values && std::min(image->bytes.size(), image->floats.size()) == 0,
                 "image must hold width x height x channels values, of one kind");
    }
    return std::move(check).done();
}

Result<void> validate(const Camera& camera) {
    Check check("camera", camera.name);
    check.lens(camera.lens);
    return std::move(check).done();
}

Result<void> validate(const Lens& lens) {
    Check check("lens of the view");
    check.lens(lens);
    return std::move(check).done();
}

Result<void> validate(const Environment& environment) {
    Check check("environment");
    check.color("colour", environment.color);
    check.not_negative("intensity", environment.intensity);
    check.finite("rotation", environment.rotation_degrees);
    if (environment.kind == Environment::Kind::image) {
        const Image* image = environment.image.get();
        check.is(image && image->width > 0 && image->height > 0 && image->channels >= 3 && !image->floats.empty(),
                 "image must have float pixels with 3 or 4 channels");
    }
    const Sky& sky = environment.sky;
    check.between("turbidity", sky.turbidity, 1.7, 10);
    check.between("ground albedo", sky.ground_albedo, 0, 1);
    check.between("sun's elevation", sky.elevation_degrees, -90, 90);
    check.finite("sun's azimuth", sky.azimuth_degrees);
    check.between("latitude", sky.latitude_degrees, -90, 90);
    check.between("longitude", sky.longitude_degrees, -180, 180);
    check.between("year", sky.year, 1900, 2100);
    check.between("month", sky.month, 1, 12);
    check.between("day", sky.day, 1, 31);
    check.between("hour", sky.utc_hours, 0, 24);
    return std::move(check).done();
}

Result<void> validate(const LightMix& mix) {
    for (const MixChannel& channel : mix.channels) {
        Check check("mix of group", channel.group);
        check.not_negative("intensity", channel.intensity);
        check.color("colour", channel.color);
        check.between("temperature", channel.kelvin, 1000, 40000);
        if (auto valid = std::move(check).done(); !valid) return valid;
    }
    return {};
}

Result<void> validate(const RenderSettings& settings) {
    Check check("render settings");
    check.between("width", settings.width, 1, 65536);
    check.between("height", settings.height, 1, 65536);
    check.is(settings.resolution_scale > 0 && settings.resolution_scale <= 4,
             fmt::format("resolution scale must be above 0 and at most 4, not {}", settings.resolution_scale));
    check.not_negative("samples per pixel", double(settings.spp));
    check.not_negative("seconds", settings.seconds);
    check.not_negative("error", settings.error);
    check.not_negative("first sample", double(settings.first_sample));
    check.is(settings.spp == 0 || settings.first_sample < settings.spp,
             fmt::format("first sample must be below the last, {}, not {}", settings.spp, settings.first_sample));
    check.region("rendered region", settings.region);
    check.is(settings.max_bounces >= unlimited_bounces, fmt::format("bounces must be a number from 0, not {}", settings.max_bounces));
    check.is(!reuse_text(settings.reuse).empty(),
             fmt::format("pixels that reuse paths must be 0 (automatic), 1, 4, 8 or 16, not {}", settings.reuse));
    const Roulette& roulette = settings.roulette;
    check.not_negative("clamp", settings.clamp.limit);
    check.not_negative("roulette's start", roulette.start);
    check.between("roulette's floor", roulette.floor, 0, 1);
    check.is(roulette.cap > 0 && roulette.cap <= 1, fmt::format("roulette's cap must be above 0 and at most 1, not {}", roulette.cap));
    check.is(roulette.floor <= roulette.cap, "roulette's floor must not be above its cap");
    check.is(roulette.probability > 0 && roulette.probability <= 1,
             fmt::format("roulette's probability must be above 0 and at most 1, not {}", roulette.probability));
    check.between("roulette's threshold", roulette.threshold, 0, 1);
    return std::move(check).done();
}

Result<void> validate(const ViewSettings& settings) {
    Check check("view settings");
    check.between("exposure", settings.exposure_ev, -100, 100);
    check.is(settings.gamma > 0 && settings.gamma <= 100, fmt::format("gamma must be above 0 and at most 100, not {}", settings.gamma));
    check.color("white", settings.white);
    check.is(settings.white != Vec3{0, 0, 0}, "white must not be black");
    check.positive("lower end of the false colours", settings.false_color.low);
    check.positive("upper end of the false colours", settings.false_color.high);
    check.is(settings.false_color.low < settings.false_color.high, "the lower end of the false colours must be below the upper");
    if (settings.measured) check.region("measured region", *settings.measured);
    if (const float aspect = settings.frame_aspect.value_or(0); aspect != 0)
        check.between("aspect of the camera's frame", aspect, 0.01, 100);
    check.is(settings.meters.size() <= max_light_meters, fmt::format("there can be at most {} light meters", max_light_meters));
    for (const LightMeter& meter : settings.meters) {
        check.finite("light meter's position", meter.position);
        check.finite("light meter's normal", meter.normal);
        check.is(meter.normal != Vec3{0, 0, 0}, "light meter's normal must not be zero");
        check.not_negative("light meter's clearance", meter.clearance);
    }
    return std::move(check).done();
}

} // namespace blush
