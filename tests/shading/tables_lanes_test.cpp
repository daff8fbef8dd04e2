// Table lookups are bit-identical across lanes and instruction sets.
#include "render/lights/environment_table.h"
#include "render/materials/material_table.h"
#include "scene/texture_slots.h"
#include "tests/shading/tables.h"
#include "tests/shading/tables_evaluate.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <vector>

namespace blush {

namespace isa_v2 {
void evaluate_tables_wide(const TablePoints& points, const std::array<float*, table_answers>& answers);
}
namespace isa_v3 {
void evaluate_tables_wide(const TablePoints& points, const std::array<float*, table_answers>& answers);
}
namespace isa_v4 {
void evaluate_tables_wide(const TablePoints& points, const std::array<float*, table_answers>& answers);
}

} // namespace blush

namespace blush::TEST_FILE {
namespace {

using Evaluate = void (*)(const TablePoints&, const std::array<float*, table_answers>&);

Scene varied_scene(Random& random) {
    Scene scene;
    std::vector<Id<Texture>> textures;
    for (int i = 0; i < 8; ++i) {
        Texture t;
        const int w = 1 + random.below(9), h = 1 + random.below(9), channels = 1 + random.below(4);
        t.image = i % 2 ? make_byte_image(w, h, channels, [&] { return uint8_t(random.below(256)); })
                        : make_float_image(w, h, channels, [&] { return random.between(0, 2); });
        t.wrap_u = Texture::Wrap(random.below(3));
        t.wrap_v = Texture::Wrap(random.below(3));
        t.filter = Texture::Filter(random.below(2));
        textures.push_back(scene.textures.add(t));
    }
    for (int i = 0; i < 40; ++i) {
        Material m;
        for (const TextureSlot& slot : texture_slots) {
            if (random.coin()) m.*slot.ref = {textures[size_t(random.below(8))], uint8_t(random.below(2)), {0, 0}, {2, 3}, random.unit()};
        }
        m.base_color = {random.unit(), random.unit(), random.unit()};
        m.emissive = {random.unit(), 0, random.unit()};
        m.metallic = random.unit();
        m.transmission = random.coin() ? random.unit() : 0;
        m.unlit = random.below(5) == 0;
        add_layers(random, m);
        add_used_material(scene, m);
    }
    scene.environment.kind = Environment::Kind::image;
    scene.environment.rotation_degrees = 77;
    scene.environment.image = make_float_image(13, 6, 3, [&] { return random.below(3) == 0 ? random.between(0, 9) : 0; });
    return scene;
}

std::vector<float> run(Evaluate evaluate, const TablePoints& points) {
    std::vector<float> values(size_t(table_answers) * size_t(points.count));
    std::array<float*, table_answers> answers;
    for (size_t i = 0; i < answers.size(); ++i) answers[i] = &values[i * size_t(points.count)];
    evaluate(points, answers);
    return values;
}

} // namespace

TEST(ShadingTables, EveryInstructionSetGivesTheSameBits) {
    Random random(11);
    const Scene scene = varied_scene(random);
    MaterialTable materials;
    build_material_table(materials, scene);
    const EnvironmentTable environment = build_environment_table(scene.environment);
    const MaterialTables material_tables = materials.tables();
    const EnvironmentTables environment_tables = environment.tables();

    constexpr int count = 4096;
    std::array<std::vector<float>, 14> numbers;
    std::vector<int32_t> material(count), active(count);
    std::vector<uint32_t> bits(count);
    TablePoints points{&material_tables, &environment_tables, count, {}, material.data(), bits.data(), active.data()};
    for (size_t i = 0; i < numbers.size(); ++i) {
        numbers[i].resize(count);
        points.numbers[i] = numbers[i].data();
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t i = 0; i < 8; ++i) numbers[i][k] = random.between(-3, 3);
        const Vec3 direction = random.direction();
        numbers[8][k] = direction.x;
        numbers[9][k] = direction.y;
        numbers[10][k] = direction.z;
        numbers[11][k] = random.unit();
        for (size_t i = 12; i < 14; ++i) numbers[i][k] = random.coin() ? 0 : random.unit();
        bits[k] = random.bits();
        active[k] = random.below(8) != 0;
        material[k] = active[k] ? random.below(41) : int32_t(random.bits());
        if (!active[k]) {
            for (size_t i = 0; i < 11; ++i) numbers[i][k] = std::bit_cast<float>(random.bits());
        }
        if (random.below(64) == 0) numbers[size_t(random.below(4))][k] = std::numeric_limits<float>::quiet_NaN();
    }

    const std::vector<float> scalar = run(evaluate_tables<float>, points);
    struct Set {
        const char* name;
        bool is_supported;
        Evaluate evaluate;
    };
    const Set sets[] = {{"baseline", true, evaluate_tables<Wide>},
                        {"x86-64-v2", bool(__builtin_cpu_supports("sse4.2")), isa_v2::evaluate_tables_wide},
                        {"x86-64-v3", bool(__builtin_cpu_supports("avx2")), isa_v3::evaluate_tables_wide},
                        {"x86-64-v4", bool(__builtin_cpu_supports("avx512f")), isa_v4::evaluate_tables_wide}};
    for (const Set& set : sets) {
        if (!set.is_supported) continue;
        const std::vector<float> wide = run(set.evaluate, points);
        for (size_t i = 0; i < scalar.size(); ++i) {
            ASSERT_EQ(std::bit_cast<uint32_t>(wide[i]), std::bit_cast<uint32_t>(scalar[i]))
                << set.name << ", answer " << i / count << " of point " << i % count;
        }
    }
}

} // namespace blush::TEST_FILE
