// SPDX-License-Identifier: MIT
// Bakes normal maps: the normals of a detailed mesh, in the tangent frames of a plain mesh.
#include <estampe/normal_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <estampe/error.hpp>

#include "core/long_jobs.hpp"
#include "scene/scene_limits.hpp"
#include "style/parameter.hpp"
#include "techniques/bake/canvas.hpp"
#include "techniques/bake/normals/corners.hpp"
#include "techniques/bake/normals/detail.hpp"

namespace estampe::bake {
namespace {

constexpr glm::dvec3 flat(0.0, 0.0, 1.0);

/// Whether the node or one of its ancestors has a name that matches the pattern.
bool is_below(const Scene& scene, Index node, const std::string& pattern)
{
    while (node != no_index && !style::matches(pattern, scene.nodes[node].name)) {
        node = scene.nodes[node].parent;
    }
    return node != no_index;
}

/// Throws Error unless the pattern is empty or matches the name of one of `items`.
template <class Item>
void check_name(const std::vector<Item>& items, const std::string& pattern, const char* kind,
                const Scene& scene)
{
    if (pattern.empty()) {
        return;
    }
    std::set<std::string> names;
    for (const Item& item : items) {
        if (style::matches(pattern, item.name)) {
            return;
        }
        if (!item.name.empty()) {
            names.insert('"' + item.name + '"');
        }
    }
    throw Error(fmt::format("no {} has the name \"{}\"", kind, pattern), scene.name,
                names.empty() ? fmt::format("no {} has a name", kind)
                              : fmt::format("there is {}", fmt::join(names, ", ")));
}

/// Throws Error unless the number is in its range.
void check_range(const char* what, uint32_t number, uint32_t least, uint32_t most)
{
    if (number < least || number > most) {
        throw Error(fmt::format("{} {} is out of range", what, number), {},
                    fmt::format("allowed: {} to {}", least, most));
    }
}

void check_settings(const NormalBakeSettings& settings)
{
    check_range("the size", settings.size, 16, 8192);
    check_range("the number of samples", settings.samples, 1, 8);
    check_range("the border", settings.border, 0, 64);
    check_range("the UV set", settings.uv_set, 0, 1);
    if (settings.distance_m && !(*settings.distance_m > 0.0 && *settings.distance_m <= farthest_m)) {
        throw Error(fmt::format("the distance {} m is out of range", *settings.distance_m), {},
                    fmt::format("allowed: more than 0, up to {:g} m", farthest_m));
    }
}

/// The plain mesh, for which the map is made.
class Plain {
public:
    Plain(Corners own, TangentFrame frame) : corners(std::move(own)), outward_(smooth_normals(corners))
    {
        if (frame == TangentFrame::of_vertices) {
            tangents_ = vertex_tangents(corners);
        }
    }

    /// Normal of the detail at a point of a triangle, in the frame of the map; nothing if no ray hits.
    [[nodiscard]] std::optional<glm::dvec3> seen(const Detail& detail, size_t triangle,
                                                 const glm::dvec3& weights, double distance_m) const
    {
        const glm::dvec3 place = between(corners.positions, triangle, weights);
        const glm::dvec3 sum = between(corners.normals, triangle, weights);
        const glm::dvec3 smooth = between(outward_, triangle, weights);
        if (!(glm::dot(sum, sum) > 0.0 && glm::dot(smooth, smooth) > 0.0)) {
            return std::nullopt;
        }
        const glm::dvec3 normal = glm::normalize(sum);
        const glm::dvec3 outward = glm::normalize(smooth);
        const std::optional<glm::dvec3> hit =
            detail.normal_along(glm::vec3(place + distance_m * outward), glm::vec3(-outward),
                                static_cast<float>(2.0 * distance_m));
        if (!hit) {
            return std::nullopt;
        }
        const glm::dmat3 frame = tangents_.empty()
                                     ? triangle_frame(corners, triangle, normal)
                                     : vertex_frame(between(tangents_, triangle, weights), normal);
        return in_frame(frame, *hit);
    }

