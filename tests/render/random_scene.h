// Random scenes and settings, in which features meet that meet in none of the other tests.
#pragma once

#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace blush::test {

// A scene in which each part has one of some forms: casters of caustics, receivers, what lets pass a part of the light, and lights so large
// that paths find them by chance. The same seed gives the same scene.
class RandomScene {
public:
    explicit RandomScene(uint32_t seed);
    // Adds textures, further lobes, copies, a sky, hidden lights and other cameras.
    void enrich();
    // Adds lights without size, a sky with a sun, and shadow catchers: what not all strategies find, or no film shows.
    void harden();

    Scene scene;
    int max_bounces = unlimited_bounces;

private:
    bool one_in(uint32_t n) { return random_() % n == 0; }
    float number(float low, float high) { return low + (high - low) * float(random_() % 1024) / 1024; }
    Vec3 color() { return {number(0.3f, 0.9f), number(0.3f, 0.9f), number(0.3f, 0.9f)}; }
    ObjectSet some_objects() { return {one_in(2), {objects_[random_() % objects_.size()]}}; }

    Material receiver();
    Material caster();
    Material veil();
    void add_light();
    void add_environment();
    void add_copies();
    void add_textures(Material& material);
    void add_lobes(Material& material);
    TextureRef texture();

    std::mt19937 random_;
    std::vector<Id<Node>> objects_;
};

// Settings that change nothing about the mean of an image.
RenderSettings random_unbiased_settings(uint32_t seed);
// For messages: the settings that these functions choose.
std::string text_of(const RenderSettings& settings);

} // namespace blush::test
