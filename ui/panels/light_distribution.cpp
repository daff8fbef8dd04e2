// The light inspector's rows of a measured distribution (IES).
#include "ui/panels/light_fields.h"

#include "scene/ies_profile.h"
#include "ui/polar_plot.h"

#include <filesystem>
#include <fmt/format.h>

namespace blush {

void draw_light_distribution(Fields& f, PanelContext& c, Light& light) {
    if (light.kind != Light::Kind::point && light.kind != Light::Kind::spot) return;
    if (!light.ies) {
        if (f.button("IES file...", "Shine as a real luminaire was measured to: a photometric file (.ies) of its manufacturer."))
            c.ui.commands.push_back(Command::ies);
        return;
    }
    const IesProfile& profile = *light.ies;
    f.info("IES file", std::filesystem::path(light.ies_file).filename().string(), light.ies_file.c_str());
    draw_polar_plot(profile, light);
    f.info("", fmt::format("{:.4g} lm, peak {:.4g} cd", luminous_flux(profile), profile.peak));
    if (f.button("As measured", "Give the light the candela of the file. Otherwise the intensity is that of its brightest direction.")) {
        light.intensity = profile.peak;
        f.note_change();
    }
    if (f.button("Another file...", "Choose another photometric file.")) c.ui.commands.push_back(Command::ies);
    if (f.button("No distribution", "Shine alike to all sides, or as the cone says.")) {
        light.ies = nullptr;
        light.ies_file.clear();
        f.note_change();
    }
}

} // namespace blush
