#include "app/free_name.h"

#include <fmt/format.h>

namespace blush {

Result<std::filesystem::path> free_name(const std::filesystem::path& folder, const std::string& stem, const std::string& extension) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return Error{folder.string(), "cannot make the folder: " + error.message(), ""};
    for (int number = 1; number < 100000; ++number) {
        const auto file = folder / fmt::format("{}-{:04}{}", stem, number, extension);
        if (!std::filesystem::exists(file, error)) return file;
    }
    return Error{folder.string(), fmt::format("the folder is full of files called {}-0001{} and so on", stem, extension), ""};
}

} // namespace blush
