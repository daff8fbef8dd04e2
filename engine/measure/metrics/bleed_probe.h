// Bleed probe: the light of a pixel, a rectangle or a surface point by who sent it there last, by light and by bounce, with 95 %
// confidence intervals, and the colour shift that scattered light causes. Measured in rounds besides the render.
#pragma once

#include "measure/statistics/intervals.h"
#include "render/diagnostics/bleed_tracer.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace blush {

// How the colour of the whole differs from its colour without some of its light.
struct ColorShift {
    // Steps in the CIE 1976 UCS diagram, and the length of both together; `length` is unknown while noise may explain it.
    Interval u, v, length;
    std::string towards; // "red", ... (color_difference.h)
    // CIEDE2000 of both, exposed such that the whole has L* = 50. `hue` is that of the colour alone: the rest is scaled to the luminance
    // of the whole.
    Interval delta_e, hue;
};

// A part of the light.
struct BleedShare {
    std::string name;
    SentBy by = SentBy::itself; // of rows of senders
    uint32_t object = 0;        // Id<Node>.value of a sender; 0: none
    Interval light;             // luminance, nits or lux
    Interval share;             // of the whole, 0 .. 1
    Vec3d rgb{0, 0, 0};         // linear Rec.709, nits or lux
    ColorShift shift;           // that this part causes
    Vec3d place{0, 0, 0};       // of senders: mean of where its light leaves it, world space, metres; at infinity: the direction towards it
    bool infinite = false;
};

struct BleedReport {
    bool lit = true; // the scene has light
    int64_t paths = 0, dropped = 0;
    Interval whole;                          // luminance, nits or lux
    Vec3d rgb{0, 0, 0};                      // linear Rec.709, nits or lux
    BleedShare direct, indirect;             // seen directly or scattered once; scattered more often
    std::vector<BleedShare> senders, lights; // greatest first
    std::vector<BleedShare> bounces;         // by number of scatterings, without empty ones
    bool has_place = false;                  // a surface is probed
    Vec3d place{0, 0, 0};                    // mean of the probed points, world space, metres
    std::string missing_light;               // message about light that no path finds; empty: none
    // Largest half interval of the whole and of the senders, relative to the whole; infinite before there are intervals.
    double error() const;
};

// Names and links of senders are those of `scene`.
class BleedProbe {
public:
    // 0 threads: one per core.
    explicit BleedProbe(unsigned threads, bool low_priority = false);
    ~BleedProbe();

    // Restarts the measurement. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, std::span<const BleedTarget> targets);
    // Adds paths to each target. False if `wanted` returned false: the round is then discarded. Rounds do not depend on the number of
    // threads.
    bool round(const std::function<bool()>& wanted = {});
    // Paths of each target so far.
    int64_t paths() const;
    // Of target `i`.
    BleedReport report(size_t i) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
