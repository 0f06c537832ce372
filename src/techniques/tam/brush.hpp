// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/image.hpp>

#include "techniques/tam/tam_style.hpp"

namespace estampe::tam {

/// A texel as a stroke sees it.
struct Touch {
    float along = 0.0F;     ///< 0 at the start of the stroke, 1 at its end
    float across_px = 0.0F; ///< from the middle of the stroke, signed
    float half_px = 1.0F;   ///< half the width here
    float tooth = 0.0F;     ///< height of the paper, 0 to 1
    float hairs = 1.0F;     ///< how many times finer than usual those of a brush are
    bool on_middle = false; ///< the line in the middle of the stroke runs through this texel
};

/// Height of the paper at each texel of a level, 0 to 1; it wraps. `cell_px` is the size of its bumps.
[[nodiscard]] std::vector<float> paper_tooth(uint32_t size_px, uint32_t cell_px, uint32_t seed);

/// The ink of a picture of a stroke from left to right, 0 to 1, row by row from the top: its alpha, or where
/// it is opaque throughout, its darkness. Throws Error with `where` as its place when the picture is empty or
/// has no ink.
[[nodiscard]] std::vector<float> stroke_of(const Image& picture, size_t columns, size_t rows,
                                           const std::string& where = {});

/// What leaves the ink: a pen, pencil, charcoal, burin or brush that is a formula, or the picture of one.
/// The line in the middle of a stroke is always more than half ink, so that a stroke that is ink in one level
/// is ink in the next; but not of a picture, which may have gaps.
class Brush {
public:
    /// Of a picture, its alpha (or, where it is opaque throughout, its darkness) is the ink of a stroke that
    /// runs from its left to its right side. Throws Error when the picture is empty or has no ink.
    explicit Brush(const TamStyle& style, const Image* picture = nullptr);

    /// Ink at a texel, 0 to 1. `seed` tells strokes apart.
    [[nodiscard]] float ink(const Touch& touch, uint32_t seed) const;

    /// Width at `along` as a share of the full width, from the pressure of the hand; tapers not counted.
    [[nodiscard]] float pressure(float along, uint32_t seed) const;

    /// Side of the bumps of the paper, in pixels; 0 when the tool feels none.
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

} // namespace estampe::tam
