// SPDX-License-Identifier: MIT
#include "gpu/graph/schedule.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace estampe::gpu {
namespace {

/// Adds the resource uses of `pass` to `merged`, one entry per resource.
void merge_uses(const Graph& graph, const PassRecord& pass, std::vector<PassUse>& merged)
{
    const size_t first = merged.size();
    for (const Use& use : pass.uses) {
        const ResourceRecord& resource = graph.resources()[use.resource];
        const bool writes = is_write(use.access);
        const Layout layout = resource.is_image ? layout_for(use.access) : Layout::undefined;
        const auto same = std::find_if(merged.begin() + static_cast<std::ptrdiff_t>(first), merged.end(),
                                       [&](const PassUse& known) { return known.resource == use.resource; });
        if (same == merged.end()) {
            merged.push_back({use.resource, use.access, writes, layout});
            continue;
        }
        if (same->writes || writes || same->layout != layout)
            throw std::logic_error(
                fmt::format("pass '{}' binds '{}' twice with clashing accesses ({} among them)", pass.name,
                            resource.name, name_of(use.access)));
        same->accesses |= use.access;
    }
}

/// Finds the resource uses of all passes, because incompatible accesses are an error in culled passes too.
void find_uses(const Graph& graph, Schedule& schedule)
{
    schedule.uses.clear();
    schedule.first_use.clear();
    for (const PassRecord& pass : graph.passes()) {
        schedule.first_use.push_back(static_cast<uint32_t>(schedule.uses.size()));
        merge_uses(graph, pass, schedule.uses);
    }
    schedule.first_use.push_back(static_cast<uint32_t>(schedule.uses.size()));
}

/// Whether a pass alone occupies a whole device. The workgroup count of an indirect pass is not known here;
/// indirect passes mostly process short lists.
bool is_wide(const PassRecord& pass)
{
    constexpr uint64_t groups_that_fill = 1024;
    const Dispatch& dispatch = pass.dispatch;
    return dispatch.indirect_resource == UINT32_MAX &&
           uint64_t{dispatch.groups_x} * dispatch.groups_y * dispatch.groups_z >= groups_that_fill;
}

} // namespace

void Scheduler::Wanted::forget(const Graph& graph)
{
    first.clear();
    uint32_t versions = 0;
    for (const ResourceRecord& resource : graph.resources()) {
        first.push_back(versions);
        versions += resource.newest_version + 1;
    }
    is_wanted.assign(versions, 0);
}

void Scheduler::find_kept(const Graph& graph, Schedule& schedule)
{
    wanted_.forget(graph);
    schedule.passes.clear();
    for (auto index = static_cast<uint32_t>(graph.passes().size()); index-- > 0;) {
        const PassRecord& pass = graph.passes()[index];
        const bool keep = pass.has_side_effect || std::ranges::any_of(pass.uses, [&](const Use& use) {
                              const ResourceRecord& resource = graph.resources()[use.resource];
                              if (!is_write(use.access))
                                  return use.access == Access::host_read;
                              return resource.exported || resource.is_imported() ||
                                     wanted_.at(use.resource, use.version + 1) != 0;
                          });
        if (!keep)
            continue;
        schedule.passes.push_back(index);
        for (const Use& use : pass.uses) {
            if (is_read(use.access))
                wanted_.at(use.resource, use.version) = 1;
        }
    }
    std::ranges::reverse(schedule.passes);
}

uint32_t Scheduler::next_level(const Schedule& schedule, size_t step)
{
    uint32_t level = 0;
    for (const PassUse& use : schedule.uses_of(step)) {
        Wave& wave = waves_[use.resource];
        const bool clashes = wave.is_begun && (use.writes || wave.writes || use.layout != wave.layout);
        wave.from_level = clashes ? wave.past_level : wave.from_level;
        wave.is_begun = true;
        wave.writes = use.writes;
        wave.layout = use.layout;
        level = std::max(level, wave.from_level);
    }
    return level;
}

