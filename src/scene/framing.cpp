// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/pose.hpp"

namespace estampe {
namespace {

constexpr double azimuth_rad = 0.61;   // 35 degrees from the front, +z, towards +x
constexpr double elevation_rad = 0.31; // 18 degrees
constexpr double margin = 0.08;        // of the picture's shorter side
constexpr double shadow_room = 0.03;   // below the model, of the shorter side

/// What the outermost surfaces show to the middle of the scene, along -x, +x, -y, +y, -z, +z.
struct Walls {
    std::array<bool, 6> inward{};
    std::array<bool, 6> two_sided{};

    [[nodiscard]] bool room() const { return std::count(inward.begin(), inward.end(), true) >= 4; }
};

/// Outermost hits of a grid of rays parallel to each axis: walls of a room face inwards, a model's skin
/// outwards.
class WallProbe {
public:
    explicit WallProbe(const Bounds& bounds) : bounds_(bounds) {}

    void add(const std::array<glm::dvec3, 3>& corners, bool two_sided)
    {
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        for (int axis = 0; axis < 3; ++axis)
            if (normal[axis] != 0.0)
                add_along(axis, corners, normal, two_sided);
    }

    [[nodiscard]] Walls walls() const
    {
        Walls walls;
        for (size_t side = 0; side < 6; ++side) {
            int inward = 0;
            int two_sided = 0;
            for (const Hit& hit : hits_[side]) {
                inward += hit.inward ? 1 : 0;
                two_sided += hit.two_sided ? 1 : 0;
            }
            walls.inward[side] = inward > rays / 2;
            walls.two_sided[side] = two_sided > rays / 2;
        }
        return walls;
    }

private:
    static constexpr int grid = 3;
    static constexpr int rays = grid * grid;

    struct Hit {
        double depth = -std::numeric_limits<double>::infinity();
        bool inward = false;
        bool two_sided = false;
    };

    void add_along(int axis, const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal,
                   bool two_sided)
    {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int ray = 0; ray < rays; ++ray) {
            const int column = ray % grid;
            const int row = ray / grid;
            glm::dvec3 point = bounds_.min;
            // Uneven fractions, so that a ray does not run along the seam of a symmetrical mesh.
            point[u] += (bounds_.max[u] - bounds_.min[u]) * (0.2637 + 0.2361 * column);
            point[v] += (bounds_.max[v] - bounds_.min[v]) * (0.2753 + 0.2247 * row);
            if (!covers(corners, point, u, v))
                continue;
            const glm::dvec3 offset = corners[0] - point;
            const double depth = point[axis] + glm::dot(offset, normal) / normal[axis];
            const size_t side = 2 * static_cast<size_t>(axis);
            note(hits_[side][static_cast<size_t>(ray)], -depth, normal[axis] > 0.0, two_sided);
            note(hits_[side + 1][static_cast<size_t>(ray)], depth, normal[axis] < 0.0, two_sided);
        }
    }

    static bool covers(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point, int u, int v)
    {
        int left = 0;
        int right = 0;
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec3& a = corners[i];
            const glm::dvec3& b = corners[(i + 1) % 3];
            const double side = (b[u] - a[u]) * (point[v] - a[v]) - (b[v] - a[v]) * (point[u] - a[u]);
            left += side >= 0.0 ? 1 : 0;
            right += side <= 0.0 ? 1 : 0;
        }
        return left == 3 || right == 3;
    }

    static void note(Hit& hit, double depth, bool inward, bool two_sided)
    {
        if (depth > hit.depth)
            hit = {depth, inward, two_sided};
    }

    Bounds bounds_;
    std::array<std::array<Hit, rays>, 6> hits_{};
};

Walls probe_walls(const Scene& scene, const ScenePose& pose, const Bounds& bounds)
{
    WallProbe probe(bounds);
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        const Primitive& primitive = *posed.primitive;
        if (primitive.topology != Topology::triangles)
            return;
        const bool two_sided =
            primitive.material < scene.materials.size() && scene.materials[primitive.material].double_sided;
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const auto corner = [&](size_t k) { return posed.positions[primitive.indices[i + k]]; };
            if (posed.mirrored)
                probe.add({corner(0), corner(2), corner(1)}, two_sided);
            else
                probe.add({corner(0), corner(1), corner(2)}, two_sided);
        }
    });
    return probe.walls();
}

/// A point as the camera sees it from the origin: to the right, upwards, and away from it.
struct ViewAxes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;

    [[nodiscard]] glm::dvec3 of(const glm::dvec3& point) const
    {
        return {glm::dot(right, point), glm::dot(up, point), glm::dot(forward, point)};
    }

    [[nodiscard]] glm::dvec3 world(const glm::dvec3& v) const
    {
        return right * v.x + up * v.y + forward * v.z;
    }
};

ViewAxes look_from(double azimuth, double elevation)
{
    const glm::dvec3 forward{-std::sin(azimuth) * std::cos(elevation), -std::sin(elevation),
                             -std::cos(azimuth) * std::cos(elevation)};
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    return {right, glm::cross(right, forward), forward};
}

