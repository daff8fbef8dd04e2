// 64-bit hash of words and bytes, against accidents: not cryptographic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace blush {

class Hash64 {
public:
    void word(uint64_t w) { state_ = mixed(state_, w); }
    void bytes(std::span<const std::byte> data) {
        word(data.size());
        if (data.size() >= 64 * lanes * sizeof(uint64_t)) data = in_lanes(data);
        for (; data.size() >= sizeof(uint64_t); data = data.subspan(sizeof(uint64_t))) word(word_at(data.data()));
        uint64_t rest = 0;
        if (!data.empty()) std::memcpy(&rest, data.data(), data.size());
        word(rest);
    }
    template <class Values> void array(const Values& values) { bytes(std::as_bytes(std::span(values))); }

    uint64_t value() const { return state_; }

private:
    static constexpr size_t lanes = 8;

    // Multiply and fold, then the finaliser of SplitMix64 (Steele, Lea, Flood 2014), so that each word reaches every bit.
    static uint64_t mixed(uint64_t state, uint64_t w) {
        uint64_t x = (state ^ w) + 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    static uint64_t word_at(const std::byte* place) {
        uint64_t w;
        std::memcpy(&w, place, sizeof w);
        return w;
    }
    // Lane k takes each eighth word: a word waits for the one before it in its lane only, which is several times faster. Returns
    // the bytes that are left.
    std::span<const std::byte> in_lanes(std::span<const std::byte> data) {
        std::array<uint64_t, lanes> states;
        for (size_t k = 0; k < lanes; ++k) states[k] = mixed(state_, k);
        constexpr size_t step = lanes * sizeof(uint64_t);
        const size_t end = data.size() / step * step;
        for (size_t at = 0; at < end; at += step)
            for (size_t k = 0; k < lanes; ++k) states[k] = mixed(states[k], word_at(data.data() + at + k * sizeof(uint64_t)));
        for (const uint64_t state : states) word(state);
        return data.subspan(end);
    }

    uint64_t state_ = 0;
};

} // namespace blush
