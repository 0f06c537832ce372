// SPDX-License-Identifier: MIT
#pragma once

// Layers and colours for programs that composite sRGB-encoded integers.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/layers.hpp>

#include "core/color.hpp"

namespace estampe::output {

/// Arithmetic of compositing with integers from 0 to `top`.
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

/// Returns the straight (not premultiplied) colour and alpha of a pixel of a transparent picture. If the
/// result is composited onto `paper`, it equals the drawing to within half a step. `page` is the pixel's
/// premultiplied linear colour and alpha.
[[nodiscard]] glm::ivec4 straight(const glm::vec4& page, const glm::vec3& paper, const Arithmetic& in);

/// A layer of integers from 0 to the largest value of the bit depth: red, green, blue and alpha,
/// sRGB-encoded, straight alpha.
struct EncodedLayer {
    std::string name;
    LayerBlend blend = LayerBlend::normal;
    bool is_visible = true;
    std::vector<uint16_t> rgba; ///< Red, green, blue and alpha for each pixel of the page
};

/// Converts layers to integers that give the picture when composited in sRGB-encoded values by svg:src-over
/// and svg:multiply. Each layer is computed from the rounded composite of the layers below, so that a program
/// that works in bytes shows the exact picture. Among several possible values, the best value for programs
/// that work in floats is used. Throws Error as check_whole() does, and if the bottom layer is not opaque.
[[nodiscard]] std::vector<EncodedLayer> encoded_layers(const LayeredImage& image, int bits);

/// Checks the layers and the picture. Throws Error as flattened() does, and if the picture and its layers
/// differ in size.
void check_whole(const LayeredImage& image);

/// Composites a layer onto the picture `below` in linear light.
void lay(LinearImage& below, const PictureLayer& layer);

/// Returns the layer with this name on white, or white minus the mask with this name. If no layer or mask has
/// the name, throws an Error that lists the names. Also throws Error as flattened() does.
[[nodiscard]] LinearImage one_layer(const LayeredImage& image, const std::string& name);

/// Encodes a linear image as sRGB bytes.
[[nodiscard]] Image encoded_bytes(const LinearImage& image);

} // namespace estampe::output
