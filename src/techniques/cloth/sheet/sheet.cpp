// SPDX-License-Identifier: MIT
#include "techniques/cloth/sheet/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace estampe::cloth {

Sheet grid_sheet(glm::uvec2 particles, glm::vec3 corner_m, glm::vec3 along_m, glm::vec3 across_m,
                 const Cloth& cloth)
{
    Sheet sheet{.cloth = cloth};
    const glm::vec2 last = glm::max(glm::vec2(particles) - 1.0F, glm::vec2(1.0F));
    for (uint32_t y = 0; y < particles.y; ++y) {
        for (uint32_t x = 0; x < particles.x; ++x) {
            const glm::vec2 share = glm::vec2(x, y) / last;
            sheet.rest_m.push_back(corner_m + share.x * along_m + share.y * across_m);
            if (x + 1 < particles.x && y + 1 < particles.y) {
                const uint32_t i = y * particles.x + x;
                const uint32_t j = i + particles.x;
                // Diagonals alternate, so that the sheet is equally stiff along both diagonals.
                if ((x + y) % 2 == 0) {
                    sheet.triangles.insert(sheet.triangles.end(), {{i, i + 1, j + 1}, {i, j + 1, j}});
                } else {
                    sheet.triangles.insert(sheet.triangles.end(), {{i, i + 1, j}, {i + 1, j + 1, j}});
                }
            }
        }
    }
    return sheet;
}

bool hangs(const Sheet& sheet)
{
    if (sheet.cloth.tear > 0.0F) {
        return false;
    }
    std::vector<uint32_t> parent(sheet.rest_m.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](uint32_t particle) {
        while (parent[particle] != particle) {
            particle = parent[particle] = parent[parent[particle]];
        }
        return particle;
    };
    for (const glm::uvec3& triangle : sheet.triangles) {
        parent[root(triangle.y)] = root(triangle.x);
        parent[root(triangle.z)] = root(triangle.x);
    }
    for (const Thread& thread : sheet.threads) {
        parent[root(thread.to)] = root(thread.from);
    }
    std::vector<bool> is_held(parent.size(), false);
    for (uint32_t i = 0; i < sheet.held.size(); ++i) {
        is_held[root(i)] = is_held[root(i)] || sheet.held[i] >= 1.0F;
    }
    for (uint32_t i = 0; i < parent.size(); ++i) {
        if (!is_held[root(i)]) {
            return false;
        }
    }
    return true;
}

std::optional<GridForm> grid_form(const Sheet& sheet)
{
    const auto& rest = sheet.rest_m;
    if (rest.size() < 9 || !sheet.threads.empty()) {
        return std::nullopt;
    }
    const glm::vec3 along = rest[1] - rest[0];
    const float spacing_m = glm::length(along);
    const auto is_in_row = [&](size_t i) {
        return glm::distance(rest[i], rest[0] + static_cast<float>(i) * along) <= 1e-3F * spacing_m;
    };
    size_t columns = 1;
    while (columns < rest.size() && is_in_row(columns)) {
        ++columns;
    }
    const size_t rows = rest.size() / columns;
    if (!(spacing_m > 0.0F) || columns < 3 || rows < 3 || rows * columns != rest.size() ||
        sheet.triangles.size() != 2 * (columns - 1) * (rows - 1)) {
        return std::nullopt;
    }
    const glm::vec3 across = rest[columns] - rest[0];
    const float across_m = glm::length(across);
    const float tolerance_m = 1e-3F * std::min(spacing_m, across_m);
    if (std::abs(glm::dot(along, across)) > 1e-3F * spacing_m * across_m) {
        return std::nullopt;
    }
    for (size_t i = 0; i < rest.size(); ++i) {
        const glm::vec2 at(i % columns, i / columns);
        if (!(glm::distance(rest[i], rest[0] + at.x * along + at.y * across) <= tolerance_m)) {
            return std::nullopt;
        }
    }
    for (const glm::uvec3& triangle : sheet.triangles) {
        const glm::uvec3 column = triangle % static_cast<uint32_t>(columns);
        const glm::uvec3 row = triangle / static_cast<uint32_t>(columns);
        const auto spread = [](const glm::uvec3& n) {
            return std::max({n.x, n.y, n.z}) - std::min({n.x, n.y, n.z});
        };
        if (spread(column) != 1 || spread(row) != 1) {
            return std::nullopt;
        }
    }
    const glm::uvec3& first = sheet.triangles.front();
    const glm::vec3 area = glm::cross(rest[first.y] - rest[first.x], rest[first.z] - rest[first.x]);
    return GridForm{.columns = static_cast<uint32_t>(columns),
                    .rows = static_cast<uint32_t>(rows),
                    .spacing_m = {spacing_m, across_m},
                    .winding = glm::dot(area, glm::cross(along, across)) >= 0.0F ? 1.0F : -1.0F};
}

} // namespace estampe::cloth
