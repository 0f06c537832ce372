// SPDX-License-Identifier: MIT
#include "techniques/sky/clouds/cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/hash.hpp"

namespace estampe::sky {
namespace {

/// Value noise on a repeating tile, with `period` random values per side of the tile.
float periodic_noise(glm::vec2 place, uint32_t period, uint32_t seed)
{
    const glm::vec2 cell = glm::floor(place);
    glm::vec2 f = place - cell;
    f = f * f * (3.0F - 2.0F * f);
    const auto value = [&](float x, float y) {
        const auto wrapped = [&](float coordinate) {
            return static_cast<uint32_t>(static_cast<int>(coordinate) + static_cast<int>(period)) % period;
        };
        return hashed(wrapped(cell.x + x), wrapped(cell.y + y), seed);
    };
    return glm::mix(glm::mix(value(0.0F, 0.0F), value(1.0F, 0.0F), f.x),
                    glm::mix(value(0.0F, 1.0F), value(1.0F, 1.0F), f.x), f.y);
}

/// The inverse of the function smoothstep from 0 to 1: the position at which its value is `y`.
float inverse_smoothstep(float y)
{
    return 0.5F - std::sin(std::asin(std::clamp(1.0F - 2.0F * y, -1.0F, 1.0F)) / 3.0F);
}

/// Random position of a puff, relative to the corner of its cell, and its radius when it is full-grown.
struct PuffSeed {
    glm::vec2 place{0.0F};
    float radius = 0.0F;
    float trait = 0.0F;
};

PuffSeed seed_of(const CoverField& field, const PuffShape& shape, int x, int y, uint32_t level,
                 uint32_t layer_seed)
{
    const uint32_t cell = field.index(x, y);
    const uint32_t number = 4U * level + 16U * layer_seed;
    const glm::vec2 stray(hashed(cell, number, 11U), hashed(cell, number, 12U));
    const float size = 0.72F + 0.5F * hashed(cell, number, 13U);
    return {.place = glm::vec2(0.5F) + 0.5F * (stray - 0.5F),
            .radius = shape.radius * size * (1.0F - 0.09F * static_cast<float>(level)),
            .trait = hashed(cell, number, 14U)};
}

/// Direction in which the cloud mass around a cell gets thinner. The shading treats the mass as if it faced
/// in the direction in which it gets thinner.
glm::vec3 lean_of(const CoverField& field, int x, int y)
{
    const glm::vec2 slope(field.at(x + 1, y) - field.at(x - 1, y), field.at(x, y + 1) - field.at(x, y - 1));
    return glm::normalize(glm::vec3(-6.0F * slope.x, 0.6F, -6.0F * slope.y));
}

/// Makes lists of puffs (balls of cloud) per cell. `for_cells` visits all cells that a puff touches, and
/// gives the shift of the puff for each cell.
template <typename ForCells>
PuffLists list_by_cell(std::span<const shared::CloudPuff> puffs, uint32_t cells, const ForCells& for_cells)
{
    PuffLists lists{.starts = std::vector<uint32_t>(size_t{cells} * cells + 1)};
    const auto index = [cells](glm::ivec2 cell) {
        return static_cast<size_t>(cell.y) * cells + static_cast<size_t>(cell.x);
    };
    for (const shared::CloudPuff& puff : puffs) {
        for_cells(puff, [&](glm::ivec2 cell, glm::vec2) { ++lists.starts[index(cell) + 1]; });
    }
    std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
    lists.puffs.resize(lists.starts.back());
    std::vector<uint32_t> next = lists.starts;
    for (const shared::CloudPuff& puff : puffs) {
        for_cells(puff, [&](glm::ivec2 cell, glm::vec2 around) {
            shared::CloudPuff& listed = lists.puffs[next[index(cell)]++];
            listed = puff;
            listed.centre += glm::vec3(around.x, 0.0F, around.y);
        });
    }
    return lists;
}

} // namespace

float hashed(uint32_t a, uint32_t b, uint32_t c)
{
    return static_cast<float>(hash(a ^ hash(b ^ hash(c))) >> 8U) * 0x1p-24F;
}

CoverField cover_field(const CoverNoise& noise)
{
    struct Octave {
        uint32_t period;
        float weight;
    };

    const uint32_t masses = std::max(noise.cells / std::max(noise.mass_cells, 1U), 2U);
    const std::array octaves{Octave{std::max(masses / 3U, 2U), 0.7F}, Octave{masses, 1.0F},
                             Octave{2U * masses + 1U, 0.5F}};
    const float angle = 2.0F * std::numbers::pi_v<float> * noise.turn;
    const glm::vec2 shares(std::cos(angle), std::sin(angle));
    CoverField field{.cells = noise.cells, .values = std::vector<float>(size_t{noise.cells} * noise.cells)};
    for (uint32_t y = 0; y < noise.cells; ++y) {
        for (uint32_t x = 0; x < noise.cells; ++x) {
            const glm::vec2 on_tile = (glm::vec2(x, y) + 0.5F) / static_cast<float>(noise.cells);
            float sum = 0.0F;
            for (uint32_t i = 0; i < octaves.size(); ++i) {
                const glm::vec2 place = on_tile * static_cast<float>(octaves[i].period);
                for (int part = 0; part < 2; ++part) {
                    const uint32_t seed = 64U * noise.seed + 2U * i + static_cast<uint32_t>(part);
                    sum += octaves[i].weight * shares[part] *
                           (periodic_noise(place, octaves[i].period, seed) - 0.5F);
                }
            }
            field.values[size_t{y} * noise.cells + x] = 0.5F + sum;
        }
    }
    return field;
}

float limit_for(const CoverField& field, const PuffShape& shape, float share, uint32_t seed)
{
    constexpr uint32_t points_a_cell = 2;
    constexpr int reach = 2; // reach of a puff, in cells
    const auto cells = static_cast<int>(field.cells);
    std::vector<PuffSeed> seeds;
    seeds.reserve(field.values.size());
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            seeds.push_back(seed_of(field, shape, x, y, 0, seed));
        }
    }
    // For each point of the cloud base: the value of the limit below which puffs (balls of cloud) cover the
    // point.
    std::vector<float> limits;
    limits.reserve(size_t{points_a_cell} * field.values.size());
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            for (uint32_t i = 0; i < points_a_cell; ++i) {
                const uint32_t cell = field.index(x, y);
                const glm::vec2 point(hashed(cell, i, 21U), hashed(cell, i, 22U));
                float covered = -10.0F;
                for (int dy = -reach; dy <= reach; ++dy) {
                    for (int dx = -reach; dx <= reach; ++dx) {
                        const PuffSeed& puff = seeds[field.index(x + dx, y + dy)];
                        const float away = glm::distance(point, puff.place + glm::vec2(dx, dy)) / puff.radius;
                        if (away < 1.0F) {
                            covered = std::max(covered, field.at(x + dx, y + dy) -
                                                            shape.growth * inverse_smoothstep(away));
                        }
                    }
                }
                limits.push_back(covered);
            }
        }
    }
    const auto below = static_cast<size_t>((1.0F - share) * static_cast<float>(limits.size() - 1));
    std::ranges::nth_element(limits, limits.begin() + static_cast<std::ptrdiff_t>(below));
    return limits[below];
}

