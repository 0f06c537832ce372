// SPDX-License-Identifier: MIT
// What the program knows about the temple before it makes it.
#include <memory>
#include <optional>

#include "flight.hpp"
#include "world.hpp"

namespace temple {
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
            .show_s = 60.0, // gusts, a tornado and a storm come once
            .make = make};
}

} // namespace temple
