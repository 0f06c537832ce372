// SPDX-License-Identifier: MIT
#pragma once

// A sheet of cloth as it was cut, what everything else is made from; and who pulls whom in it, in lists that
// particles gather from.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/cloth.hpp>

#include "techniques/cloth/cloth.glsl.h"

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

/// Lists of up to `width` items, one a particle: the k-th of particle i is items[k * particles + i], and
/// those that are missing are zeros.
template <class Item>
struct Lists {
    uint32_t width = 0;
    std::vector<Item> items;
};

/// To a particle that is held, and how far from it the sheet reaches.
struct Tether {
    uint32_t held = 0;
    float most_m = 0.0F;
};

struct Structure {
    std::optional<GridForm> grid; ///< then neither links nor faces have lists
    std::vector<float> masses_kg;
    std::vector<float>
        link_shares; ///< sum over a particle's links: cloth_near_share of near ones, 1 of far ones
    Lists<shared::ClothLink> links;
    Lists<glm::uvec2> faces; ///< the other two corners, in order; of none twice the particle itself
    Lists<Tether> tethers;
    std::vector<std::vector<uint32_t>> colours; ///< all particles; no two of a colour are linked
    float softness = 0.0F;                      ///< of a grid's links: compliance in m / N of one of 1 m
    float bending_rate_s2 = 0.0F;               ///< squared frequency of the quickest bending at rigidity 1
};

/// Particles next to each other, and those two apart, are linked: to as many as 24 on a grid. A sheet that
/// may tear has no tethers, which would hold it together. Throws Error for triangles or threads that name no
/// particle, a particle that more than 64 edges meet at, numbers that are not finite, a sheet without mass,
/// and one that tears at less than its length, or with more than 64 links at a particle. Cost: n log n in
/// particles for each group of those that are held.
[[nodiscard]] Structure build_structure(const Sheet& sheet);

/// The bit that says of a particle of a sheet that may tear whether its link to one next to it is torn.
/// Throws std::logic_error where there is none.
[[nodiscard]] uint32_t link_bit(const Structure& structure, uint32_t from, uint32_t to);

} // namespace estampe::cloth