    Corners corners;

private:
    std::vector<glm::vec3> outward_; ///< direction from each corner to the start of its ray
    std::vector<glm::vec4> tangents_;
};

/// A triangle at one place of the map, in samples from the top left. A triangle whose UVs lie outside 0 to 1
/// has a place for each repetition of the map that it touches.
struct Placed {
    uint32_t triangle = 0;
    std::array<glm::dvec2, 3> at{};

    [[nodiscard]] glm::dvec2 least() const { return glm::min(glm::min(at[0], at[1]), at[2]); }

    [[nodiscard]] glm::dvec2 most() const { return glm::max(glm::max(at[0], at[1]), at[2]); }

    /// Weights of the corners at a point of the triangle.
    [[nodiscard]] glm::dvec3 weights(const glm::dvec2& point) const
    {
        const glm::dvec2 a = at[1] - at[0];
        const glm::dvec2 b = at[2] - at[0];
        const glm::dvec2 p = point - at[0];
        const double area = a.x * b.y - a.y * b.x;
        glm::dvec3 result(0.0, p.x * b.y - p.y * b.x, a.x * p.y - a.y * p.x);
        result /= area != 0.0 ? area : 1.0;
        result.x = 1.0 - result.y - result.z;
        result = glm::clamp(result, 0.0, 1.0); // against rounding, in triangles that are thin in the map
        return result / (result.x + result.y + result.z);
    }

    /// Calls `visit` with the columns of samples in one row whose centres the triangle covers. Triangles that
    /// share an edge cover no sample twice and leave none out.
    template <class Visit>
    void visit_row(int64_t row, int64_t columns, const Visit& visit) const
    {
        const double y = static_cast<double>(row) + 0.5;
        double left = std::numeric_limits<double>::infinity();
        double right = -left;
        for (size_t k = 0; k < 3; ++k) {
            glm::dvec2 from = at[k];
            glm::dvec2 to = at[(k + 1) % 3];
            if (to.y < from.y) {
                std::swap(from, to); // both triangles of an edge round alike
            }
            if (from.y <= y && y < to.y) {
                const double x = from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y));
                left = std::min(left, x);
                right = std::max(right, x);
            }
        }
        const auto column_of = [&](double x) {
            return static_cast<int64_t>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(columns)));
        };
        if (left < right) {
            const int64_t end = column_of(right);
            for (int64_t column = column_of(left); column < end; ++column) {
                visit(column);
            }
        }
    }
};

/// Counts of one band of rows.
struct Tally {
    uint64_t samples = 0;
    uint64_t overlapping = 0;
    uint64_t covered_texels = 0;
    uint64_t missed_texels = 0;
};

constexpr uint32_t band_rows = 4; ///< rows of texels that one thread works on at a time
constexpr uint32_t no_triangle = 0xffffffffU;

/// Makes one map, in bands of rows.
class Sheet {
public:
    Sheet(const Plain& plain, const Detail& detail, const NormalBakeSettings& settings, double distance_m)
        : plain_(plain), detail_(detail), size_(settings.size), samples_(settings.samples),
          distance_m_(distance_m), canvas_(settings.size, true), bands_((size_ + band_rows - 1) / band_rows),
          tallies_(bands_.size()), covered_(static_cast<size_t>(size_) * size_, 0)
    {
    }

