// SPDX-License-Identifier: MIT
// Checks which cells an eye sees: by hand for two rooms with a door, and by rays for random houses.
#include "techniques/cells/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe::cells {
namespace {

struct House {
    std::vector<SceneCell> cells;
    std::vector<ScenePortal> portals;
};

constexpr glm::uvec2 page_px(320, 240);

/// A projection with reversed depth and an infinite far plane, y down, as the renderer's.
glm::mat4 clip_of(const glm::dvec3& eye, const glm::dvec3& towards, double half_width, double half_height,
                  double near_m)
{
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / half_width;
    clip[1][1] = -1.0 / half_height;
    clip[2][3] = -1.0;
    clip[3][2] = near_m;
    return glm::mat4(clip * glm::lookAt(eye, eye + towards, {0.0, 1.0, 0.0}));
}

Eye eye_at(const glm::dvec3& eye, const glm::dvec3& towards, double half_width = 1.0, double near_m = 0.01)
{
    return *eye_of(clip_of(eye, towards, half_width, 0.75 * half_width, near_m), {}, page_px);
}

/// A wall opening across z, in the plane of a z.
ScenePortal door_at_z(double z, double low_x, double high_x, double low_y, double high_y, Index from,
                      Index to)
{
    return {.corners_m = {{low_x, low_y, z}, {high_x, low_y, z}, {high_x, high_y, z}, {low_x, high_y, z}},
            .from = from,
            .to = to};
}

/// Two rooms of 4 x 3 x 4 m behind each other along -z. A door 1 m wide in the middle joins them, and another
/// leads from the second room outdoors.
House two_rooms()
{
    return {.cells = {{"front", {-2, 0, -4}, {2, 3, 0}}, {"back", {-2, 0, -8}, {2, 3, -4}}},
            .portals = {door_at_z(-4.0, -0.5, 0.5, 0.0, 2.0, 0, 1),
                        door_at_z(-8.0, -0.5, 0.5, 0.0, 2.0, 1, no_index)}};
}

std::set<Index> seen_from(const House& house, const Eye& eye)
{
    SeenCells seen;
    seen.find(house.cells, house.portals, eye);
    std::set<Index> cells;
    for (const Beam& beam : seen.beams()) {
        cells.insert(beam.cell);
    }
    return cells;
}

bool shows(const House& house, const Eye& eye, const glm::dvec3& place)
{
    SeenCells seen;
    seen.find(house.cells, house.portals, eye);
    std::vector<uint32_t> bits;
    CellsOfClusters(house.cells, {Bounds{place, place}}).find_seen(eye, seen, bits);
    return bits[0] != 0;
}

TEST(Cells, OfTwoRoomsAreSeenThroughTheDoor)
{
    const House house = two_rooms();
    using Seen = std::set<Index>;
    const glm::dvec3 into(0.0, 0.0, -1.0);
    const glm::dvec3 back(0.0, 0.0, 1.0);
    EXPECT_EQ(seen_from(house, eye_at({0, 1, -1}, into)), (Seen{0, 1, no_index})) << "both doors in line";
    EXPECT_EQ(seen_from(house, eye_at({0, 1, -1}, back)), Seen{0}) << "the door is behind the eye";
    // From x = 1.9 the line through the first door's far side at x = -0.5 reaches z = -8 at x = -3.7, and the
    // line through its near side at x = 0.5 reaches z = -8 at x = -1.37: beside the second door.
    EXPECT_EQ(seen_from(house, eye_at({1.9, 1, -1}, into, 2.0)), (Seen{0, 1}));
    EXPECT_EQ(seen_from(house, eye_at({0, 1, -9}, back)), (Seen{0, 1, no_index})) << "from outdoors";
    EXPECT_EQ(seen_from(house, eye_at({0, 1, 1}, into)), Seen{no_index})
        << "outdoors, before a wall without a door: the eye is on the wrong side of both doors";
    EXPECT_EQ(seen_from(house, eye_at({5, 1, -6}, {-1, 0, 0})), Seen{no_index});
    EXPECT_EQ(seen_from(house, eye_at({0, 1, -4}, back)), (Seen{0, 1})) << "in the doorway";
}

TEST(Cells, AreShownWithinTheDoorsEdges)
{
    const House house = two_rooms();
    const Eye eye = eye_at({0, 1, -1}, {0, 0, -1}, 2.0);
    // The door's sides at x = 0.5, 3 m ahead, let the eye see up to x = 0.5 * 6 / 3 at z = -7.
    EXPECT_TRUE(shows(house, eye, {0.98, 1, -7}));
    EXPECT_FALSE(shows(house, eye, {1.1, 1, -7}));
    EXPECT_TRUE(shows(house, eye, {-0.98, 1, -7}));
    EXPECT_FALSE(shows(house, eye, {-1.1, 1, -7}));
    // The lintel at y = 2 lets the eye see up to y = 1 + 1 * 6 / 3.
    EXPECT_TRUE(shows(house, eye, {0, 2.95, -7}));
    EXPECT_FALSE(shows(house, eye_at({0, 1.7, -1}, {0, 0, -1}, 2.0), {0, 2.5, -7}));
    EXPECT_TRUE(shows(house, eye, {1.9, 1, -3.9})) << "the eye's own room is seen as far as the page reaches";
    EXPECT_FALSE(shows(house, eye, {0, 1, -0.5})) << "behind the eye";
}

TEST(Cells, WithinTheNearPlaneAreAllSeen)
{
    const House house = two_rooms();
    // 5 cm before the wall beside the door, with a near plane that lies beyond the wall.
    const Eye eye = eye_at({1.5, 1, -3.95}, {0, 0, -1}, 1.0, 0.1);
    EXPECT_NEAR(eye.near_m, 0.1 * std::sqrt(1.0 + 1.0 + 0.75 * 0.75), 1e-6);
    EXPECT_EQ(seen_from(house, eye), (std::set<Index>{0, 1, no_index}));
    EXPECT_TRUE(shows(house, eye, {1.5, 1, -6}));
}

TEST(Cells, EyeIsFoundFromTheProjection)
{
    const glm::dvec3 place(3.0, 1.5, -20.0);
    const Eye eye = eye_at(place, {1.0, 0.2, 0.3}, 0.8);
    EXPECT_LT(glm::length(eye.place_m - place), 1e-4);
    EXPECT_NEAR(eye.margin, 0.8 / page_px.x, 1e-5) << "half a pixel at 1 m";
    glm::mat4 parallel(1.0F);
    EXPECT_FALSE(eye_of(parallel, {}, page_px));
}

TEST(Cells, AreCheckedWhenASceneIsLoaded)
{
    const auto message = [](const auto& change) {
        const House house = two_rooms();
        Scene scene;
        scene.cells = house.cells;
        scene.portals = house.portals;
        change(scene);
        try {
            check_cells(scene);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message([](Scene&) {}), "");
    EXPECT_NE(message([](Scene& scene) { scene.cells[1].high_m.y = -1.0; }).find("cell 1"),
              std::string::npos);
    EXPECT_NE(message([](Scene& scene) { scene.portals[0].corners_m.resize(2); }).find("2 corners"),
              std::string::npos);
    EXPECT_NE(message([](Scene& scene) { scene.portals[1].from = 7; }).find("cell 7"), std::string::npos);
    EXPECT_NE(message([](Scene& scene) { scene.portals[1].to = 1; }).find("same cell"), std::string::npos);
    EXPECT_NE(message([](Scene& scene) { scene.portals[0].corners_m[2].z += 0.5; }).find("not flat"),
              std::string::npos);
    EXPECT_NE(
        message([](Scene& scene) { scene.portals[0].corners_m.assign(4, glm::dvec3(1.0)); }).find("no area"),
        std::string::npos);
    EXPECT_NE(message([](Scene& scene) {
                  scene.portals[0].corners_m[0].x = std::numeric_limits<double>::quiet_NaN();
              }).find("no area"),
              std::string::npos);
}

/// A house of rooms in a grid, of which some are missing. Openings lie at random places of walls, floors and
/// roofs that are chosen at random.
class RandomHouse {
public:
    explicit RandomHouse(uint32_t seed) : random_(seed)
    {
        for (int axis = 0; axis < 3; ++axis) {
            planes_[axis].push_back(0.0);
            for (int i = 0; i < size[axis]; ++i) {
                planes_[axis].push_back(planes_[axis].back() + between(2.0, 6.0));
            }
        }
        cell_of_.assign(static_cast<size_t>(size.x) * size.y * size.z, no_index);
        for (int i = 0; i < size.x * size.y * size.z; ++i) {
            if (between(0.0, 1.0) < 0.8) {
                const glm::ivec3 at(i % size.x, i / size.x % size.y, i / (size.x * size.y));
                cell_of_[static_cast<size_t>(i)] = static_cast<Index>(house.cells.size());
                house.cells.push_back({"room", corner(at), corner(at + 1)});
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 at(0);
            for (at.z = 0; at.z <= size.z - (axis == 2 ? 0 : 1); ++at.z) {
                for (at.y = 0; at.y <= size.y - (axis == 1 ? 0 : 1); ++at.y) {
                    for (at.x = 0; at.x <= size.x - (axis == 0 ? 0 : 1); ++at.x) {
                        open(axis, at);
                    }
                }
            }
        }
    }

    double between(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

    [[nodiscard]] Index cell_at(const glm::dvec3& place) const
    {
        glm::ivec3 at;
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] = -1;
            for (const double plane : planes_[axis]) {
                at[axis] += place[axis] >= plane ? 1 : 0;
            }
        }
        return cell_in(at);
    }

    /// Follows a ray from opening to opening; calls `visit` for each cell and a place in it.
    template <typename Visit>
    void follow(glm::dvec3 from, const glm::dvec3& direction, const Visit& visit) const
    {
        Index cell = cell_at(from);
        double passed = 0.0;
        visit(cell, from);
        for (int step = 0; step < 40; ++step) {
            // The next place where the ray crosses a plane of the grid.
            double nearest = std::numeric_limits<double>::infinity();
            for (int axis = 0; axis < 3; ++axis) {
                for (const double plane : planes_[axis]) {
                    const double t = (plane - from[axis]) / direction[axis];
                    nearest = t > passed + 1e-9 ? std::min(nearest, t) : nearest;
                }
            }
            if (!std::isfinite(nearest)) {
                return;
            }
            visit(cell, from + 0.5 * (passed + nearest) * direction);
            passed = nearest;
            const glm::dvec3 crossing = from + nearest * direction;
            const Index next = cell_at(from + (nearest + 1e-7) * direction);
            if (next != cell && !is_open(crossing)) {
                return;
            }
            cell = next;
        }
    }

    House house;

private:
    static constexpr glm::ivec3 size{4, 2, 4};

    [[nodiscard]] glm::dvec3 corner(const glm::ivec3& at) const
    {
        return {planes_[0][static_cast<size_t>(at.x)], planes_[1][static_cast<size_t>(at.y)],
                planes_[2][static_cast<size_t>(at.z)]};
    }

    [[nodiscard]] Index cell_in(const glm::ivec3& at) const
    {
        if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, size))) {
            return no_index;
        }
        return cell_of_[static_cast<size_t>(at.x + size.x * (at.y + size.y * at.z))];
    }

    void open(int axis, const glm::ivec3& at)
    {
        glm::ivec3 before = at;
        --before[axis];
        const Index from = cell_in(before);
        const Index to = cell_in(at);
        if (from == to || between(0.0, 1.0) > 0.45) {
            return;
        }
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        glm::ivec3 beyond = at + 1;
        beyond[axis] = at[axis];
        const glm::dvec3 low = corner(at);
        const glm::dvec3 high = corner(beyond);
        glm::dvec3 first = low;
        glm::dvec3 last = low;
        for (const int side : {u, v}) {
            const double a = between(0.0, 0.8);
            first[side] = glm::mix(low[side], high[side], a);
            last[side] = glm::mix(low[side], high[side], between(a + 0.05, 1.0));
        }
        ScenePortal portal{.corners_m = {first, first, last, last}, .from = from, .to = to};
        portal.corners_m[1][u] = last[u];
        portal.corners_m[3][u] = first[u];
        house.portals.push_back(portal);
    }

    /// Whether a place on a plane of the grid lies in an opening.
    [[nodiscard]] bool is_open(const glm::dvec3& place) const
    {
        for (const ScenePortal& portal : house.portals) {
            const glm::dvec3& low = portal.corners_m[0];
            const glm::dvec3& high = portal.corners_m[2];
            if (glm::all(glm::greaterThanEqual(place, low - 1e-9)) &&
                glm::all(glm::lessThanEqual(place, high + 1e-9))) {
                return true;
            }
        }
        return false;
    }

    std::mt19937 random_;
    std::vector<double> planes_[3];
    std::vector<Index> cell_of_;
};

