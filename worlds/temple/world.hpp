// SPDX-License-Identifier: MIT
#pragma once

// The temple alive: its demons, its weather and its light, brought to a moment and shown; and how what lives
// and what burns is drawn, over any style.

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

/// One temple and what goes on in it. The same seed, weather and ways of the walker give the same moments.
///
///     temple::World world(seed, {.kind = temple::WeatherKind::storm});
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

    /// All of it as it stands at the beginning. Cost: a fifth of a second.
    [[nodiscard]] estampe::Scene scene() const override;

    /// Calls meet(). The sun moves in a film, and slowly on a walk, unless WeatherChoice sets its speed.
    /// Calls film() for a film that is not a draft.
    void begin(const estampe::Scene& scene, const worlds::Purpose& purpose) override;

    /// Learns which nodes of its scene() are what. Throws Error for a scene that has no demons.
    void meet(const estampe::Scene& scene);

    /// Brings what lives to a moment, which is seen and walked by `walker`. Moments of a film or a walk come
    /// one after the other; one long before the last, or more than 10 s after it, begins anew, 8 s before
    /// time does or a minute before itself. One up to half a second before it leaves all as it is. Cost: a
    /// millisecond a tenth of a second.
    void go_to(double time_s, const estampe::Camera& walker) override;

    /// Somebody comes to the middle of the last hall at that moment, from which on its Ending takes its way.
    void end_at(double time_s) override { end_s_ = time_s; }

    /// A film is taken of it: smoke rises from the great halls' fires, one who came before has left prints in
    /// the sand, and style() has a lens, and a shutter that is open.
    void film() { is_filmed_ = true; }

    /// Moves it on the renderer that has the scene. Cost: linear in the nodes that move; where the ending
    /// begins, once that of laying out anew what stood still.
    void show(estampe::Renderer& renderer) override;

    /// Pushes the renderer's sand back where demons are. Cost: where one has moved on sand, a copy of the
    /// heights of its mask.
    void press(estampe::Renderer& renderer) override;

    /// Another world, or nobody, has pressed the renderer's sand since.
    void forget_pressed() override { pressed_.reset(); }

    /// `base` with the weather and the light of the moment that was shown: wind for cloth, sand and ink, air,
    /// sky, clouds and the sun; and how demons and what flies are drawn.
    [[nodiscard]] estampe::Style style(const estampe::Style& base,
                                       const estampe::Camera& camera) const override;

    /// Makes the Flight through the temple.
    [[nodiscard]] std::unique_ptr<worlds::CameraPath> film_camera(const estampe::Scene& scene) const override;

    /// Makes a Visit of the temple.
    [[nodiscard]] std::unique_ptr<worlds::Visit> visit(const estampe::Scene& scene) const override;

    [[nodiscard]] Demons& demons() { return demons_; }

    [[nodiscard]] const Demons& demons() const { return demons_; }

    [[nodiscard]] const Weather& weather() const { return weather_; }

    /// The ground that nobody presses, for those who walk on it.
    [[nodiscard]] const estampe::Terrain& desert() const { return still_; }

    [[nodiscard]] const Plan& plan() const { return plan_; }

    [[nodiscard]] const Site& site() const { return site_; }

private:
    /// Where nodes were at a moment.
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
    std::vector<Shown> shown_;                   ///< not yet on a renderer
    std::optional<std::vector<Hollow>> pressed_; ///< nothing: the renderer's sand is as it may be
    std::optional<Ending> ending_;
    std::optional<double> end_s_;
    bool has_begun_to_end_ = false;
    bool is_filmed_ = false;
};

/// The temple among the worlds that the program knows by name.
[[nodiscard]] worlds::Description description();

} // namespace temple
