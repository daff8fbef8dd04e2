// Import report against the Khronos validator: its errors are rejected or warned about, and valid files are read without
// warnings.
#include "tests/io/gltf/broken.h"
#include "tests/io/gltf/node.h"
#include "tests/support/process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace blush::test::TEST_FILE {
namespace {

struct Exception {
    const char *file, *why;
};

// Files with an error that needs no warning.
constexpr Exception harmless[] = {
    {"bounds that are not there.gltf", "bounds are computed from the vertices, not read"},
    {"bounds that are others.gltf", "bounds are computed from the vertices, not read"},
    {"children that are none.gltf", "an empty list says the same as none"},
    {"far plane before the near one.gltf", "clipping planes do not clip"},
    {"image without a kind.gltf", "its bytes tell"},
    {"light of range zero.gltf", "ranges do not cut the light off"},
    {"matrix that shears.gltf", "it is shown as it says"},
    {"second texture coordinates without the first.gltf", "each set is read by its number"},
    {"texture coordinates as plain bytes.gltf", "they are read as KHR_mesh_quantization says"},
    {"view for corners that holds positions.gltf", "targets are a hint to graphics processors"},
};

// Files without errors and warnings of the validator, for which the importer warns.
constexpr Exception suspicious[] = {
    {"unknown extension is required.gltf", "it says that it cannot be read without"},
    {"triangle without area.gltf", "it cannot be seen"},
};

enum Severity : int { error, warning, information, hint };

struct Verdict {
    bool wrong = false; // has errors
    bool clean = true;  // has neither errors nor warnings
    std::string text;
};

// By name of the files in the folder.
std::map<std::string, Verdict> verdicts_of(const GltfFiles& files, const TempFolder& folder) {
    std::vector<std::string> command{node_program(), BLUSH_JUDGE_SCRIPT, BLUSH_VALIDATOR};
    for (const auto& [name, bytes] : files) {
        write_bytes(folder / name, bytes);
        command.push_back(folder / name);
    }
    const Finished rr_throughput = run(command);
    EXPECT_EQ(rr_throughput.exit_code, 0) << rr_throughput.err;
    std::map<std::string, Verdict> verdicts;
    std::istringstream lines(rr_throughput.out);
    for (const auto& [name, bytes] : files) {
        std::string line;
        EXPECT_TRUE(std::getline(lines, line)) << name;
        Verdict& verdict = verdicts[name];
        const Json messages = Json::parse(line, nullptr, false);
        if (!messages.is_array()) continue;
        for (const Json& message : messages) {
            verdict.wrong = verdict.wrong || message[0] == error;
            verdict.clean = verdict.clean && message[0] >= information;
            if (message[0] <= warning) verdict.text += fmt::format("{} {} ", message[1].get<std::string>(), message[2].get<std::string>());
        }
    }
    return verdicts;
}

// Warnings and errors of the importer, one per line.
std::string complaints(const std::filesystem::path& file) {
    const Result<ImportedScene> imported = import_gltf(file);
    if (!imported) return imported.error().text() + "\n";
    std::string all;
    for (const Diagnostic& d : imported->report.diagnostics)
        if (d.severity == Diagnostic::Severity::warning) all += fmt::format("{}, {}\n", d.what, d.where);
    return all;
}

template <size_t N> bool is_among(const Exception (&exceptions)[N], const std::string& file) {
    return std::ranges::count(exceptions, file, &Exception::file) > 0;
}

TEST(GltfValidation, ErrorsOfTheValidatorAreRefusedOrReported) {
    REQUIRE_VALIDATOR();
    const TempFolder folder;
    size_t wrong = 0;
    for (const auto& [name, verdict] : verdicts_of(broken_files(), folder)) {
        if (!verdict.wrong) continue;
        ++wrong;
        EXPECT_EQ(complaints(folder / name).empty(), is_among(harmless, name)) << name << ": " << verdict.text;
    }
    EXPECT_GT(wrong, 100u);
}

TEST(GltfValidation, ValidFilesAreReadWithoutWarnings) {
    REQUIRE_VALIDATOR();
    const TempFolder folder;
    const GltfFiles sound = valid_files();
    GltfFiles all = sound;
    all.merge(broken_files());
    for (const auto& [name, verdict] : verdicts_of(all, folder)) {
        EXPECT_TRUE(verdict.clean || !sound.contains(name)) << name << ": " << verdict.text;
        if (!verdict.clean) continue;
        const std::string said = complaints(folder / name);
        EXPECT_EQ(!said.empty(), is_among(suspicious, name)) << name << ": " << said;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
