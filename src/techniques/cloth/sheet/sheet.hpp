// SPDX-License-Identifier: MIT
#pragma once

// A sheet of cloth as it was cut: what everything else is made from.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/cloth.hpp>

namespace estampe::cloth {

/// Two particles that are kept so far apart as they lie.
struct Thread {
    uint32_t from = 0;
    uint32_t to = 0;
    float compliance_m_n = 0.0F;
};

/// In metres and kilograms, flat or not, of any triangles; also threads alone. What is bent at rest tends to
/// flatten by its bending stiffness.
struct Sheet {
    std::vector<glm::vec3> rest_m;
    std::vector<glm::uvec3> triangles;
    std::vector<Thread> threads;
    std::vector<float> held;      ///< one a particle: 0 free, 1 held; empty: all free
    std::vector<float> masses_kg; ///< one a particle; empty: by the cloth's density
    Cloth cloth;
};

/// A rectangle of columns times rows particles from `corner` on: `along` and `across` are its sides, and its
/// front is where they turn from one to the other counter-clockwise.
[[nodiscard]] Sheet grid_sheet(glm::uvec2 particles, glm::vec3 corner_m, glm::vec3 along_m,
                               glm::vec3 across_m, const Cloth& cloth = {});

/// Whether every particle hangs on one that is held, by triangles or threads that never tear: then none comes
/// farther from it than they were apart along the sheet.
[[nodiscard]] bool hangs(const Sheet& sheet);

/// A regular grid of right angles.
struct GridForm {
    uint32_t columns = 0;
    uint32_t rows = 0;
    glm::vec2 spacing_m{0.0F};
    float winding = 1.0F; ///< 1 where faces look to where columns turn to rows counter-clockwise, else -1
};

/// What a sheet is laid out as, row by row, to a thousandth of its spacing; nothing where it is otherwise.
[[nodiscard]] std::optional<GridForm> grid_form(const Sheet& sheet);

} // namespace estampe::cloth
