// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/bending.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <tbb/parallel_for.h>

#include "scene/smooth_surface.hpp"
#include "shaders/view_bends_comp.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {
namespace {

// Radius within which curvature is smoothed, as a share of the object's size.
constexpr float reach_share = 0.0075F;
constexpr uint32_t most_rounds = 16;
// Share by which each smoothing round moves a vertex's value towards the mean of the neighbouring vertices.
constexpr float mean_step = 0.85F;
constexpr uint32_t change_rounds = 2;

struct Frame {
    glm::vec3 normal{0.0F};
    glm::vec3 x{0.0F};
    glm::vec3 y{0.0F};
};

/// Tangent frame and area of a triangle.
struct Face {
    Frame frame;
    float area = 0.0F;
};

/// Rotates a first tangent frame by the shortest rotation that takes the frame's normal to the normal of a
/// second frame. Returns the first frame's x axis, rotated, in coordinates of the second frame; or nothing if
/// the two normals are opposite.
std::optional<glm::vec2> turn_between(const Frame& from, const Frame& to)
{
    const float cosine = glm::dot(from.normal, to.normal);
    if (cosine < -0.99F) {
        return std::nullopt;
    }
    const glm::vec3 x = from.x - glm::dot(from.x, to.normal) / (1.0F + cosine) * (from.normal + to.normal);
    return glm::vec2(glm::dot(x, to.x), glm::dot(x, to.y));
}

glm::vec3 turned(const glm::vec3& form, const glm::vec2& turn)
{
    const float c = turn.x;
    const float s = turn.y;
    return {c * c * form.x - 2.0F * c * s * form.y + s * s * form.z,
            c * s * (form.x - form.z) + (c * c - s * s) * form.y,
            s * s * form.x + 2.0F * c * s * form.y + c * c * form.z};
}

/// Contracts a third-order derivative of curvature with the direction `way`. The result is a second
/// fundamental form.
glm::vec3 along(const glm::vec4& change, const glm::vec2& way)
{
    return glm::vec3(change.x, change.y, change.z) * way.x + glm::vec3(change.y, change.z, change.w) * way.y;
}

float between(const glm::vec3& form, const glm::vec2& a, const glm::vec2& b)
{
    return form.x * a.x * b.x + form.y * (a.x * b.y + a.y * b.x) + form.z * a.y * b.y;
}

glm::vec4 turned(const glm::vec4& change, const glm::vec2& turn)
{
    const glm::vec2 x(turn.x, -turn.y);
    const glm::vec2 y(turn.y, turn.x);
    const glm::vec3 along_x = along(change, x);
    const glm::vec3 along_y = along(change, y);
    return {between(along_x, x, x), between(along_x, x, y), between(along_x, y, y), between(along_y, y, y)};
}

class BendingFinder {
public:
    explicit BendingFinder(const RestSurface& surface)
        : surface_(surface), triangles_(surface.mesh.triangles), bendings_(surface.positions.size()),
          faces_(triangles_.size())
    {
    }

