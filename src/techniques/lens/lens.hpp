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

/// Diameter, in millimetres on the sensor, of the circle of confusion of a thin lens that is focused at
/// `focus_m`, for a point at `distance_m`. An infinite distance is allowed; a focus within the focal length
/// is not.
[[nodiscard]] double circle_mm(double focal_mm, double f_number, double focus_m, double distance_m);

/// The page that a lens renders. The lens is at the camera's position; the camera's field of view is that of
/// the focused lens.
struct LensPage {
    double focus_m = 1.0;
    double near_m = 0.01;          ///< the camera's near plane: reversed depth is near_m / distance
    double pixel_at_one_m = 0.001; ///< size of a pixel at a distance of one metre
    float pixels_per_mm = 1.0F;    ///< pixels per millimetre of the page
    float line_half_px = 1.0F;     ///< how far the widest line extends beyond its edge
};

/// Returns the constants that all passes of the lens share; none if the style has no lens.
[[nodiscard]] std::optional<shared::LensConstants> lens_on(const LensStyle& style, const LensPage& page);

/// Largest distance of the pixels that one pixel depends on.
[[nodiscard]] uint32_t reach_px(const LensStyle& style, float pixels_per_mm);

struct LensInputs {
    gpu::ImageId depth;    ///< r32f: reversed, 0 where no surface is visible
    gpu::ImageId wash;     ///< rgba16f
    gpu::ImageId hatch;    ///< r16f
    gpu::ImageId lines;    ///< rgba8
    gpu::ImageId sky_ink;  ///< r16f
    bool has_sky = false;  ///< false: `sky_ink` is not used
    glm::uvec2 from_px{0}; ///< position of the first pixel on the page
    glm::uvec2 size_px{0};
};

struct LensLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    bool holds_sky = true; ///< `hatch` contains the sky's ink where no surface is visible
};

/// Blurs the layers as the lens sees them, either all together or only the wash. Composed on paper they look
/// like the blurred picture, while the paper itself stays sharp.
///
/// Writes  new layers; pixels whose circle is smaller than a pixel keep their bits unless a nearer surface
///         blurs over them
/// Cost    gather: one pass over the page for packing, six over smaller and smaller pages, one over a quarter
///         of the pixels with up to 98 texels each, one over the page with 17. separable: 26 texels per
///         pixel; mips and sums: at most 20
[[nodiscard]] LensLayers add_lens(gpu::Graph& graph, const LensInputs& in, const LensStyle& style,
                                  shared::LensConstants lens);

/// Enlarges the footprints by which strokes are drawn, so that strokes become wider and fewer out of focus.
///
/// Writes  rgba32ui: the enlarged footprints, see shaders/surface_images.glsl
/// Cost    one full-screen dispatch
[[nodiscard]] gpu::ImageId add_wider_strokes(gpu::Graph& graph, gpu::ImageId depth, gpu::ImageId footprint,
                                             glm::uvec2 size_px, const shared::LensConstants& lens);

} // namespace estampe::lens
