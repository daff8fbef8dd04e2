// The groups of cases; each group is in the file of its name.
#pragma once

#include "measure/stability/stability_case.h"

#include <string_view>
#include <vector>

namespace blush::stability {

std::vector<StabilityCase> absorption_cases();
std::vector<StabilityCase> camera_cases();
std::vector<StabilityCase> dielectric_cases();
std::vector<StabilityCase> film_cases();
std::vector<StabilityCase> furnace_cases();
std::vector<StabilityCase> geometry_cases();
std::vector<StabilityCase> grazing_cases();
std::vector<StabilityCase> health_cases();
std::vector<StabilityCase> light_cases();
std::vector<StabilityCase> limit_cases();
// The known limit whose value a test compares with a quadrature.
constexpr std::string_view grazing_gain_case = "white smooth dielectric in a furnace, seen at 75 degrees";
std::vector<StabilityCase> microfacet_cases();
std::vector<StabilityCase> mirror_cases();
std::vector<StabilityCase> scale_cases();
std::vector<StabilityCase> world_cases();

} // namespace blush::stability
