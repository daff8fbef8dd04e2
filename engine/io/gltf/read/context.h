// Internal to the import: what every step gets: the parsed file, the options, and where it reports.
#pragma once

#include "core/result.h"
#include "io/gltf/read/geometry/indices.h"
#include "io/gltf/read/import_options.h"
#include "io/gltf/read/import_report.h"
#include "io/gltf/read/source.h"

#include <atomic>
#include <string>
#include <utility>
#include <vector>

namespace blush {

struct GltfContext {
    const GltfSource& source;
    const ImportOptions& options;
    ImportReport& report;
    // If set, triangles and pixels are not read, and primitives and textures are taken from here.
    const GltfIndices* known = nullptr;

    const tinygltf::Model& model() const { return source.model; }
    const nlohmann::json& json() const { return *source.json; }
    Error error(std::string what, std::string where) const { return {source.file.string(), std::move(what), std::move(where)}; }
    // Diagnostics beyond a few hundred are dropped: a broken exporter may cause one per triangle.
    void warn(std::string what, std::string where) const { add(Diagnostic::Severity::warning, std::move(what), std::move(where)); }
    void note(std::string what, std::string where) const { add(Diagnostic::Severity::note, std::move(what), std::move(where)); }
    // Appends the diagnostics of another context of the same import.
    void add_all(const std::vector<Diagnostic>& findings) const {
        for (const Diagnostic& d : findings) add(d.severity, d.what, d.where);
    }
    GltfContext reporting_to(ImportReport& other) const { return {source, options, other, known}; }
    bool cancelled() const { return options.cancel && options.cancel->load(std::memory_order_relaxed); }
    Error cancel_error() const { return error(import_cancelled, ""); }
    void progress(double fraction, const std::string& what) const {
        if (options.on_progress) options.on_progress(fraction, what);
    }

private:
    void add(Diagnostic::Severity severity, std::string what, std::string where) const;
};

} // namespace blush
