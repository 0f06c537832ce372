// SPDX-License-Identifier: MIT
#include "worlds.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/text.hpp"
#include "features/common/style_tables.hpp"
#include "options.hpp"

namespace estampe::app {
namespace {

bool has_option(const worlds::Description& world, const std::string& key)
{
    return std::ranges::find(world.options, key, &worlds::Option::key) != world.options.end();
}

} // namespace

std::vector<std::string> world_names()
{
    std::vector<std::string> names;
    for (const worlds::Description& world : worlds::registry().all()) {
        names.push_back(world.name);
    }
    return names;
}

const worlds::Description* world_of(const std::string& scene)
{
    const worlds::Description* const world = worlds::registry().find(scene);
    std::error_code problem;
    const std::filesystem::file_status status = std::filesystem::status(scene, problem);
    return std::filesystem::exists(status) && !std::filesystem::is_directory(status) ? nullptr : world;
}

std::unique_ptr<worlds::World> make_world(const DrawOptions& draw)
{
    const worlds::Description* const world = world_of(draw.scene);
    return world != nullptr ? world->make(worlds::Values(world->options, draw.world)) : nullptr;
}

void WorldOptions::add_to(CLI::App& command, Seed seed)
{
    command
        .add_option("--world", assignments_,
                    "Option of a built-in world, as in seed=7; may be repeated. estampe info\n"
                    "lists all worlds and their options.")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    if (seed == Seed::is_an_option) {
        command
            .add_option("--seed", seed_,
                        "Number that varies a built-in world at random, as --world seed=N does")
            ->type_name("N");
    }
}

std::vector<std::string> WorldOptions::read(const std::string& scene) const
{
    if (assignments_.empty() && !seed_) {
        return {};
    }
    const char* const option = seed_ ? "--seed" : "--world";
    const worlds::Description* const world = world_of(scene);
    if (world == nullptr) {
        throw UsageError(scene.empty()
                             ? "works only with a world"
                             : fmt::format("works only with a world; {} is not one", in_quotes(scene)),
                         option, known_worlds());
    }
    std::vector<std::string> all = assignments_;
    if (seed_) {
        if (!has_option(*world, "seed")) {
            throw UsageError(fmt::format("the world {} has no option \"seed\"", world->name), option,
                             world->options.empty() ? "it has no options"
                                                    : "its options: " + keys_of(world->options));
        }
        if (std::ranges::any_of(all, [](const std::string& word) { return word.starts_with("seed="); })) {
            throw UsageError("is short for --world seed=N, which is given too", option,
                             "leave one of the two out");
        }
        all.push_back(fmt::format("seed={}", *seed_));
    }
    try {
        const worlds::Values checked(world->options, all);
    } catch (const Error& problem) {
        throw UsageError(problem.what(), "--world");
    }
    return all;
}

void check_has_film(const std::string& scene)
{
    const worlds::Description* const world = world_of(scene);
    if (world == nullptr || !world->film_s) {
        std::vector<std::string> filmed;
        for (const worlds::Description& other : worlds::registry().all()) {
            if (other.film_s) {
                filmed.push_back(other.name);
            }
        }
        throw UsageError(
            fmt::format("works only with a world that has a film of its own; {} has none", in_quotes(scene)),
            "--film", fmt::format("worlds with a film: {}", fmt::join(filmed, ", ")));
    }
}

std::string world_option_as_typed(const std::string& key, const std::string& value)
{
    const auto& all = worlds::registry().all();
    const bool is_known =
        std::ranges::any_of(all, [&](const worlds::Description& world) { return has_option(world, key); });
    return is_known ? fmt::format("--world {}={}", key, value.empty() ? "VALUE" : value) : std::string();
}

std::string known_worlds()
{
    return fmt::format("the worlds: {}", fmt::join(world_names(), ", "));
}

namespace {

/// Copies to `style` each parameter that differs between `chosen.style` and its base, because the user has
/// edited it.
void keep_choices(Style& style, const ChosenStyle& chosen)
{
    const features::StyleTables& changed = chosen.style.tables();
    const features::StyleTables& base = chosen.base.tables();
    for (const style::Section& section : features::style_schema().sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            const style::Value value = parameter.get(section.place.in(&changed));
            if (value != parameter.get(section.place.in(&base))) {
                parameter.set(section.place.in(&style.tables()), value);
            }
        }
    }
    // If the user has chosen a direction of the sun, this direction is kept.
    const light::LightStyle& light = changed.light;
    if (light.sun_azimuth_deg != base.light.sun_azimuth_deg ||
        light.sun_elevation_deg != base.light.sun_elevation_deg) {
        style.tables().sun = changed.sun;
    }
}

} // namespace

WorldAnimator::WorldAnimator(const DrawOptions& draw, const Scene& scene, worlds::Occasion occasion)
    : draw_(draw), world_(make_world(draw))
{
    if (world_) {
        world_->begin(scene, {.occasion = occasion, .is_draft = draw.is_draft});
    }
}

WorldAnimator::~WorldAnimator() = default;

void WorldAnimator::go_to(double time_s, const Camera& camera)
{
    if (world_) {
        world_->go_to(time_s, camera);
    }
}

void WorldAnimator::show_world(Renderer& renderer, double time_s, const Camera& camera)
{
    world_->go_to(time_s, camera);
    world_->show(renderer);
    if (!has_left_ground_) {
        world_->press(renderer);
    }
}

Style WorldAnimator::show(Renderer& renderer, double time_s, const Camera& camera)
{
    if (!world_) {
        return draw_.style;
    }
    show_world(renderer, time_s, camera);
    Style style = world_->style(draw_.style, camera);
    for (const std::string& assignment : draw_.assignments) {
        style.set(assignment);
    }
    return style;
}

Style WorldAnimator::show(Renderer& renderer, const ChosenStyle& chosen, double time_s, const Camera& camera)
{
    if (!world_) {
        return chosen.style;
    }
    show_world(renderer, time_s, camera);
    Style style = world_->style(chosen.style, camera);
    keep_choices(style, chosen);
    return style;
}

void WorldAnimator::end_at(double time_s)
{
    if (world_) {
        world_->end_at(time_s);
    }
}

void WorldAnimator::forget_pressed()
{
    if (world_) {
        world_->forget_pressed();
    }
}

std::shared_ptr<const worlds::CameraPath> WorldAnimator::film_camera(const Scene& scene) const
{
    return world_ ? world_->film_camera(scene) : nullptr;
}

} // namespace estampe::app
