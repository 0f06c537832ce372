// SPDX-License-Identifier: MIT
#pragma once

// Layers, and colours, as programs lay them on each other that know of whole numbers and sRGB-encoded values
// alone.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/layers.hpp>

#include "core/color.hpp"

namespace estampe::output {

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

/// A pixel of a picture that is transparent, in numbers that are not multiplied by alpha: laid on its own
/// `paper` it is the drawing, to half a step. `page` is linear colour times alpha, and alpha.
[[nodiscard]] glm::ivec4 straight(const glm::vec4& page, const glm::vec3& paper, const Arithmetic& in);

/// A layer of whole numbers, 0 to the top of the picture's depth: red, green, blue and alpha, sRGB-encoded,
/// colours not multiplied by alpha.
struct EncodedLayer {
    std::string name;
    LayerBlend blend = LayerBlend::normal;
    bool is_visible = true;
    std::vector<uint16_t> rgba; ///< four a pixel of the page
};

/// Finds layers of whole numbers which, laid on each other in sRGB-encoded values by svg:src-over and
/// svg:multiply, give the picture. Each is found against what those below it come to when every step is
/// rounded, so that a program that works in bytes shows the picture itself; where more than one number does
/// that, the one is taken that serves programs that work in floats. Throws Error as check_whole() does,
/// and when the bottom layer is not opaque.
[[nodiscard]] std::vector<EncodedLayer> encoded_layers(const LayeredImage& image, int bits);

/// Throws Error as well when the picture is not as large as its layers.
void check_whole(const LayeredImage& image);

/// Lays one layer on another in linear light.
void lay(LinearImage& below, const PictureLayer& layer);

/// The layer of that name on white, or what its mask leaves of white. Throws Error naming those that there
/// are when none has it, and as flattened() does.
[[nodiscard]] LinearImage one_layer(const LayeredImage& image, const std::string& name);

/// In bytes, sRGB-encoded.
[[nodiscard]] Image encoded_bytes(const LinearImage& image);

} // namespace estampe::output
