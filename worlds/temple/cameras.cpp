// SPDX-License-Identifier: MIT
#include "cameras.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plan.hpp"
#include "site.hpp"
#include "visit.hpp"

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

    /// Adds a viewpoint outside the prison, with the eye `over_m` above the sand.
    void outside(const char* name, const glm::vec2& eye, float over_m, const glm::vec3& target, float fov_deg)
    {
        all_.push_back({name, {eye.x, ground_m(eye) + over_m, eye.y}, target, fov_deg});
    }

    /// Returns the highest point of the sand near `place`.
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

/// Returns the largest room of a kind, or the entrance if there is none.
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

/// Adds a viewpoint near one end of a room, from which the camera looks along the room's length.
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

namespace {

constexpr double over_ground_m = 1.68;
constexpr double spacing_m = 0.25;
constexpr double keys_a_s = 10.0;
constexpr double held_s = 6.5; ///< Part of the film's minute during which the camera stands in the last hall

/// Smooths a list of values with a bell-shaped kernel. The first and the last value do not change.
template <typename Value>
std::vector<Value> smoothed(const std::vector<Value>& values, double width)
{
    const int reach = static_cast<int>(std::ceil(2.5 * width));
    const int count = static_cast<int>(values.size());
    std::vector<Value> result;
    result.reserve(values.size());
    for (int i = 0; i < count; ++i) {
        // The kernel's window is symmetric, so that values near the ends are not shifted along the list.
        const int most = std::min({reach, i, count - 1 - i});
        Value sum = values[static_cast<size_t>(i)];
        double weights = 1.0;
        for (int k = 1; k <= most; ++k) {
            const double weight = std::exp(-0.5 * k * k / (width * width));
            sum += weight * (values[static_cast<size_t>(i - k)] + values[static_cast<size_t>(i + k)]);
            weights += 2.0 * weight;
        }
        result.push_back(sum / weights);
    }
    return result;
}

/// Resamples the camera's path at equal spacing.
std::vector<glm::dvec3> resampled(const std::vector<glm::dvec3>& way)
{
    std::vector<glm::dvec3> even{way.front()};
    double left_m = spacing_m;
    for (size_t i = 0; i + 1 < way.size(); ++i) {
        const double length_m = glm::distance(way[i], way[i + 1]);
        double at_m = left_m;
        for (; at_m <= length_m; at_m += spacing_m) {
            even.push_back(glm::mix(way[i], way[i + 1], at_m / length_m));
        }
        left_m = at_m - length_m;
    }
    even.push_back(way.back());
    return even;
}

/// Smooths the camera's path: straightens it where there is room, and rounds its turns.
void relax(std::vector<glm::dvec3>& way, const walk::Chart& chart)
{
    constexpr int rounds = 400;
    constexpr double wanted_m = 0.75;
    for (int round = 0; round < rounds; ++round) {
        for (size_t i = 1; i + 1 < way.size(); ++i) {
            const glm::dvec3 middle = 0.5 * (way[i - 1] + way[i + 1]);
            const glm::dvec2 there(middle.x, middle.z);
            const double room_m = chart.room_m(there);
            if (room_m >= std::min(wanted_m, chart.room_m({way[i].x, way[i].z}))) {
                way[i] = glm::mix(way[i], middle, 0.5);
            }
        }
    }
}

/// Returns the square near a place that has the most room around it.
glm::dvec2 roomy(const walk::Chart& chart, const glm::dvec2& near_m)
{
    constexpr int steps = 12;
    constexpr double step_m = 0.3;
    glm::dvec2 best = near_m;
    double most = -1.0;
    for (int z = -steps; z <= steps; ++z) {
        for (int x = -steps; x <= steps; ++x) {
            const glm::dvec2 off = step_m * glm::dvec2(x, z);
            const double room_m =
                chart.reaches(near_m + off) ? chart.room_m(near_m + off) - 0.1 * glm::length(off) : -1.0;
            if (room_m > most) {
                most = room_m;
                best = near_m + off;
            }
        }
    }
    return best;
}

glm::dvec3 turned(const glm::dvec3& look, double yaw_rad)
{
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    return {c * look.x - s * look.z, look.y, s * look.x + c * look.z};
}

/// Turns each view direction of the film's camera sideways by at most 50 degrees, in steps of 2.5 degrees, to
/// where the view between the walls is free. Dynamic programming (Bellman) finds the directions of least
/// total cost. A direction costs more if an obstacle is near, if it points sideways, or if the camera must
/// turn.
void look_into_the_open(const std::vector<glm::dvec3>& eyes, std::vector<glm::dvec3>& looks,
                        const walk::Solids& solids)
{
    constexpr int most = 20; // Largest turn to one side, in steps of 2.5 degrees
    constexpr int half = 10; // Half of the field of view, in steps of 2.5 degrees
    constexpr int count = 2 * most + 1;
    constexpr int quickest = 2; // Fastest turn of the camera, in steps of 2.5 degrees per key of the path
    constexpr double aside_cost = 0.25;
    constexpr double turn_cost = 0.16;
    const double step_rad = glm::radians(2.5);
    std::vector<std::array<double, count>> costs(eyes.size());
    std::vector<std::array<int, count>> from(eyes.size());
    for (size_t i = 0; i < eyes.size(); ++i) {
        // For each direction: free distance ahead, as a share from 0 to 1.
        std::array<double, count + 2 * half> open{};
        for (size_t ray = 0; ray < open.size(); ++ray) {
            glm::dvec3 way = turned(looks[i], (static_cast<int>(ray) - most - half) * step_rad);
            for (const double rise : {-0.1, 0.2}) {
                way.y = rise;
                for (const double away_m : {3.2, 8.0}) {
                    const bool is_blocked =
                        solids.blocks(glm::vec3(eyes[i]), glm::vec3(eyes[i] + away_m * way));
                    open[ray] += is_blocked ? 0.0 : 0.25;
                }
            }
        }
        const double base_rad = i == 0 ? 0.0
                                       : std::remainder(std::atan2(looks[i].z, looks[i].x) -
                                                            std::atan2(looks[i - 1].z, looks[i - 1].x),
                                                        2.0 * std::numbers::pi);
        for (int k = 0; k < count; ++k) {
            double near = 0.0;
            for (int ray = k; ray <= k + 2 * half; ++ray) {
                near += (1.0 - open.at(static_cast<size_t>(ray))) / (2 * half + 1);
            }
            const double aside = static_cast<double>(k - most) / most;
            double least = i == 0 ? std::abs(aside) * 1e3 : 1e9;
            for (int before = std::max(k - quickest, 0); i > 0 && before <= std::min(k + quickest, count - 1);
                 ++before) {
                const double turns = base_rad / step_rad + (k - before);
                const double cost = costs[i - 1].at(static_cast<size_t>(before)) + turn_cost * turns * turns;
                if (cost < least) {
                    least = cost;
                    from[i].at(static_cast<size_t>(k)) = before;
                }
            }
            costs[i].at(static_cast<size_t>(k)) = least + near + aside_cost * aside * aside;
        }
    }
    auto k = static_cast<int>(std::ranges::min_element(costs.back()) - costs.back().begin());
    for (size_t i = eyes.size(); i-- > 0;) {
        looks[i] = turned(looks[i], (k - most) * step_rad);
        k = from[i].at(static_cast<size_t>(k));
    }
}

/// Speed of the film's camera along its path in metres per second: fast over the dunes, slow inside.
double speed_at(const glm::dvec3& place_m)
{
    const double z = place_m.z;
    const double dunes = glm::smoothstep(56.0, 84.0, z + 0.35 * std::abs(place_m.x));
    const double inside = glm::smoothstep(-8.0, -24.0, z);
    return glm::mix(glm::mix(4.0, 3.1, inside), 10.0, dunes);
}

} // namespace

