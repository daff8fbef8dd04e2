// Reciprocity: f(wo, wi) n_i^2 = f(wi, wo) n_o^2 (Veach 1997, equation 5.14), and delta lobes for light paths (adjoint.h). Not reciprocal
// by their definition are three kinds of layering, each of which has a test of its own size below: that of a coat, energy compensation, and
// diffuse transmission into a solid.
#include "shading/adjoint.h"
#include "tests/shading/reference.h"
#include "tests/support/statistics.h"

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

// Index of refraction on the side of w.
double index_of(const Params& p, const Vec3& w) {
    const bool refracts = p.specular > 0 || p.transmission > 0;
    return is_solid(p) && refracts && w.z < 0 ? p.ior : 1;
}
// f(wo, wi) times the squared index of the side of wi, green. A viewer of a thin wall is above it.
double scattered(const Params& p, const Vec3& wo, const Vec3& wi, const EnergyTable* energy = nullptr) {
    const float up = !is_solid(p) && wo.z < 0 ? -1.f : 1.f;
    const Vec3 o{wo.x, wo.y, up * wo.z}, i{wi.x, wi.y, up * wi.z};
    return eval<all_features>(make_bsdf<all_features>(p, o, energy), o, i).f_cos.y / double(std::abs(wi.z)) *
           reference::sqr(index_of(p, wi));
}
double bound_of_both(const Params& p, const Vec3& wo, const Vec3& wi) {
    double bound = reference::relative_bound(p, wo, wi) + reference::relative_bound(p, wi, wo);
    if (is_solid(p) && wo.z < 0 && wi.z < 0) { // reflection inside rises like a root up to the critical angle
        const double c2 = 0.5 + 0.5 * dot(reference::to_double(wo), reference::to_double(wi));
        bound += 4 * float_rounding / std::sqrt(std::max(std::abs(1 / reference::sqr(p.ior) - 1 + c2), 1e-12));
    }
    return bound;
}
// Pairs of directions, none grazing; half of them are sampled from the lobes.
template <class Visit> int for_each_pair(const Params& p, int count, Random& random, const Visit& visit) {
    int compared = 0;
    for (int i = 0; i < count; ++i) {
        Vec3 wo = random.direction();
        if (!is_solid(p)) wo.z = std::abs(wo.z);
        const BsdfSample<float> s = sample_next<all_features>(make_bsdf<all_features>(p, wo, nullptr), wo, random);
        const Vec3 wi = i % 2 && s.valid && !s.delta ? s.wi : random.direction();
        if (std::abs(wo.z) < 0.01f || std::abs(wi.z) < 0.01f || !(scattered(p, wo, wi) > 0)) continue;
        ++compared;
        visit(wo, wi);
    }
    return compared;
}

std::vector<Material> random_materials(int count, Random& random) {
    std::vector<Material> all;
    for (int i = 0; i < count; ++i) {
        Params p{{random(), random(), random()}, random(), 0.1f + 0.9f * random(), 1.05f + 1.5f * random(), random(),
                 {random(), random(), random()}, random(), random() < 0.5f};
        if (i % 3 == 0) p = with_sheen(p, random(), {random(), random(), random()});
        if (i % 4 == 0) p = stretched(p, random());
        if (i % 5 == 0) p = under_film(p, 1000 * random(), 1.1f + random());
        if (p.thin && i % 2 == 0) p = translucent(p, random(), {random(), random(), random()});
        all.push_back({"random material " + std::to_string(i), p});
    }
    return all;
}

} // namespace

