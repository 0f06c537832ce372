// SPDX-License-Identifier: MIT
#pragma once

// Depth of field: surfaces in front of or behind the plane in focus are blurred as by a thin lens.

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

/// Diameter of the circle of confusion of a thin lens, in millimetres on the sensor. The lens is focused at
/// `focus_m`, and the point is at `distance_m`. An infinite distance is allowed; a focus within the focal
/// length is not.
[[nodiscard]] double circle_mm(double focal_mm, double f_number, double focus_m, double distance_m);

/// The page on which a lens draws. The lens is at the camera's position, and the camera's field of view is
/// that of the focused lens.
struct LensPage {
    double focus_m = 1.0;
    /// Distance of the camera's near plane; reversed depth is near_m / distance.
    double near_m = 0.01;
    double pixel_at_one_m = 0.001; ///< size of a pixel in metres, one metre from the eye
    float pixels_per_mm = 1.0F;    ///< pixels per millimetre of the page
    /// Distance by which the widest line extends beyond the edge that it follows, in pixels.
    float line_half_px = 1.0F;
};

/// Returns the constants that all passes of the lens share, or none if the style has no lens.
[[nodiscard]] std::optional<shared::LensConstants> lens_on(const LensStyle& style, const LensPage& page);

/// Largest distance in pixels between a pixel and a second pixel on which the first pixel depends.
[[nodiscard]] uint32_t reach_px(const LensStyle& style, float pixels_per_mm);

struct LensInputs {
    gpu::ImageId depth;    ///< r32f: reversed depth (1 at the near plane), 0 where no surface is visible
    gpu::ImageId wash;     ///< rgba16f: transmittance of the paint
    gpu::ImageId hatch;    ///< r16f: coverage by hatching
    gpu::ImageId lines;    ///< rgba8: colour and coverage of lines
    gpu::ImageId sky_ink;  ///< r16f: coverage by the sky's strokes
    bool has_sky = false;  ///< the sky has strokes; otherwise `sky_ink` is not used
    glm::uvec2 from_px{0}; ///< position on the page of the first drawn pixel
    glm::uvec2 size_px{0};
};

struct LensLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    bool holds_sky = true; ///< after the blur, `hatch` contains the sky's strokes where no surface is visible
};

/// Blurs the layers by the lens, either all layers together or only the wash. The finished picture looks
/// blurred, while the paper itself stays sharp.
///
/// Writes  new layers; pixels whose blur circle is smaller than a pixel stay bit-identical, unless a nearer
///         surface blurs over them
/// Cost    gather: one pass over the page for packing, six over smaller and smaller pages, one over a quarter
///         of the pixels with up to 98 texels each, one over the page with 17 texels each. separable: 26
///         texels per pixel; mips and sums: at most 20
[[nodiscard]] LensLayers add_lens(gpu::Graph& graph, const LensInputs& in, const LensStyle& style,
                                  shared::LensConstants lens);

/// Enlarges the footprints with which strokes are drawn, so that strokes become wider and fewer out of focus.
///
/// Writes  rgba32ui: the enlarged footprints, see shaders/surface_images.glsl
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_wider_strokes(gpu::Graph& graph, gpu::ImageId depth, gpu::ImageId footprint,
                                             glm::uvec2 size_px, const shared::LensConstants& lens);

} // namespace estampe::lens