    std::vector<Bending> run()
    {
        list_corners();
        for_all(faces_.size(), [this](size_t t) { measure_face(t); });
        for_all(bendings_.size(), [this](size_t v) { set_frame(v); });
        find_forms();
        smooth_forms();
        find_changes();
        return std::move(bendings_);
    }

private:
    template <class Task>
    static void for_all(size_t count, const Task& task)
    {
        tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 512),
                          [&](const tbb::blocked_range<size_t>& range) {
                              for (size_t i = range.begin(); i != range.end(); ++i) {
                                  task(i);
                              }
                          });
    }

    [[nodiscard]] uint32_t vertex(size_t triangle, uint32_t corner) const
    {
        return triangles_[triangle][static_cast<int>(corner % 3)];
    }

    [[nodiscard]] glm::vec3 place(size_t triangle, uint32_t corner) const
    {
        return surface_.positions[vertex(triangle, corner)];
    }

    /// Lists the triangle corners that meet at each vertex.
    void list_corners()
    {
        first_corner_.assign(surface_.positions.size() + 1, 0);
        const auto each_corner = [this](const auto& task) {
            for (uint32_t t = 0; t < triangles_.size(); ++t) {
                for (uint32_t k = 0; k < 3 && surface_.sizes[triangles_[t].x] > 0.0F; ++k) {
                    task(vertex(t, k), side_of(t, k));
                }
            }
        };
        each_corner([this](uint32_t v, uint32_t) { ++first_corner_[v + 1]; });
        std::partial_sum(first_corner_.begin(), first_corner_.end(), first_corner_.begin());
        corners_.resize(first_corner_.back());
        std::vector<uint32_t> next(first_corner_.begin(), first_corner_.end() - 1);
        each_corner([&](uint32_t v, uint32_t corner) { corners_[next[v]++] = corner; });
    }

    [[nodiscard]] std::span<const uint32_t> corners_at(size_t v) const
    {
        return std::span(corners_).subspan(first_corner_[v], first_corner_[v + 1] - first_corner_[v]);
    }

    void measure_face(size_t t)
    {
        const glm::vec3 edge = place(t, 1) - place(t, 0);
        const glm::vec3 cross = glm::cross(edge, place(t, 2) - place(t, 0));
        const float twice_area = glm::length(cross);
        if (twice_area > 0.0F) {
            const float sense = surface_.runs_clockwise[t] != 0 ? -1.0F : 1.0F;
            const glm::vec3 normal = sense / twice_area * cross;
            const glm::vec3 x = glm::normalize(edge);
            faces_[t] = {{normal, x, glm::cross(normal, x)}, 0.5F * twice_area};
        }
    }

    void set_frame(size_t v)
    {
        glm::dvec3 sum(0.0);
        for (const uint32_t corner : corners_at(v)) {
            // The normal of each triangle is weighted by the angle between the triangle's sides and by the
            // sides' lengths. The resulting vertex normal is exact on a sphere (Max 1999).
            const glm::dvec3 a(place(corner >> 2U, (corner & 3U) + 1) - place(corner >> 2U, corner & 3U));
            const glm::dvec3 b(place(corner >> 2U, (corner & 3U) + 2) - place(corner >> 2U, corner & 3U));
            const double lengths = glm::dot(a, a) * glm::dot(b, b);
            const Face& face = faces_[corner >> 2U];
            sum += lengths > 0.0
                       ? 2.0 * static_cast<double>(face.area) / lengths * glm::dvec3(face.frame.normal)
                       : glm::dvec3(0.0);
        }
        const double length = glm::length(sum);
        if (!(length > 0.0) || !std::isfinite(length)) {
            return;
        }
        Bending& bending = bendings_[v];
        bending.normal = glm::vec3(sum / length);
        const glm::vec3 axis =
            std::abs(bending.normal.x) < 0.6F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
        bending.tangent = glm::normalize(glm::cross(bending.normal, axis));
    }

    [[nodiscard]] Frame frame_at(size_t v) const
    {
        const Bending& bending = bendings_[v];
        return {bending.normal, bending.tangent, glm::cross(bending.normal, bending.tangent)};
    }

    [[nodiscard]] bool has_frame(size_t v) const { return bendings_[v].normal != glm::vec3(0.0F); }

    [[nodiscard]] bool is_usable(size_t t) const
    {
        return faces_[t].area > 0.0F && has_frame(vertex(t, 0)) && has_frame(vertex(t, 1)) &&
               has_frame(vertex(t, 2));
    }

    /// The second fundamental form of a triangle, from the differences of the normals at the ends of the
    /// triangle's sides.
    [[nodiscard]] glm::vec3 form_of_face(size_t t) const
    {
        if (!is_usable(t)) {
            return glm::vec3(0.0F);
        }
        const Frame& frame = faces_[t].frame;
        std::array<SideChange, 3> sides;
        for (uint32_t k = 0; k < 3; ++k) {
            const glm::vec3 edge = place(t, k + 1) - place(t, k);
            const glm::vec3 change = bendings_[vertex(t, k + 1)].normal - bendings_[vertex(t, k)].normal;
            sides.at(k) = {{glm::dot(edge, frame.x), glm::dot(edge, frame.y)},
                           {glm::dot(change, frame.x), glm::dot(change, frame.y)}};
        }
        return glm::vec3(second_form(sides, 1e-9));
    }

    /// Mean of a value over the triangles around a vertex, weighted by area, in the tangent frame of the
    /// vertex.
    template <class Value>
    [[nodiscard]] Value mean_of_faces(size_t v, const std::vector<Value>& of_face) const
    {
        Value sum(0.0F);
        float weight = 0.0F;
        for (const uint32_t corner : corners_at(v)) {
            const Face& face = faces_[corner >> 2U];
            const auto turn = is_usable(corner >> 2U) ? turn_between(face.frame, frame_at(v)) : std::nullopt;
            if (turn) {
                sum += face.area * turned(of_face[corner >> 2U], *turn);
                weight += face.area;
            }
        }
        return weight > 0.0F ? sum / weight : Value(0.0F);
    }

    void find_forms()
    {
        std::vector<glm::vec3> of_face(faces_.size());
        for_all(faces_.size(), [&](size_t t) { of_face[t] = form_of_face(t); });
        for_all(bendings_.size(), [&](size_t v) {
            if (has_frame(v)) {
                bendings_[v].form = mean_of_faces(v, of_face);
            }
        });
    }

    /// Number of smoothing rounds that a vertex needs. Each round extends the smoothing by half the length of
    /// an edge.
    [[nodiscard]] float rounds_wanted(size_t v) const
    {
        float squares = 0.0F;
        float count = 0.0F;
        for (const uint32_t corner : corners_at(v)) {
            const glm::vec3 edge = place(corner >> 2U, (corner & 3U) + 1) - place(corner >> 2U, corner & 3U);
            squares += glm::dot(edge, edge);
            count += 1.0F;
        }
        const float reach = reach_share * surface_.sizes[v];
        return squares > 0.0F ? std::min(2.0F * reach * reach * count / squares, float{most_rounds}) : 0.0F;
    }

    /// Mean of a value over the neighbouring vertices, in the tangent frame of the vertex.
    template <class Value>
    [[nodiscard]] Value mean_around(size_t v, Value Bending::*value) const
    {
        Value sum(0.0F);
        float count = 0.0F;
        for (const uint32_t corner : corners_at(v)) {
            for (const uint32_t step : {1U, 2U}) {
                const uint32_t other = vertex(corner >> 2U, (corner & 3U) + step);
                const auto turn =
                    has_frame(other) ? turn_between(frame_at(other), frame_at(v)) : std::nullopt;
                if (turn) {
                    sum += turned(bendings_[other].*value, *turn);
                    count += 1.0F;
                }
            }
        }
        return count > 0.0F ? sum / count : bendings_[v].*value;
    }

    template <class Value>
    void smooth(Value Bending::*value, const std::vector<float>& steps)
    {
        std::vector<Value> next(bendings_.size());
        for_all(bendings_.size(), [&](size_t v) {
            const Value& own = bendings_[v].*value;
            next[v] = has_frame(v) && steps[v] > 0.0F ? glm::mix(own, mean_around(v, value), steps[v]) : own;
        });
        for_all(bendings_.size(), [&](size_t v) { bendings_[v].*value = next[v]; });
    }

    void smooth_forms()
    {
        std::vector<float> steps(bendings_.size());
        for_all(steps.size(), [&](size_t v) { steps[v] = rounds_wanted(v); });
        const float most = steps.empty() ? 0.0F : *std::ranges::max_element(steps);
        const auto rounds = static_cast<uint32_t>(std::ceil(most));
        for (float& step : steps) {
            step *= mean_step / static_cast<float>(std::max(rounds, 1U));
        }
        for (uint32_t i = 0; i < rounds; ++i) {
            smooth(&Bending::form, steps);
        }
    }

    /// The derivative of curvature on a triangle, a least squares fit to the differences of the second
    /// fundamental forms at the ends of its sides.
    [[nodiscard]] glm::vec4 change_of_face(size_t t) const
    {
        if (!is_usable(t)) {
            return glm::vec4(0.0F);
        }
        const Frame& frame = faces_[t].frame;
        std::array<glm::vec3, 3> forms;
        for (uint32_t k = 0; k < 3; ++k) {
            const auto turn = turn_between(frame_at(vertex(t, k)), frame);
            forms.at(k) = turn ? turned(bendings_[vertex(t, k)].form, *turn) : glm::vec3(0.0F);
        }
        glm::dmat4 squares(0.0);
        glm::dvec4 right(0.0);
        for (uint32_t k = 0; k < 3; ++k) {
            const glm::vec3 edge = place(t, k + 1) - place(t, k);
            const glm::dvec2 e(glm::dot(edge, frame.x), glm::dot(edge, frame.y));
            const glm::dvec3 change(forms.at((k + 1) % 3) - forms.at(k));
            const std::array<glm::dvec4, 3> rows{glm::dvec4(e.x, e.y, 0.0, 0.0),
                                                 glm::dvec4(0.0, e.x, e.y, 0.0),
                                                 glm::dvec4(0.0, 0.0, e.x, e.y)};
            for (int i = 0; i < 3; ++i) {
                // The form is symmetric: the entry xy counts twice, for xy and for yx.
                const double weight = i == 1 ? 2.0 : 1.0;
                squares += weight * glm::outerProduct(rows.at(static_cast<size_t>(i)),
                                                      rows.at(static_cast<size_t>(i)));
                right += weight * change[i] * rows.at(static_cast<size_t>(i));
            }
        }
        const double size = squares[0][0] + squares[3][3];
        const bool is_sound = std::abs(glm::determinant(squares)) > 1e-12 * size * size * size * size;
        return is_sound ? glm::vec4(glm::inverse(squares) * right) : glm::vec4(0.0F);
    }

    void find_changes()
    {
        std::vector<glm::vec4> of_face(faces_.size());
        for_all(faces_.size(), [&](size_t t) { of_face[t] = change_of_face(t); });
        for_all(bendings_.size(), [&](size_t v) {
            if (has_frame(v)) {
                bendings_[v].change = mean_of_faces(v, of_face);
            }
        });
        const std::vector<float> steps(bendings_.size(), 0.5F);
        for (uint32_t i = 0; i < change_rounds; ++i) {
            smooth(&Bending::change, steps);
        }
    }

    const RestSurface& surface_;
    std::span<const glm::uvec4> triangles_;
    std::vector<Bending> bendings_;
    std::vector<Face> faces_;
    /// For each vertex: index in `corners_` of the vertex's first triangle corner.
    std::vector<uint32_t> first_corner_;
    std::vector<uint32_t> corners_; ///< triangle corners, sorted by vertex: triangle << 2 | corner
};

