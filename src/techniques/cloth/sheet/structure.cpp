// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "techniques/cloth/sheet/sheet.hpp"

namespace estampe::cloth {
namespace {

constexpr size_t most_groups = 16; // most groups of held particles; more groups are merged into one

using Neighbours = std::span<const std::vector<uint32_t>>;

std::vector<std::vector<uint32_t>> groups_of_held(const Sheet& sheet, Neighbours neighbours)
{
    std::vector<std::vector<uint32_t>> groups;
    std::vector<bool> is_taken(sheet.held.size(), false);
    for (uint32_t i = 0; i < sheet.held.size(); ++i) {
        if (sheet.held[i] < 1.0F || is_taken[i]) {
            continue;
        }
        std::vector<uint32_t>& group = groups.emplace_back(1, i);
        is_taken[i] = true;
        for (size_t k = 0; k < group.size(); ++k) {
            for (const uint32_t j : neighbours[group[k]]) {
                if (sheet.held[j] >= 1.0F && !is_taken[j]) {
                    is_taken[j] = true;
                    group.push_back(j);
                }
            }
        }
    }
    if (groups.size() > most_groups) {
        for (size_t k = 1; k < groups.size(); ++k) {
            groups[0].insert(groups[0].end(), groups[k].begin(), groups[k].end());
        }
        groups.resize(1);
    }
    return groups;
}

/// For each particle of the sheet, finds the nearest particle of a group, measured along the sheet.
std::vector<Tether> nearest_of(const Sheet& sheet, bool is_flat, Neighbours neighbours,
                               const std::vector<uint32_t>& group)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    // On a regular sheet, the largest ratio of a path along links to the straight distance.
    constexpr float detour = 1.09F;
    std::vector<Tether> nearest(sheet.rest_m.size(), {.most_m = infinity});
    using Reached = std::pair<float, uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> reached;
    for (const uint32_t i : group) {
        nearest[i] = {.held = i, .most_m = 0.0F};
        reached.emplace(0.0F, i);
    }
    while (!reached.empty()) {
        const auto [length_m, i] = reached.top();
        reached.pop();
        if (length_m > nearest[i].most_m) {
            continue;
        }
        const glm::vec3& held = sheet.rest_m[nearest[i].held];
        for (const uint32_t j : neighbours[i]) {
            const float straight_m = glm::distance(sheet.rest_m[j], held);
            const float path_m =
                is_flat ? straight_m : length_m + glm::distance(sheet.rest_m[j], sheet.rest_m[i]);
            if (path_m < nearest[j].most_m) {
                nearest[j] = {.held = nearest[i].held, .most_m = path_m};
                reached.emplace(path_m, j);
            }
        }
    }
    for (uint32_t i = 0; i < nearest.size(); ++i) {
        const float straight_m = glm::distance(sheet.rest_m[i], sheet.rest_m[nearest[i].held]);
        if (nearest[i].most_m < detour * straight_m) {
            nearest[i].most_m = straight_m;
        }
    }
    return nearest;
}

/// Builds up to four tethers per particle, each to a different connected group of held particles.
Lists<Tether> build_tethers(const Sheet& sheet, const std::optional<GridForm>& grid, Neighbours neighbours)
{
    const auto groups = groups_of_held(sheet, neighbours);
    const size_t count = sheet.rest_m.size();
    Lists<Tether> lists{
        .width = std::min(static_cast<uint32_t>(groups.size()), uint32_t{shared::cloth_most_tethers})};
    constexpr float infinity = std::numeric_limits<float>::infinity();
    lists.items.assign(lists.width * count, {.most_m = infinity});
    for (const auto& group : groups) {
        const std::vector<Tether> nearest = nearest_of(sheet, grid.has_value(), neighbours, group);
        for (size_t i = 0; i < count; ++i) {
            Tether added = nearest[i];
            // Insertion sort: the nearest held particle comes first.
            for (uint32_t k = 0; k < lists.width; ++k) {
                Tether& kept = lists.items[k * count + i];
                if (added.most_m < kept.most_m) {
                    std::swap(added, kept);
                }
            }
        }
    }
    return lists;
}

// Bending stiffness of cloth after Bergou, Wardetzky, Harmon, Zorin and Grinspun, "A Quadratic Bending Model
// for Inextensible Surfaces", SGP 2006.

constexpr size_t most_edges = 64; // largest number of edges at a particle
// A tether is slightly longer than the sheet between the tether's two ends, so that tethers do not work
// against links.
constexpr float tether_slack = 1.003F;
constexpr float mean_of_fourth = 0.375F; // mean of cos^4 over all directions in the plane

struct Pair {
    bool is_far = false;
    float rest_m = 0.0F;
    float bending = 0.0F;
    std::optional<float> compliance_m_n; ///< compliance of the link; empty: the compliance of the cloth
};

using Pairs = std::map<std::pair<uint32_t, uint32_t>, Pair>;

std::pair<uint32_t, uint32_t> ordered(uint32_t a, uint32_t b)
{
    return {std::min(a, b), std::max(a, b)};
}

void check(const Sheet& sheet)
{
    const size_t count = sheet.rest_m.size();
    const auto fits = [&](const auto& list) { return list.empty() || list.size() == count; };
    if (count == 0 || !fits(sheet.held) || !fits(sheet.masses_kg)) {
        throw Error("a sheet of cloth has a mass and a hold for each of its particles");
    }
    if (sheet.cloth.tear != 0.0F && !(sheet.cloth.tear > 1.0F)) {
        throw Error("a sheet of cloth tears before it is stretched", "",
                    "tear is a length as a share of that at rest: 0, or more than 1");
    }
    for (const glm::uvec3& triangle : sheet.triangles) {
        if (std::max({triangle.x, triangle.y, triangle.z}) >= count) {
            throw Error("a triangle of a sheet of cloth names a particle that it does not have");
        }
    }
    for (const Thread& thread : sheet.threads) {
        if (std::max(thread.from, thread.to) >= count) {
            throw Error("a thread of a sheet of cloth names a particle that it does not have");
        }
    }
    for (const glm::vec3& place : sheet.rest_m) {
        if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) {
            throw Error("a particle of a sheet of cloth is nowhere");
        }
    }
}

