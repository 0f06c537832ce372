// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/pcg.hpp"

namespace estampe::tam {

using estampe::hash;

[[nodiscard]] constexpr uint32_t hash(uint32_t x, uint32_t y)
{
    return hash(x ^ hash(y));
}

/// Uniform in [0, 1), from the top 24 bits.
[[nodiscard]] constexpr float unit_float(uint32_t bits)
{
    return static_cast<float>(bits >> 8U) * (1.0F / 16777216.0F);
}

/// Smooth noise in [-1, 1] over a line, knots at the whole numbers.
[[nodiscard]] constexpr float line_noise(uint32_t seed, float x)
{
    const auto knot = static_cast<int32_t>(x) - (x < 0.0F ? 1 : 0);
    const float t = x - static_cast<float>(knot);
    const float a = unit_float(hash(seed, static_cast<uint32_t>(knot)));
    const float b = unit_float(hash(seed, static_cast<uint32_t>(knot + 1)));
    return 2.0F * (a + (b - a) * t * t * (3.0F - 2.0F * t)) - 1.0F;
}

/// A stream of numbers that is the same on every machine; the distributions of the standard library are not.
class Random {
public:
    explicit Random(uint32_t seed) : state_(hash(seed)) {}

    [[nodiscard]] uint32_t bits() { return hash(state_ += 0x9E3779B9U); }

    /// Uniform in [0, 1).
    [[nodiscard]] float unit() { return unit_float(bits()); }

    /// Uniform in [-1, 1).
    [[nodiscard]] float sign() { return 2.0F * unit() - 1.0F; }

private:
    uint32_t state_;
};

} // namespace estampe::tam
