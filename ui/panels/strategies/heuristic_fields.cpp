#include "ui/panels/strategies/heuristic_fields.h"

namespace blush {

void choose_heuristic(MisHeuristic& heuristic, int rule) {
    if (rule != int(heuristic.rule)) heuristic = {.rule = MisHeuristic::Rule(rule)};
}

void draw_heuristic_fields(Fields& f, MisHeuristic& heuristic) {
    int rule = int(heuristic.rule);
    if (f.choice("MIS heuristic", rule, heuristic_names, heuristic_tip)) choose_heuristic(heuristic, rule);
    draw_heuristic_number(f, heuristic);
}

void draw_heuristic_number(Fields& f, MisHeuristic& heuristic) {
    if (heuristic.rule == MisHeuristic::Rule::power) {
        int64_t exponent = heuristic.exponent;
        if (f.integer("Exponent", exponent, 1, MisHeuristic::max_exponent, MisHeuristic{}.exponent,
                      "1 is the balance heuristic; 2 is the default; a large one comes close to the maximum heuristic."))
            heuristic.exponent = int(exponent);
    }
    if (heuristic.rule == MisHeuristic::Rule::cutoff)
        f.number("Threshold", heuristic.threshold,
                 {.min = 0,
                  .max = 1,
                  .reset = MisHeuristic{}.threshold,
                  .bar = true,
                  .tip = "A density below this share of the larger one counts as 0. 0 is the balance heuristic, 1 the maximum heuristic.",
                  .format = "%.3f"});
}

} // namespace blush
