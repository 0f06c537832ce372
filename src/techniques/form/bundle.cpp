// SPDX-License-Identifier: MIT
// Multigrid by aggregation (merging groups of nodes): Vanek, Mandel and Brezina, "Algebraic Multigrid by
// Smoothed Aggregation", 1996, without smoothing of the prolongation. Corrections from coarse multigrid
// levels are over-relaxed: Braess, "Towards Algebraic Multigrid for Elliptic Problems of Second Order", 1995.
// Diffusion with normalization: Viertel and Osting, "An Approach to Quad Meshing Based on Harmonic
// Cross-Valued Maps and the Ginzburg-Landau Theory", 2019.
#include "techniques/form/bundle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Merges the nodes of a multigrid level into groups, which are the nodes of the next coarser level. A node
/// forms a group with its neighbours if none of the neighbours has a group yet. Each remaining node then
/// joins the group of its most strongly linked neighbour. Returns false if grouping hardly reduces the number
/// of nodes.
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

namespace {

constexpr double overcorrection = 1.5;

glm::dvec2 unit_or(glm::dvec2 v, glm::dvec2 otherwise)
{
    const double length = glm::length(v);
    return length > 1e-200 && std::isfinite(length) ? v / length : otherwise;
}

glm::dvec2 random_unit(uint32_t seed, uint32_t index)
{
    // Random numbers by PCG hash, as in Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020.
    uint32_t h = seed * 747796405U + index * 2891336453U + 1013904223U;
    h = ((h >> ((h >> 28U) + 4U)) ^ h) * 277803737U;
    const double angle = 6.283185307179586 * ((h >> 22U) ^ h) / 4294967296.0;
    return {std::cos(angle), std::sin(angle)};
}

double dot(const Vectors& a, const Vectors& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += glm::dot(a[i], b[i]);
    }
    return sum;
}

} // namespace

void Bundle::set_shifts(std::vector<double> finest)
{
    levels_.front().shifts = std::move(finest);
    for (size_t l = 1; l < levels_.size(); ++l) {
        std::fill(levels_[l].shifts.begin(), levels_[l].shifts.end(), 0.0);
        for (uint32_t i = 0; i < levels_[l - 1].size(); ++i) {
            levels_[l].shifts[levels_[l - 1].coarse[i]] += levels_[l - 1].shifts[i];
        }
    }
    invert_diagonals();
}

void Bundle::set_shift(double per_mass)
{
    for (Level& level : levels_) {
        for (uint32_t i = 0; i < level.size(); ++i) {
            level.shifts[i] = per_mass * level.masses[i];
        }
    }
    invert_diagonals();
}

void Bundle::invert_diagonals()
{
    for (Level& level : levels_) {
        level.inverse_diagonal.resize(level.size());
        for (uint32_t i = 0; i < level.size(); ++i) {
            // A small value is added to the diagonal. So the matrix stays invertible even for a group of
            // nodes whose links do not conflict and which has no neighbours.
            const double least = 1e-7 * (level.diagonal[i].x + level.diagonal[i].z) + 1e-300;
            const glm::dvec3 d = level.diagonal[i] + glm::dvec3(1.0, 0.0, 1.0) * (level.shifts[i] + least);
            const double determinant = std::max(d.x * d.z - d.y * d.y, 1e-14 * d.x * d.z);
            level.inverse_diagonal[i] = glm::dvec3(d.z, -d.y, d.x) / std::max(determinant, 1e-300);
        }
    }
}

glm::dvec2 Bundle::off_diagonal(const Level& level, uint32_t row, const Vectors& x)
{
    glm::dvec2 sum(0.0);
    for (uint32_t k = level.starts[row]; k < level.starts[row + 1]; ++k) {
        sum += times(level.blocks[k], x[level.columns[k]]);
    }
    return sum;
}

void Bundle::smooth(const Level& level, Vectors& x, const Vectors& b, bool forward)
{
    const uint32_t count = level.size();
    for (uint32_t n = 0; n < count; ++n) {
        const uint32_t i = forward ? n : count - 1 - n;
        x[i] = times(level.inverse_diagonal[i], b[i] - off_diagonal(level, i, x));
    }
}

void Bundle::apply(const Level& level, const Vectors& x, Vectors& out)
{
    for (uint32_t i = 0; i < level.size(); ++i) {
        out[i] = times(level.diagonal[i], x[i]) + level.shifts[i] * x[i] + off_diagonal(level, i, x);
    }
}

/// Whether a multigrid level is coarse enough to be the last level. In a graph with many separate parts, the
/// last multigrid level is large, and its nodes have hardly any neighbours.
bool Bundle::is_small(const Level& level)
{
    return level.size() <= 1000;
}

