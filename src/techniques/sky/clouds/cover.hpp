// SPDX-License-Identifier: MIT
#pragma once

// The distribution of clouds: a noise field on a repeating tile, and the limit above which a cloud forms.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/sky/sky.glsl.h"

namespace estampe::sky {

/// A hashed random number in [0, 1). The number is the same on every machine.
[[nodiscard]] float hashed(uint32_t a, uint32_t b, uint32_t c);

/// A noise field over a tile, sampled at the middles of cells.
struct CoverField {
    uint32_t cells = 0; ///< number of cells per side, a power of two
    std::vector<float> values;

    [[nodiscard]] uint32_t index(int x, int y) const
    {
        const auto mask = static_cast<int>(cells) - 1;
        return static_cast<uint32_t>(y & mask) * cells + static_cast<uint32_t>(x & mask);
    }

    [[nodiscard]] float at(int x, int y) const { return values[index(x, y)]; }
};

struct CoverNoise {
    uint32_t cells = 64;     ///< number of cells per side of the tile
    uint32_t mass_cells = 5; ///< width of an average cloud mass, in cells
    float turn = 0.0F;       ///< phase of the field's change, 0 to 1
    uint32_t seed = 1;
};

/// Computes noise of three octaves. Each octave blends two value noises by sine and cosine of the phase. So
/// the field changes smoothly, keeps its variance, and repeats.
[[nodiscard]] CoverField cover_field(const CoverNoise& noise);

/// Size of puffs (balls of cloud) in cells, and how the puffs are stacked.
struct PuffShape {
    float radius = 0.85F;      ///< radius of a puff where the cloud is dense, in cells
    float growth = 0.10F;      ///< excess of the noise over its limit at which a puff has its full size
    uint32_t levels = 1;       ///< number of puffs (balls of cloud) on top of each other
    float level_rise = 0.62F;  ///< height from one puff to the next higher puff, in radii
    float level_limit = 0.06F; ///< Increase of the noise's limit from one puff to the next higher puff.
};

/// Finds the limit above which the noise field forms puffs (balls of cloud), such that puffs cover the given
/// share of the layer's base. Cost: linear in the number of cells.
[[nodiscard]] float limit_for(const CoverField& field, const PuffShape& shape, float share, uint32_t seed);

/// The puffs (balls of cloud) that form where the noise field exceeds the limit. Positions are in cells.
[[nodiscard]] std::vector<shared::CloudPuff> puffs_of(const CoverField& field, const PuffShape& shape,
                                                      float limit, uint32_t seed);

/// Lists of the puffs (balls of cloud) in each cell of the tile, for the walk along a ray. Each puff is in
/// the list of every cell that its outline may touch. In cells across the tile's edge, the puff's centre is
/// shifted by the tile's size, so that it lies next to the cell.
struct PuffLists {
    /// For each cell, row by row: index of its first puff. The last entry is the end of the last cell's
    /// puffs.
    std::vector<uint32_t> starts;
    std::vector<shared::CloudPuff> puffs;
};

[[nodiscard]] PuffLists list_puffs(std::span<const shared::CloudPuff> puffs, uint32_t cells);

/// Lists each puff once, in the cell that holds its centre.
[[nodiscard]] PuffLists list_homes(std::span<const shared::CloudPuff> puffs, uint32_t cells);

/// Density of streaks in each cell, scaled so that streaks cover the given share of the sky on average.
[[nodiscard]] std::vector<float> streak_density(const CoverField& field, float share);

} // namespace estampe::sky
