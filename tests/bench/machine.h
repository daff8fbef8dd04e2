// What the figures were measured on.
#pragma once

#include <nlohmann/json.hpp>

namespace blush::bench {

// Processor, cores, instruction sets, and how busy the machine is already.
nlohmann::ordered_json describe_machine();

// How much the resident memory of this process grew at most since a moment, in MB; 0 where the system does not tell.
class MemoryGrowth {
public:
    // Gives back what has been freed before, or later allocations would find it and cost nothing.
    MemoryGrowth();
    double peak_mb() const;

private:
    double before_mb_;
};

} // namespace blush::bench
