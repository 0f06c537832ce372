// SPDX-License-Identifier: MIT
#include "visit.hpp"

namespace temple {

walk::Solids solids_of(const estampe::Scene& scene)
{
    return walk::Solids(scene, [](const estampe::Node& node) { return node.name != "flame"; });
}

walk::SandAt sand_of(const estampe::Terrain& desert, const double& time_s)
{
    return [&desert, &time_s](const glm::dvec2& place_m) {
        const estampe::HeightSample sample = desert.sample(place_m.x, place_m.y, time_s);
        return walk::Sand{sample.height_m, sample.slope};
    };
}

Visit::Visit(const estampe::Scene& scene, uint64_t seed)
    : desert_(*scene.terrain), solids_(solids_of(scene)), ending_(scene, seed)
{
    constexpr glm::dvec3 beginning_m(-1.2, 0.0, 80.0);
    walker_.emplace(walk::Place(solids_, sand_of(desert_, time_s_)), walk::Body{}, beginning_m);
}

void Visit::go(const walk::Intent& intent, double seconds, double time_s)
{
    time_s_ = time_s;
    walker_->advance(intent, seconds);
    if (since_arrival_s_) {
        *since_arrival_s_ += seconds;
    } else if (ending_.begins_at(walker_->feet_m())) {
        since_arrival_s_ = 0.0;
    }
    solids_.set_gone(ending_.gratings(), since_arrival_s_ && Ending::are_open(*since_arrival_s_));
}

} // namespace temple
