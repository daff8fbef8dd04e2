#include "app/common/unique_filename.h"

#include <fmt/format.h>

namespace blush {

Result<std::filesystem::path> unique_filename(const std::filesystem::path& folder, const std::string& stem, const std::string& extension) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return Error{folder.string(), "cannot create the folder: " + error.message(), ""};
    for (int number = 1; number < 100000; ++number) {
        const auto file = folder / fmt::format("{}-{:04}{}", stem, number, extension);
        if (!std::filesystem::exists(file, error)) return file;
    }
    return Error{folder.string(), fmt::format("all file names from {}-0001{} on are in use", stem, extension), ""};
}

} // namespace blush
