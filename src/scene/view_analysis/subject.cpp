// SPDX-License-Identifier: MIT
#include "scene/view_analysis/subject.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/pose.hpp"

namespace estampe {
namespace {

constexpr uint32_t side_cells = 16;
constexpr uint32_t cell_count = side_cells * side_cells * side_cells;
constexpr uint32_t outside = cell_count;

struct StrayCell {
    Bounds bounds;
    double vertices = 0.0;
    double area_m2 = 0.0;
};

/// A part of the scene that no triangle connects to other parts, and that is not close to them.
struct Part {
    Bounds bounds;
    double vertices = 0.0;
    double area_m2 = 0.0;

    void add(const Bounds& other_bounds, double other_vertices, double other_area_m2)
    {
        bounds.extend(other_bounds.min);
        bounds.extend(other_bounds.max);
        vertices += other_vertices;
        area_m2 += other_area_m2;
    }
};

/// A grid of cubes over the scene. The grid records which cubes contain vertices, and which cubes are
/// connected.
class Grid {
public:
    explicit Grid(const Bounds& whole) : whole_(whole), cells_(cell_count), parents_(cell_count)
    {
        const glm::dvec3 size = whole.max - whole.min;
        side_m_ = std::max({size.x, size.y, size.z}) / side_cells;
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    void add(const PosedPrimitive& posed)
    {
        cell_of_.clear();
        for (const glm::dvec3& position : posed.positions) {
            const uint32_t cell = cell_at(position);
            cell_of_.push_back(cell);
            if (cell != outside) {
                cells_[cell].bounds.extend(position);
                cells_[cell].vertices += 1.0;
            }
        }
        const std::vector<uint32_t>& indices = posed.primitive->indices;
        if (posed.primitive->topology == Topology::triangles) {
            for (size_t i = 0; i + 2 < indices.size(); i += 3)
                add_triangle(posed, indices[i], indices[i + 1], indices[i + 2]);
        } else if (posed.primitive->topology == Topology::lines) {
            for (size_t i = 0; i + 1 < indices.size(); i += 2)
                join(cell_of_[indices[i]], cell_of_[indices[i + 1]]);
        }
    }

    /// Returns the connected parts of the scene. Cubes are connected by triangles or as neighbours. Parts
    /// whose boxes intersect are merged.
    [[nodiscard]] std::vector<Part> parts()
    {
        join_neighbours();
        std::vector<Part> by_root(cell_count);
        for (uint32_t i = 0; i < cell_count; ++i) {
            if (cells_[i].vertices > 0.0)
                by_root[root(i)].add(cells_[i].bounds, cells_[i].vertices, cells_[i].area_m2);
        }
        std::vector<Part> parts;
        for (const Part& part : by_root) {
            if (part.vertices > 0.0)
                merge_into(parts, part);
        }
        return parts;
    }

private:
    [[nodiscard]] uint32_t cell_at(const glm::dvec3& position) const
    {
        if (!holds(whole_, position))
            return outside;
        const glm::dvec3 place = (position - whole_.min) / side_m_;
        const glm::uvec3 cell = glm::min(glm::uvec3(place), glm::uvec3(side_cells - 1));
        return (cell.z * side_cells + cell.y) * side_cells + cell.x;
    }

    uint32_t root(uint32_t cell)
    {
        while (parents_[cell] != cell) {
            parents_[cell] = parents_[parents_[cell]];
            cell = parents_[cell];
        }
        return cell;
    }

    void join(uint32_t a, uint32_t b)
    {
        if (a != b && a != outside && b != outside)
            parents_[root(a)] = root(b);
    }

    /// Returns whether a side of a triangle is a spike: much longer than usual in a mesh with thousands of
    /// vertices. A spike comes from a broken vertex and is ignored.
    [[nodiscard]] bool is_spike(uint32_t a, uint32_t b) const
    {
        if (a == outside || b == outside)
            return a != b;
        constexpr double most_few = 1e-3;
        constexpr int long_cells = side_cells / 2;
        const auto [few, many] = std::minmax(cells_[a].vertices, cells_[b].vertices);
        const auto apart = [&](uint32_t stride) {
            return std::abs(static_cast<int>(a / stride % side_cells) -
                            static_cast<int>(b / stride % side_cells));
        };
        return few <= most_few * many &&
               std::max({apart(1), apart(side_cells), apart(side_cells * side_cells)}) >= long_cells;
    }

    void add_triangle(const PosedPrimitive& posed, uint32_t a, uint32_t b, uint32_t c)
    {
        const std::array<uint32_t, 3> in{cell_of_[a], cell_of_[b], cell_of_[c]};
        if (is_spike(in[0], in[1]) || is_spike(in[1], in[2]) || is_spike(in[2], in[0]))
            return;
        join(in[0], in[1]);
        join(in[1], in[2]);
        if (in[0] != outside) {
            const glm::dvec3& corner = posed.positions[a];
            cells_[in[0]].area_m2 +=
                0.5 * glm::length(glm::cross(posed.positions[b] - corner, posed.positions[c] - corner));
        }
    }

    void join_neighbours()
    {
        constexpr int side = side_cells;
        for (int i = 0; i < static_cast<int>(cell_count); ++i) {
            if (cells_[static_cast<size_t>(i)].vertices == 0.0)
                continue;
            const glm::ivec3 at(i % side, i / side % side, i / side / side);
            for (int k = 0; k < 27; ++k) {
                const glm::ivec3 next = at + glm::ivec3(k % 3, k / 3 % 3, k / 9) - 1;
                if (glm::any(glm::lessThan(next, glm::ivec3(0))) ||
                    glm::any(glm::greaterThanEqual(next, glm::ivec3(side))))
                    continue;
                const auto other = static_cast<uint32_t>((next.z * side + next.y) * side + next.x);
                if (cells_[other].vertices > 0.0)
                    join(static_cast<uint32_t>(i), other);
            }
        }
    }

    /// Adds a part, and merges it with all parts whose boxes are at most one cube away.
    void merge_into(std::vector<Part>& parts, Part part) const
    {
        const auto meets = [&](const Part& other) {
            return glm::all(glm::lessThanEqual(part.bounds.min, other.bounds.max + side_m_)) &&
                   glm::all(glm::lessThanEqual(other.bounds.min, part.bounds.max + side_m_));
        };
        for (auto met = std::ranges::find_if(parts, meets); met != parts.end();
             met = std::ranges::find_if(parts, meets)) {
            part.add(met->bounds, met->vertices, met->area_m2);
            std::swap(*met, parts.back());
            parts.pop_back();
        }
        parts.push_back(part);
    }

    Bounds whole_;
    double side_m_ = 0.0;
    std::vector<StrayCell> cells_;
    std::vector<uint32_t> parents_;
    std::vector<uint32_t> cell_of_; ///< grid cell of each vertex of the current primitive
};

double length_of(const Bounds& bounds)
{
    return glm::length(bounds.max - bounds.min);
}

/// Returns the bounds of the main part, which outweighs all other parts together. Returns nothing if the rest
/// of the scene is not made of strays (small parts far away).
std::optional<Bounds> main_part(const std::vector<Part>& parts, const Bounds& whole)
{
    // Extra weight of the part nearest to the origin; strays are far from the origin.
    constexpr double home = 0.15;
    constexpr double least_weight = 0.5; // smallest weight of the main part
    // Smallest extent of a scene with strays, in lengths of the main part.
    constexpr double far_lengths = 20.0;
    // Smallest extent if all other parts are specks (tiny parts), in lengths of the main part.
    constexpr double speck_lengths = 8.0;
    constexpr double speck_share = 0.005; // largest share of all specks together, by vertices and area
    Part all;
    for (const Part& part : parts)
        all.add(part.bounds, part.vertices, part.area_m2);
    const auto nearest = std::ranges::min_element(
        parts, {}, [](const Part& part) { return glm::length(part.bounds.center()); });
    const auto share = [&](const Part& part) {
        const double of_vertices = part.vertices / all.vertices;
        return 0.5 * (of_vertices + (all.area_m2 > 0.0 ? part.area_m2 / all.area_m2 : of_vertices));
    };
    const auto weight = [&](const Part& part) { return share(part) + (&part == &*nearest ? home : 0.0); };
    const auto heaviest = std::ranges::max_element(parts, {}, weight);
    const double length_m = length_of(heaviest->bounds);
    const double far = 1.0 - share(*heaviest) <= speck_share ? speck_lengths : far_lengths;
    if (weight(*heaviest) < least_weight || !(length_m > 0.0) || length_of(whole) < far * length_m)
        return std::nullopt;
    return heaviest->bounds;
}

} // namespace

Bounds bounds_without_strays(const Scene& scene, const ScenePose& pose, const Bounds& whole)
{
    // The search is repeated, because some strays are much farther away than others.
    constexpr int most_rounds = 6;
    Bounds bounds = whole;
    for (int round = 0; round < most_rounds && length_of(bounds) > 0.0; ++round) {
        if (!std::isfinite(length_of(bounds)))
            return whole;
        Grid cubes(bounds);
        visit_posed(scene, pose, [&](const PosedPrimitive& posed) { cubes.add(posed); });
        const std::vector<Part> parts = cubes.parts();
        const std::optional<Bounds> main = parts.size() > 1 ? main_part(parts, bounds) : std::nullopt;
        if (!main)
            break;
        bounds = *main;
    }
    return bounds;
}

namespace {

constexpr int level_count = 64;

/// Returns the upper end, in world space, of the thin range of heights that has the most upward-facing
/// surface.
double floor_level(const SurfaceCloud& cloud)
{
    std::array<int, level_count> upward{};
    const double low = cloud.bounds.min.y;
    const double step = std::max((cloud.bounds.max.y - low) / level_count, 1e-12);
    for (const SurfacePoint& point : cloud.points) {
        const float up = point.two_sided ? std::abs(point.normal.y) : point.normal.y;
        const double height = static_cast<double>(point.position.y) + cloud.origin.y - low;
        if (up > 0.98F)
            ++upward[static_cast<size_t>(std::clamp(height / step, 0.0, level_count - 1.0))];
    }
    const auto most = std::max_element(upward.begin(), upward.end());
    return low + step * (static_cast<double>(most - upward.begin()) + 1.0);
}

/// Returns whether the surface at the floor's height is a floor: a thin sheet that fills its bounding
/// rectangle. The brim of a hat, a saucer, arms along the ground and a plinth are parts of the subject, not
/// floors.
bool is_sheet(const SurfaceCloud& cloud, double level)
{
    constexpr int cells_across = 16;
    constexpr double most_thickness = 0.02; // largest thickness of a floor, as a share of its width
    // Smallest share of the bounding rectangle that a floor fills; a disc fills 0.79.
    constexpr double most_of_it = 0.9;
    Bounds floor;
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 position = glm::dvec3(point.position) + cloud.origin;
        if (position.y <= level)
            floor.extend(position);
    }
    const glm::dvec3 size = floor.max - floor.min;
    if (floor.empty() || size.y > most_thickness * std::max(size.x, size.z))
        return false;
    std::array<bool, cells_across * cells_across> is_filled{};
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 position = glm::dvec3(point.position) + cloud.origin;
        if (position.y > level)
            continue;
        const glm::dvec3 part = (position - floor.min) / glm::max(size, glm::dvec3(1e-300));
        const auto cell = [](double share) {
            return std::clamp(static_cast<int>(share * cells_across), 0, cells_across - 1);
        };
        is_filled[static_cast<size_t>(cell(part.x) * cells_across + cell(part.z))] = true;
    }
    return static_cast<double>(std::ranges::count(is_filled, true)) >=
           most_of_it * cells_across * cells_across;
}

/// Returns the bounds of the objects on the floor at height `level`, if the floor is the lowest surface and
/// much wider than the objects. If there is no floor of that kind, returns the bounds of all points.
Bounds without_floor(const SurfaceCloud& cloud, Bounds standing, double level)
{
    const Bounds& all = cloud.bounds;
    const glm::dvec3 whole = all.max - all.min;
    const glm::dvec3 part = standing.max - standing.min;
    const bool floor_is_lowest = level - all.min.y < 0.25 * whole.y;
    // Smallest ratio of the floor's width to the width of the objects, in each horizontal direction. A plain
    // floor must have about two and a half times the area of the objects on it, any other floor about a
    // thousand times.
    const double much_wider = is_sheet(cloud, level) ? 1.6 : 30.0;
    if (!floor_is_lowest || whole.x < much_wider * part.x || whole.z < much_wider * part.z)
        return all;
    standing.min.y = std::min(standing.min.y, level);
    return standing;
}

} // namespace

