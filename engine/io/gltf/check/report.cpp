#include "io/gltf/check/report.h"

#include "io/gltf/check/schema_check.h"
#include "io/gltf/read/extensions.h"

#include <fmt/format.h>
#include <set>
#include <sstream>

namespace blush {
namespace {

void report_extension(const GltfContext& context, const std::string& name) {
    using Kind = ExtensionSupport::Kind;
    const ExtensionSupport support = extension_support(name);
    ImportReport& report = context.report;
    report.extensions_used.push_back(name);
    switch (support.kind) {
    case Kind::honoured: report.extensions_honoured.push_back(name); return;
    case Kind::approximated:
        report.extensions_approximated.push_back(name);
        context.note(fmt::format("approximated: {}: {}", name, support.why), "extensionsUsed");
        return;
    case Kind::ignored:
        report.extensions_ignored.push_back(name);
        context.warn(fmt::format("ignored: {}: {}", name, support.why), "extensionsUsed");
        return;
    }
}

} // namespace

void report_file(const GltfContext& context) {
    const tinygltf::Model& model = context.model();
    std::set<std::string> names(model.extensionsUsed.begin(), model.extensionsUsed.end());
    names.insert(model.extensionsRequired.begin(), model.extensionsRequired.end());
    for (const std::string& name : names) report_extension(context, name.substr(0, 100));
    std::istringstream lines(context.source.parser_notes);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) context.warn(line.substr(0, 200), "");
    if (!context.known) check_schema(context);
}

} // namespace blush
