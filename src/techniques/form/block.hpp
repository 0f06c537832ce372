// SPDX-License-Identifier: MIT
#pragma once

// What multigrid needs of matrices of two rows.

#include <algorithm>

#include <glm/glm.hpp>

namespace estampe::form {

/// A 2 x 2 matrix, row by row, in single precision to save bandwidth.
struct Block {
    float xx = 0.0F, xy = 0.0F, yx = 0.0F, yy = 0.0F;
};

inline glm::dvec2 times(const Block& m, glm::dvec2 v)
{
    return {double{m.xx} * v.x + double{m.xy} * v.y, double{m.yx} * v.x + double{m.yy} * v.y};
}

inline glm::dvec2 transposed_times(const Block& m, glm::dvec2 v)
{
    return {double{m.xx} * v.x + double{m.yx} * v.y, double{m.xy} * v.x + double{m.yy} * v.y};
}

inline glm::dvec2 times(const glm::dvec3& symmetric, glm::dvec2 v)
{
    return {symmetric.x * v.x + symmetric.y * v.y, symmetric.y * v.x + symmetric.z * v.y};
}

inline Block product(const Block& a, const Block& b)
{
    return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
            a.yx * b.xy + a.yy * b.yy};
}

inline Block transposed(const Block& m)
{
    return {m.xx, m.yx, m.xy, m.yy};
}

inline float strength(const Block& m)
{
    return m.xx * m.xx + m.xy * m.xy + m.yx * m.yx + m.yy * m.yy;
}

/// The rotation or reflection nearest to -m.
inline Block nearest_orthogonal(const Block& m)
{
    const glm::vec2 rotation(-m.xx - m.yy, m.xy - m.yx);
    const glm::vec2 reflection(m.yy - m.xx, -m.xy - m.yx);
    const float turn = glm::length(rotation);
    const float mirror = glm::length(reflection);
    if (std::max(turn, mirror) <= 0.0F) {
        return {1.0F, 0.0F, 0.0F, 1.0F};
    }
    if (turn >= mirror) {
        const glm::vec2 c = rotation / turn;
        return {c.x, -c.y, c.y, c.x};
    }
    const glm::vec2 c = reflection / mirror;
    return {c.x, c.y, c.y, -c.x};
}

} // namespace estampe::form
