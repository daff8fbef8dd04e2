// Describes the machine of a measurement.
#pragma once

#include <nlohmann/json.hpp>

namespace blush::bench {

// Processor, cores, instruction sets, and current load.
nlohmann::ordered_json describe_machine();

// Maximal growth of this process's resident memory since construction, in MB; 0 if the system does not report it.
class MemoryGrowth {
public:
    // Returns freed memory to the system, or later allocations would reuse it at no cost.
    MemoryGrowth();
    double peak_mb() const;

private:
    double before_mb_;
};

} // namespace blush::bench