float area_of(const Sheet& sheet, const glm::uvec3& triangle)
{
    const glm::vec3& a = sheet.rest_m[triangle.x];
    return 0.5F * glm::length(glm::cross(sheet.rest_m[triangle.y] - a, sheet.rest_m[triangle.z] - a));
}

std::vector<float> areas_of_particles(const Sheet& sheet)
{
    std::vector<float> areas(sheet.rest_m.size(), 0.0F);
    for (const glm::uvec3& triangle : sheet.triangles) {
        const float third = area_of(sheet, triangle) / 3.0F;
        for (int k = 0; k < 3; ++k) {
            areas[triangle[k]] += third;
        }
    }
    return areas;
}

std::vector<float> masses_of(const Sheet& sheet, const std::vector<float>& areas)
{
    std::vector<float> masses = sheet.masses_kg;
    if (masses.empty()) {
        for (const float area : areas) {
            masses.push_back(sheet.cloth.density_kg_m2 * area);
        }
        // A particle without faces still needs a mass, so every mass is at least a thousandth of the largest.
        const float most = *std::ranges::max_element(masses);
        for (float& mass : masses) {
            mass = std::max(mass, 1e-3F * most);
        }
    }
    for (const float mass : masses) {
        if (!(mass > 0.0F) || !std::isfinite(mass)) {
            throw Error("a sheet of cloth has a particle without mass", "",
                        "give it triangles that have an area, and a density");
        }
    }
    return masses;
}

float cotangent(const glm::vec3& a, const glm::vec3& b)
{
    return glm::dot(a, b) / std::max(glm::length(glm::cross(a, b)), 1e-12F);
}

/// Adds the bending terms of two triangles that share an edge. `corners` 0 and 1 are the edge's ends, 2 and 3
/// the opposite corners.
void add_hinge(Pairs& pairs, const Sheet& sheet, const std::array<uint32_t, 4>& corners)
{
    const auto place = [&](size_t i) { return sheet.rest_m[corners.at(i)]; };
    const glm::vec3 edge = place(1) - place(0);
    const float c01 = cotangent(edge, place(2) - place(0));
    const float c02 = cotangent(edge, place(3) - place(0));
    const float c03 = cotangent(-edge, place(2) - place(1));
    const float c04 = cotangent(-edge, place(3) - place(1));
    const float area = 0.5F * (glm::length(glm::cross(edge, place(2) - place(0))) +
                               glm::length(glm::cross(edge, place(3) - place(0))));
    const std::array<float, 4> k{c03 + c04, c01 + c02, -c01 - c03, -c02 - c04};
    pairs.try_emplace(ordered(corners[2], corners[3]),
                      Pair{.is_far = true, .rest_m = glm::distance(place(2), place(3))});
    for (size_t i = 0; i < 4; ++i) {
        for (size_t j = i + 1; j < 4; ++j) {
            pairs.at(ordered(corners.at(i), corners.at(j))).bending -=
                k.at(i) * k.at(j) / std::max(area, 1e-12F);
        }
    }
}

