// SPDX-License-Identifier: MIT
// What is told of a run of steps before it: how they are cut, what they may meet, and in what they are.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "techniques/cloth/runs.hpp"

namespace estampe::cloth {
namespace {

constexpr float tear_share = 4.0F;             // small steps in place of tethers, of sheets that may tear
constexpr float longest_step_s = 1.0F / 30.0F; // a longer one is taken for that

/// What keeps the defaults' stretch at a hundredth or two: as many as a third of the particles of a side in a
/// sixtieth of a second.
float small_steps_per_s(uint32_t particles)
{
    const float side = std::sqrt(static_cast<float>(particles));
    return 60.0F * std::clamp(0.31F * side, 8.0F, 40.0F);
}

glm::vec3 direction_of(const WindStyle& wind)
{
    const float angle_rad = wind.direction_deg * std::numbers::pi_v<float> / 180.0F;
    return {std::cos(angle_rad), 0.0F, std::sin(angle_rad)};
}

/// Whether sheets at rest in `before` would not be in `now`, but for the wind.
bool are_other(const Surroundings& now, const Surroundings& before)
{
    return before.gravity_m_s2 != now.gravity_m_s2 || before.effort != now.effort ||
           before.rest_m_s != now.rest_m_s;
}

} // namespace

uint32_t Cloths::small_steps(const Kind& kind, const Surroundings& surroundings) const
{
    const bool descends = (kind.variant & shared::cloth_bit_descent) != 0;
    const bool tears = (kind.variant & shared::cloth_bit_tear) != 0;
    const float per_s = small_steps_per_s(kind.most_particles) * (tears ? tear_share : 1.0F) /
                        (descends ? sweeps_of_descent : 1.0F);
    const float wanted = per_s * surroundings.effort * surroundings.step_s;
    return static_cast<uint32_t>(std::clamp(std::ceil(wanted - 0.01F), 1.0F, 1000.0F));
}

uint32_t Cloths::most_steps(const Surroundings& surroundings) const
{
    constexpr uint32_t most_passes = 240; // others need some too
    constexpr uint32_t most_at_once = 120;
    uint32_t passes = 0;
    for (const Kind& kind : kinds_) {
        const auto descents = static_cast<uint32_t>(sweeps_of_descent * kind.colours.size());
        const uint32_t searches = (kind.variant & shared::cloth_bit_self) != 0 ? 3 : 0;
        const uint32_t tears = (kind.variant & shared::cloth_bit_tear) != 0 ? 2 : 0;
        passes += kind.is_small ? 0 : 2 + searches + tears + small_steps(kind, surroundings) * (1 + descents);
    }
    return passes == 0 ? most_at_once : std::clamp(most_passes / passes, 1U, most_at_once);
}

void Cloths::find_met_solids()
{
    constexpr float spare_m = 0.1F; // for how thick sheets are
    met_before_.clear();
    met_.clear();
    for (size_t i = 0; i < solids_.size(); ++i) {
        const glm::vec3& centre_m = solids_[i].centre_m;
        const float reach_m =
            solids_[i].reach_m + glm::distance(solids_before_[i].centre_m, centre_m) + spare_m;
        const bool is_met =
            reach_.empty() || std::ranges::any_of(reach_, [&](const SheetReach& box) {
                return glm::distance(glm::clamp(centre_m, box.min_m, box.max_m), centre_m) <= reach_m;
            });
        if (is_met) {
            met_before_.push_back(solids_before_[i]);
            met_.push_back(solids_[i]);
            if (is_seen(solids_[i])) { // which may have been larger
                met_.back().reach_m = std::max(solids_before_[i].reach_m, solids_[i].reach_m);
            }
        }
    }
}

void Cloths::lower_rigidities(const Surroundings& surroundings)
{
    float longest_small_s = 0.0F;
    for (const Kind& kind : kinds_) {
        const bool is_cut = (kind.variant & (shared::cloth_bit_relax | shared::cloth_bit_descent)) == 0;
        const float small_s = std::min(surroundings.step_s, longest_step_s) /
                              static_cast<float>(small_steps(kind, surroundings));
        longest_small_s = std::max(longest_small_s, is_cut ? small_s : 0.0F);
    }
    for (size_t i = 0; i < records_.size(); ++i) {
        const float most = 1.0F / std::max(bending_rates_s2_[i] * longest_small_s * longest_small_s, 1e-12F);
        const bool bears_all = solver_of(i) == ClothSolver::block_descent;
        records_[i].bending_n_m = bears_all ? rigidities_n_m_[i] : std::min(rigidities_n_m_[i], most);
    }
}

void Cloths::fill_runs(const Surroundings& surroundings, uint32_t count)
{
    const WindStyle& wind = surroundings.wind;
    find_met_solids();
    const size_t size_bytes = met_.size() * sizeof(shared::ClothCollider);
    const bool moves = (bodies_move_ && std::ranges::any_of(met_, is_seen)) ||
                       (!met_.empty() && std::memcmp(met_before_.data(), met_.data(), size_bytes) != 0);
    const bool rouses = rouses_all_ || (surroundings_ && are_other(surroundings, *surroundings_));
    const uint32_t roused_steps = blows(surroundings) ? count : (rouses ? 1U : 0U);
    lower_rigidities(surroundings);
    for (Kind& kind : kinds_) {
        shared::ClothRun run{.gravity_m_s2 = surroundings.gravity_m_s2,
                             .step_s = std::min(surroundings.step_s, longest_step_s),
                             .step_count = count,
                             .small_steps = small_steps(kind, surroundings),
                             .collider_count = static_cast<uint32_t>(met_.size()),
                             .collider_stride = moves ? static_cast<uint32_t>(met_.size()) : 0,
                             .wind_m_s = wind.speed_m_s * direction_of(wind),
                             .ahead_m = static_cast<float>(surroundings.ahead_m) * direction_of(wind),
                             .gustiness = wind.gustiness,
                             .gust_m = wind.gust_m,
                             .turbulence = wind.turbulence,
                             .eddy_m = wind.eddy_m,
                             .time_s = static_cast<float>(surroundings.time_s),
                             .air_kg_m3 = surroundings.air_kg_m3,
                             .most_speed_m_s = 60.0F,
                             .origin_m = glm::vec3(surroundings.origin_m),
                             .rest_m_s = surroundings.rest_m_s > 0.0F ? surroundings.rest_m_s : -1.0F,
                             .roused_steps = roused_steps,
                             .bodies_move = bodies_move_ ? 1U : 0U,
                             .flow_count = static_cast<uint32_t>(flows_.size()),
                             .flows = {},
                             .lone_sheet = {}};
        std::ranges::copy(flows_, std::begin(run.flows));
        run.lone_sheet = kind.lone ? records_[*kind.lone] : shared::ClothSheet{};
        std::memcpy(kind.run.mapped().data(), &run, sizeof run);
    }
    std::memcpy(sheets_.mapped().data(), records_.data(), records_.size() * sizeof(shared::ClothSheet));
    std::byte* const solids = colliders_.mapped().data();
    if (size_bytes > 0) {
        std::memcpy(solids, met_before_.data(), size_bytes);
        std::memcpy(solids + size_bytes, met_.data(), size_bytes);
    }
    solids_before_ = solids_;
    surroundings_ = surroundings;
    rouses_all_ = false;
}

} // namespace estampe::cloth