/// Tangents of the half angles that the model may fill.
struct Window {
    double side = 0.0;
    double top = 0.0;
    double bottom = 0.0;
};

/// The nearest eye from which every point lies in the window: each side of the window is a plane whose place
/// follows from the outermost point along its normal, so one pass over the points is exact.
glm::dvec3 fit_eye(const std::vector<glm::dvec3>& points, const Window& window)
{
    constexpr double lowest = -std::numeric_limits<double>::infinity();
    double left = lowest, right = lowest, top = lowest, bottom = lowest;
    for (const glm::dvec3& p : points) {
        right = std::max(right, p.x - window.side * p.z);
        left = std::max(left, -p.x - window.side * p.z);
        top = std::max(top, p.y - window.top * p.z);
        bottom = std::max(bottom, -p.y - window.bottom * p.z);
    }
    const double z_wide = -(left + right) / (2.0 * window.side);
    const double z_tall = -(top + bottom) / (window.top + window.bottom);
    const double z = std::min(z_wide, z_tall);
    const double lowest_y = top + window.top * z;
    const double highest_y = -bottom - window.bottom * z;
    return {0.5 * (right - left), 0.5 * (lowest_y + highest_y), z};
}

/// Moves the eye sideways until the picture's extent is in the middle of the window.
glm::dvec3 centre_eye(const std::vector<glm::dvec3>& points, const Window& window, glm::dvec3 eye)
{
    const double middle = 0.5 * (window.top - window.bottom);
    for (int round = 0; round < 4; ++round) {
        glm::dvec2 low{std::numeric_limits<double>::infinity()};
        glm::dvec2 high = -low;
        glm::dvec2 low_depth{0.0}, high_depth{0.0};
        for (const glm::dvec3& p : points) {
            const double depth = p.z - eye.z;
            for (int axis = 0; axis < 2; ++axis) {
                const double tangent = (p[axis] - eye[axis]) / depth;
                if (tangent < low[axis]) {
                    low[axis] = tangent;
                    low_depth[axis] = depth;
                }
                if (tangent > high[axis]) {
                    high[axis] = tangent;
                    high_depth[axis] = depth;
                }
            }
        }
        const glm::dvec2 wanted{0.0, middle};
        for (int axis = 0; axis < 2; ++axis)
            eye[axis] += (low[axis] + high[axis] - 2.0 * wanted[axis]) /
                         (1.0 / low_depth[axis] + 1.0 / high_depth[axis]);
    }
    return eye;
}

std::vector<glm::dvec3> view_points(const Scene& scene, const ScenePose& pose, const ViewAxes& axes,
                                    const Bounds& bounds)
{
    std::vector<glm::dvec3> points;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions)
            points.push_back(axes.of(position - bounds.center()));
    });
    return points;
}

} // namespace

Camera framing_camera(const Scene& scene, const ScenePose& pose, double aspect)
{
    Camera camera;
    const Bounds bounds = scene_bounds(scene, pose);
    if (bounds.empty())
        return camera;
    if (!(aspect > 0.0))
        aspect = 1.0;

    const Walls walls = probe_walls(scene, pose, bounds);
    constexpr size_t back = 4;
    constexpr size_t front = 5;
    const bool open_behind = walls.room() && !walls.inward[back] && walls.inward[front];
    const double turn = open_behind ? 3.141592653589793 : 0.0;
    const size_t facing = open_behind ? back : front;
    const bool cut_wall = walls.room() && walls.inward[facing] && walls.two_sided[facing];
    const bool frontal = walls.room();
    const ViewAxes axes = look_from(turn + (frontal ? 0.0 : azimuth_rad), frontal ? 0.0 : elevation_rad);

    // A wide picture keeps its sides from stretching.
    const double half_height = std::min(std::tan(0.25), 0.8 / aspect);
    const double shorter = 2.0 * half_height * std::min(1.0, aspect);
    const Window window{.side = half_height * aspect - margin * shorter,
                        .top = half_height - margin * shorter,
                        .bottom = half_height - (margin + shadow_room) * shorter};

    std::vector<glm::dvec3> points = view_points(scene, pose, axes, bounds);
    // A model without extent still stands somewhere: give it a size that arithmetic can see.
    const double least = std::max(1e-6 * glm::length(bounds.center()), 1e-9);
    if (bounds.radius() < least)
        points = {glm::dvec3(-least), glm::dvec3(least)};
    glm::dvec3 eye = centre_eye(points, window, fit_eye(points, window));

    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : points)
        nearest = std::min(nearest, point.z - eye.z);
    const double span = 2.0 * std::max(bounds.radius(), least);
    camera.eye = bounds.center() + axes.world(eye);
    camera.target = camera.eye - axes.forward * eye.z;
    camera.vertical_fov_rad = 2.0 * std::atan(half_height);
    camera.near_m = cut_wall ? nearest + 1e-3 * span : std::max(0.1 * nearest, 1e-4 * span);
    return camera;
}

} // namespace estampe