void add_edges(Pairs& pairs, const Sheet& sheet)
{
    // For each edge: the corners, opposite to the edge, of the edge's two triangles.
    std::map<std::pair<uint32_t, uint32_t>, std::array<uint32_t, 2>> beside;
    const auto join = [&](uint32_t a, uint32_t b) {
        pairs.try_emplace(ordered(a, b), Pair{.rest_m = glm::distance(sheet.rest_m[a], sheet.rest_m[b])});
    };
    std::vector<std::array<uint32_t, 4>> hinges;
    for (const glm::uvec3& triangle : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = triangle[k];
            const uint32_t b = triangle[(k + 1) % 3];
            const uint32_t opposite = triangle[(k + 2) % 3];
            join(a, b);
            const auto [found, is_new] = beside.try_emplace(ordered(a, b), std::array{opposite, opposite});
            if (!is_new && found->second[0] == found->second[1] && found->second[0] != opposite) {
                found->second[1] = opposite;
                hinges.push_back({found->first.first, found->first.second, found->second[0], opposite});
            }
        }
    }
    for (const auto& hinge : hinges) {
        add_hinge(pairs, sheet, hinge);
    }
    for (const Thread& thread : sheet.threads) {
        join(thread.from, thread.to);
        pairs.at(ordered(thread.from, thread.to)).compliance_m_n = thread.compliance_m_n;
    }
}

std::vector<std::vector<uint32_t>> neighbours_of(size_t count, const Pairs& pairs)
{
    std::vector<std::vector<uint32_t>> neighbours(count);
    for (const auto& [ends, pair] : pairs) {
        if (!pair.is_far) {
            neighbours[ends.first].push_back(ends.second);
            neighbours[ends.second].push_back(ends.first);
        }
    }
    for (const auto& list : neighbours) {
        if (list.size() > most_edges) {
            throw Error(fmt::format("{} edges of a sheet of cloth meet at one particle", list.size()), "",
                        fmt::format("cut it into triangles of which {} meet at most", most_edges));
        }
    }
    return neighbours;
}

/// Adds links to the particles that lie behind a neighbour, in a straight line.
void add_straight_on(Pairs& pairs, const Sheet& sheet, const std::vector<std::vector<uint32_t>>& neighbours)
{
    constexpr float straight = 0.85F; // smallest cosine between two edges that count as a straight line
    for (uint32_t i = 0; i < neighbours.size(); ++i) {
        for (const uint32_t j : neighbours[i]) {
            const glm::vec3 way = sheet.rest_m[j] - sheet.rest_m[i];
            float best = straight;
            uint32_t best_k = i;
            for (const uint32_t k : neighbours[j]) {
                const glm::vec3 on = sheet.rest_m[k] - sheet.rest_m[j];
                const float cosine = glm::dot(way, on) / std::max(glm::length(way) * glm::length(on), 1e-12F);
                if (k != i && cosine > best) {
                    best = cosine;
                    best_k = k;
                }
            }
            if (best_k != i) {
                pairs.try_emplace(
                    ordered(i, best_k),
                    Pair{.is_far = true, .rest_m = glm::distance(sheet.rest_m[i], sheet.rest_m[best_k])});
            }
        }
    }
}

template <class Item>
Lists<Item> as_lists(const std::vector<std::vector<Item>>& of_particles,
                     const std::function<Item(uint32_t)>& none)
{
    Lists<Item> lists;
    for (const auto& list : of_particles) {
        lists.width = std::max(lists.width, static_cast<uint32_t>(list.size()));
    }
    for (uint32_t k = 0; k < lists.width; ++k) {
        for (uint32_t i = 0; i < of_particles.size(); ++i) {
            lists.items.push_back(k < of_particles[i].size() ? of_particles[i][k] : none(i));
        }
    }
    return lists;
}

