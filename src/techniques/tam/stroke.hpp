// SPDX-License-Identifier: MIT
#pragma once

// A stroke of a tonal art map, the brush that draws it, and random numbers for both.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/image.hpp>

#include "core/hash.hpp"
#include "techniques/tam/tam_style.hpp"

namespace estampe::tam {

/// A stroke on the unit square, which wraps at its edges. The stroke is identical at every mip level, except
/// for its width relative to the square.
struct Stroke {
    glm::vec2 start{0.0F};
    glm::vec2 direction{1.0F, 0.0F}; ///< unit vector of the chord (the straight line from start to end)
    float length = 0.1F;
    float bow = 0.0F;    ///< height of the arc over the chord, as a share of the stroke's length
    float wobble = 0.0F; ///< largest random deviation from the arc, as a share of the stroke's length
    uint32_t seed = 0;

    /// Distance by which the stroke lies to the left of its chord (the straight line between its ends), in
    /// units of the square. `along` is 0 at the start and 1 at the end.
    [[nodiscard]] float offset(float along) const;

    /// The point of the centre line at `along` (0 is the start, 1 the end); not wrapped into the unit square.
    [[nodiscard]] glm::vec2 point(float along) const;
};

/// Width of a stroke in pixels. The width is the same at every level.
struct Nib {
    float width_px = 2.0F;
    float taper_px = 16.0F;
    float tip = 0.4F;
};

/// The share of ink that one stroke leaves on one texel.
struct Mark {
    uint32_t texel = 0; ///< index of the texel in the image
    uint16_t ink = 0;   ///< 65535 covers the whole texel
};

/// Position of a texel relative to a stroke.
struct Touch {
    float along = 0.0F;     ///< position along the stroke: 0 at the start, 1 at the end
    float across_px = 0.0F; ///< signed distance from the centre line, in pixels
    float half_px = 1.0F;   ///< half the stroke's width at the texel, in pixels
    float tooth = 0.0F;     ///< height of the paper at the texel, 0 to 1
    float hairs = 1.0F;     ///< fineness of a brush's hairs, as a multiple of the usual fineness
    bool on_middle = false; ///< the centre line of the stroke runs through the texel
};

/// Returns the height of rough paper at each texel of a mip level, 0 to 1. The heights repeat across the
/// edges. `cell_px` is the size of the paper's bumps in pixels.
[[nodiscard]] std::vector<float> paper_tooth(uint32_t size_px, uint32_t cell_px, uint32_t seed);

/// The ink of a picture that shows a stroke from left to right: values from 0 to 1, row by row from the top.
/// Ink is the picture's alpha, or its darkness if the picture is fully opaque. Throws Error with `where` as
/// its place if the picture is empty or has no ink.
[[nodiscard]] std::vector<float> stroke_of(const Image& picture, size_t columns, size_t rows,
                                           const std::string& where = {});

/// A drawing tool: a pen, pencil, charcoal, burin or brush that is computed by a formula, or a picture of a
/// stroke. The centre line of a computed stroke is always more than half ink, so that ink in one level is
/// also ink in the next level. A picture may have gaps.
class Brush {
public:
    /// `picture` shows a stroke from its left to its right side. The picture's alpha is the ink, or its
    /// darkness if the picture is fully opaque. Throws Error if the picture is empty or has no ink.
    explicit Brush(const TamStyle& style, const Image* picture = nullptr);

    /// Ink of a stroke at a texel, 0 to 1. Strokes with different `seed` differ.
    [[nodiscard]] float ink(const Touch& touch, uint32_t seed) const;

    /// Width of a stroke at `along`, as a share of its full width, from the pressure of the hand. The tapers
    /// at the ends are not included.
    [[nodiscard]] float pressure(float along, uint32_t seed) const;

    /// Size of the paper's bumps in pixels; 0 if the tool does not show the paper's bumps.
    [[nodiscard]] uint32_t tooth_cell_px() const;

private:
    [[nodiscard]] float formula(const Touch& touch, uint32_t seed) const;
    [[nodiscard]] float grained(const Touch& touch, float roughness) const;
    [[nodiscard]] float hairs(const Touch& touch, uint32_t seed) const;
    [[nodiscard]] float pictured(const Touch& touch) const;

    Tool tool_;
    float opacity_;
    float grain_;
    float pressure_;
    float width_px_;
    /// Ink of the picture, rows of `picture_columns` values across the stroke; empty for a computed tool.
    std::vector<float> picture_;
    size_t picture_rows_ = 0;
};

/// Fills `marks` with the ink of `stroke` on a level of `size_px` texels per side: one mark per texel, or two
/// where a stroke overlaps itself across the edge. `tooth` holds the heights of that level's paper, or is
/// empty.
///
/// Cost    about 30 ns per texel near the stroke
void draw_stroke(const Stroke& stroke, const Nib& nib, const Brush& brush, const std::vector<float>& tooth,
                 uint32_t size_px, std::vector<Mark>& marks);

using estampe::hash;

[[nodiscard]] constexpr uint32_t hash(uint32_t x, uint32_t y)
{
    return hash(x ^ hash(y));
}

/// Converts random bits to a uniform number in [0, 1), from the top 24 bits.
[[nodiscard]] constexpr float unit_float(uint32_t bits)
{
    return static_cast<float>(bits >> 8U) * (1.0F / 16777216.0F);
}

/// Smooth noise in [-1, 1] along a line, with random values at whole numbers.
[[nodiscard]] constexpr float line_noise(uint32_t seed, float x)
{
    const auto knot = static_cast<int32_t>(x) - (x < 0.0F ? 1 : 0);
    const float t = x - static_cast<float>(knot);
    const float a = unit_float(hash(seed, static_cast<uint32_t>(knot)));
    const float b = unit_float(hash(seed, static_cast<uint32_t>(knot + 1)));
    return 2.0F * (a + (b - a) * t * t * (3.0F - 2.0F * t)) - 1.0F;
}

/// A stream of random numbers that is identical on every machine, unlike the standard library's
/// distributions.
class Random {
public:
    explicit Random(uint32_t seed) : state_(hash(seed)) {}

    [[nodiscard]] uint32_t bits() { return hash(state_ += 0x9E3779B9U); }

    /// Returns a uniform random number in [0, 1).
    [[nodiscard]] float unit() { return unit_float(bits()); }

    /// Returns a uniform random number in [-1, 1).
    [[nodiscard]] float sign() { return 2.0F * unit() - 1.0F; }

private:
    uint32_t state_;
};

} // namespace estampe::tam
