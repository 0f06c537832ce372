// SPDX-License-Identifier: MIT
#pragma once

// Computes the position of an eye that sees given points within the page, for automatic framing and for views
// from a side.

#include <optional>
#include <vector>

#include "scene/view_analysis/view_analysis.hpp"

namespace estampe {

/// Margin of framed pictures, as a share of the shorter side.
inline constexpr double framed_margin = 0.08;

/// Tangents of the half angles that the subject may fill.
struct Window {
    double side = 0.0;
    double top = 0.0;
    double bottom = 0.0;
};

/// Tangent of half the vertical angle of view of framed pictures. In wide pictures it is smaller, so that
/// their sides are not stretched.
[[nodiscard]] double framed_half_height(double aspect);

/// The nearest eye from which every point lies in the window. `points` are in camera space, see
/// ViewAxes::of().
[[nodiscard]] glm::dvec3 fit_eye(const std::vector<glm::dvec3>& points, const Window& window);

/// Moves the eye sideways until the points' extent is in the middle of the window.
[[nodiscard]] glm::dvec3 centre_eye(const std::vector<glm::dvec3>& points, const Window& window,
                                    glm::dvec3 eye);

/// The facts about a scene that automatic framing uses.
struct SceneSurvey {
    Bounds whole; ///< bounds of all vertices in the pose, never empty
    SurfaceCloud cloud;
    ViewAnalysis analysis;
};

/// Surveys the scene; returns nothing if the scene has nothing to draw. Throws Error when the scene is so
/// large, small or far away that it cannot be drawn. Cost: linear in vertices and triangles.
[[nodiscard]] std::optional<SceneSurvey> survey(const Scene& scene, const ScenePose& pose);

/// Decides which vertices a framed picture must contain.
class Subject {
public:
    /// `analysis` is that of the scene, `whole` the bounds of the scene in `pose`.
    Subject(const Scene& scene, const ScenePose& pose, const ViewAnalysis& analysis, const Bounds& whole);

    /// Bounds of everything except strays.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

    /// False if the vertex is a stray or lies on the wide floor around the subject.
    [[nodiscard]] bool holds_vertex(const glm::dvec3& position) const;

    /// Whether the scene has a floor at this position that is much wider than the objects on it.
    [[nodiscard]] bool has_floor_at(const glm::dvec3& position) const;

private:
    Bounds bounds_;
    Bounds standing_;
    bool has_floor_ = false;
    double slack_m_ = 0.0;
};

} // namespace estampe
