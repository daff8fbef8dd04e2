#include "render/lights/continuation_trial.h"

namespace blush {

void ContinuationTrials::begin(int slots) { rays_.assign(size_t(slots), 0); }

} // namespace blush