    /// Places a triangle in the map, or counts in `result` why it has no place.
    void add(uint32_t triangle, BakedNormals& result)
    {
        constexpr double most_widths = 16.0;
        const double side = static_cast<double>(size_) * samples_;
        std::array<glm::dvec2, 3> uv{};
        for (size_t k = 0; k < 3; ++k) {
            uv[k] = glm::dvec2(plain_.corners.uvs[3 * static_cast<size_t>(triangle) + k]);
        }
        const glm::dvec2 least = glm::min(glm::min(uv[0], uv[1]), uv[2]);
        const glm::dvec2 most = glm::max(glm::max(uv[0], uv[1]), uv[2]);
        const glm::dvec2 span = most - least;
        const double largest = std::max({-least.x, -least.y, most.x, most.y});
        if (!(span.x <= most_widths && span.y <= most_widths && largest < 1e6)) {
            ++result.triangles_of_wild_uvs;
            return;
        }
        const glm::dvec2 a = uv[1] - uv[0];
        const glm::dvec2 b = uv[2] - uv[0];
        if (a.x * b.y == a.y * b.x) {
            ++result.triangles_without_uvs;
            return;
        }
        for (double v = std::floor(least.y); v <= most.y; ++v) {
            for (double u = std::floor(least.x); u <= most.x; ++u) {
                Placed placed{.triangle = triangle};
                for (size_t k = 0; k < 3; ++k) {
                    placed.at[k] = side * (uv[k] - glm::dvec2(u, v));
                }
                place(placed);
            }
        }
    }

    /// Traces the rays of all bands on all cores.
    void trace()
    {
        const size_t at_once = std::max<size_t>(
            bands_.size() / 20, 4 * static_cast<size_t>(tbb::this_task_arena::max_concurrency()));
        for (size_t first = 0; first < bands_.size(); first += at_once) {
            report_progress(static_cast<double>(first) / static_cast<double>(bands_.size()));
            tbb::parallel_for(first, std::min(first + at_once, bands_.size()),
                              [this](size_t band) { trace_band(static_cast<uint32_t>(band)); });
        }
        for (size_t i = 0; i < covered_.size(); ++i) {
            canvas_.known[i] = covered_[i] != 0;
        }
    }

    /// Extends the covered parts of the map by a border.
    void extend(uint32_t border)
    {
        std::vector<uint32_t> edge;
        for (uint32_t i = 0; i < covered_.size(); ++i) {
            if (covered_[i] != 0) {
                edge.push_back(i);
            }
        }
        for (uint32_t ring = 0; ring < border && !edge.empty(); ++ring) {
            edge = fill_beside(canvas_, unknown_beside(canvas_, edge));
        }
    }

    [[nodiscard]] Image image(bool is_green_down) const
    {
        Image image{.width = size_, .height = size_, .rgba = std::vector<uint8_t>(4 * covered_.size(), 255)};
        const auto byte_of = [](double component) {
            return static_cast<uint8_t>(std::lround(127.5 * (component + 1.0)));
        };
        for (size_t i = 0; i < covered_.size(); ++i) {
            const glm::dvec3 sum(canvas_.light[i]);
            const glm::dvec3 normal =
                canvas_.known[i] && glm::length(sum) > 1e-6 ? glm::normalize(sum) : flat;
            image.rgba[4 * i] = byte_of(normal.x);
            image.rgba[4 * i + 1] = byte_of(is_green_down ? -normal.y : normal.y);
            image.rgba[4 * i + 2] = byte_of(normal.z);
        }
        return image;
    }

    [[nodiscard]] Tally tally() const
    {
        Tally sum;
        for (const Tally& tally : tallies_) {
            sum.samples += tally.samples;
            sum.overlapping += tally.overlapping;
            sum.covered_texels += tally.covered_texels;
            sum.missed_texels += tally.missed_texels;
        }
        return sum;
    }

private:
    /// Lists a triangle in the bands that it touches.
    void place(const Placed& placed)
    {
        const double side = static_cast<double>(size_) * samples_;
        const glm::dvec2 least = placed.least();
        const glm::dvec2 most = placed.most();
        if (most.x <= 0.0 || most.y <= 0.0 || least.x >= side || least.y >= side) {
            return;
        }
        const double per_band = static_cast<double>(band_rows) * samples_;
        const auto last = std::min(static_cast<size_t>(most.y / per_band), bands_.size() - 1);
        for (auto band = static_cast<size_t>(std::max(least.y, 0.0) / per_band); band <= last; ++band) {
            bands_[band].push_back(static_cast<uint32_t>(placed_.size()));
        }
        placed_.push_back(placed);
    }

