// SPDX-License-Identifier: MIT
#pragma once

// What goes on in a world that the program makes, while it is drawn.

#include <cstdint>
#include <memory>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "options.hpp"

namespace temple {
class World;
}

namespace estampe::app {

/// What it is drawn for: in a picture the sun stands, in a film it goes on, on a walk slowly.
enum class Occasion : uint8_t { picture, film, walk };

/// A style that was chosen, and changed by hand: what differs from `base` is over all that a world says.
struct ChosenStyle {
    Style style;
    Style base;
};

class Living {
public:
    /// Of what `draw` names, which is to outlive it; a file has nothing that goes on.
    Living(const DrawOptions& draw, const Scene& scene, Occasion occasion);
    ~Living();
    Living(const Living&) = delete;
    Living& operator=(const Living&) = delete;

    /// Brings it to a moment that is not drawn, as before the first frame of a film that is resumed.
    void go_to(double time_s, const Camera& camera);

    /// Brings it to a moment and shows that on the renderer. Returns the style of `draw` with what of it is
    /// the style's; what was asked for by --set is over both.
    [[nodiscard]] Style show(Renderer& renderer, double time_s, const Camera& camera);

    /// The same of another style.
    [[nodiscard]] Style show(Renderer& renderer, const ChosenStyle& chosen, double time_s,
                             const Camera& camera);

    /// The renderer was given another ground, which is not to be pressed.
    void leave_ground() { has_left_ground_ = true; }

    [[nodiscard]] bool has_left_ground() const { return has_left_ground_; }

    /// The world that is made; null for a file.
    [[nodiscard]] temple::World* world() { return world_.get(); }

private:
    void show_world(Renderer& renderer, double time_s, const Camera& camera);

    const DrawOptions& draw_;
    std::unique_ptr<temple::World> world_;
    bool has_left_ground_ = false;
};

} // namespace estampe::app
