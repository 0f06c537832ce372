// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DRAW_WORD
#define ESTAMPE_DRAW_WORD

#include "shaders/stroke_kind.glsl.h"

// What the surface's draw image holds: draw + 1 (0: nothing is seen), and what many passes ask of its
// material at once.

#define DRAW_PAPER (1u << 31) // takes shadow, but neither wash nor outline
#define DRAW_UNLIT (1u << 30)
#define DRAW_EMISSIVE (1u << 29)
#define DRAW_STROKES_SHIFT 26 // what strokes follow, see shaders/stroke_kind.glsl.h
#define DRAW_NUMBER_MASK ((1u << DRAW_STROKES_SHIFT) - 1u)

bool sees_draw(uint word)
{
    return word != 0u;
}

uint draw_of(uint word)
{
    return (word & DRAW_NUMBER_MASK) - 1u;
}

uint strokes_of(uint word)
{
    return (word >> DRAW_STROKES_SHIFT) & 7u;
}

// Nothing at all, or bare paper: no line goes between two of these.
bool is_paper(uint word)
{
    return word == 0u || (word & DRAW_PAPER) != 0u;
}

#endif