Bounds subject_bounds(const SurfaceCloud& cloud)
{
    const double level = floor_level(cloud);
    Bounds standing;
    size_t below = 0;
    size_t above = 0;
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 position = glm::dvec3(point.position) + cloud.origin;
        if (position.y > level) {
            standing.extend(position);
            ++above;
        } else {
            ++below;
        }
    }
    if (above < 32 || below < cloud.points.size() / 16)
        return cloud.bounds;
    return without_floor(cloud, standing, level);
}

Bounds subject_by_vertices(const Scene& scene, const ScenePose& pose, const SurfaceCloud& cloud,
                           const Bounds& found)
{
    const bool is_whole = found.min == cloud.bounds.min && found.max == cloud.bounds.max;
    if (!is_whole || cloud.points.empty())
        return found;
    const double level = floor_level(cloud);
    const auto is_above = [&](const SurfacePoint& point) {
        return static_cast<double>(point.position.y) + cloud.origin.y > level;
    };
    const auto above = std::ranges::count_if(cloud.points, is_above);
    if (static_cast<size_t>(above) > cloud.points.size() / 16)
        return found; // the cloud already contains the objects on the floor
    Bounds standing;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            if (position.y > level && holds(cloud.bounds, position))
                standing.extend(position);
        }
    });
    return standing.radius() > 0.0 ? without_floor(cloud, standing, level) : found;
}