    void trace_band(uint32_t band)
    {
        const int64_t columns = static_cast<int64_t>(size_) * samples_;
        const int64_t first_row = static_cast<int64_t>(band) * band_rows * samples_;
        const int64_t rows = static_cast<int64_t>(std::min(band_rows, size_ - band * band_rows)) * samples_;
        std::vector<uint32_t> seen(static_cast<size_t>(columns * rows), no_triangle);
        Tally& tally = tallies_[band];
        for (const uint32_t i : bands_[band]) {
            const Placed& placed = placed_[i];
            const auto from =
                std::max(static_cast<int64_t>(std::floor(placed.least().y)) - first_row, int64_t{0});
            const auto to = std::min(static_cast<int64_t>(std::ceil(placed.most().y)) - first_row, rows);
            for (int64_t row = from; row < to; ++row) {
                placed.visit_row(first_row + row, columns, [&](int64_t column) {
                    uint32_t& winner = seen[static_cast<size_t>(row * columns + column)];
                    if (winner == no_triangle) {
                        winner = i;
                        ++tally.samples;
                    } else {
                        winner |= overlapped;
                    }
                });
            }
        }
        for (const uint32_t winner : seen) {
            tally.overlapping += winner != no_triangle && (winner & overlapped) != 0 ? 1 : 0;
        }
        for (uint32_t y = 0; y < static_cast<uint32_t>(rows) / samples_; ++y) {
            for (uint32_t x = 0; x < size_; ++x) {
                trace_texel(x, band * band_rows + y,
                            &seen[static_cast<size_t>(y) * samples_ * size_ * samples_], tally);
            }
        }
    }

    /// Averages the samples of a texel. `seen` is the first row of samples of the row of texels.
    void trace_texel(uint32_t x, uint32_t y, const uint32_t* seen, Tally& tally)
    {
        const size_t columns = static_cast<size_t>(size_) * samples_;
        glm::dvec3 sum(0.0);
        bool is_covered = false;
        bool is_hit = false;
        for (uint32_t j = 0; j < samples_; ++j) {
            for (uint32_t i = 0; i < samples_; ++i) {
                const uint32_t winner = seen[j * columns + x * samples_ + i];
                if (winner == no_triangle) {
                    continue;
                }
                is_covered = true;
                const Placed& placed = placed_[winner & ~overlapped];
                const glm::dvec2 point(x * samples_ + i + 0.5, y * samples_ + j + 0.5);
                if (const std::optional<glm::dvec3> normal =
                        plain_.seen(detail_, placed.triangle, placed.weights(point), distance_m_)) {
                    sum += *normal;
                    is_hit = true;
                }
            }
        }
        const size_t at = static_cast<size_t>(y) * size_ + x;
        covered_[at] = is_covered ? 1 : 0;
        canvas_.light[at] = glm::vec3(is_hit ? sum : flat);
        tally.covered_texels += is_covered ? 1 : 0;
        tally.missed_texels += is_covered && !is_hit ? 1 : 0;
    }

    static constexpr uint32_t overlapped = 1U << 31U; ///< mark of a sample that several triangles cover

    const Plain& plain_;
    const Detail& detail_;
    uint32_t size_;
    uint32_t samples_;
    double distance_m_;
    Canvas canvas_;
    std::vector<Placed> placed_;
    std::vector<std::vector<uint32_t>> bands_; ///< indices into `placed_`
    std::vector<Tally> tallies_;
    std::vector<uint8_t> covered_; ///< for each texel: whether a triangle covers one of its samples
};

