#include "render/session/error_cadence.h"

namespace blush {

void ErrorCadence::restart() {
    budget_.restart();
    last_samples_ = 0;
}

bool ErrorCadence::due(const Source& p) const {
    if (p.samples < 2) return false;
    if (p.wanted) return true;
    return double(p.samples) >= growth * double(last_samples_) && budget_.allows(p.pixels, p.seconds);
}

void ErrorCadence::record(const Source& p, double seconds) {
    last_samples_ = p.samples;
    budget_.record(p.pixels, seconds);
}

} // namespace blush