SurfaceCloud within(const SurfaceCloud& cloud, const Bounds& subject)
{
    SurfaceCloud inside{.origin = cloud.origin, .bounds = subject};
    const double slack = 1e-6 * subject.radius();
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 p = glm::dvec3(point.position) + cloud.origin;
        if (glm::all(glm::greaterThanEqual(p, subject.min - slack)) &&
            glm::all(glm::lessThanEqual(p, subject.max + slack)))
            inside.points.push_back(point);
    }
    return inside;
}

namespace {

constexpr size_t slice_count = 40;

/// Horizontal extent of a subject at one height, as a share of the subject's total height.
struct Slice {
    double left = 0.0, right = 0.0, back = 0.0, front = 0.0;
    bool is_empty = true;

    void add(double x, double z)
    {
        left = is_empty ? x : std::min(left, x);
        right = is_empty ? x : std::max(right, x);
        back = is_empty ? z : std::min(back, z);
        front = is_empty ? z : std::max(front, z);
        is_empty = false;
    }

    [[nodiscard]] double width() const { return right - left; }

    [[nodiscard]] double depth() const { return front - back; }

    [[nodiscard]] double middle() const { return 0.5 * (left + right); }
};

using Slices = std::array<Slice, slice_count>;

Slices slices_of(const SurfaceCloud& cloud)
{
    Slices slices;
    const double height = cloud.bounds.max.y - cloud.bounds.min.y;
    const glm::dvec3 foot(cloud.bounds.center().x, cloud.bounds.min.y, cloud.bounds.center().z);
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 p = (glm::dvec3(point.position) + cloud.origin - foot) / height;
        const double level = std::clamp(p.y * slice_count, 0.0, slice_count - 1.0);
        slices[static_cast<size_t>(level)].add(p.x, p.z);
    }
    return slices;
}