/// Compliance of one link, chosen so that all `link_count` links about a particle with the area `area_m2`
/// together give the cloth's stretch.
float softness_of(const Cloth& cloth, float area_m2, uint32_t link_count)
{
    return mean_of_fourth * static_cast<float>(link_count) / (2.0F * area_m2 * cloth.stretch_n_m);
}

void fill_lists(Structure& structure, const Sheet& sheet, const Pairs& pairs, const std::vector<float>& areas)
{
    const size_t count = sheet.rest_m.size();
    structure.link_shares.assign(count, 0.0F);
    std::vector<uint32_t> link_counts(count, 0);
    for (const auto& [ends, pair] : pairs) {
        for (const uint32_t end : {ends.first, ends.second}) {
            structure.link_shares[end] += pair.is_far ? 1.0F : shared::cloth_near_share;
            ++link_counts[end];
        }
    }
    std::vector<std::vector<shared::ClothLink>> links(count);
    std::vector<float> rates(count, 0.0F);
    for (const auto& [ends, pair] : pairs) {
        const auto [a, b] = ends;
        const float area = std::max(0.5F * (areas[a] + areas[b]), 1e-12F);
        const uint32_t link_count = (link_counts[a] + link_counts[b] + 1) / 2;
        const float compliance = pair.compliance_m_n.value_or(softness_of(sheet.cloth, area, link_count) *
                                                              pair.rest_m * pair.rest_m);
        const float rest_m = std::max(pair.rest_m, 1e-6F);
        shared::ClothLink link{.other = b,
                               .rest_m = pair.is_far ? -rest_m : rest_m,
                               .compliance_m_n = compliance,
                               .bending = pair.bending};
        links[a].push_back(link);
        link.other = a;
        links[b].push_back(link);
        rates[a] += 2.0F * std::abs(pair.bending) / structure.masses_kg[a];
        rates[b] += 2.0F * std::abs(pair.bending) / structure.masses_kg[b];
    }
    structure.bending_rate_s2 = *std::ranges::max_element(rates);
    structure.links = as_lists<shared::ClothLink>(links, [](uint32_t) { return shared::ClothLink{}; });
    std::vector<std::vector<glm::uvec2>> faces(count);
    for (const glm::uvec3& triangle : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            faces[triangle[k]].emplace_back(triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
        }
    }
    structure.faces = as_lists<glm::uvec2>(faces, [](uint32_t i) { return glm::uvec2(i); });
}

void fill_grid(Structure& structure, const Sheet& sheet)
{
    const GridForm& grid = *structure.grid;
    // Number of links of length `reach` in the 8 directions.
    const auto links = [&](uint32_t i, uint32_t reach) {
        const auto along = [&](uint32_t at, uint32_t size) {
            return (at >= reach ? 1U : 0U) + (at + reach < size ? 1U : 0U);
        };
        return static_cast<float>(
            (1 + along(i % grid.columns, grid.columns)) * (1 + along(i / grid.columns, grid.rows)) - 1);
    };
    for (uint32_t i = 0; i < sheet.rest_m.size(); ++i) {
        structure.link_shares.push_back(shared::cloth_near_share * links(i, 1) + links(i, 2));
    }
    constexpr uint32_t all_links = 16;
    const glm::vec2 s = grid.spacing_m;
    structure.softness = softness_of(sheet.cloth, s.x * s.y, all_links);
    const float stencil = 16.0F * (s.x / (s.y * s.y * s.y) + s.y / (s.x * s.x * s.x)) + 32.0F / (s.x * s.y);
    structure.bending_rate_s2 = stencil / *std::ranges::min_element(structure.masses_kg);
}

std::vector<std::vector<uint32_t>> neighbours_on_grid(const GridForm& grid)
{
    std::vector<std::vector<uint32_t>> neighbours(size_t{grid.columns} * grid.rows);
    for (uint32_t i = 0; i < neighbours.size(); ++i) {
        const glm::ivec2 at(i % grid.columns, i / grid.columns);
        for (int k = 0; k < 9; ++k) {
            const glm::ivec2 there = at + glm::ivec2(k % 3 - 1, k / 3 - 1);
            if (k != 4 && there.x >= 0 && there.y >= 0 && there.x < static_cast<int>(grid.columns) &&
                there.y < static_cast<int>(grid.rows)) {
                neighbours[i].push_back(static_cast<uint32_t>(there.y) * grid.columns +
                                        static_cast<uint32_t>(there.x));
            }
        }
    }
    return neighbours;
}