/// Cells that were found visible, and cells that rays reached, in a number of looks.
struct Count {
    size_t found = 0;
    size_t reached = 0;
    size_t all = 0;

    [[nodiscard]] double needless() const
    {
        return 1.0 - static_cast<double>(reached) / static_cast<double>(found);
    }
};

TEST(Cells, LeaveOutNothingThatARayReaches)
{
    Count indoors;
    Count outdoors;
    for (uint32_t seed = 0; seed < 60; ++seed) {
        RandomHouse random(seed);
        const House& house = random.house;
        for (int look = 0; look < 12; ++look) {
            // In most looks the eye is in a room.
            glm::dvec3 place(random.between(-3.0, 19.0), random.between(-1.0, 10.0),
                             random.between(-3.0, 19.0));
            if (look % 4 != 0) {
                const SceneCell& room = house.cells[static_cast<size_t>(look) % house.cells.size()];
                place = glm::mix(room.low_m, room.high_m, random.between(0.02, 0.98));
            }
            const glm::dvec3 ahead = glm::normalize(
                glm::dvec3(random.between(-1.0, 1.0), random.between(-0.7, 0.7), random.between(-1.0, 1.0)));
            const double half_width = random.between(0.3, 1.5);
            const Eye eye = eye_at(place, ahead, half_width);
            SeenCells seen;
            seen.find(house.cells, house.portals, eye);
            ASSERT_LT(seen.beams().size(), 512U);
            const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)));
            const glm::dvec3 up = glm::cross(right, ahead);
            std::set<Index> reached;
            for (int ray = 0; ray < 4000; ++ray) {
                const glm::dvec3 direction = ahead + half_width * random.between(-1.0, 1.0) * right +
                                             0.75 * half_width * random.between(-1.0, 1.0) * up;
                random.follow(place, direction, [&](Index cell, const glm::dvec3& at) {
                    const bool is_shown = std::ranges::any_of(seen.beams(), [&](const Beam& beam) {
                        return beam.cell == cell && may_show(eye, beam, {at, at});
                    });
                    ASSERT_TRUE(is_shown) << "house " << seed << ", look " << look << ", cell " << cell;
                    reached.insert(cell);
                });
                ASSERT_FALSE(HasFatalFailure());
            }
            std::set<Index> found;
            for (const Beam& beam : seen.beams()) {
                found.insert(beam.cell);
            }
            Count& count = found.contains(no_index) ? outdoors : indoors;
            count.found += found.size();
            count.reached += reached.size();
            count.all += house.cells.size() + 1;
        }
    }
    RecordProperty("needless_indoors_percent", fmt::format("{:.2f}", 100.0 * indoors.needless()));
    RecordProperty("needless_outdoors_percent", fmt::format("{:.2f}", 100.0 * outdoors.needless()));
    // Rays miss openings that are small on the page. Outdoors, rooms do not hide the openings behind them.
    EXPECT_LT(indoors.needless(), 0.03);
    EXPECT_LT(outdoors.needless(), 0.2);
    EXPECT_LT(indoors.found + outdoors.found, (indoors.all + outdoors.all) / 5) << "most rooms are hidden";
}

