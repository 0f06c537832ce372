// SPDX-License-Identifier: MIT
#include "techniques/form/form.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <numbers>

#include "core/long_jobs.hpp"
#include "techniques/form/form_mesh.hpp"

namespace estampe::form {
namespace {

// A smooth body has a few singular triangles, whatever the number of its triangles.
constexpr uint32_t usual_singular_triangles = 64;

glm::dvec3 unit_or_y(const glm::vec3& v)
{
    const double length = glm::length(glm::dvec3(v));
    return length > 0.0 && std::isfinite(length) ? glm::dvec3(v) / length : glm::dvec3(0.0, 1.0, 0.0);
}

double period_in_radii(float period_m, double radius_m)
{
    const double period = static_cast<double>(period_m) / radius_m;
    return period > 0.0 && std::isfinite(period) ? std::clamp(period, 0.002, 4.0) : 0.25;
}

/// Stroke coordinates of a point, for meshes without a usable surface: the point's positions between the
/// planes of two sets of parallel planes.
glm::vec2 slice(const glm::vec3& position_m, const glm::dvec3& center_m, double period_m)
{
    const glm::dvec3 away = (glm::dvec3(position_m) - center_m) / period_m;
    const glm::vec2 phases(glm::dot(away, glm::dvec3(0.2998, 0.8995, -0.3198)),
                           glm::dot(away, glm::dvec3(0.7993, 0.4196, 0.4296)));
    const bool is_sane = std::abs(phases.x) < 1e6F && std::abs(phases.y) < 1e6F;
    return is_sane ? phases : glm::vec2(0.0F);
}

void slice_solid(FormField& field, std::span<const glm::vec3> positions, std::span<const uint32_t> indices,
                 const Mesh& mesh, double period_m)
{
    for (size_t t = 0; t < field.corners.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t index = indices[3 * t + k];
            field.corners[t][k] =
                index < positions.size() ? slice(positions[index], mesh.center_m, period_m) : glm::vec2(0.0F);
        }
    }
}

bool is_finite(const Stripes& stripes)
{
    return std::all_of(stripes.corners.begin(), stripes.corners.end(), [](const auto& corners) {
        return std::all_of(corners.begin(), corners.end(),
                           [](double phase) { return std::abs(phase) < 1e6; });
    });
}

} // namespace

FormField follow_form(std::span<const glm::vec3> positions_m, std::span<const uint32_t> triangle_indices,
                      const FormOptions& options)
{
    FormField field;
    field.corners.resize(triangle_indices.size() / 3);
    field.is_faulty.assign(field.corners.size(), 0);
    const Mesh mesh = build_mesh(positions_m, triangle_indices);
    field.faults.dropped_triangles = mesh.dropped_triangles;
    field.faults.crease_edges = mesh.crease_edges;
    const double period = period_in_radii(options.period_m, mesh.radius_m);
    slice_solid(field, positions_m, triangle_indices, mesh, period * mesh.radius_m);
    if (mesh.triangles.empty()) {
        return field;
    }
    const double smoothing =
        std::isfinite(options.smoothing) ? std::clamp<double>(options.smoothing, 0.05, 100.0) : 1.0;
    const Directions directions = find_directions(mesh, unit_or_y(options.up), smoothing * period);
    auto along = std::async(launch_if_possible,
                            [&] { return find_stripes(mesh, directions, 0.0, period, options.seed + 1); });
    const Stripes a = find_stripes(mesh, directions, 0.5 * std::numbers::pi, period, options.seed);
    const Stripes b = along.get();
    if (!is_finite(a) || !is_finite(b)) {
        return field;
    }
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const double index = singularity(mesh, directions, t);
        field.faults.singular_triangles += index != 0.0 ? 1 : 0;
        field.faults.branch_triangles_a += a.branches[t] != 0 ? 1 : 0;
        field.faults.branch_triangles_b += b.branches[t] != 0 ? 1 : 0;
        field.faults.index_sum += static_cast<float>(index);
        field.is_faulty[mesh.sources[t]] = index != 0.0 || a.branches[t] != 0 || b.branches[t] != 0 ? 1 : 0;
    }
    const auto singular = static_cast<double>(field.faults.singular_triangles);
    if (singular >
            static_cast<double>(options.most_singular_share) * static_cast<double>(mesh.triangles.size()) &&
        field.faults.singular_triangles > usual_singular_triangles) {
        field.is_faulty.assign(field.corners.size(), 0);
        return field;
    }
    field.follows_form = true;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            field.corners[mesh.sources[t]][k] = glm::vec2(a.corners[t][k], b.corners[t][k]);
        }
    }
    return field;
}

} // namespace estampe::form
