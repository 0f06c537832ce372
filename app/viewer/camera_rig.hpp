// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::viewer {

enum class CameraMode : uint8_t {
    orbit, ///< The camera moves around its target
    fly,   ///< The camera moves in the direction of view
    walk,  ///< The camera moves over the ground
};

/// Sides from which to look at the scene, as in the viewer f3d.
enum class ViewSide : uint8_t { front, back, left, right, top, bottom, isometric };

/// A camera with the controls orbit, fly and walk. The camera rig is independent of windows: drags are
/// measured in shares of the view's height, so that a window's size does not change their effect.
class CameraRig {
public:
    /// Function that returns the height of the ground below a place, if there is any; for CameraMode::walk.
    using Ground = std::function<std::optional<double>(const glm::dvec3& place)>;

    /// Replaces the scene, whose first camera is `home`.
    void set_scene(const Camera& home, const Bounds& bounds, Ground ground = {});
    /// Sets the camera's place; in walk mode the camera keeps its height until it moves.
    void place(const Camera& camera);

    [[nodiscard]] const Camera& camera() const { return camera_; }

    [[nodiscard]] CameraMode mode() const { return mode_; }

    void set_mode(CameraMode mode);

    /// Turns the camera by a drag of the pointer; x points to the right, y down. A drag in pan() moves the
    /// camera sideways.
    void turn(const glm::dvec2& drag);
    void pan(const glm::dvec2& drag);
    /// Moves the camera closer by this many steps of the mouse wheel; a negative number moves the camera
    /// away. In parallel projection the view is enlarged; in fly and walk mode the camera moves ahead.
    void zoom(double steps);
    void roll(double angle_rad);

    /// Moves the camera for `seconds` at walking speed along `direction`: x to the right, y up, z ahead, each
    /// from -1 to 1.
    void go(const glm::dvec3& direction, double seconds, bool is_fast);

    void go_home() { place(home_); }

    void look_from(ViewSide side);
    void toggle_projection();

private:
    [[nodiscard]] glm::dvec3 ahead() const;
    [[nodiscard]] glm::dvec3 world_up() const;
    [[nodiscard]] double step_m() const;
    void look_along(const glm::dvec3& direction);
    void stand();

    Camera home_;
    Camera camera_;
    Bounds bounds_;
    Ground ground_;
    CameraMode mode_ = CameraMode::orbit;
    double eye_height_m_ = 1.7;
};

/// The ground of a scene for walking: the upper sides of all surfaces that never move.
class Ground {
public:
    /// Collects the ground of a scene. Cost: linear in triangles.
    explicit Ground(const Scene& scene);

    /// Returns the height of the highest surface that is straight below a place; nothing if there is none.
    /// Cost: linear in triangles that are not vertical, about a millisecond for half a million.
    [[nodiscard]] std::optional<double> height_under(const glm::dvec3& place) const;

private:
    glm::dvec3 anchor_{0.0};
    std::vector<std::array<glm::vec3, 3>> triangles_;
};

} // namespace estampe::viewer
