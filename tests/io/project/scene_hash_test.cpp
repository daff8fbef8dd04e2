// The hash of a scene: each byte of a large payload counts, and so does its place.
#include "io/project/scene_hash.h"

#include <gtest/gtest.h>

#include <set>

namespace blush::test::TEST_FILE {
namespace {

std::string hash_of(const std::vector<uint8_t>& bytes) {
    Scene scene;
    const auto count = int(bytes.size());
    auto image = std::make_shared<Image>(Image{.width = count, .height = 1, .channels = 1, .bytes = bytes, .floats = {}});
    scene.textures.add({.name = "noise", .image = std::move(image)});
    return scene_hash(scene);
}

std::vector<uint8_t> ramp(size_t count) {
    std::vector<uint8_t> bytes(count);
    for (size_t i = 0; i < count; ++i) bytes[i] = uint8_t(i * 31 + i / 251);
    return bytes;
}

// Sizes around the one from which bytes are hashed in lanes, and with bytes left over.
TEST(SceneHash, EachByteCounts) {
    for (const size_t count : {size_t(64), size_t(4095), size_t(4096), size_t(10'003)}) {
        const std::vector<uint8_t> bytes = ramp(count);
        std::set<std::string> seen{hash_of(bytes)};
        for (size_t i = 0; i < count; i += count < 5000 ? 61 : 7) {
            std::vector<uint8_t> other = bytes;
            other[i] ^= 1;
            EXPECT_TRUE(seen.insert(hash_of(other)).second) << i << " of " << count;
        }
        EXPECT_EQ(hash_of(bytes), hash_of(ramp(count)));
    }
}

TEST(SceneHash, ThePlaceOfAByteCounts) {
    const std::vector<uint8_t> bytes = ramp(9000);
    std::set<std::string> seen{hash_of(bytes)};
    for (const size_t apart : {size_t(8), size_t(64), size_t(512)}) { // words of two lanes, of one lane
        std::vector<uint8_t> other = bytes;
        std::swap_ranges(other.begin() + 800, other.begin() + 808, other.begin() + std::ptrdiff_t(800 + apart));
        EXPECT_TRUE(seen.insert(hash_of(other)).second) << apart;
    }
    std::vector<uint8_t> shorter = bytes;
    shorter.pop_back();
    EXPECT_TRUE(seen.insert(hash_of(shorter)).second);
}

} // namespace
} // namespace blush::test::TEST_FILE
