#include "io/gltf/read/context.h"

namespace blush {
namespace {

constexpr size_t max_findings = 500;

} // namespace

void GltfContext::add(Diagnostic::Severity severity, std::string what, std::string where) const {
    if (report.diagnostics.size() < max_findings)
        report.diagnostics.push_back({severity, std::move(what), std::move(where)});
    else if (report.diagnostics.size() == max_findings)
        report.diagnostics.push_back({severity, "more findings than can be listed", ""});
}

} // namespace blush
