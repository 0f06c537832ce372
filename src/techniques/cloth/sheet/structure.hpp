// SPDX-License-Identifier: MIT
#pragma once

// Who pulls whom in a sheet, in lists that particles gather from.

#include <span>
#include <vector>

#include "techniques/cloth/cloth.glsl.h"
#include "techniques/cloth/sheet/sheet.hpp"

namespace estampe::cloth {

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

/// Up to four a particle, each to another group of held particles that hang together; of none more than zero
/// long. Part of build_structure().
[[nodiscard]] Lists<Tether> build_tethers(const Sheet& sheet, const std::optional<GridForm>& grid,
                                          std::span<const std::vector<uint32_t>> neighbours);

} // namespace estampe::cloth
