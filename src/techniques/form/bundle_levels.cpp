// SPDX-License-Identifier: MIT
// Aggregation after Vanek, Mandel and Brezina, "Algebraic Multigrid by Smoothed Aggregation", 1996, without
// the smoothing of the prolongation.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "techniques/form/bundle.hpp"
#include "techniques/form/form_mesh.hpp"

namespace estampe::form {

Bundle::Bundle(uint32_t node_count, const std::vector<Link>& links, std::vector<double> masses)
{
    Level& fine = levels_.emplace_back();
    fine.masses = std::move(masses);
    fine.diagonal.assign(node_count, glm::dvec3(0.0));
    fine.starts.assign(node_count + 1, 0);
    for (const Link& link : links) {
        ++fine.starts[link.from + 1];
        ++fine.starts[link.to + 1];
    }
    std::partial_sum(fine.starts.begin(), fine.starts.end(), fine.starts.begin());
    fine.columns.resize(fine.starts.back());
    fine.blocks.resize(fine.starts.back());
    std::vector<uint32_t> next(fine.starts.begin(), fine.starts.end() - 1);
    for (const Link& link : links) {
        const auto c = static_cast<float>(-link.weight * std::cos(link.turn_rad));
        const auto s = static_cast<float>(-link.weight * std::sin(link.turn_rad));
        const Block to_from = link.mirrors ? Block{c, -s, -s, -c} : Block{c, -s, s, c};
        fine.columns[next[link.to]] = link.from;
        fine.blocks[next[link.to]++] = to_from;
        fine.columns[next[link.from]] = link.to;
        fine.blocks[next[link.from]++] = transposed(to_from);
        fine.diagonal[link.from] += glm::dvec3(link.weight, 0.0, link.weight);
        fine.diagonal[link.to] += glm::dvec3(link.weight, 0.0, link.weight);
    }
    constexpr uint32_t small_enough = 40;
    while (levels_.back().size() > small_enough && aggregate(levels_.back())) {
        levels_.push_back(coarsen(levels_.back()));
    }
    for (Level& level : levels_) {
        level.shifts.assign(level.size(), 0.0);
        level.x.resize(level.size());
        level.b.resize(level.size());
        level.r.resize(level.size());
    }
}

/// First nodes all of whose neighbours are free found groups, then each that is left joins the group of the
/// neighbour that it is most strongly tied to. False when that hardly lessens their number.
bool Bundle::aggregate(Level& fine)
{
    const uint32_t count = fine.size();
    fine.coarse.assign(count, none);
    fine.from_coarse.assign(count, {1.0F, 0.0F, 0.0F, 1.0F});
    uint32_t groups = 0;
    for (uint32_t i = 0; i < count; ++i) {
        bool is_free = fine.coarse[i] == none && fine.starts[i] < fine.starts[i + 1];
        for (uint32_t k = fine.starts[i]; is_free && k < fine.starts[i + 1]; ++k) {
            is_free = fine.coarse[fine.columns[k]] == none;
        }
        if (!is_free) {
            continue;
        }
        fine.coarse[i] = groups;
        for (uint32_t k = fine.starts[i]; k < fine.starts[i + 1]; ++k) {
            fine.coarse[fine.columns[k]] = groups;
            fine.from_coarse[fine.columns[k]] = nearest_orthogonal(transposed(fine.blocks[k]));
        }
        ++groups;
    }
    const std::vector<uint32_t> founded = fine.coarse;
    for (uint32_t i = 0; i < count; ++i) {
        if (founded[i] != none) {
            continue;
        }
        float strongest = 0.0F;
        for (uint32_t k = fine.starts[i]; k < fine.starts[i + 1]; ++k) {
            const uint32_t j = fine.columns[k];
            if (founded[j] != none && strength(fine.blocks[k]) > strongest) {
                strongest = strength(fine.blocks[k]);
                fine.coarse[i] = founded[j];
                fine.from_coarse[i] = product(nearest_orthogonal(fine.blocks[k]), fine.from_coarse[j]);
            }
        }
        if (fine.coarse[i] == none) {
            fine.coarse[i] = groups++;
        }
    }
    return groups < count - count / 8;
}

Bundle::Level Bundle::coarsen(const Level& fine)
{
    Level coarse;
    const uint32_t count = 1 + *std::max_element(fine.coarse.begin(), fine.coarse.end());
    coarse.diagonal.assign(count, glm::dvec3(0.0));
    coarse.masses.assign(count, 0.0);
    std::vector<uint32_t> member_starts(count + 1, 0);
    for (const uint32_t group : fine.coarse) {
        ++member_starts[group + 1];
    }
    std::partial_sum(member_starts.begin(), member_starts.end(), member_starts.begin());
    std::vector<uint32_t> members(fine.size());
    std::vector<uint32_t> next(member_starts.begin(), member_starts.end() - 1);
    for (uint32_t i = 0; i < fine.size(); ++i) {
        members[next[fine.coarse[i]]++] = i;
    }
    std::vector<uint32_t> slot(count, none);
    coarse.starts.push_back(0);
    for (uint32_t group = 0; group < count; ++group) {
        const auto row_start = static_cast<uint32_t>(coarse.columns.size());
        for (uint32_t m = member_starts[group]; m < member_starts[group + 1]; ++m) {
            const uint32_t i = members[m];
            const Block& p = fine.from_coarse[i];
            const glm::dvec3& d = fine.diagonal[i];
            const glm::dvec2 column_x = transposed_times(p, times(d, {p.xx, p.yx}));
            const glm::dvec2 column_y = transposed_times(p, times(d, {p.xy, p.yy}));
            coarse.diagonal[group] += glm::dvec3(column_x.x, 0.5 * (column_x.y + column_y.x), column_y.y);
            coarse.masses[group] += fine.masses[i];
            for (uint32_t k = fine.starts[i]; k < fine.starts[i + 1]; ++k) {
                const uint32_t j = fine.columns[k];
                const Block block = product(transposed(p), product(fine.blocks[k], fine.from_coarse[j]));
                const uint32_t other = fine.coarse[j];
                if (other == group) {
                    coarse.diagonal[group] += glm::dvec3(block.xx, 0.5F * (block.xy + block.yx), block.yy);
                    continue;
                }
                if (slot[other] == none || slot[other] < row_start) {
                    slot[other] = static_cast<uint32_t>(coarse.columns.size());
                    coarse.columns.push_back(other);
                    coarse.blocks.emplace_back();
                }
                Block& sum = coarse.blocks[slot[other]];
                sum = {sum.xx + block.xx, sum.xy + block.xy, sum.yx + block.yx, sum.yy + block.yy};
            }
        }
        coarse.starts.push_back(static_cast<uint32_t>(coarse.columns.size()));
    }
    return coarse;
}

} // namespace estampe::form