std::vector<shared::CloudPuff> puffs_of(const CoverField& field, const PuffShape& shape, float limit,
                                        uint32_t seed)
{
    // Smallest radius of a puff in cells; smaller puffs look like crumbs.
    constexpr float least_radius = 0.06F;
    const auto cells = static_cast<int>(field.cells);
    std::vector<shared::CloudPuff> puffs;
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            for (uint32_t level = 0; level < shape.levels; ++level) {
                const float above = field.at(x, y) - limit - shape.level_limit * static_cast<float>(level);
                const PuffSeed puff = seed_of(field, shape, x, y, level, seed);
                const float radius = puff.radius * glm::smoothstep(0.0F, 1.0F, above / shape.growth);
                if (radius < least_radius) {
                    continue;
                }
                const glm::vec2 place = puff.place + glm::vec2(x, y);
                const float height = shape.level_rise * shape.radius * static_cast<float>(level);
                puffs.push_back({.centre = {place.x, height, place.y},
                                 .radius = radius,
                                 .lean = lean_of(field, x, y),
                                 .trait = puff.trait});
            }
        }
    }
    return puffs;
}

PuffLists list_puffs(std::span<const shared::CloudPuff> puffs, uint32_t cells)
{
    const auto mask = static_cast<int>(cells) - 1;
    return list_by_cell(puffs, cells, [&](const shared::CloudPuff& puff, const auto& visit) {
        const glm::vec2 centre(puff.centre.x, puff.centre.z);
        const float reach = shared::puff_wavers * puff.radius;
        const glm::ivec2 first(glm::floor(centre - reach));
        const glm::ivec2 last(glm::floor(centre + reach));
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                const glm::vec2 nearest = glm::clamp(centre, glm::vec2(x, y), glm::vec2(x + 1, y + 1));
                if (glm::distance(nearest, centre) <= reach) {
                    const glm::ivec2 on_tile(x & mask, y & mask);
                    visit(on_tile, glm::vec2(on_tile - glm::ivec2(x, y)));
                }
            }
        }
    });
}

PuffLists list_homes(std::span<const shared::CloudPuff> puffs, uint32_t cells)
{
    return list_by_cell(puffs, cells, [](const shared::CloudPuff& puff, const auto& visit) {
        visit(glm::ivec2(puff.centre.x, puff.centre.z), glm::vec2(0.0F));
    });
}

std::vector<float> streak_density(const CoverField& field, float share)
{
    constexpr float gain = 2.5F;
    constexpr float densest = 0.9F;
    std::vector<float> density(field.values.size());
    const auto mean_above = [&](float limit) {
        double sum = 0.0;
        for (size_t i = 0; i < density.size(); ++i) {
            density[i] = std::clamp(gain * (field.values[i] - limit), 0.0F, densest);
            sum += static_cast<double>(density[i]);
        }
        return sum / static_cast<double>(density.size());
    };
    float low = -1.0F;
    float high = 2.0F;
    for (int i = 0; i < 24; ++i) {
        const float middle = 0.5F * (low + high);
        (mean_above(middle) > static_cast<double>(share) ? low : high) = middle;
    }
    mean_above(low);
    return density;
}

} // namespace estampe::sky