/// Graph colouring of a grid's particles, such that no two linked particles share a colour. Links reach two
/// particles, so colours repeat after three particles each way.
std::vector<std::vector<uint32_t>> colours_of_grid(const GridForm& grid)
{
    constexpr uint32_t apart = 3;
    std::vector<std::vector<uint32_t>> colours(size_t{apart} * apart);
    for (uint32_t i = 0; i < grid.columns * grid.rows; ++i) {
        const uint32_t colour = i % grid.columns % apart + apart * (i / grid.columns % apart);
        colours[colour].push_back(i);
    }
    return colours;
}

/// Greedy graph colouring of particles: each particle gets the first colour that no linked particle has.
std::vector<std::vector<uint32_t>> colours_of_lists(const Lists<shared::ClothLink>& links, size_t count)
{
    std::vector<std::vector<uint32_t>> colours;
    std::vector<size_t> colour_of(count, count);
    for (uint32_t i = 0; i < count; ++i) {
        std::vector<bool> is_taken(colours.size() + 1, false);
        for (uint32_t k = 0; k < links.width; ++k) {
            const shared::ClothLink& link = links.items[k * count + i];
            if (link.rest_m != 0.0F && colour_of[link.other] < count) {
                is_taken[colour_of[link.other]] = true;
            }
        }
        const auto free = static_cast<size_t>(std::ranges::find(is_taken, false) - is_taken.begin());
        if (free == colours.size()) {
            colours.emplace_back();
        }
        colours[free].push_back(i);
        colour_of[i] = free;
    }
    return colours;
}

void check_torn_bits(const Structure& structure)
{
    if (structure.links.width > shared::cloth_torn_bits) {
        throw Error(fmt::format("{} links of a sheet of cloth that may tear meet at one particle",
                                structure.links.width),
                    "", fmt::format("cut it into finer triangles: {} are kept", shared::cloth_torn_bits));
    }
}

} // namespace

uint32_t link_bit(const Structure& structure, uint32_t from, uint32_t to)
{
    if (structure.grid) {
        const auto columns = static_cast<int>(structure.grid->columns);
        const auto i = static_cast<int>(from);
        const auto j = static_cast<int>(to);
        return static_cast<uint32_t>(5 * (j / columns - i / columns + 2) + j % columns - i % columns + 2);
    }
    const size_t count = structure.masses_kg.size();
    for (uint32_t k = 0; k < structure.links.width; ++k) {
        const shared::ClothLink& link = structure.links.items[k * count + from];
        if (link.rest_m > 0.0F && link.other == to) {
            return k;
        }
    }
    throw std::logic_error("two particles of a sheet of cloth are not next to each other");
}

Structure build_structure(const Sheet& sheet)
{
    check(sheet);
    Structure structure{.grid = grid_form(sheet)};
    const std::vector<float> areas = areas_of_particles(sheet);
    structure.masses_kg = masses_of(sheet, areas);
    std::vector<std::vector<uint32_t>> neighbours;
    if (structure.grid) {
        fill_grid(structure, sheet);
        neighbours = neighbours_on_grid(*structure.grid);
        structure.colours = colours_of_grid(*structure.grid);
    } else {
        Pairs pairs;
        add_edges(pairs, sheet);
        neighbours = neighbours_of(sheet.rest_m.size(), pairs);
        if (!sheet.triangles.empty()) {
            add_straight_on(pairs, sheet, neighbours);
        }
        fill_lists(structure, sheet, pairs, areas);
        structure.colours = colours_of_lists(structure.links, sheet.rest_m.size());
    }
    if (sheet.cloth.tear > 0.0F) {
        check_torn_bits(structure);
        return structure;
    }
    structure.tethers = build_tethers(sheet, structure.grid, neighbours);
    for (Tether& tether : structure.tethers.items) {
        tether.most_m *= tether_slack;
    }
    return structure;
}

} // namespace estampe::cloth
