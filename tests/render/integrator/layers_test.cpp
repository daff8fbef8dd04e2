// Rendered tests of clear coats, sheen, thin films, anisotropic and translucent surfaces, and dispersive glass.
#include "render/integrator/dispersion.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// Smooth normals and tangents along +X.
GeometryPtr brushed_quad(float half, const Vec4& tangent = {1, 0, 0, 1}) {
    Geometry g = *floor_quad(half);
    g.serial = next_payload_serial();
    g.normals.assign(4, {0, 1, 0});
    g.tangents.assign(4, tangent);
    return std::make_shared<const Geometry>(g);
}

Material coated(Material m, float roughness) {
    m.clearcoat = 1;
    m.clearcoat_roughness = roughness;
    return m;
}
Material with_sheen(Material m, float roughness) {
    m.sheen_color = {0.9f, 0.7f, 0.8f};
    m.sheen_roughness = roughness;
    return m;
}
Material stretched(Material m, float anisotropy) {
    m.anisotropy = anisotropy;
    return m;
}
Material under_film(Material m, float nanometres) {
    m.iridescence = 1;
    m.iridescence_thickness_maximum = nanometres;
    return m;
}
Material translucent(Material m, float share) {
    m.diffuse_transmission = share;
    m.diffuse_transmission_color = {0.9f, 0.6f, 0.3f};
    return m;
}
Material dispersive(Material m, float dispersion) {
    m.dispersion = dispersion;
    return m;
}

// Each material on its own sphere, three rows of four, between a coated area light, a floor and a sky.
Scene grid(const std::vector<Material>& materials) {
    Scene scene;
    place(scene, floor_quad(6), lambert(0.5f));
    place(scene, ceiling_quad(1.5f, 4), coated(emitter(8), 0.3f));
    for (size_t i = 0; i < materials.size(); ++i)
        place(scene, sphere(false), materials[i],
              at({float(i % 4) * 1.1f - 1.65f, 0.5f + 0.2f * float(i / 4), 1.2f - float(i / 4) * 1.1f}, 0.45f));
    constant_world(scene, 0.3f);
    scene.view = looking({0, 4, 5}, {0, 0.4f, 0}, 0.65f);
    return scene;
}

std::vector<Measured> blocks(const Scene& scene, Strategy strategy, int64_t spp) {
    RenderSettings settings = settings_for(32, 24, spp);
    settings.strategy = strategy;
    settings.seed = 4 + uint32_t(strategy);
    return render(scene, settings).blocks(8, 8);
}

TEST(Layers, StrategiesAgreeOnAGrid) {
    const Material red = [] {
        Material m = plastic(0.5f);
        m.base_color = {0.7f, 0.2f, 0.1f};
        return m;
    }();
    Material wax = translucent(red, 0.6f);
    wax.thickness = 1;
    const std::vector<Material> materials = {coated(red, 0.3f),
                                             coated(metal(0.6f), 0.3f),
                                             with_sheen(red, 0.2f),
                                             with_sheen(red, 0.6f),
                                             stretched(metal(0.3f), 0.6f),
                                             under_film(metal(0.4f), 300),
                                             under_film(red, 450),
                                             translucent(red, 0.5f),
                                             wax,
                                             coated(with_sheen(red, 0.4f), 0.4f),
                                             dispersive(glass(0.4f, 1.5f), 2),
                                             coated(glass(0.5f, 1.3f), 0.4f)};
    const Scene scene = grid(materials);
    const auto mis = blocks(scene, Strategy::mis, 64);
    EXPECT_TRUE(same_means(mis, blocks(scene, Strategy::light, 128), sidak(significance, 2))) << "light";
    EXPECT_TRUE(same_means(mis, blocks(scene, Strategy::bsdf, 256), sidak(significance, 2))) << "bsdf";
}

TEST(Layers, WhiteFurnacesStayWhite) {
    Material paper = lambert(1), wax = lambert(1);
    paper.diffuse_transmission = wax.diffuse_transmission = 0.6f;
    wax.thickness = 1;
    const auto varnished = [](const Material& m) { return coated(m, 0); };
    const std::vector<Material> lossless = {varnished(lambert(1)),
                                            varnished(metal(0)),
                                            varnished(glass(0, 1.5f)),
                                            paper,
                                            wax,
                                            dispersive(glass(0, 1.5f), 1),
                                            dispersive(varnished(glass(0, 2.4f)), 0.36f)};
    for (size_t i = 0; i < lossless.size(); ++i) {
        Scene scene;
        place(scene, sphere(false), lossless[i]);
        constant_world(scene, 1);
        scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
        EXPECT_TRUE(is_mean(render(scene, settings_for(16, 16, 64)).whole(), 1, sidak(significance, int64_t(lossless.size())))) << i;
    }
}

