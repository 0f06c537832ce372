// SPDX-License-Identifier: MIT
#pragma once

// Depth of field: what is before or behind the plane in focus is drawn as through a thin lens.

#include <optional>
#include <string>

#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/lens/lens.glsl.h"

namespace estampe::lens {

enum class Mode : uint8_t { gather, separable, mips, sums, circles };
enum class ActsOn : uint8_t { picture, wash, strokes };

struct LensStyle {
    bool enabled = false;
    Mode mode = Mode::gather;
    ActsOn acts_on = ActsOn::picture;
    float focal_mm = 50.0F;
    float f_number = 2.8F;
    float focus_m = 0.0F;
    std::string focus_on;
    float largest_mm = 10.0F;
    int blades = 0;
    float blade_turn_deg = 0.0F;
    float widen = 1.0F;
    float pale = 0.6F;
};

[[nodiscard]] const style::Table<LensStyle>& lens_table();

/// Diameter on the sensor of the circle that a thin lens, focused at one distance, makes of a point at
/// another, in millimetres. An infinite distance is allowed; a focus within the focal length is none.
[[nodiscard]] double circle_mm(double focal_mm, double f_number, double focus_m, double distance_m);

/// The page that a lens draws on. The camera stands where the lens does; its field of view is what the sensor
/// takes in when the lens is focused.
struct LensPage {
    double focus_m = 1.0;
    double near_m = 0.01;          ///< of the camera: reversed depth is this over the distance
    double pixel_at_one_m = 0.001; ///< what a pixel spans at a distance of one metre
    float pixels_per_mm = 1.0F;    ///< of the page
    float line_half_px = 1.0F;     ///< of the widest line: what of it lies beyond the edge it follows
};

/// A lens that is there: what all its passes share. None where the style has none.
[[nodiscard]] std::optional<shared::LensConstants> lens_on(const LensStyle& style, const LensPage& page);

/// How far off the pixels may lie that a pixel hangs on.
[[nodiscard]] uint32_t reach_px(const LensStyle& style, float pixels_per_mm);

struct LensInputs {
    gpu::ImageId depth;    ///< r32f: reversed, 0 where nothing is
    gpu::ImageId wash;     ///< rgba16f
    gpu::ImageId hatch;    ///< r16f
    gpu::ImageId lines;    ///< rgba8
    gpu::ImageId sky_ink;  ///< r16f
    bool has_sky = false;  ///< else there is no such ink
    glm::uvec2 from_px{0}; ///< where on the page the first pixel lies
    glm::uvec2 size_px{0};
};

struct LensLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    bool holds_sky = true; ///< `hatch` has the sky's ink where nothing is seen
};

/// Draws layers as the lens sees them: all together or the wash alone, so that on paper they are the picture
/// blurred, and the paper is not.
///
/// Writes  new layers; where a circle is smaller than a pixel, and nothing falls on it from before, they keep
///         their bits
/// Cost    gather: a pass over the page that packs it, six over ever smaller pages, one over a quarter of its
///         pixels with up to 98 texels each, one over the page with 17; separable 26 texels a pixel, mips and
///         sums 20 at most
[[nodiscard]] LensLayers add_lens(gpu::Graph& graph, const LensInputs& in, const LensStyle& style,
                                  shared::LensConstants lens);

/// What strokes are drawn by where they become wider and fewer out of focus.
///
/// Writes  rgba32ui: the footprints of shaders/surface_images.glsl, larger
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_wider_strokes(gpu::Graph& graph, gpu::ImageId depth, gpu::ImageId footprint,
                                             glm::uvec2 size_px, const shared::LensConstants& lens);

} // namespace estampe::lens
