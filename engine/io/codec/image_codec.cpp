#include "io/codec/image_codec.h"

#include "core/memory_limit.h"
#include "io/codec/guarded.h"

#include <atomic>
#include <chrono>
#include <dlfcn.h>
#include <fmt/format.h>
#include <mutex>

namespace blush {
namespace {

constexpr double not_loaded = -1;
std::atomic<double> load_seconds{not_loaded};

// What loading needs: address space, of which measured 0.43 GB, and memory, of which measured 0.12 GB. One of the libraries starts
// threads, and waits for ever for those that it could not start.
constexpr double address_space = 6e8, memory = 1.5e8;

struct Loaded {
    const ImageCodec* codec = nullptr;
    std::string error = {};
};

// By its name alone: the program's run path leads to it, in the build folder as after installation.
Loaded load() {
    const MemoryLimit room = memory_limit();
    const double needed = room.is_of_address_space() ? address_space : memory;
    if (double(room.left) < needed) return {nullptr, fmt::format("it needs {:.2g} GB of memory: {}", needed / 1e9, room.text())};
    const auto begin = std::chrono::steady_clock::now();
    void* module = dlopen(BLUSH_IMAGE_CODEC, RTLD_LAZY | RTLD_LOCAL);
    if (!module) return {nullptr, one_line(dlerror())};
    using Entry = const ImageCodec*(const char* version);
    auto* const entry = reinterpret_cast<Entry*>(dlsym(module, "blush_image_codec"));
    const ImageCodec* const codec = entry ? entry(BLUSH_VERSION) : nullptr;
    if (!codec) return {nullptr, BLUSH_IMAGE_CODEC " is of another version of Blush"};
    load_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return {codec};
}

} // namespace

Result<const ImageCodec*> image_codec(const std::string& name) {
    static std::mutex mutex;
    static const ImageCodec* codec = nullptr;
    const std::lock_guard lock(mutex);
    if (!codec) {
        const Loaded loaded = load();
        if (!loaded.codec) return Error{name, "the library for image files cannot be loaded: " + loaded.error, ""};
        codec = loaded.codec;
    }
    return codec;
}

std::optional<double> image_codec_load_seconds() {
    const double seconds = load_seconds;
    return seconds == not_loaded ? std::nullopt : std::optional(seconds);
}

} // namespace blush
