#include "ui/instrument.h"

#include <algorithm>

namespace blush {

const Instrument* find_instrument(std::span<const Instrument> instruments, const std::string& id) {
    const auto found = std::ranges::find_if(instruments, [&](const Instrument& i) { return i.id == id; });
    return found == instruments.end() ? nullptr : &*found;
}

std::vector<Instrument> instruments_in_sight(std::span<const Instrument> instruments, const PanelContext& c) {
    std::vector<Instrument> shown;
    for (const Instrument& i : instruments) {
        // A snapshot in a presentation is a comparison, but one that is only looked at.
        const bool hides = c.ui.presentation.on && (c.ui.presentation.hidden.contains(i.id) || i.id == std::string_view("comparison"));
        if (!hides) shown.push_back(i);
    }
    return shown;
}

std::vector<std::string> open_instruments(std::span<const Instrument> instruments, const PanelContext& c) {
    std::vector<std::string> open;
    for (const Instrument& i : instruments)
        if (i.is_open(c)) open.emplace_back(i.id);
    return open;
}

} // namespace blush
