// SPDX-License-Identifier: MIT
#pragma once

// A cloth sheet in its rest shape, and the structure that is computed from the rest shape: lists of the
// neighbours that act on each particle.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/cloth.hpp>

#include "techniques/cloth/cloth.glsl.h"

namespace estampe::cloth {

/// A link without triangles: two particles that keep the distance of the rest shape.
struct Thread {
    uint32_t from = 0;
    uint32_t to = 0;
    float compliance_m_n = 0.0F;
};

/// A cloth sheet in metres and kilograms: flat or curved, with any triangles. Threads need no triangles.
/// Bending stiffness tends to flatten a sheet that is curved at rest.
struct Sheet {
    std::vector<glm::vec3> rest_m;
    std::vector<glm::uvec3> triangles;
    std::vector<Thread> threads;
    std::vector<float> held;      ///< strength of the hold per particle: 0 free, 1 held; empty: all free
    std::vector<float> masses_kg; ///< mass per particle; empty: computed from the cloth's density
    Cloth cloth;
};

/// Makes a rectangle of `particles.x` columns times `particles.y` rows, starting at `corner_m`, with the
/// sides `along_m` and `across`. Seen from the front, the turn from `along_m` to `across` is
/// counter-clockwise.
[[nodiscard]] Sheet grid_sheet(glm::uvec2 particles, glm::vec3 corner_m, glm::vec3 along_m,
                               glm::vec3 across_m, const Cloth& cloth = {});

/// Whether every particle is connected to a held particle by triangles or threads that never tear. In a sheet
/// that hangs, no particle gets farther from its held particle than their distance along the sheet.
[[nodiscard]] bool hangs(const Sheet& sheet);

/// A regular grid of particles with right angles.
struct GridForm {
    uint32_t columns = 0;
    uint32_t rows = 0;
    glm::vec2 spacing_m{0.0F};
    float winding = 1.0F; ///< 1 if, seen from the front, columns turn to rows counter-clockwise, else -1
};

/// Finds the regular grid that a sheet's particles form row by row, within a thousandth of the grid's
/// spacing. Returns nothing if the particles form no regular grid.
[[nodiscard]] std::optional<GridForm> grid_form(const Sheet& sheet);

/// Lists with up to `width` items per particle. Item number k of particle number i is items[k * particles +
/// i]. Missing items are zero.
template <class Item>
struct Lists {
    uint32_t width = 0;
    std::vector<Item> items;
};

/// A tether: the largest distance of a particle from a held particle, measured along the sheet.
struct Tether {
    uint32_t held = 0;
    float most_m = 0.0F;
};

struct Structure {
    std::optional<GridForm> grid; ///< the sheet's regular grid; if set, links and faces are empty
    std::vector<float> masses_kg;
    std::vector<float> link_shares; ///< per particle, the sum over its links of cloth_near_share (near links)
                                    ///< or 1 (far links)
    Lists<shared::ClothLink> links;
    Lists<glm::uvec2> faces; ///< for each face at a particle: the face's two other corners, in order; a
                             ///< missing face has the particle itself twice
    Lists<Tether> tethers;
    /// All particles, sorted by colour: particles of one colour have no links between them.
    std::vector<std::vector<uint32_t>> colours;
    float softness = 0.0F;        ///< compliance of a grid's links, in m / N for a link of 1 m
    float bending_rate_s2 = 0.0F; ///< squared frequency of the fastest bending oscillation at rigidity 1
};

/// Builds links between neighbouring particles and between particles two edges apart, up to 24 per particle
/// on a grid. A sheet that may tear gets no tethers, because tethers would hold torn parts together. Throws
/// Error for indices out of range, numbers that are not finite, a sheet without mass, and a particle with
/// more than 64 edges. Throws Error too for a sheet that tears below its rest length, or that may tear and
/// has more than 64 links at a particle. Cost: n log n in the number n of particles for each group of held
/// particles.
[[nodiscard]] Structure build_structure(const Sheet& sheet);

/// Finds the bit of the link to a neighbour in a particle's word of torn links, in a sheet that may tear.
/// Throws std::logic_error if the two particles have no link.
[[nodiscard]] uint32_t link_bit(const Structure& structure, uint32_t from, uint32_t to);

} // namespace estampe::cloth
