// SPDX-License-Identifier: MIT
#include "viewpoints.hpp"

#include <algorithm>

namespace temple {
namespace {

constexpr float eye_height_m = 1.7F;

class Finder {
public:
    explicit Finder(const estampe::Terrain& desert) : desert_(desert) {}

    [[nodiscard]] float ground_m(const glm::vec2& place) const
    {
        return static_cast<float>(desert_.sample(place.x, place.y).height_m);
    }

    /// On the sand, so high over it.
    void outside(const char* name, const glm::vec2& eye, float over_m, const glm::vec3& target, float fov_deg)
    {
        all_.push_back({name, {eye.x, ground_m(eye) + over_m, eye.y}, target, fov_deg});
    }

    /// The highest place thereabouts.
    [[nodiscard]] glm::vec2 crest_near(const glm::vec2& place) const
    {
        constexpr int steps = 8;
        constexpr float step_m = 5.0F;
        glm::vec2 best = place;
        for (int z = -steps; z <= steps; ++z) {
            for (int x = -steps; x <= steps; ++x) {
                const glm::vec2 other = place + step_m * glm::vec2(x, z);
                best = ground_m(other) > ground_m(best) ? other : best;
            }
        }
        return best;
    }

    void inside(const char* name, const glm::vec2& eye, const glm::vec2& target, float target_m,
                float fov_deg)
    {
        all_.push_back({name,
                        {eye.x, floor_m + eye_height_m, eye.y},
                        {target.x, floor_m + target_m, target.y},
                        fov_deg});
    }

    [[nodiscard]] std::vector<Viewpoint> take() { return std::move(all_); }

private:
    const estampe::Terrain& desert_;
    std::vector<Viewpoint> all_;
};

/// The largest room of a kind, or the entrance.
int largest(const Plan& plan, RoomKind kind)
{
    int best = 0;
    float best_m2 = 0.0F;
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        const Room& room = plan.rooms[i];
        const glm::vec2 size = room.high_m() - room.low_m();
        if (room.kind == kind && size.x * size.y > best_m2) {
            best = static_cast<int>(i);
            best_m2 = size.x * size.y;
        }
    }
    return best;
}

/// From near one end of a room along its length.
void look_along(Finder& finder, const char* name, const Room& room, float aside_m, float fov_deg)
{
    const glm::vec2 half = 0.5F * (room.high_m() - room.low_m());
    const glm::vec2 middle = room.middle_m();
    const bool is_along_x = half.x >= half.y;
    const glm::vec2 along = is_along_x ? glm::vec2(half.x - 1.1F, 0.0F) : glm::vec2(0.0F, half.y - 1.1F);
    const glm::vec2 aside = is_along_x ? glm::vec2(0.0F, aside_m) : glm::vec2(aside_m, 0.0F);
    finder.inside(name, middle + along + aside, middle - along - 0.4F * aside, 0.42F * room.height_m,
                  fov_deg);
}

} // namespace

std::vector<Viewpoint> find_viewpoints(const Plan& plan, const Site& site, const estampe::Terrain& desert)
{
    Finder finder(desert);
    finder.outside("arrival", finder.crest_near({-84.0F, 118.0F}), 2.2F, {2.0F, 5.0F, -4.0F}, 27.0F);
    finder.outside("avenue", {-1.2F, 80.0F}, 2.0F, {0.6F, 5.0F, 27.0F}, 42.0F);
    finder.outside("gate", {5.0F, 45.0F}, 1.7F, {-3.6F, 6.6F, court_south_m}, 58.0F);
    finder.outside("court", {1.5F, 22.0F}, 3.4F, {-1.8F, 4.6F, -20.0F}, 50.0F);
    finder.outside("arcade", {court_west_m - 3.2F, 20.0F}, 1.7F, {court_west_m - 2.2F, 2.9F, -20.0F}, 54.0F);
    finder.outside("shadows", {-11.0F, -13.5F}, 2.6F, {16.0F, 2.4F, 8.0F}, 54.0F);
    const glm::vec2 giant = site.colossus_m;
    finder.outside("colossus", giant + glm::vec2(6.0F, 33.0F), 1.6F, {giant.x + 1.5F, 6.2F, giant.y}, 44.0F);
    finder.outside("tower", {-50.0F, -98.0F}, 3.0F, {18.0F, 9.0F, -68.0F}, 46.0F);

    const Room& entrance = plan.rooms.front();
    finder.inside("threshold", entrance.middle_m() + glm::vec2(-0.6F, -4.9F),
                  plan.doors.front().place_m + glm::vec2(0.7F, 0.0F), 2.3F, 58.0F);
    look_along(finder, "hall", plan.rooms[static_cast<size_t>(largest(plan, RoomKind::hall))], 0.0F, 56.0F);
    look_along(finder, "corridor", plan.rooms[static_cast<size_t>(largest(plan, RoomKind::corridor))], 0.9F,
               60.0F);
    look_along(finder, "last hall", plan.rooms[static_cast<size_t>(plan.last_room)], 0.0F, 60.0F);
    return finder.take();
}

} // namespace temple
