// SPDX-License-Identifier: MIT
#pragma once

// The animated temple: moves its demons, weather and light to a time and shows them, and adjusts any style to
// them.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

#include "demons.hpp"
#include "lamps.hpp"
#include "plan.hpp"
#include "sand.hpp"
#include "site.hpp"
#include "visit.hpp"
#include "weather.hpp"
#include "world/registry.hpp"
#include "world/world.hpp"

namespace temple {

/// A temple with everything that moves in it. The same seed, weather and paths of the walker give the same
/// states at the same times.
///
/// temple::World world(seed, {.kind = temple::WeatherKind::storm});
///     const Scene scene = world.scene();
///     world.meet(scene);
///     renderer.set_scene(scene);
///     world.go_to(time_s, camera);
///     world.show(renderer);
///     world.press(renderer);
///     renderer.render(camera, world.style(Style::load("temple-day"), camera), {.time_s = time_s});
class World final : public worlds::World {
public:
    explicit World(uint64_t seed, const WeatherChoice& weather = {});

    /// Returns the whole scene of the temple at time 0. Cost: a fifth of a second.
    [[nodiscard]] estampe::Scene scene() const override;

    /// Prepares the temple to be drawn: calls meet(). In a film the sun moves, in a walk it moves slowly,
    /// unless WeatherChoice sets its speed. If the purpose is a film and not a draft, also calls film().
    void begin(const estampe::Scene& scene, const worlds::Purpose& purpose) override;

    /// Finds the temple's nodes in a scene that scene() made. Throws Error for a scene without demons.
    void meet(const estampe::Scene& scene);

    /// Simulates the temple up to a time, for a visitor at `walker`. Times of a film or a walk must follow
    /// each other. A time far before the last simulated time, or more than 10 s after it, restarts the
    /// simulation: 8 s before time 0, or one minute before the requested time. A time up to half a second
    /// before the last simulated time changes nothing. Cost: a millisecond per tenth of a second.
    void go_to(double time_s, const estampe::Camera& walker) override;

    /// Records that the visitor reaches the middle of the last hall at `time_s`; the ending starts then.
    void end_at(double time_s) override { end_s_ = time_s; }

    /// Prepares the temple for a film: smoke rises from the fires of the great halls, footprints of an
    /// earlier visitor are in the sand, and style() sets lens and shutter for motion blur.
    void film() { is_filmed_ = true; }

    /// Places the temple's moving nodes on a renderer that has the scene. Cost: linear in moving nodes; at
    /// the start of the ending, there is also the cost of Renderer::place() for nodes that were static.
    void show(estampe::Renderer& renderer) override;

    /// Presses hollows into the renderer's sand where demons are. Cost: a copy of the terrain's mask of
    /// heights, if a demon has moved on sand.
    void press(estampe::Renderer& renderer) override;

    /// Forgets which hollows the renderer's sand has. Call this function after other code has changed the
    /// renderer's sand.
    void forget_pressed() override { pressed_.reset(); }

    /// Returns the style `base`, changed for the time of the last show(): wind for cloth, sand and ink, haze,
    /// sky, clouds and sun. Also sets how demons and particles are drawn.
    [[nodiscard]] estampe::Style style(const estampe::Style& base,
                                       const estampe::Camera& camera) const override;

    /// Makes the camera path of the temple's own film.
    [[nodiscard]] std::unique_ptr<worlds::CameraPath> film_camera(const estampe::Scene& scene) const override;

    /// Makes a visit: a walk through the temple.
    [[nodiscard]] std::unique_ptr<worlds::Visit> visit(const estampe::Scene& scene) const override;

    [[nodiscard]] Demons& demons() { return demons_; }

    [[nodiscard]] const Demons& demons() const { return demons_; }

    [[nodiscard]] const Weather& weather() const { return weather_; }

    /// Returns the ground without hollows, for walking.
    [[nodiscard]] const estampe::Terrain& desert() const { return still_; }

    [[nodiscard]] const Plan& plan() const { return plan_; }

    [[nodiscard]] const Site& site() const { return site_; }

private:
    /// Transforms of the temple's nodes at one time.
    struct Shown {
        double time_s = 0.0;
        std::vector<estampe::NodePlace> places;
    };

    uint64_t seed_;
    WeatherChoice choice_;
    Plan plan_;
    Site site_;
    Desert desert_;
    estampe::Terrain still_;
    Demons demons_;
    WeatherTimeline timeline_;
    Weather weather_;
    std::vector<Plume> plumes_;
    std::optional<double> time_s_;
    estampe::Index first_of_demons_ = 0;
    estampe::Index first_of_air_ = 0;
    estampe::Index first_of_smoke_ = 0;
    std::vector<Shown> shown_; ///< Transforms that were not sent to a renderer yet
    /// Hollows that the renderer's sand has now; nothing if they are unknown.
    std::optional<std::vector<Hollow>> pressed_;
    std::optional<Ending> ending_;
    std::optional<double> end_s_;
    bool has_begun_to_end_ = false;
    bool is_filmed_ = false;
};

/// Returns the description of the temple for the registry of worlds.
[[nodiscard]] worlds::Description description();

} // namespace temple
