// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <queue>

#include "techniques/cloth/sheet/structure.hpp"

namespace estampe::cloth {
namespace {

constexpr size_t most_groups = 16; // of held particles; where there are more, all are taken for one

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

/// The nearest particle of a group from each particle, along the sheet.
std::vector<Tether> nearest_of(const Sheet& sheet, bool is_flat, Neighbours neighbours,
                               const std::vector<uint32_t>& group)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    // A way from particle to particle is that much longer than the straight one at most, on a regular sheet.
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

} // namespace

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
            for (uint32_t k = 0; k < lists.width; ++k) { // nearest first
                Tether& kept = lists.items[k * count + i];
                if (added.most_m < kept.most_m) {
                    std::swap(added, kept);
                }
            }
        }
    }
    return lists;
}

} // namespace estampe::cloth
