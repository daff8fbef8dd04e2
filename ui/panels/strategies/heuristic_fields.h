// Rows that the Render tab and the Strategies panel share.
#pragma once

#include "scene/render_settings.h"
#include "ui/widgets/widgets.h"

namespace blush {

// By MisHeuristic::Rule.
constexpr const char* heuristic_names[] = {"Power", "Cutoff", "Maximum"};
constexpr const char* heuristic_tip =
    "MIS heuristic: how much of a direction that light sampling and BSDF sampling both find each contributes. Power: by a power of their "
    "densities. Cutoff: by their densities, and nothing for a small one. Maximum: all to the larger density. Unbiased; the noise differs. "
    "With any but the power heuristic with exponent 2, strategies for caustics are off.";

// The heuristic of MIS, with its number if it has one.
void draw_heuristic_fields(Fields& f, MisHeuristic& heuristic);
// The number alone; nothing for the maximum heuristic.
void draw_heuristic_number(Fields& f, MisHeuristic& heuristic);
// With the default number. The text form has no number of another rule.
void choose_heuristic(MisHeuristic& heuristic, int rule);

} // namespace blush
