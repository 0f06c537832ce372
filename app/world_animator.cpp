// SPDX-License-Identifier: MIT
#include "world_animator.hpp"

#include "features/common/style_tables.hpp"
#include "world_options.hpp"

namespace estampe::app {
namespace {

/// Sets in `style` each parameter that differs between `chosen.style` and its base.
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
    // A sun that the user has turned stays there.
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
