// How a file is imported.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace blush {

struct ImportedScene; // import.h

constexpr const char* import_cancelled = "cancelled"; // the error of an import that ImportOptions::cancel has ended

struct ImportOptions {
    unsigned threads = 0; // for meshes and textures, including the calling one; 0: one per core. Does not affect the result

    std::function<void(double fraction, const std::string& what)> on_progress; // called on the importing thread
    const std::atomic<bool>* cancel = nullptr;                                 // true ends the import with the error import_cancelled
    int64_t texture_bytes = int64_t(4) << 30; // limit of all decoded textures; the largest are halved until they fit
    // Called on the importing thread if textures take longer than the rest, with the preview scene (scene/document/preview_scene.h):
    // once without textures, then with more and more of them, some of them smaller than they are, with pauses. Textures may still
    // turn out to be unreadable, and the import may still be cancelled. Does not affect the result.
    std::function<void(const ImportedScene&)> on_preview_scene = {};
};

} // namespace blush
