#include "tests/bench/machine.h"

#include "render/renderer.h"

#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <string>
#include <thread>

namespace blush::bench {
namespace {

// The text after "key   : " in a file of such lines.
std::string value_of(const char* file, const std::string& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(key)) continue;
        const size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
        return begin == std::string::npos ? std::string() : line.substr(begin);
    }
    return {};
}

double memory_mb(const std::string& key) { return std::strtod(value_of("/proc/self/status", key).c_str(), nullptr) / 1024; }

} // namespace

nlohmann::ordered_json describe_machine() {
    double load = 0;
    std::ifstream("/proc/loadavg") >> load;
    return {{"processor", value_of("/proc/cpuinfo", "model name")},
            {"cores", std::thread::hardware_concurrency()},
            {"instruction_sets", available_isas()},
            {"load_average", load}};
}

MemoryGrowth::MemoryGrowth() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5"; // resets the peak (VmHWM)
    before_mb_ = memory_mb("VmRSS");
}

double MemoryGrowth::peak_mb() const { return memory_mb("VmHWM") - before_mb_; }

} // namespace blush::bench
