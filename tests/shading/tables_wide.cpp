#include "tests/shading/tables_evaluate.h"

namespace blush::inline BLUSH_ISA {

void evaluate_tables_wide(const TablePoints& points, const std::array<float*, table_answers>& answers) {
    evaluate_tables<Wide>(points, answers);
}

} // namespace blush::inline BLUSH_ISA
