// SPDX-License-Identifier: MIT
#pragma once

// Draws tonal art maps: the strokes of all tones and levels, the canvas of one level, and the spacing of
// strokes.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <estampe/image.hpp>

#include "techniques/tam/stroke.hpp"
#include "techniques/tam/tam_style.hpp"
#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// Version of the drawing code. The version is increased whenever the same style would give a different map,
/// so that cached maps are drawn again.
inline constexpr int drawing_version = 2;

/// A stroke of a map. The stroke appears in all mip levels from 0 (the finest) to the level `level`, and in
/// all tones from the tone `tone` to the darkest.
struct PlacedStroke {
    Stroke stroke;
    size_t tone = 0;
    size_t level = 0;
};

/// Draws a tonal art map. `picture` is an optional picture of one stroke, see Brush. `strokes`, if given,
/// receives every stroke in drawing order.
///
/// The same style and picture give the same bytes. Throws Error if the style is impossible: a side that is
/// not a power of two, or tones that do not get darker.
///
/// Cost    a second for 512 px and 6 tones, on one core
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001
[[nodiscard]] TonalArtMap make_map(const TamStyle& style, const Image* picture = nullptr,
                                   std::vector<PlacedStroke>* strokes = nullptr);

/// The darkness of each tone of a style.
[[nodiscard]] std::vector<float> darkness_of_tones(const TamStyle& style);

/// The nib (width of the pen) of a style at a level of `size_px` texels per side. In tiny levels the nib is
/// narrower, so that it does not fill the level.
[[nodiscard]] Nib nib_at(const TamStyle& style, uint32_t size_px);

/// The image of one mip level while it is drawn. Ink only increases: a mark covers its share of the paper
/// that is still bare.
class Canvas {
public:
    explicit Canvas(uint32_t size_px);

    [[nodiscard]] uint32_t size_px() const { return size_px_; }

    /// Mean coverage of the canvas, 0 to 1.
    [[nodiscard]] double mean() const;

    /// Returns by how much the canvas's mean coverage would grow if `marks` were drawn.
    [[nodiscard]] double gain(std::span<const Mark> marks) const;

    /// Draws `marks` on the canvas, and records the order in which texels turn to ink.
    void draw(std::span<const Mark> marks);

    /// Whether `mark` would turn its texel to ink, so that more than half of the texel is covered.
    [[nodiscard]] bool turns(const Mark& mark) const;

    [[nodiscard]] Gray8 coverage() const;

    /// Returns the threshold of each texel: the share of all texels, times 255, that were ink when the texel
    /// turned to ink. Texels that never turned to ink get the highest thresholds, in the order of decreasing
    /// ink. So, for any value T, a share of T / 255 of all texels has a threshold of at most T.
    [[nodiscard]] Gray8 thresholds() const;

private:
    uint32_t size_px_;
    uint64_t sum_ = 0;
    size_t turned_count_ = 0;
    std::vector<uint16_t> ink_;
    Gray8 turned_;
};

/// Positions of the strokes of one direction, at several scales; each scale is half as fine as the previous
/// scale. A new stroke is well spaced if it passes over little ink at every scale. Each scale stores a
/// picture and the mean ink around each place. In a coarse picture, strokes have the same width in pixels as
/// in the finest picture, so strokes in coarse pictures keep other strokes farther away. The mean ink is
/// still useful when the picture is full of ink.
///
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001, section 3.2, for the pictures
class Spacing {
public:
    /// Creates the scales for a mip level of `size_px` texels per side.
    explicit Spacing(uint32_t size_px);

    /// Adds a stroke. Calls `draw` once per scale, finest first. `draw` must fill `marks` with the stroke as
    /// drawn on a level of `size_px`.
    void add(const std::function<void(uint32_t size_px, std::vector<Mark>& marks)>& draw);

    /// Measures the free space along `points`, the points of a new stroke (in the unit square, not wrapped).
    /// Higher is better; the value has no unit.
    [[nodiscard]] float room(std::span<const glm::vec2> points) const;

private:
    struct Scale {
        uint32_t size_px = 0;
        std::vector<uint16_t> picture;
        std::vector<uint32_t> ink; ///< sum of the ink over the level's texels in each cell of the scale
    };

    void spread(std::span<const Mark> marks);

    std::vector<Scale> scales_;
    uint64_t ink_ = 0;
    std::vector<Mark> marks_;
};

} // namespace estampe::tam
