// SPDX-License-Identifier: MIT
#include "scene/charts/charts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace estampe::charts {
namespace {

/// Returns whether `axis` separates two triangles. Two triangles are separate if their projections onto the
/// axis overlap by at most 1e-4 of the shorter projection.
bool separates(const glm::vec2& axis, const FlatTriangle& a, const FlatTriangle& b)
{
    constexpr float tolerance = 1e-4F;
    const auto [a_low, a_high] =
        std::minmax({glm::dot(axis, a[0]), glm::dot(axis, a[1]), glm::dot(axis, a[2])});
    const auto [b_low, b_high] =
        std::minmax({glm::dot(axis, b[0]), glm::dot(axis, b[1]), glm::dot(axis, b[2])});
    const float shared = std::min(a_high, b_high) - std::max(a_low, b_low);
    return shared <= tolerance * std::min(a_high - a_low, b_high - b_low);
}

uint64_t key_of(int32_t x, int32_t y)
{
    return static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32U | static_cast<uint32_t>(x);
}

} // namespace

bool overlap(const FlatTriangle& a, const FlatTriangle& b)
{
    for (const FlatTriangle* triangle : {&a, &b}) {
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec2 edge = (*triangle)[(k + 1) % 3] - (*triangle)[k];
            if (separates({-edge.y, edge.x}, a, b)) {
                return false;
            }
        }
    }
    return true;
}

OverlapGrid::Cells OverlapGrid::cells_of(const FlatTriangle& triangle) const
{
    constexpr float farthest = 1e9F;
    const glm::vec2 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::vec2 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    const auto cell = [&](const glm::vec2& place) {
        return glm::ivec2(glm::clamp(glm::floor(place / cell_m_), -farthest, farthest));
    };
    return {cell(low), cell(high)};
}

bool OverlapGrid::is_free(const FlatTriangle& triangle, std::span<const uint32_t> others) const
{
    return std::ranges::none_of(others, [&](uint32_t other) { return overlap(triangle, triangles_[other]); });
}

bool OverlapGrid::add(const FlatTriangle& triangle)
{
    constexpr double most_cells = 4096.0;
    const Cells cells = cells_of(triangle);
    const glm::dvec2 count = glm::dvec2(cells.last) - glm::dvec2(cells.first) + 1.0;
    const auto number = static_cast<uint32_t>(triangles_.size());
    if (!is_free(triangle, wide_)) {
        return false;
    }
    if (count.x * count.y > most_cells) {
        if (std::ranges::any_of(triangles_, [&](const auto& other) { return overlap(triangle, other); })) {
            return false;
        }
        wide_.push_back(number);
        triangles_.push_back(triangle);
        return true;
    }
    for (int32_t y = cells.first.y; y <= cells.last.y; ++y) {
        for (int32_t x = cells.first.x; x <= cells.last.x; ++x) {
            const auto found = cells_.find(key_of(x, y));
            if (found != cells_.end() && !is_free(triangle, found->second)) {
                return false;
            }
        }
    }
    for (int32_t y = cells.first.y; y <= cells.last.y; ++y) {
        for (int32_t x = cells.first.x; x <= cells.last.x; ++x) {
            cells_[key_of(x, y)].push_back(number);
        }
    }
    triangles_.push_back(triangle);
    return true;
}

namespace {

constexpr float sharpest_edge_cosine =
    0.5F; // charts do not grow across an edge that turns by more than 60 degrees

struct Face {
    glm::vec3 normal{0.0F};
    float area_m2 = 0.0F;
    std::vector<uint32_t> neighbours; ///< triangles that share an edge with this one
};

/// A plane into which the triangles of a chart are projected.
struct Plane {
    explicit Plane(const glm::vec3& along)
        : normal(along), right(glm::normalize(glm::cross(
                             std::abs(along.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), along))),
          up(glm::cross(along, right))
    {
    }

    [[nodiscard]] glm::vec2 flat(const glm::vec3& place) const
    {
        return {glm::dot(place, right), glm::dot(place, up)};
    }

    glm::vec3 normal;
    glm::vec3 right;
    glm::vec3 up;
};

std::vector<uint32_t> welded(std::span<const glm::vec3> corners)
{
    std::map<std::tuple<float, float, float>, uint32_t> number_of;
    std::vector<uint32_t> numbers;
    numbers.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const auto next = static_cast<uint32_t>(number_of.size());
        numbers.push_back(number_of.try_emplace({corner.x, corner.y, corner.z}, next).first->second);
    }
    return numbers;
}

