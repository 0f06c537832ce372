// SPDX-License-Identifier: MIT
#pragma once

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

} // namespace estampe::tam
