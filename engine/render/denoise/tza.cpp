#include "render/denoise/tza.h"

#include "core/lanes.h"

#include <fmt/format.h>

#include <cmath>

namespace blush::denoise {
namespace {

constexpr uint16_t magic = 0x41D7;
constexpr uint8_t major_version = 2;

float float_from_half(uint16_t half) {
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    float magnitude;
    if (exponent == 31)
        magnitude = fraction ? NAN : INFINITY;
    else if (exponent == 0)
        magnitude = std::ldexp(float(fraction), -24);
    else
        magnitude = float_from_bits((exponent + 112) << 23 | fraction << 13);
    return half & 0x8000 ? -magnitude : magnitude;
}

// Reads little-endian numbers from a position in the file. After reading beyond the end it returns zeros and is `bad`.
class Reader {
public:
    Reader(std::span<const uint8_t> bytes, uint64_t at) : bytes_(bytes), at_(at) {}

    bool bad() const { return bad_; }
    uint64_t at() const { return at_; }

    std::span<const uint8_t> take(uint64_t count) {
        if (at_ > bytes_.size() || count > bytes_.size() - at_) bad_ = true;
        if (bad_) return {};
        const auto taken = bytes_.subspan(at_, count);
        at_ += count;
        return taken;
    }
    template <class T> T number() {
        const auto taken = take(sizeof(T));
        T value{};
        for (size_t i = 0; i < taken.size(); i++) value = T(value | T(taken[i]) << 8 * i);
        return value;
    }
    std::string text(uint64_t length) {
        const auto taken = take(length);
        return {taken.begin(), taken.end()};
    }

private:
    std::span<const uint8_t> bytes_;
    uint64_t at_;
    bool bad_ = false;
};

class TzaFile {
public:
    TzaFile(std::span<const uint8_t> bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    Result<TensorTable> read() {
        Reader head(bytes_, 0);
        if (head.number<uint16_t>() != magic) return error("not a weights file (wrong magic number)", 0);
        if (head.number<uint8_t>() != major_version) return error("unknown version of the weights format", 2);
        head.number<uint8_t>(); // minor versions only add data
        Reader table(bytes_, head.number<uint64_t>());
        const uint32_t count = table.number<uint32_t>();
        if (head.bad() || table.bad()) return error("the tensor table lies beyond the end of the file", 4);

        TensorTable tensors;
        for (uint32_t i = 0; i < count; i++) {
            const uint64_t entry = table.at();
            const std::string name = table.text(table.number<uint16_t>());
            auto tensor = read_tensor(table, entry);
            if (!tensor) return tensor.error();
            if (!tensors.emplace(name, std::move(*tensor)).second) return error("two tensors have the same name", entry);
        }
        return tensors;
    }

private:
    Error error(const char* what, uint64_t byte) const { return {file_, what, fmt::format("byte {}", byte)}; }

    Result<Tensor> read_tensor(Reader& table, uint64_t entry) {
        Tensor tensor;
        tensor.dimensions.resize(table.number<uint8_t>());
        uint64_t count = 1;
        for (uint32_t& dimension : tensor.dimensions) {
            dimension = table.number<uint32_t>();
            count = dimension && count > bytes_.size() / dimension ? bytes_.size() + 1 : count * dimension;
        }
        tensor.layout = table.text(tensor.dimensions.size());
        const char type = char(table.number<uint8_t>());
        const uint64_t offset = table.number<uint64_t>();
        if (table.bad()) return error("the tensor table is truncated", entry);
        if (type != 'h' && type != 'f') return error("unknown value type", entry);

        // Tensors do not overlap, so together they are no larger than the file. (Otherwise a table that references the same bytes
        // repeatedly could request any amount of memory.)
        const uint64_t size = count * (type == 'h' ? 2 : 4);
        if (size > bytes_.size() - claimed_) return error("tensors are larger than the file", entry);
        claimed_ += size;
        Reader data(bytes_, offset);
        tensor.values.resize(count);
        for (float& value : tensor.values)
            value = type == 'h' ? float_from_half(data.number<uint16_t>()) : float_from_bits(int32_t(data.number<uint32_t>()));
        if (data.bad()) return error("a tensor lies beyond the end of the file", entry);
        for (const float value : tensor.values)
            if (!is_finite(value)) return error("a tensor has values that are not finite", entry);
        return tensor;
    }

    std::span<const uint8_t> bytes_;
    const std::string& file_;
    uint64_t claimed_ = 0;
};

} // namespace

Result<TensorTable> read_tza(std::span<const uint8_t> bytes, const std::string& file) { return TzaFile(bytes, file).read(); }

} // namespace blush::denoise
