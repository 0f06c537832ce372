// SPDX-License-Identifier: MIT
#include "scene/view_analysis/surface_points.hpp"

#include <algorithm>
#include <cmath>

#include "scene/pose.hpp"
#include "scene/view_analysis/subject.hpp"

namespace estampe {
namespace {

/// Visits triangles and places a sample point after every `step_m2` of area.
class Sower {
public:
    explicit Sower(SurfaceCloud& cloud) : cloud_(cloud) {}

    void begin(double step_m2)
    {
        step_m2_ = step_m2;
        due_m2_ = due_ * step_m2;
    }

    void end() { due_ = due_m2_ / step_m2_; }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const Material& material)
    {
        const glm::dvec3 across = glm::cross(b - a, c - a);
        const double length = glm::length(across);
        const double area_m2 = 0.5 * length;
        if (!(area_m2 > 0.0))
            return;
        const glm::vec3 normal(across / length);
        const auto detail = static_cast<float>(1.0 / std::sqrt(area_m2));
        const bool glows = std::max({material.emissive.x, material.emissive.y, material.emissive.z}) > 0.5F;
        for (; due_m2_ <= area_m2; due_m2_ += step_m2_) {
            // Sample points follow Roberts' low-discrepancy sequence. Points outside of the triangle are
            // mirrored into it.
            const auto n = static_cast<double>(cloud_.points.size() + 1);
            double u = std::fmod(0.7548776662466927 * n, 1.0);
            double v = std::fmod(0.5698402909980532 * n, 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            cloud_.points.push_back({.position = glm::vec3(a + u * (b - a) + v * (c - a)),
                                     .normal = normal,
                                     .detail = detail,
                                     .area_m2 = static_cast<float>(step_m2_),
                                     .two_sided = material.double_sided,
                                     .glows = glows});
        }
        due_m2_ -= area_m2;
    }

private:
    SurfaceCloud& cloud_;
    double due_ = 0.5; ///< part of the step to the next point that remains; kept from primitive to primitive
    double step_m2_ = 1.0;
    double due_m2_ = 1.0;
};

double area_of(const PosedPrimitive& posed)
{
    const std::vector<uint32_t>& indices = posed.primitive->indices;
    double area_m2 = 0.0;
    for (size_t i = 0; posed.primitive->topology == Topology::triangles && i + 2 < indices.size(); i += 3) {
        const glm::dvec3& a = posed.positions[indices[i]];
        const glm::dvec3 b = posed.positions[indices[i + 1]] - a;
        const glm::dvec3 c = posed.positions[indices[i + 2]] - a;
        area_m2 += 0.5 * glm::length(glm::cross(b, c));
    }
    return area_m2;
}

} // namespace

SurfaceCloud surface_cloud(const Scene& scene, const ScenePose& pose, uint32_t count)
{
    SurfaceCloud cloud;
    std::vector<double> areas_m2; // area of each primitive, in the order of the visits
    double total_m2 = 0.0;
    double surfaces = 0.0;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions)
            cloud.bounds.extend(position);
        areas_m2.push_back(area_of(posed));
        total_m2 += areas_m2.back();
        surfaces += areas_m2.back() > 0.0 ? 1.0 : 0.0;
    });
    const Bounds all = cloud.bounds;
    cloud.bounds = bounds_without_strays(scene, pose, all);
    if (!(total_m2 > 0.0) || !std::isfinite(total_m2))
        return cloud;
    cloud.origin = cloud.bounds.center();
    cloud.points.reserve(count + 1);
    Sower sower(cloud);
    static const Material plain;
    size_t next = 0;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        const double area_m2 = areas_m2[next++];
        if (area_m2 == 0.0)
            return;
        sower.begin(area_m2 / (0.5 * count * (area_m2 / total_m2 + 1.0 / surfaces)));
        const std::vector<uint32_t>& indices = posed.primitive->indices;
        const Index material = posed.primitive->material;
        const Material& look = material < scene.materials.size() ? scene.materials[material] : plain;
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            const auto corner = [&](size_t k) { return posed.positions[indices[i + k]] - cloud.origin; };
            sower.add(corner(0), corner(posed.mirrored ? 2 : 1), corner(posed.mirrored ? 1 : 2), look);
        }
        sower.end();
    });
    if (length(all.max - all.min) > length(cloud.bounds.max - cloud.bounds.min)) {
        std::erase_if(cloud.points, [&](const SurfacePoint& point) {
            return !holds(cloud.bounds, glm::dvec3(point.position) + cloud.origin);
        });
    }
    return cloud;
}