/// The plain triangles that take part and have UVs. Counts the others.
Corners plain_corners(const Scene& plain, const ScenePose& pose, const glm::dvec3& anchor,
                      const NormalBakeSettings& settings, BakedNormals& result)
{
    check_name(plain.nodes, settings.object, "object", plain);
    check_name(plain.materials, settings.material, "material", plain);
    Corners corners =
        corners_of(plain, pose, anchor, [&](const PosedPrimitive& posed) -> std::optional<uint32_t> {
            const Primitive& primitive = *posed.primitive;
            if ((!settings.object.empty() && !is_below(plain, posed.node, settings.object)) ||
                (!settings.material.empty() &&
                 !style::matches(settings.material, plain.materials[primitive.material].name))) {
                return std::nullopt;
            }
            const size_t triangles = primitive.indices.size() / 3;
            result.triangles += triangles;
            if (primitive.uvs[settings.uv_set].empty()) {
                result.triangles_without_uvs += triangles;
                return std::nullopt;
            }
            return settings.uv_set;
        });
    if (result.triangles == 0) {
        throw Error("no triangles to make a normal map for", plain.name);
    }
    if (corners.count() == 0) {
        throw Error(settings.uv_set == 0 ? "has no UVs, so a normal map has no place on it"
                                         : "has no second set of UVs",
                    plain.name, "unwrap the mesh in a modelling program");
    }
    return corners;
}

Corners detailed_corners(const Scene& detailed, const glm::dvec3& anchor, const NormalBakeSettings& settings)
{
    check_name(detailed.nodes, settings.detailed_object, "object", detailed);
    Corners corners = corners_of(
        detailed, pose_scene(detailed, 0.0, no_index), anchor,
        [&](const PosedPrimitive& posed) -> std::optional<uint32_t> {
            if (!settings.detailed_object.empty() &&
                !is_below(detailed, posed.node, settings.detailed_object)) {
                return std::nullopt;
            }
            return std::min(detailed.materials[posed.primitive->material].normal_texture.uv_set, 1U);
        });
    if (corners.count() == 0) {
        throw Error("no triangles to take normals from", detailed.name);
    }
    return corners;
}

} // namespace
} // namespace estampe::bake

namespace estampe {

BakedNormals bake_normals(const Scene& plain, const Scene& detailed, const NormalBakeSettings& settings)
{
    constexpr double usual_share = 0.02;
    bake::check_settings(settings);
    check_drawn_size(plain);
    check_drawn_size(detailed);
    BakedNormals result;
    const ScenePose pose = pose_scene(plain, 0.0, no_index);
    const glm::dvec3 anchor = scene_bounds(plain, pose).center();
    const bake::Plain low(bake::plain_corners(plain, pose, anchor, settings, result), settings.frame);
    Bounds bounds;
    for (const glm::vec3& position : low.corners.positions) {
        bounds.extend(glm::dvec3(position));
    }
    result.distance_m = settings.distance_m.value_or(usual_share * 2.0 * bounds.radius());
    const bake::Detail detail(detailed, bake::detailed_corners(detailed, anchor, settings));
    bake::Sheet sheet(low, detail, settings, result.distance_m);
    for (uint32_t triangle = 0; triangle < low.corners.count(); ++triangle) {
        sheet.add(triangle, result);
    }
    sheet.trace();
    const bake::Tally tally = sheet.tally();
    if (tally.covered_texels == 0) {
        throw Error("the UVs cover no texel of the map", plain.name,
                    "unwrap the mesh in a modelling program");
    }
    sheet.extend(settings.border);
    result.covered_texels = tally.covered_texels;
    result.missed_share =
        static_cast<double>(tally.missed_texels) / static_cast<double>(tally.covered_texels);
    result.overlapping_share = static_cast<double>(tally.overlapping) / static_cast<double>(tally.samples);
    result.map = sheet.image(settings.is_green_down);
    return result;
}

} // namespace estampe
