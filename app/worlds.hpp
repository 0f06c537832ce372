// SPDX-License-Identifier: MIT
#pragma once

// Worlds by their names, their options on the command line, and how the one that a command draws is animated.

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

/// The names of all worlds.
[[nodiscard]] std::vector<std::string> world_names();

/// The world that `scene` names; null if it names none, or if a file has this name, which has precedence.
[[nodiscard]] const worlds::Description* world_of(const std::string& scene);

/// The world that `draw` names, with the options that it has; null if it names a file. Throws Error for a
/// mistake in the options.
[[nodiscard]] std::unique_ptr<worlds::World> make_world(const DrawOptions& draw);

/// The options of a command that are those of a world.
class WorldOptions {
public:
    enum class Seed : uint8_t { is_an_option, is_left_out };

    /// Adds --world to the command and, unless it is left out, --seed; this object must outlive the parsing.
    void add_to(CLI::App& command, Seed seed = Seed::is_an_option);

    /// The assignments that were typed, --seed among them. Throws UsageError for options with a scene that is
    /// not a world, and for assignments that the world does not take.
    [[nodiscard]] std::vector<std::string> read(const std::string& scene) const;

private:
    std::vector<std::string> assignments_;
    std::optional<uint64_t> seed_;
};

/// Throws UsageError unless `scene` is a world that has a film of its own.
void check_has_film(const std::string& scene);

/// How to write an option of a world, if `key` is one: `--world hour=18`. Else empty. An empty value stands
/// for one that is not known.
[[nodiscard]] std::string world_option_as_typed(const std::string& key, const std::string& value);

/// "the worlds: NAME, NAME".
[[nodiscard]] std::string known_worlds();

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
