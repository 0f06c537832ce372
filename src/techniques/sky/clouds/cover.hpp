// SPDX-License-Identifier: MIT
#pragma once

// Where clouds are: a field of noise on a tile that repeats, and the limit above which there is cloud.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/sky/sky.glsl.h"

namespace estampe::sky {

/// Uniform in [0, 1), the same on every machine.
[[nodiscard]] float hashed(uint32_t a, uint32_t b, uint32_t c);

/// A field over a tile, in cells, known at the middles of cells.
struct CoverField {
    uint32_t cells = 0; ///< a side, a power of two
    std::vector<float> values;

    [[nodiscard]] uint32_t index(int x, int y) const
    {
        const auto mask = static_cast<int>(cells) - 1;
        return static_cast<uint32_t>(y & mask) * cells + static_cast<uint32_t>(x & mask);
    }

    [[nodiscard]] float at(int x, int y) const { return values[index(x, y)]; }
};

struct CoverNoise {
    uint32_t cells = 64;     ///< a side of the tile
    uint32_t mass_cells = 5; ///< across a usual mass
    float turn = 0.0F;       ///< 0 to 1: how far through its changes the field is
    uint32_t seed = 1;
};

/// Three octaves of value noise; each is the sum of two, turned into each other by sine and cosine, so that
/// the field changes smoothly, keeps its spread, and comes back.
[[nodiscard]] CoverField cover_field(const CoverNoise& noise);

/// How large puffs are, in cells, and how they are piled.
struct PuffShape {
    float radius = 0.85F;      ///< where cloud is thick
    float growth = 0.10F;      ///< of the field, above the limit, over which a puff grows to that
    uint32_t levels = 1;       ///< puffs over each other
    float level_rise = 0.62F;  ///< from one to the next, in radii
    float level_limit = 0.06F; ///< each is there where the field is by so much higher
};

/// The limit for which puffs cover `share` of the base. Cost: linear in cells.
[[nodiscard]] float limit_for(const CoverField& field, const PuffShape& shape, float share, uint32_t seed);

/// The puffs where the field is above the limit, in cells.
[[nodiscard]] std::vector<shared::CloudPuff> puffs_of(const CoverField& field, const PuffShape& shape,
                                                      float limit, uint32_t seed);

/// Puffs by the cell of a tile, as the walk along a ray finds them: each stands in the list of every cell
/// that its outline may touch. Where it reaches over the tile's edge, its centre there is off the tile,
/// beside the cell.
struct PuffLists {
    std::vector<uint32_t> starts; ///< one a cell, row by row, and the end
    std::vector<shared::CloudPuff> puffs;
};

[[nodiscard]] PuffLists list_puffs(std::span<const shared::CloudPuff> puffs, uint32_t cells);

/// Each once, by the cell of the tile that has its middle.
[[nodiscard]] PuffLists list_homes(std::span<const shared::CloudPuff> puffs, uint32_t cells);

/// How dense streaks are at each cell, so that they cover `share` on average.
[[nodiscard]] std::vector<float> streak_density(const CoverField& field, float share);

} // namespace estampe::sky
