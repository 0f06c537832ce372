// SPDX-License-Identifier: MIT
#pragma once

// A picture separated into its layers and masks, for painting and compositing programs.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

namespace estampe {

/// Blend mode of a layer over the layers below it, in linear light. normal: the result is colour + (1 -
/// alpha) * below, with premultiplied colour. multiply: the result is colour * below, and the layer's alpha
/// is 1 everywhere.
enum class LayerBlend : uint8_t { normal, multiply };

/// One layer of a drawing: paper, wash, flowing ink, hatching or lines.
struct PictureLayer {
    std::string name;
    LayerBlend blend = LayerBlend::normal;
    LinearImage image; ///< Pixels of the layer; as large as the whole picture
    /// The layer is part of the picture. False for example for the paper of a transparent picture.
    bool is_visible = true;
};

/// Coverage of one object or effect, per pixel. Masks are not part of the picture.
struct PictureMask {
    std::string name;
    /// True: the mask shows the coverage of a node of the scene. False: the mask shows the coverage of an
    /// effect, such as "shadow".
    bool is_object = true;
    uint32_t above = 0; ///< Number of the picture's layers that lie below the mask
    uint32_t x = 0;     ///< Left edge of the mask's rectangle, which contains all covered pixels; in pixels
    uint32_t y = 0;     ///< Upper edge of the mask's rectangle, in pixels from the top of the picture
    uint32_t width = 0;
    uint32_t height = 0;
    /// Coverage per pixel of the mask's rectangle: width * height values from 0 to 1, rows from top to
    /// bottom.
    std::vector<float> cover;
};

/// A picture with its layers and masks; see Renderer::render_layers().
struct LayeredImage {
    Image picture;                    ///< The whole picture, with the same bytes as from Renderer::render()
    std::vector<PictureLayer> layers; ///< Layers from bottom to top; the bottom layer is opaque
    std::vector<PictureMask> masks;   ///< Masks from bottom to top
    /// Linear colour of the paper that a transparent picture leaves out; empty for an opaque picture.
    std::optional<glm::vec3> paper;
};

/// Composites the visible layers of `image` in linear light. The result is opaque unless the picture is
/// transparent. Throws Error if there are no layers or if the layers differ in size. Cost: about 10 ms per
/// megapixel and layer.
[[nodiscard]] LinearImage flattened(const LayeredImage& image);

/// Writes the layers and masks as an OpenRaster file, which Krita, GIMP and MyPaint open. Layers are visible,
/// except the paper of a transparent picture; masks are hidden. All layers and masks are stored as 8-bit PNG.
///
/// OpenRaster composites sRGB-encoded values, not linear light, so colours and alphas are converted. Where a
/// changed alpha alone gives the right result, an ink keeps its colour; elsewhere its colour is changed too.
/// Other programs then show the picture with an error of at most 1/255 per channel.
///
/// The file is written beside `path` and renamed. Throws Error as flattened() does, if the sizes differ, if
/// the bottom layer is not opaque, and if the file cannot be written. Cost: about 2 s per megapixel. Source:
/// OpenRaster 0.0.3, www.openraster.org
void save_openraster(const LayeredImage& image, const std::filesystem::path& path);

/// Writes the layers and masks of a picture as PNG files into a new folder. The file `layers.json` lists them
/// from bottom to top: file, name, blend ("normal", "multiply"), visible, x, y, width, height. `bits` is the
/// number of bits per channel of the layers: 8, or 16 if the composite must be exact to 1/65535. Masks have 8
/// bits. Throws Error as save_openraster() does, and if the folder exists and is not empty.
void save_layers(const LayeredImage& image, const std::filesystem::path& folder, int bits = 8);

/// Writes one OpenEXR file in linear light: the picture as R, G and B, with A if it is transparent; each
/// layer as NAME.R, NAME.G, NAME.B and NAME.A, with premultiplied colour; each mask as NAME.Y. The header
/// attribute `estampe:layers` lists layers and masks in the form of layers.json. Dots in names become
/// underscores, and names are made unique. Throws Error as flattened() does, and if the file cannot be
/// written.
void save_layers_exr(const LayeredImage& image, const std::filesystem::path& path,
                     ExrNumbers numbers = ExrNumbers::half);

} // namespace estampe
