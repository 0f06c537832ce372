// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "techniques/tam/stroke.hpp"
#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// One level while it is drawn. Ink only ever grows: a mark covers its share of what is still paper.
class Canvas {
public:
    explicit Canvas(uint32_t size_px);

    [[nodiscard]] uint32_t size_px() const { return size_px_; }

    /// Mean coverage, 0 to 1.
    [[nodiscard]] double mean() const;

    /// How much the mean would grow.
    [[nodiscard]] double gain(std::span<const Mark> marks) const;

    /// Draws, and notes the darkness at which texels turn to ink.
    void draw(std::span<const Mark> marks);

    /// Whether `mark` would turn its texel to ink, more than half covered.
    [[nodiscard]] bool turns(const Mark& mark) const;

    [[nodiscard]] Gray8 coverage() const;

    /// Darkness times 255 at which each texel turned to ink; what never did follows after `darkest`, the more
    /// ink the sooner.
    [[nodiscard]] Gray8 thresholds(float darkest) const;

private:
    uint32_t size_px_;
    uint64_t sum_ = 0;
    std::vector<uint16_t> ink_;
    Gray8 turned_;
};

/// Where the strokes of one direction are, at several scales: in each grid, half as fine as the one before,
/// strokes are as many cells wide, so that they keep others further away. A stroke is well spaced when it
/// adds ink at all scales.
///
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001, section 3.2
class Spacing {
public:
    /// For a level of `size_px`.
    explicit Spacing(uint32_t size_px);

    /// Adds a stroke. `draw` is called once a grid, from the finest, and fills the marks that the stroke
    /// leaves on a level of that size.
    void add(const std::function<void(uint32_t size_px, std::vector<Mark>& marks)>& draw);

    /// Free room along `points` (unit square, not wrapped): 0 all taken, 1 a grid all free, summed.
    [[nodiscard]] float room(std::span<const glm::vec2> points) const;

private:
    std::vector<std::vector<uint16_t>> scales_;
    std::vector<Mark> marks_;
    uint32_t size_px_;
};

} // namespace estampe::tam
