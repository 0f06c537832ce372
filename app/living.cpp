// SPDX-License-Identifier: MIT
#include "living.hpp"

#include "drawing.hpp"
#include "features/common/style_tables.hpp"
#include "temple/world.hpp"

namespace estampe::app {
namespace {

float hours_a_minute(Occasion occasion)
{
    constexpr float of_films = 1.2F;
    constexpr float of_walks = 0.04F; // half an hour from where it stands until it sets
    return occasion == Occasion::film ? of_films : occasion == Occasion::walk ? of_walks : 0.0F;
}

/// Gives `style` what `chosen` has otherwise than its base.
void keep_choices(Style& style, const ChosenStyle& chosen)
{
    features::StyleTables changed = chosen.style.tables();
    features::StyleTables base = chosen.base.tables();
    const style::Sheet to = features::sheet_of(style.tables());
    const style::Sheet from = features::sheet_of(changed);
    const style::Sheet before = features::sheet_of(base);
    for (size_t i = 0; i < from.sections().size(); ++i) {
        for (const style::Parameter& parameter : from.sections()[i].parameters) {
            const style::Value value = parameter.get(from.sections()[i].values);
            if (value != parameter.get(before.sections()[i].values)) {
                parameter.set(to.sections()[i].values, value);
            }
        }
    }
    // Who turns the sun has it where it was turned to.
    const light::LightStyle& light = changed.light;
    if (light.sun_azimuth_deg != base.light.sun_azimuth_deg ||
        light.sun_elevation_deg != base.light.sun_elevation_deg) {
        style.tables().sun = changed.sun;
    }
}

} // namespace

Living::Living(const DrawOptions& draw, const Scene& scene, Occasion occasion) : draw_(draw)
{
    if (is_temple(draw.scene)) {
        const temple::WeatherChoice weather{.kind = temple::weather_named(draw.weather),
                                            .hour = draw.hour,
                                            .hours_a_minute = hours_a_minute(occasion)};
        world_ = std::make_unique<temple::World>(draw.seed, weather);
        world_->meet(scene);
        if (occasion == Occasion::film && !draw.is_draft) {
            world_->film();
        }
    }
}

Living::~Living() = default;

void Living::go_to(double time_s, const Camera& camera)
{
    if (world_) {
        world_->go_to(time_s, camera);
    }
}

void Living::show_world(Renderer& renderer, double time_s, const Camera& camera)
{
    world_->go_to(time_s, camera);
    world_->show(renderer);
    if (!has_left_ground_) {
        world_->press(renderer);
    }
}

Style Living::show(Renderer& renderer, double time_s, const Camera& camera)
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

Style Living::show(Renderer& renderer, const ChosenStyle& chosen, double time_s, const Camera& camera)
{
    if (!world_) {
        return chosen.style;
    }
    show_world(renderer, time_s, camera);
    Style style = world_->style(chosen.style, camera);
    keep_choices(style, chosen);
    return style;
}

} // namespace estampe::app
