// SPDX-License-Identifier: MIT
#pragma once

// A picture taken apart into what lies on what, for programs that paint.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

namespace estampe {

/// How a layer lies on what is below it, in linear light: normal is colour + (1 - alpha) * below; multiply,
/// whose alpha is 1 throughout, colour * below.
enum class LayerBlend : uint8_t { normal, multiply };

/// One sheet of a drawing: paper, wash, flowing ink, hatching or lines.
struct PictureLayer {
    std::string name;
    LayerBlend blend = LayerBlend::normal;
    LinearImage image;      ///< as large as the page
    bool is_visible = true; ///< else it is kept for whoever wants it, as the paper of a transparent picture
};

/// Where something is, as a share of each pixel; not seen in the picture.
struct PictureMask {
    std::string name;
    bool is_object = true; ///< of the scene; else what its name says
    uint32_t above = 0;    ///< it lies on this many of the layers
    uint32_t x = 0;        ///< left edge of the part of the page that holds all of it, in pixels
    uint32_t y = 0;        ///< its upper edge, from the top
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> cover; ///< width * height values of 0 to 1, rows from top to bottom
};

/// A picture, and what it is made of, see Renderer::render_layers().
struct LayeredImage {
    Image picture;                    ///< the very bytes that Renderer::render() gives
    std::vector<PictureLayer> layers; ///< from the bottom, which is opaque, up
    std::vector<PictureMask> masks;   ///< in the order in which they lie on each other
    /// The linear colour of the paper that is left out of a transparent picture. Not given: it is opaque.
    std::optional<glm::vec3> paper;
};

/// The visible layers laid on each other, in linear light: opaque, unless the picture is transparent. Throws
/// Error when there is none, or they are not all as large as the picture. Cost: about 10 ms a megapixel and
/// layer.
[[nodiscard]] LinearImage flattened(const LayeredImage& image);

/// Writes an OpenRaster file, which Krita, GIMP and MyPaint open: the layers visible, but for the paper of a
/// transparent picture, and the masks hidden, as PNG of eight bits. The format lays layers on each other in
/// sRGB-encoded values, so colours and alphas are found anew for that: an ink keeps its colour and changes
/// its alpha wherever that gives the picture, and else takes the colour that does. What such a program then
/// shows is the picture, to 1/255 a channel. Beside `path` first and renamed into place. Throws Error as
/// flattened() does, when the picture is not as large or the bottom not opaque, and when the file cannot be
/// written. Cost: about 2 s a megapixel. Source: OpenRaster 0.0.3, www.openraster.org
void save_openraster(const LayeredImage& image, const std::filesystem::path& path);

/// Writes the same layers and masks as PNG files into a new folder, with `layers.json`, which lists them from
/// the bottom up: file, name, blend ("normal", "multiply"), visible, x, y, width, height. `bits` a channel
/// are 8, or 16 for layers that give the picture to 1/65535; masks have 8. Throws Error as save_openraster()
/// does, and when the folder exists and is not empty.
void save_layers(const LayeredImage& image, const std::filesystem::path& folder, int bits = 8);

/// Writes one OpenEXR picture in linear light: the picture as R, G and B, with A if it is transparent, each
/// layer as NAME.R, NAME.G, NAME.B and NAME.A, its colour multiplied by its alpha, and each mask as NAME.Y.
/// What is listed by its header's `estampe:layers` is in the form of layers.json. Dots in names become
/// underscores, as names must differ. Throws Error as flattened() does, and when the file cannot be written.
void save_layers_exr(const LayeredImage& image, const std::filesystem::path& path,
                     ExrNumbers numbers = ExrNumbers::half);

} // namespace estampe
