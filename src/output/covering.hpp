// SPDX-License-Identifier: MIT
#pragma once

// Colours as programs lay them on each other that know of whole numbers and sRGB-encoded values alone.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

#include "core/srgb.hpp"

namespace estampe::output {

/// A colour of whole numbers.
using Numbers = glm::ivec3;

/// What layers do, in numbers of 0 to `top`.
class Arithmetic {
public:
    explicit Arithmetic(int bits) : top_((1 << bits) - 1) {}

    [[nodiscard]] int top() const { return top_; }

    [[nodiscard]] glm::dvec3 encoded(const glm::vec3& linear) const
    {
        glm::dvec3 result;
        for (int i = 0; i < 3; ++i) {
            result[i] = top_ * static_cast<double>(srgb_from_linear(std::clamp(linear[i], 0.0F, 1.0F)));
        }
        return result;
    }

    [[nodiscard]] int multiplied(int below, int factor) const
    {
        return static_cast<int>(rounded_quotient(int64_t{below} * factor, top_));
    }

    [[nodiscard]] int over(int below, int color, int alpha) const
    {
        return static_cast<int>(
            rounded_quotient(int64_t{below} * (top_ - alpha) + int64_t{color} * alpha, top_));
    }

    [[nodiscard]] double over(double below, int color, int alpha) const
    {
        return below + (color - below) * alpha / top_;
    }

    [[nodiscard]] int nearest(double value) const
    {
        return static_cast<int>(std::lround(std::clamp(value, 0.0, static_cast<double>(top_))));
    }

private:
    static int64_t rounded_quotient(int64_t value, int64_t by) { return (value + by / 2) / by; }

    int top_;
};

/// What lies at a pixel when the layers up to one have been laid.
struct Laid {
    Numbers rounded{0};    ///< as a program shows it that rounds at every layer
    glm::dvec3 exact{0.0}; ///< as one shows it that works in floats, in the same unit
};

/// What the next layer is to make of it.
struct Wanted {
    Numbers rounded{0};
    glm::dvec3 exact{0.0};
};

/// The number nearest to `start` for which `result`, which grows with it, is what is wanted, or as near as
/// can be.
template <class Result>
int tuned(int start, int wanted, int top, const Result& result)
{
    while (start < top && result(start) < wanted) {
        ++start;
    }
    while (start > 0 && result(start) > wanted) {
        --start;
    }
    return start;
}

/// Colour and alpha of a layer of ink or paint that turns `laid` into what is wanted, of which `paint` lies
/// there in linear light: its colour times alpha, and alpha. It keeps that colour wherever some alpha gives
/// what is wanted, and else takes the colour that does. `laid` becomes what the layer has made of it.
[[nodiscard]] glm::ivec4 covering(Laid& laid, const Wanted& wanted, const glm::vec4& paint,
                                  const Arithmetic& in);

/// A pixel of a picture that is transparent, in numbers that are not multiplied by alpha: laid on its own
/// `paper` it is the drawing, to half a step. `page` is linear colour times alpha, and alpha.
[[nodiscard]] glm::ivec4 straight(const glm::vec4& page, const glm::vec3& paper, const Arithmetic& in);

} // namespace estampe::output
