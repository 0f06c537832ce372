// SPDX-License-Identifier: MIT
#pragma once

// Where an eye must stand so that points lie within the page, for automatic framing and for views from a
// side.

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

/// Tangent of half the vertical angle of view of framed pictures; a wide picture keeps its sides from
/// stretching.
[[nodiscard]] double framed_half_height(double aspect);

/// The nearest eye from which every point lies in the window. Points are as ViewAxes::of() gives them.
[[nodiscard]] glm::dvec3 fit_eye(const std::vector<glm::dvec3>& points, const Window& window);

/// Moves the eye sideways until the picture's extent is in the middle of the window.
[[nodiscard]] glm::dvec3 centre_eye(const std::vector<glm::dvec3>& points, const Window& window,
                                    glm::dvec3 eye);

/// What every framed picture is made of.
struct SceneSurvey {
    Bounds whole; ///< of all vertices in the pose, never empty
    SurfaceCloud cloud;
    ViewAnalysis analysis;
};

/// Surveys the scene; nothing where it has nothing to draw. Throws Error when the scene is so large, small or
/// far away that it cannot be drawn. Cost: linear in vertices and triangles.
[[nodiscard]] std::optional<SceneSurvey> survey(const Scene& scene, const ScenePose& pose);

/// Which vertices a framed picture has to hold.
class Subject {
public:
    /// `analysis` is that of the scene; `whole` are its bounds in `pose`.
    Subject(const Scene& scene, const ScenePose& pose, const ViewAnalysis& analysis, const Bounds& whole);

    /// Bounds of all that is no stray.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

    /// Not if the vertex is a stray, or lies on the wide floor around the subject.
    [[nodiscard]] bool holds_vertex(const glm::dvec3& position) const;

    /// Whether a floor of the scene goes on at this place: one much wider than what stands on it.
    [[nodiscard]] bool has_floor_at(const glm::dvec3& position) const;

private:
    Bounds bounds_;
    Bounds standing_;
    bool has_floor_ = false;
    double slack_m_ = 0.0;
};

} // namespace estampe
