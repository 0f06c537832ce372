// SPDX-License-Identifier: MIT
#pragma once

// Draws tonal art maps: the strokes of all tones and levels, the canvas of one level, and how strokes are
// spaced.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <estampe/image.hpp>

#include "techniques/tam/stroke.hpp"
#include "techniques/tam/tam_style.hpp"
#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// Rises whenever the same style would draw another map: maps that were kept are then drawn anew.
inline constexpr int drawing_version = 2;

/// A stroke of a map, and what it is drawn in: all levels from 0 to `level`, all tones from `tone` on.
struct PlacedStroke {
    Stroke stroke;
    size_t tone = 0;
    size_t level = 0;
};

/// Draws a tonal art map. `picture`, where given, is that of one stroke, see Brush. `strokes`, where given,
/// receives every stroke in the order they were drawn.
///
/// The same style and picture give the same bytes. Throws Error when the style asks for what cannot be: a
/// side that is no power of two, or tones that do not rise.
///
/// Cost    a second for 512 px and 6 tones, on one core
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001
[[nodiscard]] TonalArtMap make_map(const TamStyle& style, const Image* picture = nullptr,
                                   std::vector<PlacedStroke>* strokes = nullptr);

/// The darknesses that a style asks for.
[[nodiscard]] std::vector<float> darkness_of_tones(const TamStyle& style);

/// The nib of a style at a level of `size_px`: its own, but never so wide that it fills a tiny level.
[[nodiscard]] Nib nib_at(const TamStyle& style, uint32_t size_px);

/// One level while it is drawn. Ink only ever grows: a mark covers its share of what is still paper.
class Canvas {
public:
    explicit Canvas(uint32_t size_px);

    [[nodiscard]] uint32_t size_px() const { return size_px_; }

    /// Mean coverage, 0 to 1.
    [[nodiscard]] double mean() const;

    /// How much the mean would grow.
    [[nodiscard]] double gain(std::span<const Mark> marks) const;

    /// Draws, and notes when texels turn to ink.
    void draw(std::span<const Mark> marks);

    /// Whether `mark` would turn its texel to ink, more than half covered.
    [[nodiscard]] bool turns(const Mark& mark) const;

    [[nodiscard]] Gray8 coverage() const;

    /// For each texel the share of all texels, times 255, that were ink when it turned: as many as T / 255 of
    /// the texels have T or less. What never turned follows, the more ink the sooner.
    [[nodiscard]] Gray8 thresholds() const;

private:
    uint32_t size_px_;
    uint64_t sum_ = 0;
    size_t turned_count_ = 0;
    std::vector<uint16_t> ink_;
    Gray8 turned_;
};

/// Where the strokes of one direction are, at several scales, each half as fine as the one before. A stroke
/// is well spaced when at every scale it goes where little ink is. Of each scale two things are known: its
/// picture, in which strokes are as many pixels wide as on the level and so keep others further away; and the
/// mean ink around each place, which still tells places apart when the picture is all ink.
///
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001, section 3.2, for the pictures
class Spacing {
public:
    /// For a level of `size_px`.
    explicit Spacing(uint32_t size_px);

    /// Adds a stroke. `draw` is called once a scale, from the finest, and fills the marks that the stroke
    /// leaves on a level of that size.
    void add(const std::function<void(uint32_t size_px, std::vector<Mark>& marks)>& draw);

    /// How much room there is along `points` (unit square, not wrapped): more is better, without a unit.
    [[nodiscard]] float room(std::span<const glm::vec2> points) const;

private:
    struct Scale {
        uint32_t size_px = 0;
        std::vector<uint16_t> picture;
        std::vector<uint32_t> ink; ///< sum over the texels of the level that lie in a cell
    };

    void spread(std::span<const Mark> marks);

    std::vector<Scale> scales_;
    uint64_t ink_ = 0;
    std::vector<Mark> marks_;
};

} // namespace estampe::tam
