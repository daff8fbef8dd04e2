// Rows of the Light section for a measured distribution (IES profile).
#include "ui/panels/light/fields.h"

#include "scene/lights/ies_profile.h"
#include "ui/widgets/polar_plot.h"
#include "ui/widgets/value_text.h"

#include <filesystem>
#include <fmt/format.h>

namespace blush {

void draw_light_distribution(Fields& f, PanelContext& c, Light& light) {
    if (light.kind != Light::Kind::point && light.kind != Light::Kind::spot) return;
    if (!light.ies) {
        if (f.button("IES file...", "Use the measured distribution of a real luminaire: an IES file (.ies) from its manufacturer."))
            c.ui.commands.push_back(Command::ies);
        return;
    }
    const IesProfile& profile = *light.ies;
    f.info("IES file", std::filesystem::path(light.ies_file).filename().string(), light.ies_file.c_str());
    draw_polar_plot(profile, light);
    f.info("", fmt::format("{} lm, peak {} cd", shown_number(luminous_flux(profile)), shown_number(double(profile.peak))));
    if (f.button("As measured", "Set the intensity to the peak candela of the file. The intensity is that of the brightest direction.")) {
        light.intensity = profile.peak;
        f.note_change();
    }
    if (f.button("Another file...", "Choose another IES file.")) c.ui.commands.push_back(Command::ies);
    if (f.button("No distribution", "Remove the IES profile: emit uniformly, or within the cone of a spot.")) {
        light.ies = nullptr;
        light.ies_file.clear();
        f.note_change();
    }
}

} // namespace blush