TEST(Cells, HoldTheClustersThatTouchThem)
{
    const House house = two_rooms();
    const std::vector<std::optional<Bounds>> boxes{
        Bounds{{-1, 0.1, -3}, {1, 1, -2}},          // 0: in the front room
        Bounds{{-1, 0.1, -7}, {1, 1, -6}},          // 1: in the back room
        Bounds{{-1.9, 0.1, -4.1}, {-1, 2.9, -3.9}}, // 2: in the wall between them
        Bounds{{-1, 0, -20}, {1, 1, -19}},          // 3: outdoors, behind
        Bounds{{-1, 2.9, -7}, {1, 3.1, -6}},        // 4: roof of the back room
        std::nullopt,                               // 5: may move
    };
    const CellsOfClusters clusters(house.cells, boxes);
    const auto drawn = [&](const Eye& eye) {
        SeenCells seen;
        seen.find(house.cells, house.portals, eye);
        std::vector<uint32_t> bits;
        clusters.find_seen(eye, seen, bits);
        return bits.at(0);
    };
    const glm::dvec3 into(0.0, 0.0, -1.0);
    EXPECT_EQ(drawn(eye_at({0, 1, -1}, into, 2.0)), 0b111111U) << "the roof hangs over the beam";
    EXPECT_EQ(drawn(eye_at({1.9, 1, -0.5}, into, 2.0)), 0b110111U);
    EXPECT_EQ(drawn(eye_at({0, 1, -1}, {0, 0, 1}, 2.0)), 0b100000U) << "nothing is behind the eye";
    EXPECT_EQ(drawn(eye_at({-1.5, 1, -5}, {0, 0, 1}, 0.5)), 0b100100U) << "the wall from its other side";
    EXPECT_EQ(drawn(eye_at({0, 9, 12}, {0, -0.2, -1}, 1.0)), 0b111000U)
        << "from outdoors: what is outdoors, and the roof";
}

} // namespace
} // namespace estampe::cells
