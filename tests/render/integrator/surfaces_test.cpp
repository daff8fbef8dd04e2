// Materials beyond reflection: textured emission, opacity, unlit colours, absorption; each against closed forms.
#include "core/math.h"
#include "tests/render/irradiance.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
constexpr Vec3d up{0, 1, 0};

ImagePtr two_texels(float left, float right) { return float_image(2, 1, std::vector<Vec3>{{left, left, left}, {right, right, right}}); }
// White, opaque on the right half.
ImagePtr half_opaque() {
    Image image;
    image.width = 2;
    image.height = 1;
    image.channels = 4;
    image.floats = {1, 1, 1, 0, 1, 1, 1, 1};
    return std::make_shared<const Image>(std::move(image));
}

// ---- emission

// uv (0, 0) is the first vertex: u is along x.
const GeometryPtr lamp = quad({-1, 1, -0.5f}, {0.6f, 1, -0.5f}, {0.6f, 1, 0.5f}, {-1, 1, 0.5f});
const std::vector<Vec3d> lamp_left = {{-1, 1, -0.5}, {-0.2, 1, -0.5}, {-0.2, 1, 0.5}, {-1, 1, 0.5}};
const std::vector<Vec3d> lamp_right = {{-0.2, 1, -0.5}, {0.6, 1, -0.5}, {0.6, 1, 0.5}, {-0.2, 1, 0.5}};