void Scheduler::take_level(Schedule& schedule, size_t step, uint32_t level)
{
    schedule.levels[step] = level;
    for (const PassUse& use : schedule.uses_of(step))
        waves_[use.resource].past_level = std::max(waves_[use.resource].past_level, level + 1);
}

void Scheduler::find_latest(const Graph& graph, Schedule& schedule)
{
    waves_.assign(graph.resources().size(), {});
    schedule.levels.assign(schedule.passes.size(), 0);
    uint32_t past_effects = 0;
    level_count_ = 0;
    for (size_t step = schedule.passes.size(); step-- > 0;) {
        const bool has_effect = graph.passes()[schedule.passes[step]].has_side_effect;
        const uint32_t level = std::max(next_level(schedule, step), has_effect ? past_effects : 0);
        take_level(schedule, step, level);
        past_effects = has_effect ? level + 1 : past_effects;
        level_count_ = std::max(level_count_, level + 1);
    }
    for (uint32_t& level : schedule.levels)
        level = level_count_ - 1 - level;
}

void Scheduler::spread(const Graph& graph, Schedule& schedule)
{
    level_of_ = schedule.levels;
    long_.clear();
    wide_in_level_.assign(level_count_, 0);
    for (uint32_t step = 0; step < level_of_.size(); ++step) {
        const PassRecord& pass = graph.passes()[schedule.passes[step]];
        wide_in_level_[level_of_[step]] += is_wide(pass) ? 1 : 0;
        if (pass.estimated_duration_us > 0)
            long_.push_back({step, pass.estimated_duration_us});
    }
    waves_.assign(graph.resources().size(), {});
    uint32_t past_effects = 0;
    for (uint32_t step = 0; step < level_of_.size(); ++step) {
        const PassRecord& pass = graph.passes()[schedule.passes[step]];
        const uint32_t earliest =
            std::max(next_level(schedule, step), pass.has_side_effect ? past_effects : 0);
        const uint32_t latest = level_of_[step];
        wide_in_level_[latest] -= is_wide(pass) ? 1 : 0;
        const uint32_t level = pass.estimated_duration_us > 0
                                   ? beside_longest({step, pass.estimated_duration_us}, earliest, latest)
                               : is_wide(pass) ? emptiest(earliest, latest)
                                               : earliest;
        wide_in_level_[level] += is_wide(pass) ? 1 : 0;
        level_of_[step] = level;
        take_level(schedule, step, level);
        past_effects = pass.has_side_effect ? level + 1 : past_effects;
    }
}

uint32_t Scheduler::emptiest(uint32_t earliest, uint32_t latest) const
{
    uint32_t best = earliest;
    for (uint32_t level = earliest + 1; level <= latest; ++level)
        best = wide_in_level_[level] < wide_in_level_[best] ? level : best;
    return best;
}

uint32_t Scheduler::beside_longest(const Long& pass, uint32_t earliest, uint32_t latest) const
{
    const auto lengthens_us = [&](uint32_t level) {
        uint32_t longest_us = 0;
        for (const Long& other : long_) {
            if (other.step != pass.step && level_of_[other.step] == level)
                longest_us = std::max(longest_us, other.us);
        }
        return pass.us - std::min(pass.us, longest_us);
    };
    uint32_t best = earliest;
    for (uint32_t level = earliest + 1; level <= latest; ++level)
        best = lengthens_us(level) < lengthens_us(best) ? level : best;
    return best;
}

void Scheduler::sort_by_levels(const Graph& graph, Schedule& schedule)
{
    order_.resize(schedule.passes.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(order_, {}, [&](uint32_t step) {
        return std::tuple(schedule.levels[step], is_wide(graph.passes()[schedule.passes[step]]), step);
    });
    for (uint32_t& step : order_)
        step = schedule.passes[step];
    schedule.passes.swap(order_);
    std::ranges::sort(schedule.levels);
}

void Scheduler::run(const Graph& graph, Schedule& schedule)
{
    find_uses(graph, schedule);
    find_kept(graph, schedule);
    find_latest(graph, schedule);
    spread(graph, schedule);
    sort_by_levels(graph, schedule);
}

} // namespace estampe::gpu
