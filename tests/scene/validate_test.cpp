#include "scene/validate.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <limits>

namespace blush::TEST_FILE {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

// Sets one field of a default record and says whether validate() still accepts it.
template <class Record, class Field, class Value> bool accepts(Field Record::*field, Value value) {
    Record record{};
    record.*field = Field(value);
    return bool(validate(record));
}

TEST(Validate, DefaultsAreValid) {
    EXPECT_TRUE(validate(Node{}));
    EXPECT_TRUE(validate(Material{}));
    EXPECT_TRUE(validate(Light{}));
    EXPECT_TRUE(validate(Texture{}));
    EXPECT_TRUE(validate(Camera{}));
    EXPECT_TRUE(validate(Lens{}));
    EXPECT_TRUE(validate(Environment{}));
    EXPECT_TRUE(validate(RenderSettings{}));
    EXPECT_TRUE(validate(ViewSettings{}));
    EXPECT_TRUE(validate(Scene{}));
    EXPECT_TRUE(validate(test::sample_project().project.scene));
}

TEST(Validate, MaterialRanges) {
    for (const auto field : {&Material::opacity, &Material::metallic, &Material::roughness, &Material::specular, &Material::transmission}) {
        EXPECT_TRUE(accepts(field, 0) && accepts(field, 1));
        EXPECT_FALSE(accepts(field, -0.01f) || accepts(field, 1.01f) || accepts(field, nan));
    }
    for (const auto field : {&Material::emissive_strength, &Material::alpha_cutoff, &Material::thickness, &Material::attenuation_distance})
        EXPECT_FALSE(accepts(field, -1) || accepts(field, infinite) || accepts(field, nan));
    EXPECT_TRUE(accepts(&Material::ior, 0)) << "an infinite index in KHR_materials_ior";
    EXPECT_FALSE(accepts(&Material::ior, 0.5f));
    EXPECT_FALSE(accepts(&Material::base_color, Vec3{-1, 0, 0}));
}

TEST(Validate, LightRanges) {
    for (const auto field : {&Light::intensity, &Light::radius, &Light::width, &Light::height, &Light::angle_radians})
        EXPECT_FALSE(accepts(field, -1) || accepts(field, nan) || accepts(field, infinite));
    EXPECT_FALSE(accepts(&Light::kelvin, 500) || accepts(&Light::kelvin, 50000));
    EXPECT_FALSE(accepts(&Light::inner_cone_radians, 1)) << "wider than the outer cone";
    EXPECT_FALSE(accepts(&Light::outer_cone_radians, 2));
}

TEST(Validate, TransformsMustBeFiniteAndTurnable) {
    Node node;
    node.local.rotation = {0, 0, 0, 0};
    EXPECT_FALSE(validate(node));
    node.local.rotation = {};
    node.local.matrix = Affine{};
    node.local.matrix->t.x = infinite;
    EXPECT_FALSE(validate(node));
    node.local.matrix.reset();
    node.local.scale = {0, 1, 1};
    EXPECT_TRUE(validate(node)) << "flat is allowed";
}

TEST(Validate, PixelsMustBeThere) {
    Image image;
    image.width = image.height = 2;
    image.channels = 3;
    image.bytes.resize(11);
    Texture texture;
    texture.image = std::make_shared<const Image>(image);
    EXPECT_FALSE(validate(texture));
    image.bytes.resize(12);
    texture.image = std::make_shared<const Image>(image);
    EXPECT_TRUE(validate(texture));
    image.floats.resize(12);
    texture.image = std::make_shared<const Image>(image);
    EXPECT_FALSE(validate(texture)) << "two kinds of values at once";

    Environment environment;
    environment.kind = Environment::Kind::image;
    EXPECT_FALSE(validate(environment));
    environment.image = test::byte_image(2, 1, 3, 1);
    EXPECT_FALSE(validate(environment)) << "not in float";
    environment.image = test::uniform_image(2, 1, 3, 1);
    EXPECT_TRUE(validate(environment));
}

TEST(Validate, GeometryMustBeConsistent) {
    const auto with = [](auto&& change) {
        Geometry g = *test::quad_geometry();
        change(g);
        Mesh mesh;
        mesh.parts.push_back({std::make_shared<const Geometry>(std::move(g)), {}});
        return bool(validate(mesh));
    };
    EXPECT_TRUE(with([](Geometry&) {}));
    EXPECT_FALSE(with([](Geometry& g) { g.indices[3] = 4; }));
    EXPECT_FALSE(with([](Geometry& g) { g.indices.pop_back(); }));
    EXPECT_FALSE(with([](Geometry& g) { g.uv.push_back(GeometryArray<Vec2>(3)); }));
    Mesh empty;
    empty.parts.push_back({});
    EXPECT_FALSE(validate(empty));
}

TEST(Validate, RenderSettingsRanges) {
    using R = RenderSettings;
    EXPECT_FALSE(accepts(&R::height, 65537) || accepts(&R::resolution_scale, 0) || accepts(&R::spp, -1) || accepts(&R::seconds, nan) ||
                 accepts(&R::error, -1) || accepts(&R::first_sample, -1) || accepts(&R::max_bounces, -2) || accepts(&R::reuse, 5));
    EXPECT_FALSE(accepts(&R::first_sample, 64)) << "nothing left of 64 samples";
    EXPECT_TRUE(accepts(&R::spp, 0)) << "no limit";
    EXPECT_TRUE(accepts(&R::adaptive, true));
    R late;
    late.adaptive = true;
    late.first_sample = 16;
    EXPECT_TRUE(validate(late)) << "a part of an adaptive image";
    const auto roulette = [](auto&& change) {
        R settings;
        change(settings.roulette);
        return bool(validate(settings));
    };
    EXPECT_FALSE(roulette([](Roulette& r) { r.floor = 0.9f, r.cap = 0.5f; }));
    EXPECT_FALSE(roulette([](Roulette& r) { r.cap = 0; }));
    EXPECT_FALSE(roulette([](Roulette& r) { r.probability = 0; }));
    EXPECT_FALSE(roulette([](Roulette& r) { r.start = -1; }));
}

// Edits of a valid scene give a valid scene.
TEST(Validate, HoldsThroughRandomEdits) {
    test::Rng rng(11);
    Project project = test::sample_project().project;
    for (int i = 0; i < 300; ++i) {
        project = *blush::apply(project, test::random_edit(rng, project));
        const Result<void> valid = validate(project.scene);
        ASSERT_TRUE(valid) << valid.error().text();
    }
}

} // namespace
} // namespace blush::TEST_FILE
