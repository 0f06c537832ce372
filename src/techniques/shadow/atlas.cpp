// SPDX-License-Identifier: MIT
#include "techniques/shadow/atlas.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace estampe::shadow {
namespace {

// A size is kept until what is wanted is this many doublings away: half of one would do without flicker.
constexpr float patience = 0.8F;
// Who has texels is worth more than who would take them, so that equals do not take turns.
constexpr float loyalty = 1.25F;

uint32_t next_size(const AtlasRequest& request, uint32_t held)
{
    const uint32_t most = std::bit_floor(std::max(request.largest_size, smallest_map));
    const float wanted =
        std::clamp(request.wanted_size, static_cast<float>(smallest_map), static_cast<float>(most));
    const float level = std::log2(wanted);
    if (held > 0 && held <= most && std::abs(level - std::log2(static_cast<float>(held))) < patience) {
        return held;
    }
    return 1U << static_cast<uint32_t>(std::lround(level));
}

} // namespace

void Atlas::choose_sizes(std::span<const AtlasRequest> requests, const AtlasBudget& budget)
{
    const auto held_size = [&](size_t i) { return i < held_.size() ? held_[i].allotment.size : 0U; };
    sizes_.assign(requests.size(), 0);
    order_.clear();
    uint64_t total = 0;
    const auto texels = [&](size_t i) { return uint64_t{requests[i].map_count} * sizes_[i] * sizes_[i]; };
    for (size_t i = 0; i < requests.size(); ++i) {
        if (requests[i].map_count > 0) {
            sizes_[i] = next_size(requests[i], held_size(i));
            total += texels(i);
            order_.push_back(i);
        }
    }
    const auto worth = [&](size_t i) {
        return std::pair(requests[i].importance * (held_size(i) > 0 ? loyalty : 1.0F), i);
    };
    std::ranges::sort(order_, {}, worth);
    while (order_.size() > budget.lights) {
        total -= texels(order_.front());
        sizes_[order_.front()] = 0;
        order_.erase(order_.begin());
    }
    // Halve the largest, of these the least important first, until all fit; then drop from below.
    while (total > budget.texels && !order_.empty()) {
        const size_t largest =
            *std::ranges::max_element(order_, [&](size_t a, size_t b) { return sizes_[a] < sizes_[b]; });
        const size_t chosen = sizes_[largest] > smallest_map ? largest : order_.front();
        total -= texels(chosen);
        sizes_[chosen] = sizes_[chosen] > smallest_map ? sizes_[chosen] / 2 : 0;
        total += texels(chosen);
        if (sizes_[chosen] == 0) {
            std::erase(order_, chosen);
        }
    }
}

void Atlas::place(std::span<const AtlasRequest> requests, uint64_t budget_texels)
{
    std::swap(held_before_, held_);
    const std::vector<Held>& old = held_before_;
    held_.assign(requests.size(), {});
    taken_.clear();
    waiting_.clear();
    for (size_t i = 0; i < requests.size(); ++i) {
        if (sizes_[i] == 0) {
            continue;
        }
        held_[i] = {{.size = sizes_[i]}, requests[i].map_count};
        const bool keeps =
            i < old.size() && old[i].allotment.size == sizes_[i] && old[i].map_count == requests[i].map_count;
        held_[i].allotment.first_texel = keeps ? old[i].allotment.first_texel : 0;
        (keeps ? taken_ : waiting_).push_back(i);
    }
    std::ranges::sort(taken_, {}, [&](size_t i) { return held_[i].allotment.first_texel; });
    for (const size_t light : waiting_) {
        uint64_t at = 0;
        auto before = taken_.begin();
        while (before != taken_.end() && held_[*before].allotment.first_texel < at + held_[light].texels()) {
            at = held_[*before].allotment.first_texel + held_[*before].texels();
            ++before;
        }
        held_[light].allotment.first_texel = static_cast<uint32_t>(at);
        taken_.insert(before, light);
    }
    if (end_texel() <= budget_texels) {
        return;
    }
    // Free places lie scattered: all move together.
    uint64_t at = 0;
    for (const size_t light : taken_) {
        held_[light].allotment.first_texel = static_cast<uint32_t>(at);
        at += held_[light].texels();
    }
}

const std::vector<Allotment>& Atlas::allot(std::span<const AtlasRequest> requests, const AtlasBudget& budget)
{
    choose_sizes(requests, budget);
    place(requests, budget.texels);
    allotted_.clear();
    for (const Held& held : held_) {
        allotted_.push_back(held.allotment);
    }
    return allotted_;
}

uint64_t Atlas::end_texel() const
{
    uint64_t end = 0;
    for (const Held& held : held_) {
        end = std::max(end, held.allotment.first_texel + held.texels());
    }
    return end;
}

} // namespace estampe::shadow
