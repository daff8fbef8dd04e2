// The figures of a run as Markdown, for docs/dev/measured.md.
#pragma once

#include "tests/bench/bench.h"

#include <span>
#include <string>

namespace blush::bench {

// A case of the report and the sentence that says what it measures.
struct ReportedCase {
    const char* name;
    const char* description;
};

// Tables of the `cases` that `report` contains: a list of objects becomes a table with a row for each, an object a table of two
// columns; nested objects are flattened.
std::string to_markdown(const Json& report, std::span<const ReportedCase> cases);

} // namespace blush::bench
