// Internal to gltf_*.cpp: the parsed file, and what every step of the import needs beside it.
#pragma once

#include "core/result.h"
#include "io/gltf_import.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <string>

namespace blush {

struct GltfSource {
    std::filesystem::path file, folder;
    tinygltf::Model model;    // images hold their encoded bytes, or none if they live in a buffer view or are missing
    std::string parser_notes; // what tinygltf complained about without giving up
};

// Reads and checks the file and the buffers and images beside it. Nothing else is opened, whatever the file says.
Result<GltfSource> load_gltf(const std::filesystem::path& file);

struct GltfContext {
    const GltfSource& source;
    const ImportOptions& options;
    ImportReport& report;

    const tinygltf::Model& model() const { return source.model; }
    Error error(std::string what, std::string where) const { return {source.file.string(), std::move(what), std::move(where)}; }
    // Findings beyond a few hundred are dropped: one broken exporter repeats itself for every triangle.
    void warn(std::string what, std::string where) const { add(Diagnostic::Severity::warning, std::move(what), std::move(where)); }
    void note(std::string what, std::string where) const { add(Diagnostic::Severity::note, std::move(what), std::move(where)); }
    bool cancelled() const { return options.cancel && options.cancel->load(std::memory_order_relaxed); }
    Error cancel_error() const { return error("cancelled", ""); }
    void progress(double fraction, const std::string& what) const {
        if (options.on_progress) options.on_progress(fraction, what);
    }

private:
    void add(Diagnostic::Severity severity, std::string what, std::string where) const;
};

} // namespace blush
