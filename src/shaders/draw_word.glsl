// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DRAW_WORD
#define ESTAMPE_DRAW_WORD

// What the surface's draw image holds: draw + 1 (0: nothing is seen), and what many passes ask of its
// material at once.

#define DRAW_PAPER (1u << 31) // takes shadow, but neither wash nor outline
#define DRAW_UNLIT (1u << 30)
#define DRAW_EMISSIVE (1u << 29)
#define DRAW_FOLLOWS_UV (1u << 28)
#define DRAW_NUMBER_MASK (DRAW_FOLLOWS_UV - 1u)

bool sees_draw(uint word)
{
    return word != 0u;
}

uint draw_of(uint word)
{
    return (word & DRAW_NUMBER_MASK) - 1u;
}

// Nothing at all, or bare paper: no line goes between two of these.
bool is_paper(uint word)
{
    return word == 0u || (word & DRAW_PAPER) != 0u;
}

#endif
