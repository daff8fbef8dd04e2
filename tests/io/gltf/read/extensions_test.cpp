// Checks docs/reference/gltf.md against the importer and the existing tests.
#include "io/gltf/read/extensions.h"
#include "tests/io/gltf/builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

namespace blush::test::TEST_FILE {
namespace {

struct Row {
    std::string what, verdict;
    std::vector<std::string> tests; // "Suite.Name"
};

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string trimmed(std::string text) {
    text.erase(text.find_last_not_of(' ') + 1);
    return text.erase(0, text.find_first_not_of(' '));
}

std::vector<std::string> all_matches(const std::string& text, const char* pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
        found.push_back((*it)[1]);
        if (it->size() > 2) found.back() += fmt::format(".{}", (*it)[2].str());
    }
    return found;
}

std::vector<Row> coverage() {
    std::istringstream lines(text_of(std::filesystem::path(BLUSH_TESTS).parent_path() / "docs/reference/gltf.md"));
    std::vector<Row> rows;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ") || line.starts_with("| What |")) continue;
        std::vector<std::string> cells;
        std::istringstream in(line.substr(1));
        for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
        if (cells.size() != 4) {
            ADD_FAILURE() << "a row has four cells: " << line;
            continue;
        }
        rows.push_back({cells[0], cells[1], all_matches(cells[3], R"(`(\w+\.\w+)`)")});
    }
    return rows;
}

// gtest names of all source files below tests/.
std::set<std::string> existing_tests() {
    std::set<std::string> tests;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(BLUSH_TESTS))
        if (entry.path().extension() == ".cpp")
            for (std::string& name : all_matches(text_of(entry.path()), R"(\nTEST(?:_P|_F)?\((\w+),\s*(\w+)\))"))
                tests.insert(std::move(name));
    return tests;
}

const char* word(ExtensionSupport::Kind kind) {
    switch (kind) {
    case ExtensionSupport::Kind::honoured: return "honoured";
    case ExtensionSupport::Kind::approximated: return "approximated";
    case ExtensionSupport::Kind::ignored: return "ignored";
    }
    return "";
}

TEST(GltfCoverage, EveryRowHasAVerdictAndATestThatExists) {
    const std::set<std::string> known = existing_tests();
    const std::vector<Row> rows = coverage();
    ASSERT_GT(rows.size(), 50u);
    for (const Row& row : rows) {
        EXPECT_TRUE(row.verdict == "honoured" || row.verdict == "approximated" || row.verdict == "ignored")
            << row.what << ": " << row.verdict;
        EXPECT_FALSE(row.tests.empty()) << row.what;
        for (const std::string& test : row.tests) EXPECT_TRUE(known.contains(test)) << row.what << ": there is no test " << test;
    }
}

TEST(GltfCoverage, EveryExtensionThatTheImporterKnowsHasItsRow) {
    const std::vector<Row> rows = coverage();
    for (const std::string_view name : known_extensions()) {
        const auto row = std::ranges::find(rows, fmt::format("`{}`", name), &Row::what);
        ASSERT_NE(row, rows.end()) << name;
        EXPECT_EQ(row->verdict, word(extension_support(name).kind)) << name;
    }
}

TEST(GltfCoverage, ExtensionsAreReportedAsTheTableSays) {
    for (const std::string_view name : known_extensions()) {
        GltfBuilder b;
        b.json["extensionsUsed"] = {std::string(name)};
        const auto imported = import_built(b);
        ASSERT_TRUE(imported) << error_text(imported);
        const ImportReport& report = imported->report;
        const ExtensionSupport support = extension_support(name);
        const auto listed = [&](const std::vector<std::string>& list) { return std::ranges::count(list, name) == 1; };
        EXPECT_EQ(listed(report.extensions_honoured), support.kind == ExtensionSupport::Kind::honoured) << name;
        EXPECT_EQ(listed(report.extensions_approximated), support.kind == ExtensionSupport::Kind::approximated) << name;
        EXPECT_EQ(listed(report.extensions_ignored), support.kind == ExtensionSupport::Kind::ignored) << name;
        const bool explained = reports(report, fmt::format("{}: {}: {}", word(support.kind), name, support.why));
        EXPECT_EQ(explained, support.kind != ExtensionSupport::Kind::honoured) << name;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
