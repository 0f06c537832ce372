// SPDX-License-Identifier: MIT
#pragma once

// A cloth sheet in its rest shape, and the structure computed from it: lists of the neighbours that act on
// each particle.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/cloth.hpp>

#include "techniques/cloth/cloth.glsl.h"

namespace estampe::cloth {

/// Two particles whose distance stays as it is at rest.
struct Thread {
    uint32_t from = 0;
    uint32_t to = 0;
    float compliance_m_n = 0.0F;
};

/// A sheet in metres and kilograms, flat or curved, with any triangles; threads need no triangles. Bending
/// stiffness tends to flatten a sheet that is curved at rest.
struct Sheet {
    std::vector<glm::vec3> rest_m;
    std::vector<glm::uvec3> triangles;
    std::vector<Thread> threads;
    std::vector<float> held;      ///< per particle: 0 free, 1 held; empty: all free
    std::vector<float> masses_kg; ///< per particle; empty: computed from the cloth's density
    Cloth cloth;
};

/// A rectangle of columns times rows of particles, starting at `corner`, with the sides `along` and `across`.
/// Seen from the front, the turn from `along` to `across` is counter-clockwise.
[[nodiscard]] Sheet grid_sheet(glm::uvec2 particles, glm::vec3 corner_m, glm::vec3 along_m,
                               glm::vec3 across_m, const Cloth& cloth = {});

/// Whether every particle is connected to a held one by triangles or threads that never tear. Then its
/// distance from the held one cannot exceed their distance along the sheet.
[[nodiscard]] bool hangs(const Sheet& sheet);

/// A regular grid with right angles.
struct GridForm {
    uint32_t columns = 0;
    uint32_t rows = 0;
    glm::vec2 spacing_m{0.0F};
    float winding = 1.0F; ///< 1 if, seen from the front, columns turn to rows counter-clockwise, else -1
};

/// The grid that a sheet forms, row by row, within a thousandth of its spacing; empty if it forms none.
[[nodiscard]] std::optional<GridForm> grid_form(const Sheet& sheet);

/// Lists with up to `width` items per particle: the k-th item of particle i is items[k * particles + i].
/// Missing items are zero.
template <class Item>
struct Lists {
    uint32_t width = 0;
    std::vector<Item> items;
};

/// A tether to a held particle, and the distance to it along the sheet.
struct Tether {
    uint32_t held = 0;
    float most_m = 0.0F;
};

struct Structure {
    std::optional<GridForm> grid; ///< if set, the lists of links and faces are empty
    std::vector<float> masses_kg;
    std::vector<float>
        link_shares; ///< sum over a particle's links: cloth_near_share for near links, 1 for far ones
    Lists<shared::ClothLink> links;
    Lists<glm::uvec2> faces; ///< the two other corners, in order; if missing, twice the particle itself
    Lists<Tether> tethers;
    std::vector<std::vector<uint32_t>> colours; ///< all particles; no two of a colour are linked
    float softness = 0.0F;                      ///< of a grid's links: compliance in m / N of a link of 1 m
    float bending_rate_s2 = 0.0F;               ///< squared frequency of the fastest bending at rigidity 1
};

/// Builds links between neighbouring particles and between particles two edges apart, up to 24 on a grid. A
/// sheet that may tear gets no tethers, because they would hold torn parts together. Throws Error for indices
/// out of range, a particle with more than 64 edges, numbers that are not finite, a sheet without mass, and a
/// sheet that tears below its rest length or has more than 64 links at a particle. Cost: n log n in particles
/// for each group of held particles.
[[nodiscard]] Structure build_structure(const Sheet& sheet);

/// Bit of a particle's torn-link word for the link to a neighbour, in a sheet that may tear. Throws
/// std::logic_error if there is no such link.
[[nodiscard]] uint32_t link_bit(const Structure& structure, uint32_t from, uint32_t to);

} // namespace estampe::cloth