void Bundle::cycle(size_t index, Vectors& x, const Vectors& b)
{
    Level& level = levels_[index];
    if (index + 1 == levels_.size()) {
        const int rounds = is_small(level) ? 12 : 2;
        for (int i = 0; i < rounds; ++i) {
            smooth(level, x, b, true);
            smooth(level, x, b, false);
        }
        return;
    }
    smooth(level, x, b, true);
    apply(level, x, level.r);
    Level& coarse = levels_[index + 1];
    std::fill(coarse.b.begin(), coarse.b.end(), glm::dvec2(0.0));
    std::fill(coarse.x.begin(), coarse.x.end(), glm::dvec2(0.0));
    for (uint32_t i = 0; i < level.size(); ++i) {
        coarse.b[level.coarse[i]] += transposed_times(level.from_coarse[i], b[i] - level.r[i]);
    }
    cycle(index + 1, coarse.x, coarse.b);
    for (uint32_t i = 0; i < level.size(); ++i) {
        x[i] += overcorrection * times(level.from_coarse[i], coarse.x[level.coarse[i]]);
    }
    smooth(level, x, b, false);
}

Vectors Bundle::attract(const std::vector<double>& pulls, const Vectors& targets, double tolerance)
{
    Vectors right(targets.size());
    for (size_t i = 0; i < right.size(); ++i) {
        right[i] = pulls[i] * targets[i];
    }
    return solve(pulls, right, tolerance);
}

Vectors Bundle::solve(const std::vector<double>& pulls, const Vectors& right, double tolerance)
{
    set_shifts(pulls);
    const Level& fine = levels_.front();
    const uint32_t count = fine.size();
    Vectors x(count, glm::dvec2(0.0));
    Vectors residual = right;
    Vectors direction(count, glm::dvec2(0.0));
    Vectors image(count);
    Vectors preconditioned(count);
    const double enough = tolerance * tolerance * dot(residual, residual);
    double old_product = 1.0;
    constexpr int most_rounds = 60;
    for (int round = 0; round < most_rounds && dot(residual, residual) > enough; ++round) {
        std::fill(preconditioned.begin(), preconditioned.end(), glm::dvec2(0.0));
        cycle(0, preconditioned, residual);
        const double new_product = dot(residual, preconditioned);
        const double keep = round == 0 ? 0.0 : new_product / old_product;
        old_product = new_product;
        for (uint32_t i = 0; i < count; ++i) {
            direction[i] = preconditioned[i] + keep * direction[i];
        }
        apply(fine, direction, image);
        const double curvature = dot(direction, image);
        if (!(curvature > 0.0)) {
            break;
        }
        const double step = new_product / curvature;
        for (uint32_t i = 0; i < count; ++i) {
            x[i] += step * direction[i];
            residual[i] -= step * image[i];
        }
    }
    return x;
}

void Bundle::diffuse(size_t index, Vectors& z, double reach, int times_over)
{
    set_shift(1.0 / (reach * reach));
    const Level& level = levels_[index];
    Vectors b(z.size());
    for (int step = 0; step < times_over; ++step) {
        for (uint32_t i = 0; i < level.size(); ++i) {
            b[i] = level.shifts[i] * z[i];
        }
        const Vectors old = z;
        cycle(index, z, b);
        cycle(index, z, b);
        for (uint32_t i = 0; i < level.size(); ++i) {
            z[i] = unit_or(z[i], old[i]);
        }
    }
}

Vectors Bundle::relax(double reach, uint32_t seed)
{
    Vectors z(levels_.back().size());
    for (uint32_t i = 0; i < z.size(); ++i) {
        z[i] = random_unit(seed, i);
    }
    for (size_t l = levels_.size(); l-- > 0;) {
        if (l + 1 < levels_.size()) {
            Vectors finer(levels_[l].size());
            for (uint32_t i = 0; i < finer.size(); ++i) {
                finer[i] = times(levels_[l].from_coarse[i], z[levels_[l].coarse[i]]);
            }
            z = std::move(finer);
        }
        const double mass = std::accumulate(levels_[l].masses.begin(), levels_[l].masses.end(), 0.0);
        const double spacing = std::sqrt(mass / levels_[l].size());
        const bool is_last = l + 1 == levels_.size() && is_small(levels_[l]);
        diffuse(l, z, std::max(2.0 * reach, 4.0 * spacing), is_last ? 40 : 6);
        diffuse(l, z, std::max(0.5 * reach, 2.0 * spacing), 3);
    }
    return z;
}

} // namespace estampe::form
