// SPDX-License-Identifier: MIT
#pragma once

// Sheets that tests simulate and inspect.

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "techniques/cloth/cloth.hpp"

namespace estampe::cloth {

inline constexpr double gravity_m_s2 = 9.81;

struct State {
    std::vector<glm::dvec3> places_m;
    std::vector<glm::dvec3> speeds_m_per_s;
    float calm_s = 0.0F; ///< how long all particles have been calm
};

/// One sheet on the tests' device.
class Lab {
public:
    explicit Lab(const Sheet& sheet) : sheet_(sheet), cloths_(test::shared_device(), {&sheet_, 1}) {}

    [[nodiscard]] Cloths& cloths() { return cloths_; }

    [[nodiscard]] const Sheet& sheet() const { return sheet_; }

    Surroundings air{.air_kg_m3 = 0.0F}; ///< no air unless a test sets some
    std::function<void(gpu::Graph&, Cloths::Handles&)>
        at_first; ///< passes before the steps of the first graph of a run, once

    State run(double seconds)
    {
        const auto wanted = static_cast<uint32_t>(std::lround(seconds / air.step_s));
        State state;
        for (uint32_t left = wanted; left > 0;) {
            const uint32_t now = std::min(left, cloths_.most_steps(air));
            gpu::Graph graph;
            Cloths::Handles handles = cloths_.import(graph);
            if (at_first) {
                std::exchange(at_first, nullptr)(graph, handles);
            }
            cloths_.add_steps(graph, handles, air, now);
            left -= now;
            air.time_s += static_cast<double>(now) * air.step_s;
            state = read(graph, handles);
        }
        return state;
    }

    State carry(const glm::mat4& place)
    {
        gpu::Graph graph;
        Cloths::Handles handles = cloths_.import(graph);
        cloths_.add_carry(graph, handles, {&place, 1});
        return read(graph, handles);
    }

    /// Moves the held particles.
    void move_to(const std::function<glm::vec3(glm::vec3)>& place)
    {
        std::vector<glm::vec3> targets;
        for (const glm::vec3& rest : sheet_.rest_m) {
            targets.push_back(place(rest));
        }
        cloths_.set_targets(test::shared_device(), targets);
    }

private:
    State read(gpu::Graph& graph, const Cloths::Handles& handles) const
    {
        const auto bytes = test::run_and_read(graph, std::array{handles.places, handles.speeds});
        State state{.calm_s = shared::cloth_rest_s};
        for (size_t i = 0; i < sheet_.rest_m.size(); ++i) {
            state.places_m.emplace_back(glm::vec3(test::items_of<glm::vec4>(bytes[0])[i]));
            state.speeds_m_per_s.emplace_back(glm::vec3(test::items_of<glm::vec4>(bytes[1])[i]));
            state.calm_s = std::min(state.calm_s, test::items_of<glm::vec4>(bytes[1])[i].w);
        }
        return state;
    }

    Sheet sheet_;
    Cloths cloths_;
};

/// A square metre that hangs down from y = 0 in the plane z = 0, its left corner at x = 0.
[[nodiscard]] inline Sheet hanging_square(uint32_t particles, const Cloth& cloth = {})
{
    Sheet sheet =
        grid_sheet(glm::uvec2(particles), {0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, cloth);
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    return sheet;
}

/// A horizontal sheet of one square metre at a height, centred on the y axis.
[[nodiscard]] inline Sheet lying_square(uint32_t particles, float height_m, const Cloth& cloth = {})
{
    return grid_sheet(glm::uvec2(particles), {-0.5F, height_m, -0.5F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F},
                      cloth);
}

/// A sheet with particles slightly displaced, so that it is no grid but nearly equal cloth.
[[nodiscard]] inline Sheet out_of_rank(Sheet sheet, float shift_m)
{
    for (size_t i = 0; i < sheet.rest_m.size(); ++i) {
        const auto n = static_cast<float>(i);
        sheet.rest_m[i] += shift_m * glm::vec3(std::sin(12.9F * n), std::sin(78.2F * n), 0.0F);
    }
    return sheet;
}

/// Relative change of the length of edges against the rest length, sorted.
[[nodiscard]] inline std::vector<double> strains(const Sheet& sheet, const State& state)
{
    std::vector<double> result;
    for (const glm::uvec3& triangle : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = triangle[k];
            const uint32_t b = triangle[(k + 1) % 3];
            const double rest_m = glm::distance(sheet.rest_m[a], sheet.rest_m[b]);
            result.push_back(std::abs(glm::distance(state.places_m[a], state.places_m[b]) / rest_m - 1.0));
        }
    }
    std::ranges::sort(result);
    return result;
}

[[nodiscard]] inline double percentile(const std::vector<double>& sorted, double share)
{
    return sorted.at(static_cast<size_t>(share * static_cast<double>(sorted.size() - 1)));
}

} // namespace estampe::cloth
