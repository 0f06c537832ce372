// SPDX-License-Identifier: MIT
#pragma once

// A stroke, the brush that draws it, and the random numbers of both.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/image.hpp>

#include "core/hash.hpp"
#include "techniques/tam/tam_style.hpp"

namespace estampe::tam {

/// A stroke on the unit square, which wraps; identical at every level, except for its width.
struct Stroke {
    glm::vec2 start{0.0F};
    glm::vec2 direction{1.0F, 0.0F}; ///< of the chord, unit length
    float length = 0.1F;
    float bow = 0.0F;    ///< height of the arc over the chord, as a share of the length
    float wobble = 0.0F; ///< largest deviation from the arc, as a share of the length
    uint32_t seed = 0;

    /// Distance to the left of the chord at `along` (0 to 1), in units of the square.
    [[nodiscard]] float offset(float along) const;

    /// The centre line at `along`, not wrapped.
    [[nodiscard]] glm::vec2 point(float along) const;
};

/// Width in pixels, the same at every level.
struct Nib {
    float width_px = 2.0F;
    float taper_px = 16.0F;
    float tip = 0.4F;
};

/// The share of ink that one stroke leaves on one texel.
struct Mark {
    uint32_t texel = 0; ///< index into the image
    uint16_t ink = 0;   ///< 0 to 65535
};

/// Position of a texel relative to a stroke.
struct Touch {
    float along = 0.0F;     ///< 0 at the start of the stroke, 1 at its end
    float across_px = 0.0F; ///< from the centre line, signed
    float half_px = 1.0F;   ///< half the width here
    float tooth = 0.0F;     ///< height of the paper, 0 to 1
    float hairs = 1.0F;     ///< fineness of a brush's hairs, as a multiple of the usual fineness
    bool on_middle = false; ///< the centre line runs through this texel
};

/// Height of the paper at each texel of a level, 0 to 1; it wraps. `cell_px` is the size of its bumps.
[[nodiscard]] std::vector<float> paper_tooth(uint32_t size_px, uint32_t cell_px, uint32_t seed);

/// The ink of a picture of a stroke from left to right, 0 to 1, row by row from the top: its alpha, or its
/// darkness if it is fully opaque. Throws Error with `where` as its place if the picture is empty or has no
/// ink.
[[nodiscard]] std::vector<float> stroke_of(const Image& picture, size_t columns, size_t rows,
                                           const std::string& where = {});

/// A drawing tool: a pen, pencil, charcoal, burin or brush from a formula, or a picture of a stroke. The
/// centre line of a formula's stroke is always more than half ink, so that ink in one level is ink in the
/// next; a picture may have gaps.
class Brush {
public:
    /// `picture` shows a stroke from its left to its right side; its alpha is the ink, or its darkness if it
    /// is fully opaque. Throws Error if the picture is empty or has no ink.
    explicit Brush(const TamStyle& style, const Image* picture = nullptr);

    /// Ink at a texel, 0 to 1. Strokes differ by `seed`.
    [[nodiscard]] float ink(const Touch& touch, uint32_t seed) const;

    /// Width at `along` as a share of the full width, from the pressure of the hand; without tapers.
    [[nodiscard]] float pressure(float along, uint32_t seed) const;

    /// Size of the paper's bumps in pixels; 0 if the tool does not show them.
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
    std::vector<float> picture_; ///< rows of `picture_columns` across the stroke; empty for a formula
    size_t picture_rows_ = 0;
};

/// Fills `marks` with the ink of `stroke` on a level of `size_px`, one mark per texel (two where a stroke
/// overlaps itself across the wrap). `tooth` is the paper of that level, or empty.
///
/// Cost    about 30 ns per texel near the stroke
void draw_stroke(const Stroke& stroke, const Nib& nib, const Brush& brush, const std::vector<float>& tooth,
                 uint32_t size_px, std::vector<Mark>& marks);

using estampe::hash;

[[nodiscard]] constexpr uint32_t hash(uint32_t x, uint32_t y)
{
    return hash(x ^ hash(y));
}

/// Uniform in [0, 1), from the top 24 bits.
[[nodiscard]] constexpr float unit_float(uint32_t bits)
{
    return static_cast<float>(bits >> 8U) * (1.0F / 16777216.0F);
}

/// Smooth noise in [-1, 1] along a line, with knots at whole numbers.
[[nodiscard]] constexpr float line_noise(uint32_t seed, float x)
{
    const auto knot = static_cast<int32_t>(x) - (x < 0.0F ? 1 : 0);
    const float t = x - static_cast<float>(knot);
    const float a = unit_float(hash(seed, static_cast<uint32_t>(knot)));
    const float b = unit_float(hash(seed, static_cast<uint32_t>(knot + 1)));
    return 2.0F * (a + (b - a) * t * t * (3.0F - 2.0F * t)) - 1.0F;
}

/// A random stream that is identical on every machine, unlike the standard library's distributions.
class Random {
public:
    explicit Random(uint32_t seed) : state_(hash(seed)) {}

    [[nodiscard]] uint32_t bits() { return hash(state_ += 0x9E3779B9U); }

    /// Uniform in [0, 1).
    [[nodiscard]] float unit() { return unit_float(bits()); }

    /// Uniform in [-1, 1).
    [[nodiscard]] float sign() { return 2.0F * unit() - 1.0F; }

private:
    uint32_t state_;
};

} // namespace estampe::tam
