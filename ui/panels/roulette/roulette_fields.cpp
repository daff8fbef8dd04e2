#include "ui/panels/roulette/roulette_fields.h"

namespace blush {

void draw_roulette_fields(Fields& f, Roulette& r) {
    static constexpr const char* rules[] = {"Automatic",           "Off",
                                            "Largest component",   "Luminance",
                                            "Square root",         "Constant",
                                            "Adjoint (learned)",   "Efficiency (learned)",
                                            "Splitting (learned)", "Biased cut (wrong)"};
    int rule = int(r.rule);
    if (f.choice("Roulette", rule, rules,
                 "Survival probability of a path after a bounce, as a function of its throughput. Survivors are weighted up, so "
                 "the result is unbiased. Automatic takes the square root, or a learned rule where that is worth it. Learned: a pilot "
                 "measures the light behind each place of the scene; adjoint ends paths that "
                 "will add little to their pixel, efficiency those that cost more time than they save noise; splitting also continues "
                 "paths that "
                 "save much noise in several copies. The biased cut omits the weight and darkens the image, as a demonstration."))
        r.rule = Roulette::Rule(rule);
    if (r.rule == Roulette::Rule::off) return;
    int64_t start = r.start;
    if (f.integer("From bounce", start, 0, 10000, 3, "First bounce at which roulette can terminate a path.")) r.start = int(start);
    const auto share = [&](const char* label, float& value, float reset, const char* tip) {
        f.number(label, value, {.min = 0, .max = 1, .reset = reset, .bar = true, .tip = tip, .format = "%.3f"});
    };
    if (r.rule == Roulette::Rule::biased_cut) {
        share("Cut below", r.threshold, 0.1f, "Paths with a lower throughput are terminated without compensation.");
        return;
    }
    if (r.rule == Roulette::Rule::constant) share("Chance", r.probability, 0.8f, "Survival probability after every bounce.");
    share("At least", r.floor, 0, "Minimum survival probability.");
    share("At most", r.cap, 1,
          "Maximum survival probability. In a closed room, the variance is infinite if this is below the reflectance of the walls.");
}

void draw_bounce_limit_fields(Fields& f, RenderSettings& r) {
    bool unlimited = r.max_bounces == unlimited_bounces;
    if (f.checkbox("All bounces", unlimited, "No limit on the number of bounces. A limit darkens the image."))
        r.max_bounces = unlimited ? unlimited_bounces : 8;
    if (unlimited) return;
    int64_t bounces = r.max_bounces;
    if (f.integer("Bounces", bounces, 0, 100000, 8,
                  "Maximum number of bounces. 0: emission only. 1: direct light. 2: first indirect bounce."))
        r.max_bounces = int(bounces);
}

} // namespace blush
