// SPDX-License-Identifier: MIT
#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <glm/gtc/constants.hpp>

#include <estampe/error.hpp>

#include "cameras.hpp"
#include "prison.hpp"
#include "temple.hpp"
#include "visit.hpp"
#include "weather.hpp"

namespace temple {

namespace {

/// Sets parameters of a style by their keys.
class Setter {
public:
    explicit Setter(estampe::Style& style) : style_(style) {}

    void operator()(const std::string& key, double value) { style_.set(key + "=" + std::to_string(value)); }

    void operator()(const std::string& key, const std::string& value) { style_.set(key + "=" + value); }

    void color(const std::string& key, const glm::vec3& srgb);

private:
    estampe::Style& style_;
};

void Setter::color(const std::string& key, const glm::vec3& srgb)
{
    const glm::ivec3 bytes(glm::round(255.0F * glm::clamp(srgb, 0.0F, 1.0F)));
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", bytes.x, bytes.y, bytes.z);
    style_.set(key + "=" + text);
}

/// Sets the style of the demons, and of the blots that they leave on the page.
void dress_demons(Setter& set)
{
    // The demons are drawn black in every style.
    set("material.demon*.wash.strength", 1.0);
    set("material.demon*.wash.neutral", 1.0);
    set("material.demon*.wash.least", 0.0);
    set("material.demon*.wash.detail", 0.0);
    const std::string wisp = "object.wisp*.particles.";
    set(wisp + "look", "blots");
    set(wisp + "ink", "#0a090d");
    set(wisp + "per_s", 15.0);
    set(wisp + "life_s", 1.7);
    set(wisp + "speed_m_per_s", 0.3);
    set(wisp + "spread_deg", 50.0);
    set(wisp + "lift_m_per_s2", 0.3);
    set(wisp + "swirl_m_per_s", 0.5);
    set(wisp + "swirl_m", 0.8);
    set(wisp + "size_m", 0.34);
    set(wisp + "grown_m", 0.04);
    set(wisp + "opacity", 1.0);
    set(wisp + "soft_m", 0.05);
}

/// Sets the style of sand and other particles in the wind.
void dress_air(Setter& set)
{
    const std::string sand = "object.sand*.particles.";
    set(sand + "look", "wash");
    set(sand + "per_s", 5.0);
    set(sand + "life_s", 2.6);
    set(sand + "speed_m_per_s", 4.0);
    set(sand + "spread_deg", 25.0);
    set(sand + "lift_m_per_s2", 0.15);
    set(sand + "swirl_m_per_s", 1.4);
    set(sand + "swirl_m", 5.0);
    set(sand + "size_m", 0.8);
    set(sand + "grown_m", 5.5);
    set(sand + "opacity", 0.3);
    set(sand + "soft_m", 1.5);
    set("object.whirl*.particles.look", "drawn");
    set("object.whirl*.particles.opacity", 0.75);
    set("object.murk*.particles.look", "strokes");
    set("object.murk*.particles.ink", "#17141a");
    for (const std::string& whirl :
         {std::string("object.whirl*.particles."), std::string("object.murk*.particles.")}) {
        set(whirl + "per_s", 13.0);
        set(whirl + "life_s", 1.5);
        set(whirl + "speed_m_per_s", 11.0);
        set(whirl + "spread_deg", 14.0);
        set(whirl + "lift_m_per_s2", 1.2);
        set(whirl + "swirl_m_per_s", 1.5);
        set(whirl + "swirl_m", 6.0);
        set(whirl + "size_m", 1.4);
        set(whirl + "grown_m", 6.0);
        set(whirl + "soft_m", 1.0);
    }
}

/// Sets the style of the ink that flows out of demons, and that spreads over the page when demons dissolve.
/// If `base` has ink already, its settings stay.
void dress_ink(Setter& set, const estampe::Style& base)
{
    if (base.number("ink.enabled") != 0.0) {
        return;
    }
    set("ink.enabled", "true");
    set("ink.source", "things");
    set("ink.objects", R"("body of demon*")");
    set("object.stain*.ink.zone.give", 0.6);
    set("object.stain*.ink.zone.turn_deg_per_s", 12.0);
    set("object.eddy*.ink.zone.turn_deg_per_s", 110.0);
    set("ink.color", "#0b0a0e");
    set("ink.thin_color", "#2b2830");
    set("ink.spot_mm", 0.9);
    set("ink.spacing_mm", 4.2);
    set("ink.amount_per_s", 22.0);
    set("ink.spot_s", 1.5);
    set("ink.life_s", 1.7);
    set("ink.soak", 0.12);
    set("ink.stain_s", 7.0);
    set("ink.swirl_mm", 34.0);
    set("ink.swirl_mm_per_s", 12.0);
    set("ink.sharpness", 0.8);
}

/// Sets the style of the smoke over fires. If `base` has smoke already, its settings stay.
void dress_smoke(Setter& set, const estampe::Style& base)
{
    if (base.number("smoke.enabled") != 0.0) {
        return;
    }
    // The smoke is a slender, transparent column, because round puffs over a brazier would look like a tree.
    set("smoke.cells", "64");
    set("smoke.puffs", "false");
    set("smoke.age_s", 3.0);
    set("smoke.source", 0.15);
    set("smoke.amount_per_s", 5.0);
    set("smoke.rise_s", 1.2);
    set("smoke.life_s", 2.6);
    set("smoke.curl", 0.2);
    set("smoke.thickness", 4.0);
    set("smoke.medium", "wash");
    set("smoke.opacity", 0.6);
    set("smoke.color", "#e0d2b6");
    set("smoke.shade_color", "#ab9e86");
    set("smoke.deep_color", "#7b7264");
    set("smoke.shade_below", 0.25);
    set("smoke.deep_below", 0.08);
    set("smoke.line_mm", 0.16);
}

/// Sets the style of films, as opposed to pictures: smoke rises, the lens is sharp at one distance, and
/// motion blur follows the moving eye. Settings that `base` has already stay.
void dress_film(Setter& set, const estampe::Style& base)
{
    set("smoke.enabled", "true");
    if (base.number("lens.enabled") == 0.0) {
        // The lens's aperture leaves a room sharp except close to the eye; far objects are a little soft.
        set("lens.enabled", "true");
        set("lens.focus_m", 8.0);
        set("lens.f_number", 2.8);
        set("lens.largest_mm", 3.0);
    }
    if (base.number("motion_blur.enabled") == 0.0) {
        set("motion_blur.enabled", "true");
        set("motion_blur.shutter_deg", 60.0);
        set("motion_blur.largest_mm", 4.0);
    }
}

constexpr double before_s = 8.0;      ///< Length of the simulation before time 0, from which a film starts
constexpr double remembered_s = 60.0; ///< Length of the simulation before a time to which the program jumps
/// Interval of the simulated samples from which plumes of particles are computed.
constexpr double sample_s = 0.1;

const glm::vec3 dust_color(0.84F, 0.72F, 0.52F); ///< Colour of dust in the air, sRGB

bool is_in_prison(const Plan& plan, const glm::vec2& place)
{
    return std::ranges::any_of(plan.rooms, [&](const Room& room) {
        return room.is_roofed() && glm::all(glm::greaterThan(place, room.low_m())) &&
               glm::all(glm::lessThan(place, room.high_m()));
    });
}

/// Returns how sheltered a place is: 0 outside, 1 deep under a roof.
float shelter_at(const Plan& plan, const glm::vec2& place)
{
    constexpr float within_m = 3.5F;
    float inside_m = 0.0F;
    for (const Room& room : plan.rooms) {
        const glm::vec2 in = glm::min(place - room.low_m(), room.high_m() - place);
        // Inner walls do not count for the shelter: depth is measured from the prison's front.
        if (room.is_roofed() && std::min(in.x, in.y) > 0.0F) {
            inside_m = front_z_m - place.y;
        }
    }
    return glm::smoothstep(0.0F, within_m, inside_m);
}

float hours_a_minute(worlds::Occasion occasion)
{
    constexpr float of_films = 1.2F;
    // Speed of the sun in walks, in hours per minute. The sun sets half an hour after the start of the walk.
    constexpr float of_walks = 0.04F;
    return occasion == worlds::Occasion::film   ? of_films
           : occasion == worlds::Occasion::walk ? of_walks
                                                : 0.0F;
}

/// Interpolates between the logarithms of two sizes, and returns the size.
double mixed_size(double from, double to, double share)
{
    return std::exp((1.0 - share) * std::log(std::max(from, 0.01)) + share * std::log(std::max(to, 0.01)));
}

} // namespace

World::World(uint64_t seed, const WeatherChoice& weather)
    : seed_(seed), choice_(weather), plan_(make_plan(seed)), site_(make_site(seed)), desert_(plan_, seed),
      still_(desert_.with({})), demons_(plan_, site_, still_, seed), timeline_(seed, weather),
      weather_(timeline_.at(0.0)), plumes_(find_plumes(plan_, seed))
{
}

estampe::Scene World::scene() const
{
    estampe::Scene scene = build_temple(seed_);
    demons_.add_to(scene);
    add_air(scene);
    add_smoke(scene, plumes_);
    return scene;
}

void World::go_to(double time_s, const estampe::Camera& walker)
{
    constexpr double leap_s = 10.0;
    // Time by which a picture may be earlier than the last one without a restart of the simulation.
    constexpr double slack_s = 0.5;
    if (!time_s_ || time_s < *time_s_ - slack_s || time_s > *time_s_ + leap_s) {
        demons_ = Demons(plan_, site_, still_, seed_);
        time_s_ = std::max(time_s - remembered_s, 0.0) - before_s;
        shown_.clear();
    }
    const std::vector<bool> in_sight = rooms_in_sight(plan_, glm::vec3(walker.eye));
    const auto record = [&] {
        weather_ = timeline_.at(*time_s_);
        // Demons in rooms out of sight are not drawn.
        Shown shown{.time_s = *time_s_, .places = demons_.places(first_of_demons_, [&](const Demon& demon) {
                        return demon.haunt().room != outside &&
                               !in_sight[static_cast<size_t>(demon.haunt().room)];
                    })};
        const auto air =
            air_places(first_of_air_, weather_,
                       {.eye_m = walker.eye,
                        .time_s = *time_s_,
                        .ground_m =
                            [&](const glm::vec2& place) {
                                return static_cast<float>(still_.sample(place.x, place.y).height_m);
                            },
                        .is_roofed = [&](const glm::vec2& place) { return is_in_prison(plan_, place); }});
        shown.places.insert(shown.places.end(), air.begin(), air.end());
        const auto smoke = smoke_places(first_of_smoke_, plumes_, walker.eye, in_sight);
        shown.places.insert(shown.places.end(), smoke.begin(), smoke.end());
        // The nodes that move in the ending stay static until the ending begins.
        has_begun_to_end_ = has_begun_to_end_ || (end_s_ && *time_s_ >= *end_s_);
        if (has_begun_to_end_ && ending_) {
            const auto moved = ending_->nodes(end_s_ ? *time_s_ - *end_s_ : -1.0);
            shown.places.insert(shown.places.end(), moved.begin(), moved.end());
        }
        shown_.push_back(std::move(shown));
    };
    while (*time_s_ < time_s) {
        const double step_s = std::min(sample_s, time_s - *time_s_);
        weather_ = timeline_.at(*time_s_);
        demons_.step(step_s, walker.eye, weather_.wind_m_per_s * wind_way());
        time_s_ = step_s < sample_s ? time_s : *time_s_ + step_s;
        if (time_s - *time_s_ < before_s) {
            record();
        }
    }
    if (shown_.empty()) {
        record();
    }
}

void World::begin(const estampe::Scene& scene, const worlds::Purpose& purpose)
{
    if (choice_.hours_a_minute == 0.0F) {
        WeatherChoice choice = choice_;
        choice.hours_a_minute = hours_a_minute(purpose.occasion);
        timeline_ = WeatherTimeline(seed_, choice);
        weather_ = timeline_.at(0.0);
    }
    meet(scene);
    if (purpose.occasion == worlds::Occasion::film && !purpose.is_draft) {
        film();
    }
}

void World::meet(const estampe::Scene& scene)
{
    const auto first = [&](const char* name) {
        const auto found = std::ranges::find(scene.nodes, name, &estampe::Node::name);
        if (found == scene.nodes.end()) {
            throw estampe::Error("the scene has no demons", scene.name, "it must be one of World::scene()");
        }
        return static_cast<estampe::Index>(found - scene.nodes.begin());
    };
    first_of_demons_ = first("demon 0");
    first_of_air_ = first("sand 0");
    first_of_smoke_ = first("smoke 0");
    ending_.emplace(scene, seed_);
}

void World::show(estampe::Renderer& renderer)
{
    for (const Shown& shown : shown_) {
        renderer.place(shown.places, shown.time_s);
    }
    shown_.clear();
    if (ending_ && end_s_ && time_s_) {
        renderer.set_brightness(ending_->lights(*time_s_ - *end_s_));
    }
}

void World::press(estampe::Renderer& renderer)
{
    std::vector<Hollow> hollows = demons_.hollows();
    const auto is_near = [](const Hollow& a, const Hollow& b) {
        constexpr float least_m = 0.01F;
        return glm::distance(a.place_m, b.place_m) < least_m && std::abs(a.depth_m - b.depth_m) < least_m;
    };
    if (!pressed_ || !std::ranges::equal(hollows, *pressed_, is_near)) {
        renderer.set_terrain(desert_.with(hollows, is_filmed_));
        pressed_ = std::move(hollows);
    }
}

std::unique_ptr<worlds::CameraPath> World::film_camera(const estampe::Scene& scene) const
{
    return std::make_unique<Flight>(scene, seed_);
}

std::unique_ptr<worlds::Visit> World::visit(const estampe::Scene& scene) const
{
    return std::make_unique<Visit>(scene, seed_);
}

estampe::Style World::style(const estampe::Style& base, const estampe::Camera& camera) const
{
    estampe::Style style = base;
    Setter set(style);
    set("particles.emitters", R"("wisp*, sand*, whirl*, murk*")");
    dress_demons(set);
    dress_air(set);
    dress_ink(set, base);
    dress_smoke(set, base);
    if (is_filmed_) {
        dress_film(set, base);
    }

    const auto wind_m_per_s = static_cast<double>(weather_.wind_m_per_s);
    const auto gusts = static_cast<double>(weather_.gusts);
    const double shelter = static_cast<double>(shelter_at(plan_, {camera.eye.x, camera.eye.z}));
    const double dust = static_cast<double>(weather_.dust) * (1.0 - 0.93 * shelter);
    set("wind.from", "style");
    set("wind.speed_m_per_s", wind_m_per_s);
    set("wind.blown_m", weather_.blown_m);
    set("wind.towards_deg", 90.0 - static_cast<double>(wind_to_deg));
    const auto blow = [&](const std::string& what, double speed_m_per_s) {
        set("object." + what + ".particles.wind_m_per_s", speed_m_per_s);
    };
    // A column of smoke is drawn from the paths of all its particles. The wind has constant speed here,
    // because each gust would move the whole column at once.
    blow("wisp*", 0.8);
    blow("sand*", 12.0);
    blow("whirl*", 4.0);
    blow("murk*", 4.0);
    // Blown sand is lighter than the ground, but in a storm darker than the dusty air.
    set.color("object.sand*.particles.color", dust_color + static_cast<float>(glm::mix(0.06, -0.16, dust)));
    set("sky.darkness", base.number("sky.darkness") * (1.0 - 0.85 * dust));
    set.color("object.whirl*.particles.color", dust_color);
    set("drift.amount", std::min(0.6 + 0.4 * gusts, 1.0));

    // Computes the direction of the wind on the page.
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec3 way(wind_way().x, 0.0, wind_way().y);
    const glm::dvec2 on_page(glm::dot(way, right), glm::dot(way, glm::cross(right, ahead)) + 0.25);
    set("ink.wind_mm_per_s", 1.6 * wind_m_per_s * glm::length(on_page) * (1.0 - 0.7 * shelter));
    set("ink.wind_deg", glm::degrees(std::atan2(on_page.y, on_page.x)));

    set("haze.start_m", mixed_size(base.number("haze.start_m"), 2.5, dust));
    set("haze.reach_m", mixed_size(base.number("haze.reach_m"), 15.0, dust));
    const auto dusty = [&](const char* key, double share) {
        set.color(key, glm::mix(base.color(key), dust_color, static_cast<float>(share)));
    };
    dusty("sky.horizon", 0.9 * dust);
    dusty("sky.zenith", 0.75 * dust);
    dusty("haze.tint_color", dust);
    if (base.text("light.metering") == "lights") {
        // Sets the exposure by hand: automatic exposure would make the court too dark because of its many
        // lamps. With this value, white marble in the sun is white.
        set("light.metering", "manual");
        set("light.ev100", -0.1);
    }
    set("light.ambient", std::min(base.number("light.ambient") + 0.25 * dust, 1.0));
    set("clouds.coverage",
        (1.0 - dust) * std::max(static_cast<double>(weather_.clouds), base.number("clouds.coverage")));
    if (base.number("clouds.coverage") == 0.0) {
        // Clouds get the sky's colours, so that marble is the only white thing in the picture.
        const glm::vec3 straw = base.color("sky.horizon");
        set.color("clouds.color", glm::mix(base.color("clouds.color"), straw, 0.6F));
        set.color("clouds.shade_color", glm::mix(straw, base.color("sky.zenith"), 0.3F));
    }
    if (weather_.hour) {
        set("sun.by", "place");
        set("sun.latitude_deg", 31.0);
        set("sun.date", "2026-03-21");
        set("sun.hour", static_cast<double>(*weather_.hour));
        set("sun.north_deg", -34.6);
    }
    return style;
}

// Properties of the temple that the program needs before creating it.

namespace {

std::unique_ptr<worlds::World> make(const worlds::Values& values)
{
    WeatherChoice weather;
    if (const std::optional<std::string> kind = values.word("weather")) {
        weather.kind = weather_named(*kind);
    }
    if (const std::optional<double> hour = values.number("hour")) {
        weather.hour = static_cast<float>(*hour);
    }
    return std::make_unique<World>(values.whole("seed").value(), weather);
}

} // namespace

worlds::Description description()
{
    return {.name = "temple",
            .summary = "A half-buried temple that was a prison, in a desert of moving dunes",
            .styles = {"temple-day", "temple-ink"},
            .examples = {"estampe render temple -o temple.png --camera court --style temple-day --seed 7",
                         "estampe render temple -o storm.png --camera avenue --world weather=storm",
                         "estampe render temple -o temple.mp4 --film --style temple-day"},
            .options = {{.key = "seed",
                         .meaning = "Random seed: another number makes another temple",
                         .allowed = worlds::WholeRange{},
                         .initial = "1"},
                        {.key = "weather",
                         .meaning = "Holds one kind of weather",
                         .allowed = weather_names(),
                         .without = "the weather changes with time",
                         .changes_scene = false},
                        {.key = "hour",
                         .meaning = "Hour of the sun; in a film the sun moves on from there",
                         .allowed = worlds::NumberRange{0.0, 24.0},
                         .without = "16.67",
                         .changes_scene = false}},
            .film_s = Flight::length_s,
            .show_s = 60.0, // Within this time, gusts, a tornado and a storm occur once each
            .make = make};
}

} // namespace temple
