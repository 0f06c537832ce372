// SPDX-License-Identifier: MIT
#include "features/shadows/sun_casters.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace estampe::features {
namespace {

/// Where a draw is at rest; empty where that is not known.
Bounds place_of(const pose::MeshData& layout, const Scene& scene, const ScenePose& rest, uint32_t draw)
{
    const pose::DrawSource& source = layout.sources[draw];
    const auto& instances = scene.nodes[source.node].instances;
    glm::dmat4 place = rest.world_from_node[source.node];
    if (!instances.empty()) {
        place = place * glm::dmat4(instances[source.instance]);
    }
    Bounds bounds;
    const Bounds& local = source.local_bounds;
    for (int i = 0; i < 8 && !local.empty(); ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? local.max.x : local.min.x,
                                (i & 2) != 0 ? local.max.y : local.min.y,
                                (i & 4) != 0 ? local.max.z : local.min.z);
        bounds.extend(glm::dvec3(place * glm::dvec4(corner, 1.0)));
    }
    return bounds;
}

/// Whether a box is within a piece as the sun sees both, or next to it.
bool is_within(const Bounds& place, const glm::dvec3& anchor, const shadow::Clipmap& clipmap,
               const shadow::Piece& piece)
{
    constexpr double beside_texels = 2.0;
    const double texel_m = std::ldexp(clipmap.finest_m, static_cast<int>(piece.level));
    const glm::dvec3 middle = 0.5 * (place.min + place.max) - anchor;
    const glm::dvec3 half = 0.5 * (place.max - place.min);
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec3 along(axis == 0 ? clipmap.view.right : clipmap.view.down);
        const double at = glm::dot(along, middle) / texel_m;
        const double reach = glm::dot(glm::abs(along), half) / texel_m + beside_texels;
        const double low = piece.low[axis];
        if (at + reach < low || at - reach > low + static_cast<double>(piece.size[axis])) {
            return false;
        }
    }
    return true;
}

} // namespace

std::vector<StillCaster> still_casters(const pose::MeshData& layout, const Scene& scene)
{
    const ScenePose rest = pose_scene(scene, 0.0); // of what never moves, at any time
    std::vector<StillCaster> casters;
    for (const pose::CasterRun& run : layout.casters) {
        const uint32_t end = run.range.first + run.range.count;
        for (uint32_t triangle = run.range.first; triangle < end && !run.moves;) {
            const uint32_t draw = layout.triangles[triangle].w & shared::triangle_draw_mask;
            StillCaster caster{.range = {.first = triangle, .plain = run.range.plain},
                               .place = place_of(layout, scene, rest, draw),
                               .masked = run.masked,
                               .groups = run.groups};
            while (triangle < end && (layout.triangles[triangle].w & shared::triangle_draw_mask) == draw) {
                ++triangle;
            }
            caster.range.count = triangle - caster.range.first;
            casters.push_back(caster);
        }
    }
    return casters;
}

void add_casters_within(const shadow::Piece& piece, const shadow::Clipmap& clipmap, const glm::dvec3& anchor,
                        std::span<const StillCaster> still, Groups groups, size_t most,
                        std::vector<raster::Batch>& batches)
{
    const size_t first = batches.size();
    std::vector<bool> bars; // of each batch: not all before it is a caster that the piece does not show
    uint32_t passed_triangles = 0; // of such casters, since the last that it shows
    for (const StillCaster& caster : still) {
        if (!caster.place.empty() && !is_within(caster.place, anchor, clipmap, piece)) {
            passed_triangles += caster.range.count;
            continue;
        }
        if ((caster.groups & groups) == 0) {
            continue;
        }
        const bool goes_on =
            batches.size() > first && batches.back().masked == caster.masked &&
            batches.back().groups == caster.groups &&
            batches.back().first_triangle + batches.back().triangle_count == caster.range.first;
        if (goes_on) {
            batches.back().triangle_count += caster.range.count;
            batches.back().plain = batches.back().plain && caster.range.plain;
        } else {
            const uint32_t end =
                bars.empty() ? 0 : batches.back().first_triangle + batches.back().triangle_count;
            bars.push_back(caster.range.first - end != passed_triangles);
            batches.push_back({.first_triangle = caster.range.first,
                               .triangle_count = caster.range.count,
                               .masked = caster.masked,
                               .plain = caster.range.plain,
                               .groups = caster.groups});
        }
        passed_triangles = 0;
    }
    const auto gap_before = [&](size_t i) {
        const raster::Batch& before = batches[i - 1];
        const bool is_one_kind =
            before.masked == batches[i].masked && before.groups == batches[i].groups && !bars[i - first];
        return is_one_kind ? batches[i].first_triangle - before.first_triangle - before.triangle_count : ~0U;
    };
    while (batches.size() > first + most) {
        size_t shortest = first + 1;
        for (size_t i = first + 2; i < batches.size(); ++i) {
            shortest = gap_before(i) < gap_before(shortest) ? i : shortest;
        }
        if (gap_before(shortest) == ~0U) {
            return;
        }
        batches[shortest - 1].triangle_count += gap_before(shortest) + batches[shortest].triangle_count;
        batches[shortest - 1].plain = batches[shortest - 1].plain && batches[shortest].plain;
        batches.erase(batches.begin() + static_cast<std::ptrdiff_t>(shortest));
        bars.erase(bars.begin() + static_cast<std::ptrdiff_t>(shortest - first));
    }
}

} // namespace estampe::features
