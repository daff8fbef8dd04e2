// Internal to gltf_*.cpp: the parsed file, and the context that is passed to every step of the import.
#pragma once

#include "core/result.h"
#include "io/gltf/read/import.h"

#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

#include <filesystem>
#include <memory>
#include <string>

namespace blush {

struct GltfSource {
    std::filesystem::path file, folder;
    tinygltf::Model model;                      // images hold their encoded bytes; none if they are in a buffer view or missing
    std::string parser_notes;                   // warnings of tinygltf
    std::shared_ptr<const std::string> text;    // the JSON
    std::shared_ptr<const nlohmann::json> json; // parsed: extras and extensions are read from here
};

// Reads and checks the file and its external buffers and images. Opens no other files.
Result<GltfSource> load_gltf(const std::filesystem::path& file);

// For a document that is being saved: everything except triangles and pixels. Opens no files.
Result<GltfSource> load_gltf_records(const std::string& text);

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
    Error cancel_error() const { return error("cancelled", ""); }
    void progress(double fraction, const std::string& what) const {
        if (options.on_progress) options.on_progress(fraction, what);
    }

private:
    void add(Diagnostic::Severity severity, std::string what, std::string where) const;
};

} // namespace blush
