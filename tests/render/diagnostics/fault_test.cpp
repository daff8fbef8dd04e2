// Invalid samples are traced to their cause: by hand-made vertices for every place, and end to end.
#include "render/diagnostics/fault_finder.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
using Kind = Fault::Kind;
using Place = Fault::Place;

// A valid vertex whose path escapes after `bounce` scatterings.
ReplayedVertex valid_vertex(int bounce) {
    ReplayedVertex v;
    v.bounce = bounce;
    v.path.ray = {{0, 0, 0}, {0, 0, 1}};
    v.path.beta = {1, 1, 1};
    v.path.pdf = 1;
    v.hit.geometry = -1;
    v.step.emits = v.step.connects = v.step.continues = v.step.non_finite = false;
    v.step.weights = {1, 1, 1, 1, 1, false, {1, 1, 1}};
    v.arrived = {0, 0, 0};
    return v;
}
std::optional<Fault> fault(const ReplayedVertex& v) { return fault_at(v, SceneTables{}); }

TEST(Fault, OfAValidVertexIsNone) { EXPECT_FALSE(fault(valid_vertex(0))); }

TEST(Fault, IsFoundInTheRay) {
    ReplayedVertex v = valid_vertex(0);
    v.path.ray.direction.y = nan;
    EXPECT_EQ(fault(v), (Fault{Kind::nan, Place::camera, 0}));
    v = valid_vertex(3);
    v.path.ray.origin.x = inf;
    EXPECT_EQ(fault(v), (Fault{Kind::infinite, Place::bsdf_sample, 3}));
}

TEST(Fault, IsFoundInLightAtInfinity) {
    ReplayedVertex v = valid_vertex(2);
    v.step.emitted = {0, -1, 0};
    EXPECT_FALSE(fault(v)) << "not added";
    v.step.emits = true;
    EXPECT_EQ(fault(v), (Fault{Kind::negative, Place::environment, 2}));
}

TEST(Fault, IsFoundInTheLightSampleAndItsDensities) {
    ReplayedVertex v = valid_vertex(1);
    v.step.connects = true;
    v.step.direct = {inf, 0, 0};
    EXPECT_FALSE(fault(v)) << "blocked";
    v.arrived = v.step.direct;
    EXPECT_EQ(fault(v), (Fault{Kind::infinite, Place::light_sample, 1}));
    v.step.weights.light_bsdf_pdf = 0;
    EXPECT_EQ(fault(v), (Fault{Kind::infinite, Place::light_sample, 1}));
    v.step.weights.light_bsdf_pdf = inf;
    EXPECT_EQ(fault(v), (Fault{Kind::overflowing_pdf, Place::bsdf_eval, 1}));
    v.step.weights.light_pdf = 0;
    EXPECT_EQ(fault(v), (Fault{Kind::zero_pdf, Place::light_sample, 1}));
    v.step.weights.light_pdf = inf;
    EXPECT_EQ(fault(v), (Fault{Kind::overflowing_pdf, Place::light_sample, 1}));
}

TEST(Fault, IsFoundInTheScatteredPath) {
    ReplayedVertex v = valid_vertex(4);
    v.step.next.beta = {nan, 1, 1};
    v.step.next.pdf = 1;
    EXPECT_FALSE(fault(v)) << "the path ended there";
    v.step.non_finite = true;
    EXPECT_EQ(fault(v), (Fault{Kind::nan, Place::bsdf_sample, 4}));
    v.step.next.pdf = 0;
    EXPECT_EQ(fault(v), (Fault{Kind::zero_pdf, Place::bsdf_sample, 4}));
    v.step.next.pdf = inf;
    EXPECT_EQ(fault(v), (Fault{Kind::nan, Place::bsdf_sample, 4})) << "a delta lobe";
}

struct Refused {
    Frame frame;
    std::string first_log;
};
Refused render_refused(const Scene& scene, const RenderSettings& settings = settings_for(16, 16, 4)) {
    Renderer renderer({.threads = 2, .planes = {}});
    renderer.update(scene, settings);
    renderer.render(0, settings.spp);
    Refused r{renderer.resolve(), {}};
    if (!r.frame.health.first.empty()) {
        const BadSample& bad = r.frame.health.first.front();
        r.first_log = trace_sample(scene, settings, bad.x, bad.y, bad.sample);
    }
    return r;
}
// All drops have one cause, and the log of a sample reports it too.
void expect_only(const Refused& r, Kind kind, Place place) {
    ASSERT_GT(r.frame.health.dropped(), 0);
    EXPECT_EQ(r.frame.health.count(kind, place), r.frame.health.dropped());
    EXPECT_NE(r.first_log.find(std::string(to_string(kind)) + " at " + std::string(to_string(place))), std::string::npos) << r.first_log;
    int64_t mapped = 0;
    for (const uint32_t count : r.frame.health.dropped_map) mapped += count;
    EXPECT_EQ(mapped, r.frame.health.dropped());
    for (const float value : r.frame.rgba) EXPECT_TRUE(std::isfinite(value) && value >= 0);
}

TEST(Fault, OfALightThatOverflowsSinglePrecision) {
    expect_only(render_refused(floor_under_an_overflowing_bulb()), Kind::infinite, Place::light_sample);
}

// One spot of the floor overflows: the rest of the image and the error estimate are as without it.
TEST(Fault, DoesNotPoisonTheErrorEstimate) {
    std::vector<Vec3> values(64, Vec3{1, 1, 1});
    values[0] = {3e38f, 3e38f, 3e38f};
    Scene scene;
    Material material = emitter(5, 0.5f);
    const Id<Texture> texture = add_texture(scene, float_image(8, 8, values));
    Texture unfiltered = *scene.textures.find(texture); // else its neighbours would be extremely bright but finite
    unfiltered.filter = Texture::Filter::nearest;
    scene.textures.set(texture, unfiltered);
    material.emissive_texture.texture = texture;
    place(scene, floor_quad(1), material);
    scene.environment.kind = Environment::Kind::sky; // not even, so that all pixels have noise
    scene.view = looking_down(1, 1);
    const Frame frame = render_refused(scene, settings_for(64, 64, 32)).frame;
    EXPECT_GT(frame.health.dropped(), 0);
    EXPECT_TRUE(frame.error.known);
    EXPECT_TRUE(std::isfinite(frame.error.relmse) && std::isfinite(frame.error.high));
}

} // namespace
} // namespace blush::test::TEST_FILE