std::vector<Face> faces_of(std::span<const glm::vec3> corners)
{
    std::vector<Face> faces(corners.size() / 3);
    for (size_t i = 0; i < faces.size(); ++i) {
        const glm::vec3 twice =
            glm::cross(corners[3 * i + 1] - corners[3 * i], corners[3 * i + 2] - corners[3 * i]);
        const float length = glm::length(twice);
        if (std::isfinite(length) && length > 0.0F) {
            faces[i].normal = twice / length;
            faces[i].area_m2 = 0.5F * length;
        }
    }
    const std::vector<uint32_t> vertices = welded(corners);
    // Each edge: two vertices, and the triangle to which the edge belongs.
    std::vector<std::tuple<uint32_t, uint32_t, uint32_t>> edges;
    for (uint32_t i = 0; i < vertices.size(); ++i) {
        const uint32_t next = vertices[i % 3 == 2 ? i - 2 : i + 1];
        edges.emplace_back(std::min(vertices[i], next), std::max(vertices[i], next), i / 3);
    }
    std::sort(edges.begin(), edges.end());
    for (size_t first = 0, last = 0; first < edges.size(); first = last) {
        while (last < edges.size() && std::get<0>(edges[last]) == std::get<0>(edges[first]) &&
               std::get<1>(edges[last]) == std::get<1>(edges[first])) {
            ++last;
        }
        constexpr size_t most_around_an_edge = 8;
        for (size_t a = first; a < std::min(last, first + most_around_an_edge); ++a) {
            for (size_t b = first; b < std::min(last, first + most_around_an_edge); ++b) {
                if (a != b) {
                    faces[std::get<2>(edges[a])].neighbours.push_back(std::get<2>(edges[b]));
                }
            }
        }
    }
    return faces;
}

class Cutter {
public:
    explicit Cutter(std::span<const glm::vec3> corners) : corners_(corners), faces_(faces_of(corners))
    {
        double area_m2 = 0.0;
        for (const Face& face : faces_) {
            area_m2 += face.area_m2;
        }
        cell_m_ = static_cast<float>(
            2.0 * std::sqrt(area_m2 / static_cast<double>(std::max<size_t>(faces_.size(), 1))));
    }

    std::vector<Chart> run()
    {
        taken_.assign(faces_.size(), false);
        queued_by_.assign(faces_.size(), 0);
        std::vector<uint32_t> seeds(faces_.size());
        std::iota(seeds.begin(), seeds.end(), 0U);
        std::stable_sort(seeds.begin(), seeds.end(),
                         [&](uint32_t a, uint32_t b) { return faces_[a].area_m2 > faces_[b].area_m2; });
        std::vector<Chart> charts;
        for (const uint32_t seed : seeds) {
            if (!taken_[seed] && faces_[seed].area_m2 > 0.0F) {
                charts.push_back(chart_around(seed));
            }
        }
        return charts;
    }

private:
    Chart chart_around(uint32_t seed)
    {
        Plane plane(faces_[seed].normal);
        std::vector<uint32_t> members = grown(seed, plane);
        glm::vec3 mean(0.0F);
        for (const uint32_t member : members) {
            mean += faces_[member].area_m2 * faces_[member].normal;
        }
        const Plane refit(glm::normalize(mean));
        if (members.size() > 1 && fits(faces_[seed], refit)) {
            plane = refit;
            members = grown(seed, plane);
        }
        Chart chart{.triangles = std::move(members)};
        for (const uint32_t member : chart.triangles) {
            taken_[member] = true;
            for (size_t k = 0; k < 3; ++k) {
                chart.corners_m.push_back(plane.flat(corners_[3 * member + k]));
            }
        }
        return chart;
    }

    [[nodiscard]] static bool fits(const Face& face, const Plane& plane)
    {
        static const float least_cosine = std::cos(steepest_lean_rad);
        return face.area_m2 > 0.0F && glm::dot(face.normal, plane.normal) >= least_cosine;
    }

    /// Grows a chart: returns the triangles that are reachable from `seed` across edges and are nearly
    /// parallel to `plane`, in the order in which they are reached.
    std::vector<uint32_t> grown(uint32_t seed, const Plane& plane)
    {
        ++round_;
        OverlapGrid grid(cell_m_);
        std::vector<uint32_t> members;
        const auto take = [&](uint32_t face) {
            queued_by_[face] = round_;
            const glm::vec3* corner = &corners_[3 * static_cast<size_t>(face)];
            if (grid.add({plane.flat(corner[0]), plane.flat(corner[1]), plane.flat(corner[2])})) {
                members.push_back(face);
            }
        };
        take(seed);
        size_t next = 0; // `members` grows during this loop
        while (next < members.size()) {
            const Face& face = faces_[members[next++]];
            for (const uint32_t neighbour : face.neighbours) {
                if (!taken_[neighbour] && queued_by_[neighbour] != round_ && fits(faces_[neighbour], plane) &&
                    glm::dot(faces_[neighbour].normal, face.normal) >= sharpest_edge_cosine) {
                    take(neighbour);
                }
            }
        }
        return members;
    }