// Diffuse and microfacet reflection, sheen, films, anisotropy, thin walls and rough solids, alone and mixed.
TEST(Reciprocity, HoldsForEveryLobeUpToTheSquaredIndex) {
    Random random(2);
    std::vector<Material> all = all_materials();
    for (const Material& m : random_materials(200, random)) all.push_back(m);
    int refracted = 0;
    for (const Material& m : all) {
        const Params& p = m.params;
        const bool straight = is_solid(p) && reference::sqr(p.roughness) * (p.ior - 1) < 1e-5;
        if (straight || p.layers.clearcoat > 0 || (is_solid(p) && p.layers.diffuse_transmission > 0)) continue;
        for_each_pair(p, 1000, random, [&](const Vec3& wo, const Vec3& wi) {
            refracted += is_solid(p) && wo.z * wi.z < 0;
            const double there = scattered(p, wo, wi), back = scattered(p, wi, wo);
            ASSERT_NEAR(there, back, bound_of_both(p, wo, wi) * std::max(there, back)) << m.name << ", wo.z " << wo.z << ", wi.z " << wi.z;
        });
    }
    EXPECT_GT(refracted, 10'000);
}

// KHR_materials_clearcoat splits light by the cosine of the viewer alone, for the coat and for what is below.
TEST(Reciprocity, OfCoatsHoldsUpToTheShareOfTheViewer) {
    Random random(3);
    const auto taken = [](const Vec3& w) { return double(clearcoat_reflectance(1.f, std::abs(w.z))); };
    Params coat_alone = coated(lambert({0, 0, 0}), 0.5f); // rough coat on black
    for (const bool below : {false, true}) {
        const Params p = below ? coated(lambert(), 0) : coat_alone; // the smooth coat has no density
        const int compared = for_each_pair(p, 2000, random, [&](const Vec3& wo, const Vec3& wi) {
            const auto share = [&](const Vec3& viewer) { return below ? 1 - taken(viewer) : taken(viewer); };
            const double there = scattered(p, wo, wi) / share(wo), back = scattered(p, wi, wo) / share(wi);
            ASSERT_NEAR(there, back, bound_of_both(p, wo, wi) * there) << (below ? "below" : "coat");
        });
        EXPECT_GT(compared, 700);
    }
    // The size: at 80 degrees the coat takes 41 % of the light, from above 4 %.
    const Vec3 up{0, 0, 1}, aside = Viewer{80, false}.wo();
    const double takes = 0.04 + 0.96 * std::pow(1 - double(aside.z), 5);
    EXPECT_NEAR(takes, 0.41, 0.001);
    EXPECT_NEAR(scattered(coated(lambert(), 0), up, aside) / scattered(coated(lambert(), 0), aside, up), 0.96 / (1 - takes), 1e-5);
    EXPECT_NEAR(scattered(coat_alone, aside, up) / scattered(coat_alone, up, aside), takes / 0.04, 1e-4);
}

// Turquin 2019 scales lobes by the albedo towards the viewer.
TEST(Reciprocity, OfCompensatedMetalHoldsUpToTheViewersAlbedo) {
    const EnergyTable table = make_energy_table();
    Random random(4);
    double largest = 0;
    for (const float roughness : {0.3f, 0.6f, 1.f}) {
        const Params p = metal(roughness);
        for_each_pair(p, 1000, random, [&](const Vec3& wo, const Vec3& wi) {
            const double a = directional_albedo(table, roughness, wo.z), b = directional_albedo(table, roughness, wi.z);
            const double there = scattered(p, wo, wi, &table) * a, back = scattered(p, wi, wo, &table) * b;
            ASSERT_NEAR(there, back, bound_of_both(p, wo, wi) * there);
            largest = std::max(largest, b / a);
        });
    }
    EXPECT_GT(largest, 1.5);
    EXPECT_LT(largest, 2.5);
}

// What enters a solid diffusely is what the interface does not reflect, as its viewer's side sees it.
TEST(Reciprocity, OfDiffuseTransmissionIntoSolidsHoldsUpToTheViewersReflectance) {
    Random random(5);
    const Params p = solid(translucent(plastic(0.5f, {0, 0, 0}), 1));
    double largest = 0;
    const int compared = for_each_pair(p, 4000, random, [&](const Vec3& wo, const Vec3& wi) {
        if (wo.z * wi.z > 0) return;
        const double c = std::sqrt(0.5 + 0.5 * dot(reference::to_double(wo), Vec3d{wi.x, wi.y, -wi.z}));
        const auto passes = [&](const Vec3& viewer) { return 1 - reference::largest(reference::dielectric_fresnel(p, c, viewer.z < 0)); };
        const double there = scattered(p, wo, wi), back = scattered(p, wi, wo);
        if (!(passes(wo) > 0.01) || !(passes(wi) > 0.01)) return; // near the critical angle
        ASSERT_NEAR(there * passes(wi), back * passes(wo), 4 * bound_of_both(p, wo, wi) * there);
        largest = std::max(largest, there / back);
    });
    EXPECT_GT(compared, 1000);
    EXPECT_GT(largest, 3); // inside, nothing passes beyond the critical angle
}

namespace {

struct DeltaLobe {
    BsdfSample<float> sample;
    bool coat;
    float choice;
    double light; // weight times probability, green
};
DeltaLobe delta_lobe(const Params& p, const Vec3& wo, float choice) {
    const Bsdf<float> b = make_bsdf<all_features>(p, wo, nullptr);
    DeltaLobe lobe{sample<all_features>(b, wo, 0.3f, 0.6f, choice), choice < b.coat.probability, choice, 0};
    const bool reflects = lobe.sample.wi.z * wo.z > 0 || !is_solid(p);
    const double base = double(b.p_base) * (1 - double(b.p_diffuse)) *
                        double(facet_probability<all_features>(facet_albedo<all_features>(b, b.cos), reflects));
    lobe.light = lobe.sample.weight.y * (lobe.coat ? double(b.coat.probability) : base);
    return lobe;
}
// The same lobe as `there`, for a viewer in its direction who looks back to wo.
std::optional<DeltaLobe> exchanged(const Params& p, const Vec3& wo, const DeltaLobe& there) {
    for (int i = 0; i < 4096; ++i) {
        const DeltaLobe back = delta_lobe(p, there.sample.wi, (float(i) + 0.5f) / 4096);
        if (back.sample.valid && back.sample.delta && back.coat == there.coat && length(back.sample.wi - wo) < 1e-3f) return back;
    }
    return std::nullopt;
}

} // namespace

// A viewer sees radiance f n_o^2 / n_i^2 within a beam of another solid angle; flux has neither factor. Layers are those of the viewer.
TEST(Reciprocity, OfDeltaLobesForLightPathsIsThatOfTheViewer) {
    Random random(6);
    const Vec3 tilted = normalize(Vec3{0.3f, -0.2f, 1});
    const std::vector<Material> all = {{"mirror", metal(0, {0.9f, 0.7f, 0.4f})},
                                       {"half metal", half_metal(0)},
                                       {"plastic", plastic(0)},
                                       {"glass", glass(0, 1.5f)},
                                       {"half-clear glass", glass(0, 1.3f, 0.5f)},
                                       {"glass under a film", under_film(glass(0, 1.5f), 420, 1.8f)},
                                       {"dusty glass", with_sheen(glass(0, 1.5f), 0.5f, {0.4f, 0.4f, 0.4f})},
                                       {"coated glass", coated(glass(0, 1.5f), 0)},
                                       {"roughly coated glass", coated(glass(0, 1.5f), 0.5f, 0.7f)},
                                       {"coated mirror", coated(metal(0), 0)},
                                       {"mirror with a tilted coat", coated(metal(0), 0, 1, tilted)},
                                       {"glass with a tilted coat", coated(glass(0, 1.5f), 0, 1, tilted)}};
    for (const Material& m : all) {
        const Params& p = m.params;
        int compared = 0;
        for (int i = 0; i < 1000; ++i) {
            Vec3 wo = random.direction();
            if (!is_solid(p)) wo.z = std::abs(wo.z);
            const DeltaLobe there = delta_lobe(p, wo, random());
            const Vec3 wi = there.sample.wi;
            if (!there.sample.valid || !there.sample.delta || std::abs(wo.z) < 0.05f || std::abs(wi.z) < 0.05f) continue;
            // Where the coat's normal faces one end only, it is the surface's for the other.
            const auto faces = [&](const Vec3& w) { return dot(p.layers.clearcoat_normal, w) * (w.z < 0 ? -1 : 1) > 0.01f; };
            if (p.layers.clearcoat > 0 && (!faces(wo) || !faces(wi))) continue;
            const std::optional<DeltaLobe> back = exchanged(p, wo, there);
            ASSERT_TRUE(back) << m.name << ", wo.z " << wo.z << ", wi.z " << wi.z;
            const Bsdf<float> b = make_bsdf<all_features>(p, wo, nullptr);
            const double flux = there.light * double(delta_adjoint<all_features>(b, p.layers, wo, wi, there.choice));
            const double n = index_of(p, wo) / index_of(p, wi);
            const double beam = there.coat ? 1 : n * n * double(std::abs(wo.z)) / double(std::abs(wi.z));
            const double bound = float_rounding * (1 + 1 / reference::sqr(wo.z) + 1 / reference::sqr(wi.z));
            ASSERT_NEAR(flux, back->light * beam, bound * flux) << m.name << ", wo.z " << wo.z << ", wi.z " << wi.z;
            ++compared;
        }
        EXPECT_GT(compared, 100) << m.name;
    }
}

} // namespace blush::TEST_FILE
