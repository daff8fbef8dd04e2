#include "color/color_management.h"

#include "core/files.h"
#include "core/math.h"
#include "core/srgb.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <sstream>

namespace OCIO = OCIO_NAMESPACE;

namespace blush {

struct ColorManagement::State {
    OCIO::ConstConfigRcPtr config;
    std::filesystem::path file;
    std::string warning;
};

namespace {

// Exact arithmetic where OCIO would trade precision for speed, so that CPU and shader agree; no dynamic properties, because their
// uniforms would not be set.
constexpr auto exact_arithmetic =
    OCIO::OptimizationFlags(OCIO::OPTIMIZATION_LOSSLESS | OCIO::OPTIMIZATION_LUT_INV_FAST | OCIO::OPTIMIZATION_NO_DYNAMIC_PROPERTIES);

// The largest half float: the end of OCIO's tables for scene-linear values.
constexpr float max_half = 65504;
constexpr float min_gamma = 0.01f;

// Limit of a config's size in bytes: ACES configs have less than two million.
constexpr uint64_t max_config_bytes = 8 << 20;

// Names of our working space in common configs, our own first.
constexpr const char* working_space_names[] = {"Linear Rec.709",          "lin_rec709",
                                               "Linear Rec.709 (sRGB)",   "lin_srgb",
                                               "Utility - Linear - sRGB", "Utility - Linear - Rec.709",
                                               "Linear BT.709",           "scene-linear Rec.709-sRGB"};

// OCIO's message on one line.
Error failure(const std::exception& e, std::string file, std::string where) {
    std::string what = e.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    what.erase(what.find_last_not_of(' ') + 1);
    return {std::move(file), std::move(what), std::move(where)};
}

OCIO::TransformRcPtr builtin(const char* style, OCIO::TransformDirection direction) {
    auto transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

const char* working_space_of(const OCIO::Config& config) {
    for (const char* name : working_space_names)
        if (config.getColorSpace(name)) return name;
    return nullptr;
}

bool is_data_view(const OCIO::Config& config, const std::string& display, const std::string& view) {
    const auto space = config.getColorSpace(config.getDisplayViewColorSpaceName(display.c_str(), view.c_str()));
    return space && space->isData();
}

// From the working space to the display. Raw views pass values unchanged. Configs without our working space are entered through
// ACES2065-1; if that is missing too, the config's working space is assumed to be Rec.709.
OCIO::ConstTransformRcPtr display_transform(const OCIO::Config& config, const DisplayTransform& names) {
    auto group = OCIO::GroupTransform::Create();
    if (is_data_view(config, names.display, names.view)) return group;

    const char* source = working_space_of(config);
    if (!source && config.hasRole(OCIO::ROLE_INTERCHANGE_SCENE)) {
        group->appendTransform(builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", OCIO::TRANSFORM_DIR_INVERSE));
        group->appendTransform(builtin("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_FORWARD));
        source = OCIO::ROLE_INTERCHANGE_SCENE;
    } else if (!source) {
        source = OCIO::ROLE_SCENE_LINEAR;
    }
    if (!names.look.empty()) {
        auto look = OCIO::LookTransform::Create();
        look->setSrc(source);
        look->setDst(source);
        look->setLooks(names.look.c_str());
        group->appendTransform(look);
    }
    auto to_display = OCIO::DisplayViewTransform::Create();
    to_display->setSrc(source);
    to_display->setDisplay(names.display.c_str());
    to_display->setView(names.view.c_str());
    to_display->setLooksBypass(!names.look.empty());
    group->appendTransform(to_display);
    return group;
}

std::vector<std::string> displays_of(const OCIO::Config& config) {
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumDisplays(); ++i) names.emplace_back(config.getDisplay(i));
    return names;
}

std::vector<std::string> views_of(const OCIO::Config& config, const std::string& display) {
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumViews(display.c_str()); ++i) names.emplace_back(config.getView(display.c_str(), i));
    return names;
}

std::vector<std::string> looks_of(const OCIO::Config& config) {
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumLooks(); ++i) names.emplace_back(config.getLookNameByIndex(i));
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// With defaults filled in.
Result<OCIO::ConstProcessorRcPtr> make_processor(const OCIO::Config& config, DisplayTransform names) {
    if (names.display.empty()) names.display = config.getDefaultDisplay();
    const auto displays = displays_of(config);
    if (!contains(displays, names.display))
        return Error{{}, fmt::format("no display \"{}\"; there are: {}", names.display, fmt::join(displays, ", ")), {}};
    if (names.view.empty()) names.view = config.getDefaultView(names.display.c_str());
    const auto views = views_of(config, names.display);
    if (!contains(views, names.view))
        return Error{
            {}, fmt::format("no view \"{}\" for display \"{}\"; there are: {}", names.view, names.display, fmt::join(views, ", ")), {}};
    if (const auto looks = looks_of(config); !names.look.empty() && !contains(looks, names.look))
        return Error{{}, fmt::format("no look \"{}\"; there are: {}", names.look, fmt::join(looks, ", ")), {}};
    try {
        return config.getProcessor(display_transform(config, names));
    } catch (const std::exception& e) { return failure(e, {}, fmt::format("view \"{}\" of display \"{}\"", names.view, names.display)); }
}

// A parsed and validated config. User configs must also be able to build their default view, so that a missing table is found
// here and not at the first image.
Result<OCIO::ConstConfigRcPtr> open_config(const std::filesystem::path& file, bool prove_default_view) {
    try {
        const Result<std::vector<uint8_t>> bytes = read_file(file, max_config_bytes);
        if (!bytes) return bytes.error();
        std::istringstream text(std::string(bytes->begin(), bytes->end()));
        const OCIO::ConfigRcPtr config = OCIO::Config::CreateFromStream(text)->createEditableCopy();
        config->setWorkingDir(std::filesystem::absolute(file).parent_path().c_str()); // location of its tables
        config->validate();
        if (config->getNumDisplays() == 0) return Error{file.string(), "the OpenColorIO config has no display", {}};
        if (prove_default_view) {
            auto processor = make_processor(*config, {});
            if (!processor) return Error{file.string(), processor.error().what, processor.error().where};
        }
        return OCIO::ConstConfigRcPtr(config);
    } catch (const std::exception& e) { return failure(e, file.string(), {}); }
}

// NaN becomes black, infinities the ends of the range.
float sanitized(float x, float limit = max_half) { return std::isnan(x) ? 0.0f : std::clamp(x, -limit, limit); }
Vec3 sanitized(const Vec3& v, float limit = max_half) { return {sanitized(v.x, limit), sanitized(v.y, limit), sanitized(v.z, limit)}; }

// Limit of scene values: brighter than any light, and safe from overflow in white balance.
constexpr float max_scene_value = 1e30f;

Vec3 as_it_is(const Vec3& scene) {
    return {srgb_from_linear(clamp01(scene.x)), srgb_from_linear(clamp01(scene.y)), srgb_from_linear(clamp01(scene.z))};
}

// The steps of apply_display() as GLSL, in the same order, around OCIO's function `ocio_display`.
constexpr const char* shader_frame = R"(
uniform float exposure_ev;
uniform float gamma;
uniform mat3 white_balance;
uniform int false_color_of;
uniform float false_color_low, false_color_high;
uniform bool background_as_it_is;

{ocio}

const vec3 false_colors[{false_colors}] = vec3[]({false_color_list});

float sanitized(float x, float limit) {{ return isnan(x) ? 0.0 : clamp(x, -limit, limit); }}
vec3 sanitized(vec3 v, float limit) {{ return vec3(sanitized(v.r, limit), sanitized(v.g, limit), sanitized(v.b, limit)); }}
vec3 srgb_from_linear(vec3 v) {{
    return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, vec3(greaterThan(v, vec3(0.0031308))));
}}

vec3 false_color(vec3 color) {{
    float y = dot(color, vec3({luminance_weights}));
    float t = (log2(max(y, 1e-37)) - false_color_low) / (false_color_high - false_color_low);
    return false_colors[y > 0.0 ? int(clamp(floor(t * {bands}.0) + 1.0, 0.0, {bands}.0 + 1.0)) : 0];
}}

vec3 displayed(vec3 scene) {{
    vec3 exposed = sanitized(white_balance * scene * exp2(exposure_ev), {limit});
#ifdef ALL_STEPS
    if (false_color_of != 0) return false_color(false_color_of == 1 ? scene : exposed);
#endif
    vec3 encoded = clamp(sanitized(ocio_display(vec4(exposed, 1.0)).rgb, {limit}), 0.0, 1.0);
#ifdef ALL_STEPS
    encoded = pow(encoded, vec3(1.0 / max(gamma, {smallest_gamma})));
#endif
    return encoded;
}}

vec4 display_color(vec4 scene_linear) {{
    vec3 scene = sanitized(scene_linear.rgb, {largest_scene});
    vec3 shown = displayed(scene);
#ifdef ALL_STEPS
    if (background_as_it_is) shown = mix(srgb_from_linear(clamp(scene, 0.0, 1.0)), shown, scene_linear.a);
#endif
    return vec4(shown, scene_linear.a);
}}
)";

std::string false_color_list() {
    std::string list;
    for (const Vec3& c : false_colors) list += fmt::format("{}vec3({:.8f}, {:.8f}, {:.8f})", list.empty() ? "" : ", ", c.x, c.y, c.z);
    return list;
}

std::vector<DisplayShader::Lut> luts_of(const OCIO::GpuShaderDesc& description) {
    std::vector<DisplayShader::Lut> luts;
    const char *texture = nullptr, *sampler = nullptr;
    const float* values = nullptr;
    OCIO::Interpolation interpolation = OCIO::INTERP_LINEAR;
    for (unsigned i = 0; i < description.getNumTextures(); ++i) {
        unsigned width = 0, height = 0;
        OCIO::GpuShaderDesc::TextureType type = OCIO::GpuShaderDesc::TEXTURE_RGB_CHANNEL;
        description.getTexture(i, texture, sampler, width, height, type, interpolation);
        description.getTextureValues(i, values);
        const int channels = type == OCIO::GpuShaderDesc::TEXTURE_RED_CHANNEL ? 1 : 3;
        luts.push_back({.sampler = sampler,
                        .dimensions = height > 1 ? 2 : 1, // OCIO declares a sampler1D for a table of one row
                        .width = int(width),
                        .height = int(height),
                        .depth = 1,
                        .channels = channels,
                        .linear = interpolation != OCIO::INTERP_NEAREST,
                        .values = {values, values + size_t(width) * height * size_t(channels)}});
    }
    for (unsigned i = 0; i < description.getNum3DTextures(); ++i) {
        unsigned edge = 0;
        description.get3DTexture(i, texture, sampler, edge, interpolation);
        description.get3DTextureValues(i, values);
        luts.push_back({.sampler = sampler,
                        .dimensions = 3,
                        .width = int(edge),
                        .height = int(edge),
                        .depth = int(edge),
                        .channels = 3,
                        .linear = interpolation != OCIO::INTERP_NEAREST,
                        .values = {values, values + size_t(edge) * edge * edge * 3}});
    }
    return luts;
}

} // namespace

Result<ColorManagement> ColorManagement::load(const std::filesystem::path& assets, const std::filesystem::path& config_file) {
    const std::filesystem::path ours = assets / "ocio" / "config.ocio";
    std::filesystem::path wanted = config_file;
    if (const char* environment = std::getenv("OCIO"); wanted.empty() && environment) wanted = environment;

    auto state = std::make_unique<State>();
    state->file = wanted.empty() ? ours : wanted;
    auto config = open_config(state->file, state->file != ours);
    if (!config && state->file != ours) {
        state->warning = config.error().text() + "; using Blush's own OpenColorIO config instead";
        state->file = ours;
        config = open_config(ours, false);
    }
    if (!config) return config.error();
    state->config = *config;
    return ColorManagement(std::move(state));
}

ColorManagement::ColorManagement(std::unique_ptr<State> state) : state_(std::move(state)) {}
ColorManagement::ColorManagement(ColorManagement&&) noexcept = default;
ColorManagement& ColorManagement::operator=(ColorManagement&&) noexcept = default;
ColorManagement::~ColorManagement() = default;

const std::string& ColorManagement::warning() const { return state_->warning; }

std::string ColorManagement::config_name() const {
    const std::string name = state_->config->getName();
    return name.empty() ? state_->file.string() : name;
}

std::vector<std::string> ColorManagement::displays() const { return displays_of(*state_->config); }
std::vector<std::string> ColorManagement::views(std::string_view display) const { return views_of(*state_->config, std::string(display)); }
std::string ColorManagement::default_display() const { return state_->config->getDefaultDisplay(); }
std::string ColorManagement::default_view(std::string_view display) const {
    return state_->config->getDefaultView(std::string(display).c_str());
}
std::vector<std::string> ColorManagement::looks() const { return looks_of(*state_->config); }

Result<DisplayShader> ColorManagement::display_shader(const DisplayTransform& transform) const {
    auto processor = make_processor(*state_->config, transform);
    if (!processor) return processor.error();
    try {
        auto description = OCIO::GpuShaderDesc::CreateShaderDesc();
        description->setLanguage(OCIO::GPU_LANGUAGE_GLSL_1_3); // the newest one supported by GLSL 3.30
        description->setFunctionName("ocio_display");
        description->setResourcePrefix("ocio_");
        (*processor)->getOptimizedGPUProcessor(exact_arithmetic)->extractGpuShaderInfo(description);
        return DisplayShader{fmt::format(shader_frame, fmt::arg("ocio", description->getShaderText()),
                                         fmt::arg("limit", fmt::format("{:.1f}", max_half)), fmt::arg("largest_scene", max_scene_value),
                                         fmt::arg("luminance_weights", fmt::format("{:.6f}, {:.6f}, {:.6f}", luminance_weights.x,
                                                                                   luminance_weights.y, luminance_weights.z)),
                                         fmt::arg("smallest_gamma", min_gamma), fmt::arg("bands", false_color_bands),
                                         fmt::arg("false_colors", false_colors.size()), fmt::arg("false_color_list", false_color_list())),
                             luts_of(*description)};
    } catch (const std::exception& e) { return failure(e, {}, "display shader"); }
}

Result<void> ColorManagement::apply_display(const DisplayTransform& transform, const DisplayParameters& numbers, float* rgb, size_t count,
                                            const float* coverage) const {
    auto processor = make_processor(*state_->config, transform);
    if (!processor) return processor.error();

    const float gain = std::exp2(numbers.exposure_ev);
    const float power = 1 / std::max(min_gamma, numbers.gamma);
    const FalseColorScale& scale = numbers.false_color;
    const bool background = numbers.background_as_it_is && coverage;
    constexpr size_t chunk = 4096; // pixels: fits the L1 cache
    std::vector<Vec3> scene(std::min(chunk, count)), shown(scene.size());
    try {
        const auto cpu = (*processor)->getOptimizedCPUProcessor(exact_arithmetic);
        for (size_t done = 0; done < count; done += chunk) {
            const size_t pixels = std::min(chunk, count - done);
            float* const values = rgb + done * 3;
            for (size_t i = 0; i < pixels; ++i) {
                scene[i] = sanitized({values[3 * i], values[3 * i + 1], values[3 * i + 2]}, max_scene_value);
                shown[i] = sanitized(transform_vector(numbers.white_balance, scene[i]) * gain);
            }
            if (scale.of == FalseColorScale::Of::off) {
                OCIO::PackedImageDesc row(&shown[0].x, long(pixels), 1, 3);
                cpu->apply(row);
                const auto bent = [&](float x) { return std::pow(std::clamp(sanitized(x), 0.0f, 1.0f), power); };
                for (size_t i = 0; i < pixels; ++i) shown[i] = {bent(shown[i].x), bent(shown[i].y), bent(shown[i].z)};
            } else {
                const auto& read = scale.of == FalseColorScale::Of::scene ? scene : shown;
                for (size_t i = 0; i < pixels; ++i) shown[i] = false_colors[size_t(false_color_band(luminance(read[i]), scale))];
            }
            for (size_t i = 0; i < pixels; ++i) {
                const Vec3 c = background ? lerp<float>(as_it_is(scene[i]), shown[i], coverage[done + i]) : shown[i];
                values[3 * i] = c.x;
                values[3 * i + 1] = c.y;
                values[3 * i + 2] = c.z;
            }
        }
    } catch (const std::exception& e) { return failure(e, {}, "display transform"); }
    return {};
}

} // namespace blush
