// Replays the fuzz corpora without a fuzzer, as regression tests.
#include "tests/fuzz/targets.h"

#include "core/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace blush::test::TEST_FILE {
namespace {

struct Corpus {
    const char* name;
    fuzz::Target* target;
};
void PrintTo(const Corpus& corpus, std::ostream* out) { *out << corpus.name; }

class FuzzCorpus : public testing::TestWithParam<Corpus> {};

// Every file complete, and truncated to its first half.
TEST_P(FuzzCorpus, DoesNoHarm) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(BLUSH_CORPUS) / GetParam().name)) {
        SCOPED_TRACE(entry.path().filename().string());
        const auto bytes = read_file(entry.path(), 1 << 20);
        ASSERT_TRUE(bytes);
        GetParam().target(*bytes);
        GetParam().target(std::span(*bytes).first(bytes->size() / 2));
        ++files;
    }
    EXPECT_GE(files, 5);
}

INSTANTIATE_TEST_SUITE_P(, FuzzCorpus,
                         testing::Values(Corpus{"importer", fuzz::importer}, Corpus{"ies", fuzz::ies}, Corpus{"settings", fuzz::settings},
                                         Corpus{"weights", fuzz::weights}),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace blush::test::TEST_FILE
