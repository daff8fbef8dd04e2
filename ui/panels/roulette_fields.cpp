#include "ui/panels/roulette_fields.h"

namespace blush {

void draw_roulette_fields(Fields& f, Roulette& r) {
    static constexpr const char* rules[] = {"Off", "Largest component", "Luminance", "Square root", "Constant", "Biased cut (wrong)"};
    int rule = int(r.rule);
    if (f.choice("Roulette", rule, rules,
                 "Which chance a path has to go on after a bounce, given how much light it still can carry. Survivors are weighted up, so "
                 "the mean stays right; the biased cut does not and darkens the image, to show what goes wrong."))
        r.rule = Roulette::Rule(rule);
    if (r.rule == Roulette::Rule::off) return;
    int64_t start = r.start;
    if (f.integer("From bounce", start, 0, 10000, 3, "The first bounce at which roulette may end a path.")) r.start = int(start);
    const auto share = [&](const char* label, float& value, float reset, const char* tip) {
        f.number(label, value, {.min = 0, .max = 1, .reset = reset, .bar = true, .tip = tip, .format = "%.3f"});
    };
    if (r.rule == Roulette::Rule::biased_cut) {
        share("Cut below", r.threshold, 0.1f, "Paths that carry less than this are ended and nothing makes up for them.");
        return;
    }
    if (r.rule == Roulette::Rule::constant) share("Chance", r.probability, 0.8f, "The same chance to go on after every bounce.");
    share("At least", r.floor, 0, "Lowest chance to go on.");
    share("At most", r.cap, 1, "Highest chance to go on. Below the reflectance of a closed room's walls the variance becomes infinite.");
}

void draw_bounce_limit_fields(Fields& f, RenderSettings& r) {
    bool unlimited = r.max_bounces == unlimited_bounces;
    if (f.checkbox("All bounces", unlimited, "Follow light however often it is scattered. A limit darkens the image."))
        r.max_bounces = unlimited ? unlimited_bounces : 8;
    if (unlimited) return;
    int64_t bounces = r.max_bounces;
    if (f.integer("Bounces", bounces, 0, 100000, 8, "0 shows what glows, 1 adds direct light, 2 the first colour bleeding."))
        r.max_bounces = int(bounces);
}

} // namespace blush
