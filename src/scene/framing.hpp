// SPDX-License-Identifier: MIT
#pragma once

// Computes the eye position from which given points fit on the page, for automatic framing and for views from
// a side.

#include <optional>
#include <vector>

#include "scene/view_analysis/view_analysis.hpp"

namespace estampe {

/// Margin between the subject and the edge of a framed picture, as a share of the shorter side of the
/// picture.
inline constexpr double framed_margin = 0.08;

/// The part of the picture that the subject may fill, as tangents of the half angles of view.
struct Window {
    double side = 0.0;
    double top = 0.0;
    double bottom = 0.0;
};

/// Returns the tangent of half the vertical angle of view of a framed picture. Wide pictures have a smaller
/// angle, so that perspective does not stretch objects near the sides.
[[nodiscard]] double framed_half_height(double aspect);

/// Returns the eye position closest to `points` from which all points are inside the window, but not closer
/// than a twentieth of their depth. `points` are in camera space, see ViewAxes::of().
[[nodiscard]] glm::dvec3 fit_eye(const std::vector<glm::dvec3>& points, const Window& window);

/// Moves the eye sideways until the projected points are centred in the window.
[[nodiscard]] glm::dvec3 centre_eye(const std::vector<glm::dvec3>& points, const Window& window,
                                    glm::dvec3 eye);

/// Data about a scene that automatic framing uses.
struct SceneSurvey {
    Bounds whole; ///< bounds of all vertices in the given pose; never empty
    SurfaceCloud cloud;
    ViewAnalysis analysis;
};

/// Collects what automatic framing needs to know about a scene. Returns nothing if the scene has nothing to
/// draw. Throws Error when the scene is so large, small or far away that it cannot be drawn. Cost: linear in
/// vertices and triangles.
[[nodiscard]] std::optional<SceneSurvey> survey(const Scene& scene, const ScenePose& pose);

/// Decides which vertices a framed picture must contain.
class Subject {
public:
    /// `analysis` is the analysis of `scene`. `whole` are the bounds of the scene in `pose`.
    Subject(const Scene& scene, const ScenePose& pose, const ViewAnalysis& analysis, const Bounds& whole);

    /// Bounds of the scene without strays, which are small parts far away from the rest.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

    /// Returns whether the picture must contain the vertex. Returns false for strays (small parts far away)
    /// and for a wide floor around the subject.
    [[nodiscard]] bool holds_vertex(const glm::dvec3& position) const;

    /// Returns whether `position` is on a floor that is much wider than the objects on it.
    [[nodiscard]] bool has_floor_at(const glm::dvec3& position) const;

private:
    Bounds bounds_;
    Bounds standing_;
    bool has_floor_ = false;
    double slack_m_ = 0.0;
};

/// Returns the points to frame in place of `points`, which are those of the subject relative to its
/// centre in camera space, if they have no extent: a small box about a single place, or the corners of the
/// bounds where none of its vertices is left, as when motion has taken all of them out of the part that was
/// chosen at rest. Nothing if `points` can be framed.
[[nodiscard]] std::optional<std::vector<glm::dvec3>>
stand_in_points(const std::vector<glm::dvec3>& points, const Subject& subject, const ViewAxes& axes);

} // namespace estampe