// Linear value of an sRGB-encoded one up to 1.
double decoded(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

TEST(Emission, OfATextureIsThatOfItsTexels) {
    for (const auto& [left, right] : {std::pair{1.f, 0.f}, {0.f, 1.f}, {0.5f, 1.f}})
        for (const Strategy strategy : {Strategy::mis, Strategy::light, Strategy::bsdf}) {
            Scene scene;
            Material material = emitter(4);
            material.emissive_texture.texture = add_texture(scene, two_texels(left, right));
            place(scene, lamp, material);
            RenderSettings settings = settings_for(16, 16, 64);
            settings.strategy = strategy;
            const auto expected = [&](const Vec3d& x) {
                return 4 * (decoded(double(left)) * polygon_irradiance(x, up, lamp_left) +
                            decoded(double(right)) * polygon_irradiance(x, up, lamp_right));
            };
            EXPECT_TRUE(shows_on_floor(scene, expected, sidak(significance, 9), settings)) << left << ", " << right;
        }
}

TEST(Emission, IsOneSidedOrTwoSided) {
    const GeometryPtr away = floor_quad(0.5f, 1);
    const std::vector<Vec3d> corners = {{-0.5, 1, 0.5}, {0.5, 1, 0.5}, {0.5, 1, -0.5}, {-0.5, 1, -0.5}};
    Material material = emitter(4);
    for (const bool double_sided : {false, true}) {
        material.double_sided = double_sided;
        Scene scene;
        place(scene, away, material);
        EXPECT_TRUE(shows_on_floor(
            scene, [&](const Vec3d& x) { return double_sided ? 4 * polygon_irradiance(x, up, corners) : 0; }, sidak(significance, 2)));
    }
}

TEST(Emission, OfUnlitSurfacesIsVisibleButEmitsNoLight) {
    Scene scene;
    place(scene, floor_quad(2), unlit({0.3f, 0.6f, 0.9f}));
    place_light(scene, Light{}, at({0, 1, 0}));
    scene.view = looking_down(1, 0.5f);
    for (const Vec3d& pixel : render(scene, settings_for(8, 8, 4)).pixels) {
        EXPECT_FLOAT_EQ(float(pixel.x), 0.3f);
        EXPECT_FLOAT_EQ(float(pixel.y), 0.6f);
        EXPECT_FLOAT_EQ(float(pixel.z), 0.9f);
    }
}

// ---- opacity

// A sheet between the floor and the light, large enough to cover the light completely.
Scene shaded_by(const Material& sheet, int sheets) {
    Scene scene;
    for (int i = 0; i < sheets; ++i) place(scene, floor_quad(100, 0.5f + 0.1f * float(i)), sheet);
    return scene;
}
Light parallel_sun() {
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    return sun;
}

TEST(Opacity, BlendedSheetsTransmitTheirShare) {
    Material sheet = lambert(0.f);
    sheet.alpha = Material::Alpha::blend;
    sheet.opacity = 0.3f;
    Light disk = parallel_sun();
    disk.angle_radians = 0.1f;
    const auto per_candela = [](const Vec3d& x) { return 3 / std::pow(dot(x, x) + 9, 1.5); };
    for (const int sheets : {1, 2, 3}) {
        const double through = std::pow(1 - double(sheet.opacity), sheets), alpha = sidak(significance, 12);
        Scene sun = shaded_by(sheet, sheets), sky = sun, point = sun, wide = sun;
        place_light(sun, parallel_sun(), aimed({0, 0, 0}, {0, -1, 0}));
        EXPECT_TRUE(shows_on_floor(
            sun, [&](const Vec3d&) { return 3 * through; }, alpha))
            << sheets << " sheets, parallel sun";
        place_light(wide, disk, aimed({0, 0, 0}, {0, -1, 0}));
        EXPECT_TRUE(shows_on_floor(
            wide, [&](const Vec3d&) { return 3 * through; }, alpha))
            << sheets << " sheets, wide sun";
        Light bulb;
        bulb.intensity = 3;
        place_light(point, bulb, at({0, 3, 0}));
        EXPECT_TRUE(shows_on_floor(
            point, [&](const Vec3d& x) { return 3 * through * per_candela(x); }, alpha))
            << sheets << " sheets, point";
    }
}

TEST(Opacity, BlendedSheetsAreSeenAndSeenThrough) {
    Scene scene;
    Material sheet = unlit({0.9f, 0.2f, 0.4f});
    sheet.alpha = Material::Alpha::blend;
    sheet.opacity = 0.3f;
    place(scene, floor_quad(2, 2), sheet);
    place(scene, floor_quad(2, 1), sheet);
    place(scene, floor_quad(2, 0), unlit({0.1f, 0.5f, 1}));
    scene.view = looking_down(1, 3);
    const double first = 0.3 + 0.7 * 0.3, last = 0.7 * 0.7;
    EXPECT_TRUE(is_mean(render(scene, settings_for(16, 16, 64)).whole(),
                        {0.9 * first + 0.1 * last, 0.2 * first + 0.5 * last, 0.4 * first + last}, significance, 1e-6));
}

TEST(Opacity, MasksAreAllOrNothing) {
    for (const float cutoff : {0.5f, 0.999f}) {
        Scene scene;
        Material sheet = lambert(0.f);
        sheet.alpha = Material::Alpha::mask;
        sheet.alpha_cutoff = cutoff;
        sheet.base_color_texture.texture = add_texture(scene, half_opaque());
        // Opaque where x > 0.
        place(scene, floor_quad(100, 0.5f), sheet);
        place_light(scene, parallel_sun(), aimed({0, 0, 0}, {0, -1, 0}));
        EXPECT_TRUE(shows_on_floor(
            scene, [](const Vec3d& x) { return x.x < 0 ? 3 : 0; }, sidak(significance, 2)));
    }
}

// ---- solids

TEST(Absorption, FollowsBeerAndLambert) {
    const Vec3 color{0.9f, 0.5f, 0.1f};
    Scene scene;
    Material solid = glass(0, 1); // no refraction: absorption only
    solid.attenuation_color = color;
    solid.attenuation_distance = 0.5f;
    Transform slab;
    slab.scale = {2, 0.4f, 2}; // 0.8 m high
    place(scene, cube(false), solid, slab);
    constant_world(scene, 2);
    scene.view = looking_down(1, 3);
    const double exponent = 0.8 / 0.5;
    const Vec3d expected{2 * std::pow(double(color.x), exponent), 2 * std::pow(double(color.y), exponent),
                         2 * std::pow(double(color.z), exponent)};
    EXPECT_TRUE(is_mean(render(scene, settings_for(8, 8, 8)).whole(), expected, significance, 1e-6));
}

// Light perpendicular to a pane is reflected back and forth inside: R + T of the geometric series, each pass absorbing.
TEST(Absorption, InAPaneThatReflects) {
    Scene scene;
    Material solid = glass(0, 1.5f);
    solid.attenuation_color = {0.25f, 0.25f, 0.25f};
    solid.attenuation_distance = 0.8f;
    Transform slab;
    slab.scale = {2, 0.4f, 2};
    place(scene, cube(false), solid, slab);
    constant_world(scene, 1);
    scene.view = looking_down(1, 3);
    const double r = 0.04, passage = 0.25;
    const double reflected = r + r * (1 - r) * (1 - r) * passage * passage / (1 - r * r * passage * passage);
    const double transmitted = (1 - r) * (1 - r) * passage / (1 - r * r * passage * passage);
    EXPECT_TRUE(is_mean(render(scene, settings_for(16, 16, 64)).whole(), reflected + transmitted, significance, 1e-6));
}

} // namespace
} // namespace blush::test::TEST_FILE
