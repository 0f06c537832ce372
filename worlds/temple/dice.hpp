// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace temple {

/// Chance that is the same on every machine: SplitMix64 (Steele et al., "Fast splittable pseudorandom number
/// generators", 2014). The standard's distributions are each library's own.
class Dice {
public:
    /// Each `part` of a seed has throws of its own: what one part takes changes no other.
    explicit Dice(uint64_t seed, uint64_t part = 0) : state_(mixed(seed) ^ mixed(~part)) {}

    [[nodiscard]] uint64_t number()
    {
        state_ += 0x9e3779b97f4a7c15U;
        return mixed(state_);
    }

    /// 0 up to, and without, 1.
    [[nodiscard]] float share() { return static_cast<float>(number() >> 40U) * 0x1p-24F; }

    [[nodiscard]] float between(float low, float high) { return low + (high - low) * share(); }

    /// 0 to count - 1.
    [[nodiscard]] int below(int count) { return static_cast<int>(share() * static_cast<float>(count)); }

    [[nodiscard]] bool chance(float of_one) { return share() < of_one; }

private:
    [[nodiscard]] static uint64_t mixed(uint64_t bits)
    {
        bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
        bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
        return bits ^ (bits >> 31U);
    }

    uint64_t state_;
};

} // namespace temple