Flight::Flight(const estampe::Scene& scene, uint64_t seed)
{
    const Plan plan = make_plan(seed);
    const estampe::Terrain& desert = *scene.terrain;
    const walk::Solids solids = solids_of(scene);
    const double still_s = 0.0;
    const walk::Place place(solids, sand_of(desert, still_s));
    const auto sand_m = [&](double x, double z) { return desert.sample(x, z).height_m; };
    // The film's camera starts at the viewpoint `arrival`, flies over the dunes to the avenue, and moves at
    // walking height from there on.
    const estampe::Camera arrival =
        estampe::scene_camera(scene, estampe::pose_scene(scene, 0.0, estampe::no_index), "arrival");
    const glm::dvec2 avenue_m(0.4, 62.0);
    std::vector<glm::dvec3> way{arrival.eye - glm::dvec3(0.0, over_ground_m, 0.0)};
    const glm::dvec2 crest(arrival.eye.x, arrival.eye.z);
    for (const glm::dvec2& past : {glm::mix(crest, glm::dvec2(6.0, 92.0), 0.5) + glm::dvec2(2.0, 8.0),
                                   glm::dvec2(-14.0, 93.0), glm::dvec2(-1.0, 78.0)}) {
        way.emplace_back(past.x, sand_m(past.x, past.y) + 0.9, past.y);
    }
    // The film's camera is moved like a wide person, which keeps the eye away from the obstacles that it
    // passes.
    const walk::Body body{.radius_m = 0.42F, .height_m = 2.05F};
    const walk::Chart chart(place, body, {avenue_m.x, sand_m(avenue_m.x, avenue_m.y), avenue_m.y},
                            {.low_m = {-34.0, -66.0}, .high_m = {32.0, 68.0}, .square_m = 0.25});
    const Room& last = plan.rooms[static_cast<size_t>(plan.last_room)];
    const glm::dvec2 end_m(last.middle_m());
    // x coordinate of the camera's path in the roofed walk of the western arcade.
    const double walk_x = static_cast<double>(court_west_m) - 3.1;
    const std::array<glm::dvec2, 6> stations{{avenue_m,
                                              {0.0, static_cast<double>(court_south_m)},
                                              {walk_x, 17.0},
                                              {walk_x, -9.0},
                                              {-9.0, -11.5},
                                              end_m}};
    glm::dvec2 from_m = roomy(chart, stations.front());
    for (size_t i = 1; i < stations.size(); ++i) {
        const glm::dvec2 to_m = roomy(chart, stations.at(i));
        const std::vector<glm::dvec3> leg = chart.way(from_m, to_m);
        if (!leg.empty()) { // In some temples sand fills the arcade, and there is no way through it
            way.insert(way.end(), leg.begin(), leg.end());
            from_m = to_m;
        }
    }
    way = resampled(way);
    relax(way, chart);
    way = smoothed(resampled(way), 2.0);
    // The camera's heights follow the ground, but the ground's steps are smoothed.
    std::vector<double> heights_m;
    for (const glm::dvec3& at : way) {
        const bool is_outside = at.z > static_cast<double>(court_south_m) + 8.0;
        heights_m.push_back(is_outside ? std::max(at.y, sand_m(at.x, at.z)) : at.y);
    }
    heights_m = smoothed(heights_m, 1.6 / spacing_m);
    std::vector<double> speeds;
    for (size_t i = 0; i < way.size(); ++i) {
        way[i].y = heights_m[i];
        speeds.push_back(speed_at(way[i]));
    }
    speeds = smoothed(speeds, 5.0 / spacing_m);
    // The camera starts and stops slowly.
    std::vector<double> passed_s{0.0};
    const double whole_m = spacing_m * static_cast<double>(way.size());
    for (size_t i = 1; i < way.size(); ++i) {
        const double from_begin_m = spacing_m * static_cast<double>(i);
        const double soft = std::min({1.0, 0.1 + from_begin_m / 16.0, 0.06 + (whole_m - from_begin_m) / 5.0});
        passed_s.push_back(passed_s.back() + glm::distance(way[i - 1], way[i]) / (speeds[i] * soft));
    }
    arrives_s_ = length_s - held_s;
    for (double& moment_s : passed_s) {
        moment_s *= arrives_s_ / passed_s.back();
    }
    const auto place_at = [&](double time_s) {
        const auto after = std::ranges::upper_bound(passed_s, time_s);
        if (after == passed_s.end()) {
            return way.back();
        }
        const auto i = std::max<std::ptrdiff_t>(after - passed_s.begin(), 1);
        const auto k = static_cast<size_t>(i);
        const double part = (time_s - passed_s[k - 1]) / std::max(passed_s[k] - passed_s[k - 1], 1e-9);
        return glm::mix(way[k - 1], way[k], glm::clamp(part, 0.0, 1.0));
    };
    // The camera looks at a point ahead on its path. Far from the temple the camera looks at the temple, and
    // at the end of the path the camera looks up to the opening in the roof.
    const int count = static_cast<int>(length_s * keys_a_s) + 1;
    std::vector<glm::dvec3> eyes;
    std::vector<glm::dvec3> looks;
    for (int i = 0; i < count; ++i) {
        const double time_s = i / keys_a_s;
        const glm::dvec3 feet_m = place_at(time_s);
        const glm::dvec3 eye_m = feet_m + glm::dvec3(0.0, over_ground_m, 0.0);
        glm::dvec3 ahead = place_at(time_s + 1.9) - feet_m;
        ahead.y *= 0.5;
        glm::dvec3 look = glm::length(ahead) > 0.4 ? glm::normalize(ahead) : glm::dvec3(0.0);
        if (look == glm::dvec3(0.0) && !looks.empty()) {
            look = looks.back();
        }
        const double far = glm::smoothstep(60.0, 92.0, feet_m.z + 0.2 * std::abs(feet_m.x));
        const glm::dvec3 to_temple = glm::normalize(glm::dvec3(1.0, 4.5, 2.0) - eye_m);
        look = glm::mix(look, to_temple, 0.9 * far);
        eyes.push_back(eye_m);
        looks.push_back(glm::normalize(look));
    }
    eyes = smoothed(eyes, 0.35 * keys_a_s);
    looks = smoothed(looks, 0.75 * keys_a_s);
    look_into_the_open(eyes, looks, solids);
    looks = smoothed(looks, 0.45 * keys_a_s);
    for (int i = 0; i < count; ++i) {
        const double time_s = i / keys_a_s;
        const auto k = static_cast<size_t>(i);
        glm::dvec3 look = glm::normalize(looks[k]);
        look.y += 0.22 * glm::smoothstep(arrives_s_ - 1.0, length_s - 1.0, time_s);
        const double wide = glm::smoothstep(4.0, 20.0, time_s);
        keys_.push_back(
            {eyes[k], eyes[k] + 10.0 * glm::normalize(look), glm::radians(glm::mix(34.0, 56.0, wide))});
    }
}

estampe::Camera Flight::camera(double time_s) const
{
    const double at = glm::clamp(time_s, 0.0, length_s) * keys_a_s;
    const auto i = std::min(static_cast<size_t>(at), keys_.size() - 2);
    const double t = at - static_cast<double>(i);
    const auto key = [&](size_t k) { return keys_.at(std::min(k, keys_.size() - 1)); };
    // The camera's keys are interpolated by a uniform B-spline, which has continuous acceleration and stays
    // between its keys (in their convex hull).
    const std::array<Key, 4> near{{key(i > 0 ? i - 1 : 0), key(i), key(i + 1), key(i + 2)}};
    const std::array<double, 4> weights{
        {(1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
         (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, t * t * t / 6.0}};
    estampe::Camera camera;
    camera.eye = glm::dvec3(0.0);
    camera.vertical_fov_rad = 0.0;
    camera.near_m = 0.1;
    for (size_t k = 0; k < near.size(); ++k) {
        camera.eye += weights.at(k) * near.at(k).eye_m;
        camera.target += weights.at(k) * near.at(k).target_m;
        camera.vertical_fov_rad += weights.at(k) * near.at(k).fov_rad;
    }
    return camera;
}

} // namespace temple
