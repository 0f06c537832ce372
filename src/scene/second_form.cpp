// SPDX-License-Identifier: MIT
#include "scene/second_form.hpp"

#include <cmath>

namespace estampe {

glm::dvec3 second_form(const std::array<SideChange, 3>& sides, double least_determinant)
{
    glm::dmat3 squares(0.0);
    glm::dvec3 right(0.0);
    for (const SideChange& side : sides) {
        const glm::dvec3 row_x(side.place.x, side.place.y, 0.0);
        const glm::dvec3 row_y(0.0, side.place.x, side.place.y);
        squares += glm::outerProduct(row_x, row_x) + glm::outerProduct(row_y, row_y);
        right += row_x * side.normal.x + row_y * side.normal.y;
    }
    const double size = squares[0][0] + squares[2][2];
    const bool is_sound = std::abs(glm::determinant(squares)) > least_determinant * size * size * size;
    return is_sound ? glm::inverse(squares) * right : glm::dvec3(0.0);
}

} // namespace estampe