// A clear coat attenuates emission at grazing views: 1 - clearcoat * Schlick(0.04).
TEST(Layers, ClearCoatsDimEmissionBelow) {
    for (const double degrees : {0.0, 60.0, 80.0}) {
        const double a = degrees * std::numbers::pi / 180, cos = std::cos(a);
        Scene scene;
        Material lamp = coated(emitter(2), 0.2f);
        lamp.clearcoat = 0.75f;
        place(scene, floor_quad(100), lamp);
        scene.view = looking({float(5 * std::sin(a)), float(5 * cos), 0}, {0, 0, 0}, 0.5f);
        scene.view.lens.orthographic = true;
        scene.view.lens.ymag = 0.5f;
        const double expected = 2 * (1 - 0.75 * (0.04 + 0.96 * std::pow(1 - cos, 5)));
        EXPECT_TRUE(is_mean(render(scene, settings_for(8, 8, 4)).whole(), expected, significance, 1e-4)) << degrees;
    }
}

// Anisotropy along the tangents, and the same by a rotation from other tangents: highlights are long in this direction only.
TEST(Layers, AnisotropyFollowsTheTangents) {
    const auto image = [](const Vec4& tangent, float rotation) {
        Scene scene;
        Material m = stretched(metal(0.25f), 0.9f);
        m.anisotropy_rotation_radians = rotation;
        place(scene, brushed_quad(4, tangent), m);
        Light lamp;
        lamp.intensity = 10;
        place_light(scene, lamp, at({0, 3, 0}));
        scene.view = looking_down(3, 6);
        return render(scene, settings_for(32, 32, 16)).blocks(8, 8); // four by four
    };
    const float quarter = std::numbers::pi_v<float> / 2;
    const auto along_x = image({1, 0, 0, 1}, 0);
    EXPECT_TRUE(same_means(along_x, image({0, 0, 1, 1}, quarter))); // the bitangent is cross(+Y, +Z) = +X
    EXPECT_TRUE(same_means(along_x, image({0, 0, 1, -1}, -quarter)));
    EXPECT_FALSE(same_means(along_x, image({0, 0, 1, 1}, 0)));
    // Bright far along x, dark far across.
    EXPECT_GT(along_x[1 * 4 + 3].mean.x, 3 * along_x[3 * 4 + 1].mean.x);
}

TEST(Layers, ClearCoatsHaveTheirOwnNormals) {
    // A mirror-like coat on black reflects the sun only if its own normal map, not the base's, turns it there.
    const auto brightness = [](bool coat_map, bool base_map) {
        Scene scene;
        Material m = coated(lambert(0), 0.2f);
        const Id<Texture> leaning =
            add_texture(scene, float_image(1, 1, std::vector<Vec3>{{0.75f, 0.5f, 0.93301f}})); // by 30 degrees to +X
        if (coat_map) m.clearcoat_normal_texture.texture = leaning;
        if (base_map) m.normal_texture.texture = leaning;
        place(scene, brushed_quad(4), m);
        Light sun;
        sun.kind = Light::Kind::sun;
        constexpr float turn = std::numbers::pi_v<float> / 3; // from the zenith
        place_light(scene, sun, aimed({0, 0, 0}, {-std::sin(turn), -std::cos(turn), 0}));
        scene.view = looking_down(1, 5);
        return render(scene, settings_for(8, 8, 16)).whole().mean.y;
    };
    EXPECT_GT(brightness(true, false), 10 * brightness(false, false));
    EXPECT_NEAR(brightness(false, true), brightness(false, false), 1e-3 * brightness(false, false));
}

TEST(Dispersion, SpectrumAveragesToWhite) {
    const Spectrum& spectrum = visible_spectrum();
    Vec3d sum{0, 0, 0};
    for (int i = 0; i < Spectrum::steps; ++i) {
        sum = sum + Vec3d{spectrum.rgb[3 * i], spectrum.rgb[3 * i + 1], spectrum.rgb[3 * i + 2]};
        EXPECT_GE(spectrum.nanometres[i], i > 0 ? spectrum.nanometres[i - 1] : 380);
        for (int c = 0; c < 3; ++c) EXPECT_GE(spectrum.rgb[3 * i + c], 0);
    }
    for (const double channel : {sum.x, sum.y, sum.z}) EXPECT_NEAR(channel / Spectrum::steps, 1, 1e-6);
    EXPECT_LT(spectrum.nanometres[Spectrum::steps - 1], 730);
}

// n_d at 587.6 nm; n_F - n_C = (n_d - 1) / V between 486.1 and 656.3 nm, as far as the specification's constants have digits.
TEST(Dispersion, IndicesAreThoseOfTheAbbeNumber) {
    for (const float abbe : {20.f, 55.f}) {
        const auto at = [&](float nanometres) { return dispersed_ior(1.5f, 20 / abbe, nanometres); };
        EXPECT_NEAR(at(587.6f), 1.5, 5e-4 * 0.5 / abbe);
        EXPECT_NEAR(at(486.1f) - at(656.3f), 0.5 / abbe, 5e-4 * 0.5 / abbe);
    }
    EXPECT_EQ(dispersed_ior(1.01f, 1000.f, 700.f), 1); // never below that of a vacuum
}

} // namespace
} // namespace blush::test::TEST_FILE
