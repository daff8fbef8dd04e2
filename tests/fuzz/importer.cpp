#include "io/gltf/read/import.h"
#include "scene/validate.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace blush::fuzz {
namespace {

// A temporary folder with the files that the scenes of the corpus reference.
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "blush-fuzz-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(BLUSH_CORPUS) / "beside"))
            std::filesystem::copy_file(entry.path(), path_ / entry.path().filename());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace

void importer(std::span<const uint8_t> bytes) {
    static const Folder folder;
    const std::filesystem::path file = folder.path() / "scene.gltf";
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    if (const auto imported = import_gltf(file)) promise(validate(imported->scene));
}

} // namespace blush::fuzz
