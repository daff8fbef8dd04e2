#include "render/denoise/tza.h"

#include "core/files.h"
#include "render/denoise/unet_weights.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace denoise;
using Bytes = std::vector<uint8_t>;

template <class T> void put(Bytes& bytes, T value) {
    for (size_t i = 0; i < sizeof(T); i++) bytes.push_back(uint8_t(uint64_t(value) >> 8 * i));
}
void put(Bytes& bytes, const std::string& text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

// An entry of the table as stored in the file, valid or not.
struct Entry {
    std::string name = "a";
    std::vector<uint32_t> dimensions = {2};
    std::string layout = "x";
    char type = 'f';
    uint64_t offset = 12;
};

// Header, `data`, table.
Bytes file_of(const Bytes& data, const std::vector<Entry>& entries, uint16_t magic = 0x41D7, uint8_t version = 2) {
    Bytes bytes;
    put(bytes, magic);
    put(bytes, version);
    put(bytes, uint8_t(0));
    put(bytes, uint64_t(12 + data.size()));
    bytes.insert(bytes.end(), data.begin(), data.end());
    put(bytes, uint32_t(entries.size()));
    for (const Entry& entry : entries) {
        put(bytes, uint16_t(entry.name.size()));
        put(bytes, entry.name);
        put(bytes, uint8_t(entry.dimensions.size()));
        for (const uint32_t dimension : entry.dimensions) put(bytes, dimension);
        put(bytes, entry.layout);
        put(bytes, uint8_t(entry.type));
        put(bytes, entry.offset);
    }
    return bytes;
}
Bytes floats(std::initializer_list<float> values) {
    Bytes bytes;
    for (const float value : values) put(bytes, std::bit_cast<uint32_t>(value));
    return bytes;
}
Bytes halves(std::initializer_list<uint16_t> values) {
    Bytes bytes;
    for (const uint16_t value : values) put(bytes, value);
    return bytes;
}

std::string error_of(const Bytes& bytes) {
    const auto read = read_tza(bytes, "weights.tza");
    return read ? "no error" : read.error().text();
}
testing::AssertionResult refused(const Bytes& bytes, const std::string& why) {
    const std::string error = error_of(bytes);
    if (error.starts_with("weights.tza: ") && error.find(why) != std::string::npos && error.find(", byte ") != std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << error << " instead of " << why;
}

TEST(Tza, ReadsFloatsAndHalves) {
    Bytes data = floats({1.5f, -2});
    const Bytes more = halves({0x3c00, 0xc100, 0x0001, 0x83ff, 0x0400, 0x7bff});
    data.insert(data.end(), more.begin(), more.end());
    const auto read = read_tza(file_of(data, {{}, {"b", {2, 3}, "oi", 'h', 20}}), "weights.tza");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->at("a").values, (std::vector<float>{1.5f, -2}));
    EXPECT_EQ(read->at("b").layout, "oi");
    EXPECT_EQ(read->at("b").dimensions, (std::vector<uint32_t>{2, 3}));
    EXPECT_EQ(read->at("b").values, (std::vector<float>{1, -2.5f, 0x1p-24f, -1023 * 0x1p-24f, 0x1p-14f, 65504}));
}

TEST(Tza, RejectsDamagedFiles) {
    const Bytes data = floats({1, 2});
    EXPECT_EQ(error_of(file_of(data, {{}})), "no error");
    EXPECT_TRUE(refused(file_of(data, {{}}, 0x41D8), "magic"));
    EXPECT_TRUE(refused(file_of(data, {{}}, 0x41D7, 3), "version"));
    EXPECT_TRUE(refused(file_of(data, {{.type = 'd'}}), "unknown value type"));
    EXPECT_TRUE(refused(file_of(data, {{}, {}}), "same name"));
    EXPECT_TRUE(refused(file_of(data, {{.layout = ""}}), "truncated"));
    EXPECT_TRUE(refused(file_of(floats({1, INFINITY}), {{}}), "not finite"));
    EXPECT_TRUE(refused(file_of(halves({1, 0x7e00}), {{.type = 'h'}}), "not finite"));
    EXPECT_TRUE(refused({}, "magic"));
}

TEST(Tza, RejectsInvalidOffsetsAndSizes) {
    const Bytes data = floats({1, 2});
    // Offsets beyond the end, and offsets that overflow when the size is added.
    for (const uint64_t offset : {uint64_t(1000), ~uint64_t(0), ~uint64_t(0) - 7, uint64_t(1) << 63}) {
        EXPECT_TRUE(refused(file_of(data, {{.offset = offset}}), "beyond the end"));
        Bytes bytes = file_of(data, {{}});
        for (int i = 0; i < 8; i++) bytes[4 + i] = uint8_t(offset >> 8 * i);
        EXPECT_TRUE(refused(bytes, "beyond the end"));
    }
    // Products that are too large, or overflow to a small number.
    for (const std::vector<uint32_t>& dimensions :
         {std::vector<uint32_t>{~0u}, {65536, 65536, 65536, 65536}, {0x80000001, 2, 0x80000001, 2}, std::vector<uint32_t>(255, 2)})
        EXPECT_TRUE(
            refused(file_of(data, {{.dimensions = dimensions, .layout = std::string(dimensions.size(), 'x')}}), "larger than the file"));
    // More tensors than table entries.
    Bytes many = file_of(data, {{}});
    for (int i = 0; i < 4; i++) many[12 + data.size() + i] = 0xff;
    EXPECT_TRUE(refused(many, "truncated"));
    // Many tensors with the same bytes.
    std::vector<Entry> entries;
    for (int i = 0; i < 1000; i++) entries.push_back({.name = std::to_string(i), .dimensions = {4000}, .type = 'h'});
    EXPECT_TRUE(refused(file_of(Bytes(8000), entries), "larger than the file"));
}

TEST(Tza, TruncatedAnywhereIsAnError) {
    const Bytes whole = file_of(floats({1, 2}), {{.dimensions = {1}}, {"b", {1}, "x", 'f', 16}});
    ASSERT_EQ(error_of(whole), "no error");
    for (size_t length = 0; length < whole.size(); length++)
        EXPECT_TRUE(refused({whole.begin(), whole.begin() + long(length)}, "")) << length;

    const auto real = read_file(std::string(BLUSH_WEIGHTS) + "/rt_hdr_small.tza", 1 << 24);
    ASSERT_TRUE(real) << real.error().text();
    for (size_t length = 0; length < real->size(); length += 9973)
        EXPECT_TRUE(refused({real->begin(), real->begin() + long(length)}, "")) << length;
    EXPECT_TRUE(refused({real->begin(), real->end() - 1}, ""));
}

TEST(Tza, SurvivesAnyWrongByte) {
    const Bytes whole = file_of(floats({1, 2}), {{.dimensions = {1}}, {"b", {1}, "x", 'f', 16}});
    std::mt19937 random(1);
    for (int round = 0; round < 20000; round++) {
        Bytes bytes = whole;
        for (int i = 0; i < 3; i++) bytes[random() % bytes.size()] = uint8_t(random());
        const auto read = read_tza(bytes, "weights.tza"); // must return, within memory; its result does not matter
        EXPECT_LE(read ? read->size() : 0, 2u);
    }
}

TEST(UnetWeights, MustFitTheNetwork) {
    const std::string folder = BLUSH_WEIGHTS;
    const auto good = read_unet_weights(folder + "/rt_hdr_alb_nrm.tza", 9);
    ASSERT_TRUE(good) << good.error().text();
    EXPECT_EQ(good->channels(), (UnetChannels{9, 32, 32, 48, 64, 80, 96, 96, 112, 112, 96, 96, 64, 64, 64, 32, 3}));

    const auto other = read_unet_weights(folder + "/rt_hdr.tza", 9);
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().text().find("enc_conv0"), std::string::npos) << other.error().text();
    EXPECT_FALSE(read_unet_weights(folder + "/LICENSE.txt", 9));
    EXPECT_FALSE(read_unet_weights(folder + "/absent.tza", 9));
    EXPECT_FALSE(read_unet_weights("/dev/zero", 9));

    // A valid container that contains no network.
    const TemporaryFolder temporary;
    ASSERT_TRUE(write_file(temporary / "empty.tza", file_of({}, {})));
    EXPECT_FALSE(read_unet_weights(temporary / "empty.tza", 9));
    const Entry vector{"enc_conv0.weight", {2}, "x"}, bias{"enc_conv0.bias", {2}, "x", 'f', 20};
    ASSERT_TRUE(write_file(temporary / "flat.tza", file_of(floats({1, 2, 3, 4}), {vector, bias})));
    EXPECT_FALSE(read_unet_weights(temporary / "flat.tza", 9));
}

} // namespace
} // namespace blush::test::TEST_FILE