namespace {

struct Cell {
    int column = -1;
    int row = -1;
    float depth_m = 0.0F;

    [[nodiscard]] bool inside() const
    {
        return column >= 0 && row >= 0 && column < SeenGrid::side && row < SeenGrid::side;
    }

    [[nodiscard]] size_t index() const
    {
        return static_cast<size_t>(row) * SeenGrid::side + static_cast<size_t>(column);
    }
};

/// A parallel projection of a box to the grid, in single precision, to project many points.
class ParallelView {
public:
    ParallelView(const ViewAxes& axes, const glm::dvec3& centre, double radius_m)
        : right_(axes.right), up_(axes.up), forward_(axes.forward), centre_(centre),
          cells_per_m_(static_cast<float>(0.5 * SeenGrid::side / radius_m))
    {
    }

    [[nodiscard]] Cell cell(const glm::vec3& position) const
    {
        const glm::vec3 v = position - centre_;
        constexpr float middle = 0.5F * SeenGrid::side;
        return {static_cast<int>(std::floor(middle + cells_per_m_ * glm::dot(v, right_))),
                static_cast<int>(std::floor(middle - cells_per_m_ * glm::dot(v, up_))),
                glm::dot(v, forward_)};
    }

    [[nodiscard]] glm::vec3 forward() const { return forward_; }

    [[nodiscard]] float cell_m() const { return 1.0F / cells_per_m_; }

private:
    glm::vec3 right_, up_, forward_, centre_;
    float cells_per_m_;
};

/// Amounts of lines that would be drawn between adjacent cells of a grid.
struct Lines {
    double edges = 0.0; ///< silhouettes: lines between a filled cell and an empty cell
    double steps = 0.0; ///< lines at discontinuities in depth
    double bends = 0.0; ///< lines at changes of the surface's direction (its normal)

    void add(const SurfaceCloud& cloud, const SeenGrid& seen, size_t a, size_t b)
    {
        if (seen.nearest[a] == SeenGrid::nothing || seen.nearest[b] == SeenGrid::nothing) {
            edges += seen.nearest[a] != seen.nearest[b] ? 1.0 : 0.0;
            return;
        }
        if (std::abs(seen.depth_m[a] - seen.depth_m[b]) > 4.0F * seen.cell_m) {
            steps += 1.0;
            return;
        }
        const float cosine =
            glm::dot(cloud.points[seen.nearest[a]].normal, cloud.points[seen.nearest[b]].normal);
        bends += static_cast<double>(std::clamp(1.5F * (1.0F - cosine), 0.0F, 1.0F));
    }
};

/// Fills holes of a single cell, into which no sample of the nearest surface falls. A cell is a hole if at
/// least three of its four neighbours are clearly nearer to the eye.
void close_holes(SeenGrid& seen)
{
    const SeenGrid open = seen;
    constexpr size_t side = SeenGrid::side;
    for (size_t cell = side; cell < side * (side - 1); ++cell) {
        const bool is_empty = open.nearest[cell] == SeenGrid::nothing;
        int nearer = 0;
        size_t donor = cell;
        for (const size_t neighbour : {cell - side, cell + side, cell - 1, cell + 1}) {
            const bool is_nearer =
                is_empty || open.depth_m[neighbour] + 4.0F * open.cell_m < open.depth_m[cell];
            if (open.nearest[neighbour] == SeenGrid::nothing || !is_nearer)
                continue;
            ++nearer;
            donor = neighbour;
        }
        if (nearer >= 3) {
            seen.nearest[cell] = open.nearest[donor];
            seen.depth_m[cell] = open.depth_m[donor];
        }
    }
}

} // namespace

