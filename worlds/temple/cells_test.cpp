// SPDX-License-Identifier: MIT
// The temple's cells and portals show every stone that a ray from the eye hits.
#include <algorithm>
#include <random>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "support/embree_scene.hpp"
#include "techniques/cells/cells.hpp"
#include "temple/prison.hpp"
#include "temple/temple.hpp"

namespace temple {
namespace {

estampe::cells::Eye eye_at(const glm::dvec3& place, const glm::dvec3& ahead)
{
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0;
    clip[1][1] = -1.0;
    clip[2][3] = -1.0;
    clip[3][2] = 0.1;
    const glm::dmat4 from_world = glm::lookAt(glm::dvec3(0.0), ahead, {0.0, 1.0, 0.0});
    return *estampe::cells::eye_of(glm::mat4(clip * from_world), place, {640, 640});
}

/// Returns the first place at which a ray hits the front of a surface.
std::optional<glm::dvec3> first_front(const estampe::test::EmbreeScene& stone, const estampe::Scene& scene,
                                      glm::dvec3 from, const glm::dvec3& direction)
{
    for (int hits = 0; hits < 60; ++hits) {
        const auto hit = stone.first_hit(from, direction);
        if (!hit) {
            return std::nullopt;
        }
        const glm::dvec3 place = from + hit->distance_m * direction;
        if (glm::dot(hit->normal, direction) < 0.0 ||
            scene.materials[hit->primitive->material].double_sided) {
            return place;
        }
        from = place + 1e-4 * direction;
    }
    return std::nullopt;
}

/// A place for an eye: in a room, in a doorway, in front of the prison, or over its roofs. The place is not
/// in a wall or pier.
template <typename Between>
glm::dvec3 random_eye(const Plan& plan, int look, const Between& between)
{
    if (look % 4 == 0) {
        return {between(-26.0, 26.0), floor_m + between(0.3, 4.0), between(-24.0, 20.0)};
    }
    if (look % 8 == 1) {
        return {between(-30.0, 30.0), floor_m + between(12.0, 16.0), between(-70.0, -20.0)};
    }
    if (look % 4 == 1) {
        const Door& door = plan.doors[static_cast<size_t>(look / 4) % plan.doors.size()];
        const auto wall = std::ranges::find_if(
            plan.walls, [&](const WallRun& run) { return run.door && &plan.doors[*run.door] == &door; });
        const glm::dvec2 along = wall->is_along_x ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, 1.0);
        const glm::dvec2 place = glm::dvec2(door.place_m) +
                                 between(-0.7, 0.7) * static_cast<double>(door.half_m) * along +
                                 between(-1.0, 1.0) * glm::dvec2(along.y, along.x);
        return {place.x, floor_m + between(0.3, 1.9), place.y};
    }
    const Room& room = plan.rooms[static_cast<size_t>(look) % plan.rooms.size()];
    constexpr float from_wall_m = 0.9F; // piers stand 0.7 m into rooms, and the near plane is 0.18 m away
    const glm::vec2 low = room.low_m() + from_wall_m;
    const glm::vec2 high = room.high_m() - from_wall_m;
    return {between(low.x, high.x), floor_m + between(0.3, 3.0), between(low.y, high.y)};
}

TEST(TempleCells, ShowAllStonesThatRaysHit)
{
    size_t seen_rooms = 0;
    size_t rooms = 0;
    for (const uint64_t seed : {1U, 2U, 3U, 11U}) {
        const Plan plan = make_plan(seed);
        const estampe::Scene scene = build_temple(seed);
        ASSERT_GT(scene.cells.size(), 8U);
        ASSERT_GE(scene.portals.size(), scene.cells.size()) << "each room has a door";
        estampe::cells::check_cells(scene);
        const estampe::test::EmbreeScene stone(scene, 0.0);
        std::mt19937 chance(static_cast<uint32_t>(seed));
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(chance);
        };
        for (int look = 0; look < 300; ++look) {
            const glm::dvec3 eye = random_eye(plan, look, between);
            const glm::dvec3 ahead =
                glm::normalize(glm::dvec3(between(-1.0, 1.0), between(-0.6, 0.3), between(-1.0, 1.0)));
            const estampe::cells::Eye seen_by = eye_at(eye, ahead);
            estampe::cells::SeenCells seen;
            seen.find(scene.cells, scene.portals, seen_by);
            for (estampe::Index cell = 0; cell < scene.cells.size(); ++cell) {
                seen_rooms += seen.is_seen(cell) ? 1 : 0;
            }
            rooms += scene.cells.size();
            const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)));
            const glm::dvec3 up = glm::cross(right, ahead);
            std::vector<std::optional<estampe::Bounds>> hits;
            for (int ray = 0; ray < 400; ++ray) {
                const glm::dvec3 direction =
                    glm::normalize(ahead + between(-1.0, 1.0) * right + between(-1.0, 1.0) * up);
                // Surfaces before the near plane are not drawn.
                const auto hit =
                    first_front(stone, scene, eye + 0.1 / glm::dot(direction, ahead) * direction, direction);
                if (hit) {
                    hits.emplace_back(estampe::Bounds{*hit, *hit});
                }
            }
            std::vector<uint32_t> bits;
            estampe::cells::CellsOfClusters(scene.cells, hits).find_seen(seen_by, seen, bits);
            for (size_t i = 0; i < hits.size(); ++i) {
                ASSERT_TRUE(bits[i / 32] >> i % 32 & 1U)
                    << "seed " << seed << ", from " << eye.x << ", " << eye.y << ", " << eye.z << " at "
                    << hits[i]->min.x << ", " << hits[i]->min.y << ", " << hits[i]->min.z;
            }
        }
    }
    RecordProperty("rooms_in_sight_percent", fmt::format("{:.1f}", 100.0 * static_cast<double>(seen_rooms) /
                                                                       static_cast<double>(rooms)));
    EXPECT_LT(seen_rooms, rooms / 3) << "walls hide most rooms";
}

} // namespace
} // namespace temple
