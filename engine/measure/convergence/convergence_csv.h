// Convergence records as CSV: reads and writes those of the window, reads those of `blush converge`.
#pragma once

#include "core/result.h"
#include "measure/convergence/convergence.h"

#include <string>
#include <string_view>
#include <vector>

namespace blush {

// name,seconds,spp,relmse,relmse_low,relmse_high,rmse,rmse_low,rmse_high,kind,label; one line per point, and one of kind "mark"
// with a label for each mark. Unknown values are empty.
std::string to_csv(const std::vector<ConvergenceRecord>& records);

// Reads what to_csv() wrote, and the convergence.csv of `blush converge`: each variant and repeat is a record of measured points, whose
// RMSE is the root of `mse`. Columns are found by name, unknown ones are ignored. At most 64 records and 20000 lines. Errors name
// the line: missing columns, an invalid, negative or non-finite number, an unclosed quote, no data.
Result<std::vector<ConvergenceRecord>> parse_convergence_csv(std::string_view text);

// Quotes a text as a CSV field.
std::string csv_field(const std::string& text);

} // namespace blush
