// The pages of the guide that the window opens: the only place with their addresses.
#pragma once

namespace blush::guide_page {

constexpr const char* first_steps = "guide/first-steps.html";
constexpr const char* own_file = "guide/first-steps.html#your-own-file";
constexpr const char* timeline = "guide/first-steps.html#what-a-file-offers";
constexpr const char* outliner = "guide/first-steps.html#outliner";
constexpr const char* viewport = "guide/first-steps.html#viewport";
constexpr const char* status_bar = "guide/first-steps.html#status-bar";
constexpr const char* file_browser = "guide/first-steps.html#file-browser";
constexpr const char* docks = "guide/first-steps.html#instruments-and-docks";
constexpr const char* light_kinds = "guide/lighting.html#kinds-of-lights";
constexpr const char* light_units = "guide/lighting.html#units-and-colour";
constexpr const char* light_table = "guide/lighting.html#light-table";
constexpr const char* light_mix = "guide/light-mix.html";
constexpr const char* bleed = "guide/bleed.html";
constexpr const char* lessons = "guide/lessons.html";
constexpr const char* materials = "guide/materials.html";
constexpr const char* camera = "guide/camera.html";
constexpr const char* display = "guide/display.html";
constexpr const char* measuring = "guide/display.html#measuring-the-image";
constexpr const char* convergence = "guide/convergence.html";
constexpr const char* chart = "guide/convergence.html#the-chart";
constexpr const char* lab = "guide/convergence.html#roulette-lab-and-health";
constexpr const char* strategies = "guide/strategies.html";
constexpr const char* integrators = "guide/integrators.html";
constexpr const char* samplers = "guide/convergence.html#samplers";
constexpr const char* paths = "guide/paths.html";
constexpr const char* farm = "guide/farm.html#in-the-window";
constexpr const char* snapshots = "guide/snapshots.html#keep";
constexpr const char* comparison = "guide/snapshots.html#compare";

constexpr const char* all[] = {first_steps, own_file,    timeline,    outliner,    viewport,  status_bar, file_browser,
                               docks,       light_kinds, light_units, light_table, light_mix, bleed,      materials,
                               display,     camera,      measuring,   convergence, chart,     lab,        snapshots,
                               comparison,  paths,       lessons,     strategies,  farm,      samplers,   integrators};

} // namespace blush::guide_page