/// Converts a curvature at a vertex to the coordinate frame with the x axis `tangent`.
Bending with_tangent(const Bending& bending, const glm::vec3& tangent)
{
    const glm::vec3 third = glm::cross(bending.normal, tangent);
    const glm::vec2 turn(glm::dot(bending.tangent, tangent), glm::dot(bending.tangent, third));
    return {bending.normal, tangent, turned(bending.form, turn), turned(bending.change, turn)};
}

} // namespace

std::vector<Bending> find_bending(const RestSurface& surface)
{
    return BendingFinder(surface).run();
}

PrincipalCurvatures principal_curvatures(const glm::vec3& form)
{
    const float mean = 0.5F * (form.x + form.z);
    const float half = 0.5F * (form.x - form.z);
    const float radius = std::hypot(half, form.y);
    const float angle = 0.5F * std::atan2(form.y, half);
    return {mean + radius, mean - radius, {std::cos(angle), std::sin(angle)}};
}

float change_along(const glm::vec4& change, const glm::vec2& way)
{
    return between(along(change, way), way, way);
}

std::vector<shared::VertexBending> vertex_bendings(const RestSurface& surface,
                                                   std::span<const Bending> bendings)
{
    std::vector<shared::VertexBending> result(bendings.size());
    for (uint32_t v = 0; v < result.size(); ++v) {
        result[v].neighbor = v;
    }
    for (const glm::uvec4& corners : surface.mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t v = corners[k];
            const Bending& bending = bendings[v];
            if (result[v].neighbor != v || bending.normal == glm::vec3(0.0F)) {
                continue;
            }
            const glm::vec3 way = surface.positions[corners[(k + 1) % 3]] - surface.positions[v];
            const glm::vec3 flat = way - bending.normal * glm::dot(bending.normal, way);
            if (glm::length(flat) > 0.0F) {
                const Bending seen = with_tangent(bending, glm::normalize(flat));
                const float size = surface.sizes[v];
                result[v] = {corners[(k + 1) % 3], size * seen.form, size * size * seen.change};
            }
        }
    }
    return result;
}

gpu::BufferId add_view_bends(gpu::Graph& graph, gpu::BufferId frame, gpu::BufferId posed_vertices,
                             gpu::BufferId bendings, uint32_t vertex_count, const SuggestiveCut& cut)
{
    auto pass = graph.compute("contour/view bends", shaders::view_bends_comp);
    pass.uniform(frame).sample(posed_vertices).sample(bendings);
    const gpu::BufferId bends =
        pass.write(graph.buffer("contour/view bends", list_of(vertex_count, sizeof(glm::vec2))));
    pass.push(shared::ViewBendConstants{.vertex_count = vertex_count,
                                        .least_growth = cut.least_growth,
                                        .least_sine = std::sin(glm::radians(cut.least_angle_deg))})
        .dispatch_items(vertex_count);
    return bends;
}

} // namespace estampe::contour
