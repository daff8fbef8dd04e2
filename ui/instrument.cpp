#include "ui/instrument.h"

#include <algorithm>

namespace blush {

const Instrument* find_instrument(std::span<const Instrument> instruments, const std::string& id) {
    const auto found = std::ranges::find_if(instruments, [&](const Instrument& i) { return i.id == id; });
    return found == instruments.end() ? nullptr : &*found;
}

std::vector<std::string> open_instruments(std::span<const Instrument> instruments, const PanelContext& c) {
    std::vector<std::string> open;
    for (const Instrument& i : instruments)
        if (i.is_open(c)) open.emplace_back(i.id);
    return open;
}

} // namespace blush
