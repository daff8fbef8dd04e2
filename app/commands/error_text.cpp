#include "app/commands/error_text.h"

#include <fmt/format.h>

namespace blush {

std::string error_text(const ErrorEstimate& error, int digits) {
    std::string text;
    const auto add = [&](const char* name, double value, double low, double high) {
        text += fmt::format("{}{} {:.{}g} ({:.{}g} to {:.{}g})", text.empty() ? "estimated " : ", ", name, value, digits, low, digits, high,
                            digits);
    };
    if (error.known) add("relMSE", error.relmse, error.low, error.high);
    if (error.rmse_known) add("RMSE", error.rmse, error.rmse_low, error.rmse_high);
    if (error.misses_highlights)
        return text.empty() ? "error not known: small highlights of lamps may be missing"
                            : text + "; small highlights of lamps may be missing, which the intervals allow for";
    return text.empty() ? "error not known: too few samples or pixels" : text;
}

} // namespace blush
