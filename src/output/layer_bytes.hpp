// SPDX-License-Identifier: MIT
#pragma once

// Layers as programs lay them on each other that know of whole numbers and sRGB-encoded values alone.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/layers.hpp>

namespace estampe::output {

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

/// Throws Error as flattened() does.
void check_layers(const LayeredImage& image);
/// Throws Error as well when the picture is not as large as its layers.
void check_whole(const LayeredImage& image);

/// Lays one layer on another in linear light.
void lay(LinearImage& below, const PictureLayer& layer);

} // namespace estampe::output
