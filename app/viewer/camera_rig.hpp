// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::viewer {

enum class CameraMode : uint8_t {
    orbit, ///< goes around what it looks at
    fly,   ///< goes where it looks
    walk,  ///< goes over the ground
};

/// Sides to look from, as f3d has them.
enum class ViewSide : uint8_t { front, back, left, right, top, bottom, isometric };

/// A camera in the hands of a person: orbit, fly and walk. Knows no window: drags come as shares of the
/// view's height, so that one feels as another on any size.
class CameraRig {
public:
    /// Height of the ground under a place, if there is any; for CameraMode::walk.
    using Ground = std::function<std::optional<double>(const glm::dvec3& place)>;

    /// Another scene: `home` is where it is seen from at first.
    void set_scene(const Camera& home, const Bounds& bounds, Ground ground = {});
    /// A place to look from; a walker stays at its height until it moves.
    void place(const Camera& camera);

    [[nodiscard]] const Camera& camera() const { return camera_; }

    [[nodiscard]] CameraMode mode() const { return mode_; }

    void set_mode(CameraMode mode);

    /// Drags of the pointer, to the right and down.
    void turn(const glm::dvec2& drag);
    void pan(const glm::dvec2& drag);
    /// Nearer by so many steps of the wheel, or farther; in parallel projection larger. Fly and walk go
    /// ahead by it.
    void zoom(double steps);
    void roll(double angle_rad);

    /// A second's worth of going: x to the right, y up, z ahead, of -1 to 1, for `seconds`.
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

/// What one can stand on in a scene: the upper sides of what never moves.
class Ground {
public:
    /// Cost: linear in triangles.
    explicit Ground(const Scene& scene);

    /// Height of the first surface straight below a place; nothing where there is none. Cost: linear in
    /// triangles that are not upright, about a millisecond for half a million.
    [[nodiscard]] std::optional<double> height_under(const glm::dvec3& place) const;

private:
    glm::dvec3 anchor_{0.0};
    std::vector<std::array<glm::vec3, 3>> triangles_;
};

} // namespace estampe::viewer