bool is_round(const Slices& slices)
{
    double difference = 0.0;
    double size = 0.0;
    for (const Slice& slice : slices) {
        difference += std::abs(slice.width() - slice.depth());
        size += slice.width() + slice.depth();
    }
    constexpr double nearly_round = 0.1;
    return difference < nearly_round * size;
}

double widest(const Slices& slices, size_t from, size_t to)
{
    double width = 0.0;
    for (size_t i = from; i < to; ++i)
        width = std::max(width, slices[i].width());
    return width;
}

double deepest(const Slices& slices, size_t from, size_t to)
{
    double depth = 0.0;
    for (size_t i = from; i < to; ++i)
        depth = std::max(depth, slices[i].depth());
    return depth;
}

/// Returns the height of the neck as a share of the subject's height. The neck is the narrowest place below a
/// head, and the head must not be flat or far off to the side.
std::optional<double> neck(const Slices& slices)
{
    constexpr size_t lowest = slice_count * 2 / 5;
    constexpr size_t highest = slice_count - 3;
    constexpr double narrower = 0.8;
    constexpr double aside = 0.1;
    std::optional<size_t> found;
    for (size_t i = lowest; i < highest; ++i) {
        const double head = widest(slices, i + 1, slice_count);
        const double body = widest(slices, 0, i);
        const double head_depth = deepest(slices, i + 1, slice_count);
        const bool is_head = head_depth > 0.5 * head && head_depth < 2.2 * head && head > 0.25 * body;
        if (!slices[i].is_empty && is_head && slices[i].width() <= narrower * std::min(head, body) &&
            std::abs(slices[i].middle()) < aside && std::abs(slices[slice_count - 1].middle()) < aside &&
            (!found || slices[i].width() < slices[*found].width()))
            found = i;
    }
    return found ? std::optional((static_cast<double>(*found) + 0.5) / slice_count) : std::nullopt;
}

/// Returns whether more than half of all vertices are skinned.
bool is_skinned(const Scene& scene)
{
    size_t skinned = 0;
    size_t all = 0;
    for (const Node& node : scene.nodes) {
        if (node.mesh >= scene.meshes.size())
            continue;
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            all += primitive.positions.size();
            skinned += node.skin != no_index ? primitive.positions.size() : 0;
        }
    }
    return 2 * skinned > all;
}

} // namespace

std::optional<double> eye_level(const Scene& scene, const SurfaceCloud& inside)
{
    constexpr size_t fewest_points = 1024;
    const glm::dvec3 size = inside.bounds.max - inside.bounds.min;
    if (inside.points.size() < fewest_points || !(size.y > 1.25 * size.z))
        return std::nullopt;
    const Slices slices = slices_of(inside);
    const std::optional<double> found =
        size.y > 1.25 * size.x && !is_round(slices) ? neck(slices) : std::nullopt;
    constexpr double human_neck = 0.87; // height of the neck as a share of a person's height
    // A person with arms held out is as wide as tall.
    if (!found && !(is_skinned(scene) && size.y > 0.85 * size.x && size.y > 1.5 * size.z))
        return std::nullopt;
    return glm::mix(inside.bounds.min.y, inside.bounds.max.y, 0.5 * (1.0 + found.value_or(human_neck)));
}

} // namespace estampe
