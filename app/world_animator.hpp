// SPDX-License-Identifier: MIT
#pragma once

// Animates the world that a command draws.

#include <memory>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "options.hpp"
#include "world/world.hpp"

namespace estampe::app {

/// A style that the user chose and edited: what differs from `base` overrides the world's style.
struct ChosenStyle {
    Style style;
    Style base;
};

/// Brings a world to the moment of each picture. A scene that is not a world stays as it is.
class WorldAnimator {
public:
    /// `draw`, which must outlive this, names what load_scene_of() made into `scene`.
    WorldAnimator(const DrawOptions& draw, const Scene& scene, worlds::Occasion occasion);
    ~WorldAnimator();
    WorldAnimator(const WorldAnimator&) = delete;
    WorldAnimator& operator=(const WorldAnimator&) = delete;

    /// Simulates up to a moment that is not drawn, as for the frames before those of a resumed film.
    void go_to(double time_s, const Camera& camera);

    /// Simulates up to a moment and shows it on the renderer. Returns the style of `draw` with the world's
    /// weather and light; the assignments of `draw` override both.
    [[nodiscard]] Style show(Renderer& renderer, double time_s, const Camera& camera);

    /// Simulates up to a moment and shows it on the renderer. Returns the style `chosen` with the world's
    /// weather and light; what the user edited overrides both.
    [[nodiscard]] Style show(Renderer& renderer, const ChosenStyle& chosen, double time_s,
                             const Camera& camera);

    /// See worlds::World::end_at().
    void end_at(double time_s);

    /// The user has edited the renderer's terrain: the world no longer deforms it.
    void leave_ground() { has_left_ground_ = true; }

    [[nodiscard]] bool has_left_ground() const { return has_left_ground_; }

    /// See worlds::World::forget_pressed().
    void forget_pressed();

    /// The camera of the world's own film in `scene`; null if there is none.
    [[nodiscard]] std::shared_ptr<const worlds::CameraPath> film_camera(const Scene& scene) const;

private:
    void show_world(Renderer& renderer, double time_s, const Camera& camera);

    const DrawOptions& draw_;
    std::unique_ptr<worlds::World> world_; ///< null for a file
    bool has_left_ground_ = false;
};

} // namespace estampe::app