    std::span<const glm::vec3> corners_;
    std::vector<Face> faces_;
    std::vector<bool> taken_;
    std::vector<uint32_t> queued_by_; ///< for each triangle: number of the last round in which it was tried
    uint32_t round_ = 0;
    float cell_m_ = 1.0F;
};

glm::vec2 extent(const std::vector<glm::vec2>& corners, float angle_rad, glm::vec2& low)
{
    const glm::vec2 right(std::cos(angle_rad), std::sin(angle_rad));
    const glm::vec2 up(-right.y, right.x);
    low = glm::vec2(INFINITY);
    glm::vec2 high(-INFINITY);
    for (const glm::vec2& corner : corners) {
        const glm::vec2 turned(glm::dot(corner, right), glm::dot(corner, up));
        low = glm::min(low, turned);
        high = glm::max(high, turned);
    }
    return high - low;
}

/// Rotates a chart so that its bounding box becomes small. Tries the direction of the longest edge and twelve
/// fixed directions.
void settle(Chart& chart)
{
    std::vector<float> angles_rad;
    angles_rad.reserve(13);
    for (int step = 0; step < 12; ++step) {
        angles_rad.push_back(static_cast<float>(step) * 0.1308997F);
    }
    glm::vec2 longest(0.0F);
    for (size_t i = 0; i < chart.corners_m.size(); ++i) {
        const glm::vec2 edge = chart.corners_m[i % 3 == 2 ? i - 2 : i + 1] - chart.corners_m[i];
        longest = glm::dot(edge, edge) > glm::dot(longest, longest) ? edge : longest;
    }
    angles_rad.insert(angles_rad.begin(), std::atan2(longest.y, longest.x));
    float best_rad = 0.0F;
    float best_area = INFINITY;
    glm::vec2 low;
    for (const float angle_rad : angles_rad) {
        const glm::vec2 size = extent(chart.corners_m, angle_rad, low);
        if (size.x * size.y < 0.999F * best_area) {
            best_area = size.x * size.y;
            best_rad = angle_rad;
        }
    }
    chart.size_m = extent(chart.corners_m, best_rad, low);
    const glm::vec2 right(std::cos(best_rad), std::sin(best_rad));
    const glm::vec2 up(-right.y, right.x);
    for (glm::vec2& corner : chart.corners_m) {
        corner = glm::max(glm::vec2(glm::dot(corner, right), glm::dot(corner, up)) - low, glm::vec2(0.0F));
    }
}

float flat_area(const FlatTriangle& t)
{
    const glm::vec2 a = t[1] - t[0];
    const glm::vec2 b = t[2] - t[0];
    return 0.5F * std::abs(a.x * b.y - a.y * b.x);
}

} // namespace

std::vector<Chart> cut_charts(std::span<const glm::vec3> corners)
{
    std::vector<Chart> charts = Cutter(corners).run();
    for (Chart& chart : charts) {
        settle(chart);
    }
    return charts;
}

std::optional<Chart> own_chart(std::span<const glm::vec3> corners, std::span<const glm::vec2> uvs)
{
    double area_m2 = 0.0;
    double area_uv = 0.0;
    double lost_m2 = 0.0;
    std::vector<FlatTriangle> flat;
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
        const float own_m2 =
            0.5F * glm::length(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]));
        flat.push_back({uvs[i], uvs[i + 1], uvs[i + 2]});
        const float own_uv = flat_area(flat.back());
        if (!std::isfinite(own_uv)) {
            return std::nullopt;
        }
        area_m2 += own_m2;
        area_uv += own_uv;
        lost_m2 += own_uv > 0.0F ? 0.0F : own_m2;
    }
    constexpr double most_lost = 0.001;
    if (area_uv <= 0.0 || lost_m2 > most_lost * area_m2) {
        return std::nullopt;
    }
    OverlapGrid grid(static_cast<float>(2.0 * std::sqrt(area_uv / static_cast<double>(flat.size()))));
    Chart chart;
    const auto scale = static_cast<float>(std::sqrt(area_m2 / area_uv));
    glm::vec2 low(INFINITY);
    for (uint32_t i = 0; i < flat.size(); ++i) {
        if (flat_area(flat[i]) > 0.0F) {
            if (!grid.add(flat[i])) {
                return std::nullopt;
            }
            chart.triangles.push_back(i);
            for (const glm::vec2& corner : flat[i]) {
                chart.corners_m.push_back(corner * scale);
                low = glm::min(low, chart.corners_m.back());
            }
        }
    }
    for (glm::vec2& corner : chart.corners_m) {
        corner -= low;
        chart.size_m = glm::max(chart.size_m, corner);
    }
    return chart;
}

} // namespace estampe::charts
