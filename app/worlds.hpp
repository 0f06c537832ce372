// SPDX-License-Identifier: MIT
#pragma once

// Names of worlds, their options on the command line, and the animation of the world that a command draws.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "options.hpp"
#include "world/registry.hpp"
#include "world/world.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// Returns the names of all worlds.
[[nodiscard]] std::vector<std::string> world_names();

/// Returns the world named `scene`; null if there is none, or if a file has this name, because files take
/// precedence.
[[nodiscard]] const worlds::Description* world_of(const std::string& scene);

/// Makes the world that `draw` names, with its options; null if `draw` names a file. Throws Error for invalid
/// options.
[[nodiscard]] std::unique_ptr<worlds::World> make_world(const DrawOptions& draw);

/// The options --world and --seed, for a command that can draw a world.
class WorldOptions {
public:
    enum class Seed : uint8_t { is_an_option, is_left_out };

    /// Adds --world to the command and, unless it is left out, --seed; this object must outlive the parsing.
    void add_to(CLI::App& command, Seed seed = Seed::is_an_option);

    /// Returns the assignments of world options that were typed, including --seed. Throws UsageError for
    /// options with a scene that is not a world, and for assignments that the world does not accept.
    [[nodiscard]] std::vector<std::string> read(const std::string& scene) const;

private:
    std::vector<std::string> assignments_;
    std::optional<std::string> seed_;
};

/// Checks that a world has a film. Throws UsageError unless `scene` is a world with a film of its own.
void check_has_film(const std::string& scene);

/// Returns the text with which the user sets an option of a world, such as `--world hour=18`. Returns an
/// empty text if `key` is not an option of the world. If `value` is empty, the value is unknown.
[[nodiscard]] std::string world_option_as_typed(const std::string& key, const std::string& value);

/// Returns the list of worlds for messages: "the worlds: NAME, NAME".
[[nodiscard]] std::string known_worlds();

/// A style that the user chose and edited; its differences from `base` override the world's style.
struct ChosenStyle {
    Style style;
    Style base;
};

/// Animates a world to the time of each picture. Does nothing for a scene that is not a world.
class WorldAnimator {
public:
    /// Prepares to animate a scene. `scene` is the result of load_scene_of() for `draw`; `draw` must outlive
    /// this object.
    WorldAnimator(const DrawOptions& draw, const Scene& scene, worlds::Occasion occasion);
    ~WorldAnimator();
    WorldAnimator(const WorldAnimator&) = delete;
    WorldAnimator& operator=(const WorldAnimator&) = delete;

    /// Simulates the world up to a time without drawing, for example to continue a film that was stopped.
    void go_to(double time_s, const Camera& camera);

    /// Simulates the world up to a time and shows it on the renderer. Returns the style of `draw` with the
    /// world's weather and light; the assignments of `draw` override both.
    [[nodiscard]] Style show(Renderer& renderer, double time_s, const Camera& camera);

    /// Simulates the world up to a time and shows it on the renderer. Returns the style `chosen` with the
    /// world's weather and light; what the user edited overrides both.
    [[nodiscard]] Style show(Renderer& renderer, const ChosenStyle& chosen, double time_s,
                             const Camera& camera);

    /// Tells the world that the walker has reached its end, see worlds::World::end_at().
    void end_at(double time_s);

    /// Makes the world stop changing the terrain. Call this function when the user has edited the renderer's
    /// terrain.
    void leave_ground() { has_left_ground_ = true; }

    [[nodiscard]] bool has_left_ground() const { return has_left_ground_; }

    /// Tells the world that the terrain has changed, see worlds::World::forget_pressed().
    void forget_pressed();

    /// Returns the camera of the world's own film in `scene`; null if there is none.
    [[nodiscard]] std::shared_ptr<const worlds::CameraPath> film_camera(const Scene& scene) const;

private:
    void show_world(Renderer& renderer, double time_s, const Camera& camera);

    const DrawOptions& draw_;
    std::unique_ptr<worlds::World> world_; ///< The world that is animated; null for a scene file
    bool has_left_ground_ = false;
};

} // namespace estampe::app