SeenGrid see_from_afar(const SurfaceCloud& cloud, const ViewAxes& axes, const Bounds& frame, bool all_sides)
{
    SeenGrid seen;
    const ParallelView view(axes, frame.center() - cloud.origin, std::max(frame.radius(), 1e-12));
    seen.cell_m = view.cell_m();
    for (size_t i = 0; i < cloud.points.size(); ++i) {
        const SurfacePoint& point = cloud.points[i];
        if (!all_sides && !point.two_sided && glm::dot(point.normal, view.forward()) > 0.0F)
            continue;
        const Cell cell = view.cell(point.position);
        if (!cell.inside())
            continue;
        const size_t index = cell.index();
        if (seen.nearest[index] == SeenGrid::nothing || cell.depth_m < seen.depth_m[index]) {
            seen.nearest[index] = static_cast<uint32_t>(i);
            seen.depth_m[index] = cell.depth_m;
        }
    }
    close_holes(seen);
    return seen;
}

std::vector<uint32_t> seen_points(const SeenGrid& seen)
{
    std::vector<uint32_t> points;
    std::copy_if(seen.nearest.begin(), seen.nearest.end(), std::back_inserter(points),
                 [](uint32_t point) { return point != SeenGrid::nothing; });
    return points;
}

void mark_shown(const SurfaceCloud& cloud, const ViewAxes& axes, std::vector<bool>& shown)
{
    const SeenGrid seen = see_from_afar(cloud, axes, cloud.bounds, true);
    const ParallelView view(axes, cloud.bounds.center() - cloud.origin,
                            std::max(cloud.bounds.radius(), 1e-12));
    for (size_t i = 0; i < cloud.points.size(); ++i) {
        const Cell cell = view.cell(cloud.points[i].position);
        if (!cell.inside() || shown[i])
            continue;
        const float cosine = -glm::dot(cloud.points[i].normal, view.forward());
        if (cosine <= 0.0F)
            continue;
        // A surface at a grazing angle spans a larger range of depth within one cell.
        const float slack_m = seen.cell_m * (1.0F + 1.5F / std::max(cosine, 0.2F));
        shown[i] = cell.depth_m < seen.depth_m[cell.index()] + slack_m;
    }
}

double interest(const SurfaceCloud& cloud, const SeenGrid& seen)
{
    Lines lines;
    double cells = 0.0;
    double detail = 0.0;
    for (int row = 1; row < SeenGrid::side; ++row)
        for (int column = 1; column < SeenGrid::side; ++column) {
            const auto here = static_cast<size_t>(row) * SeenGrid::side + static_cast<size_t>(column);
            lines.add(cloud, seen, here, here - 1);
            lines.add(cloud, seen, here, here - SeenGrid::side);
            if (seen.nearest[here] != SeenGrid::nothing) {
                cells += 1.0;
                detail += static_cast<double>(
                    std::min(1.0F, 0.5F * seen.cell_m * cloud.points[seen.nearest[here]].detail));
            }
        }
    constexpr double page = SeenGrid::side * SeenGrid::side;
    constexpr double outline = 8.0 * SeenGrid::side;
    return 0.6 * cells / page + 0.5 * detail / page +
           (0.5 * lines.edges + lines.steps + lines.bends) / outline;
}

double lit_share(const SurfaceCloud& cloud, std::span<const uint32_t> points, const ViewAxes& from_eye,
                 const glm::dvec3& towards_light)
{
    const double azimuth = std::atan2(towards_light.x, towards_light.z);
    const double elevation = std::asin(std::clamp(towards_light.y, -0.999, 0.999));
    const ViewAxes axes = look_from(azimuth, elevation);
    const SeenGrid from_light = see_from_afar(cloud, axes, cloud.bounds, true);
    const ParallelView view(axes, cloud.bounds.center() - cloud.origin,
                            std::max(cloud.bounds.radius(), 1e-12));
    const glm::vec3 light(towards_light);
    const glm::vec3 away(from_eye.forward);
    size_t lit = 0;
    for (const uint32_t index : points) {
        const SurfacePoint& point = cloud.points[index];
        const float side = glm::dot(point.normal, away) > 0.0F ? -1.0F : 1.0F;
        const Cell cell = view.cell(point.position);
        const float cosine = side * glm::dot(point.normal, light);
        const float slack_m = from_light.cell_m * (1.5F + 1.0F / std::max(cosine, 0.1F));
        lit += cosine > 0.05F && cell.inside() && cell.depth_m < from_light.depth_m[cell.index()] + slack_m
                   ? 1U
                   : 0U;
    }
    return points.empty() ? 1.0 : static_cast<double>(lit) / static_cast<double>(points.size());
}

} // namespace estampe
