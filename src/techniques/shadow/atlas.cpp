// SPDX-License-Identifier: MIT
#include "techniques/shadow/atlas.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

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

std::vector<uint32_t> Atlas::sizes(std::span<const AtlasRequest> requests, const AtlasBudget& budget) const
{
    const auto held_size = [&](size_t i) { return i < held_.size() ? held_[i].allotment.size : 0U; };
    std::vector<uint32_t> result(requests.size(), 0);
    std::vector<size_t> order;
    uint64_t total = 0;
    const auto texels = [&](size_t i) { return uint64_t{requests[i].map_count} * result[i] * result[i]; };
    for (size_t i = 0; i < requests.size(); ++i) {
        if (requests[i].map_count > 0) {
            result[i] = next_size(requests[i], held_size(i));
            total += texels(i);
            order.push_back(i);
        }
    }
    const auto worth = [&](size_t i) { return requests[i].importance * (held_size(i) > 0 ? loyalty : 1.0F); };
    std::ranges::stable_sort(order, [&](size_t a, size_t b) { return worth(a) < worth(b); });
    while (order.size() > budget.lights) {
        total -= texels(order.front());
        result[order.front()] = 0;
        order.erase(order.begin());
    }
    // Halve the largest, of these the least important first, until all fit; then drop from below.
    while (total > budget.texels && !order.empty()) {
        const size_t largest =
            *std::ranges::max_element(order, [&](size_t a, size_t b) { return result[a] < result[b]; });
        const size_t chosen = result[largest] > smallest_map ? largest : order.front();
        total -= texels(chosen);
        result[chosen] = result[chosen] > smallest_map ? result[chosen] / 2 : 0;
        total += texels(chosen);
        if (result[chosen] == 0) {
            std::erase(order, chosen);
        }
    }
    return result;
}

void Atlas::place(const std::vector<uint32_t>& sizes, std::span<const AtlasRequest> requests,
                  uint64_t budget_texels)
{
    std::vector<Held> old = std::move(held_);
    held_.assign(requests.size(), {});
    std::vector<size_t> taken; // who has a place, in the order of places
    std::vector<size_t> waiting;
    for (size_t i = 0; i < requests.size(); ++i) {
        if (sizes[i] == 0) {
            continue;
        }
        held_[i] = {{.size = sizes[i]}, requests[i].map_count};
        const bool keeps =
            i < old.size() && old[i].allotment.size == sizes[i] && old[i].map_count == requests[i].map_count;
        held_[i].allotment.first_texel = keeps ? old[i].allotment.first_texel : 0;
        (keeps ? taken : waiting).push_back(i);
    }
    std::ranges::sort(taken, {}, [&](size_t i) { return held_[i].allotment.first_texel; });
    for (const size_t light : waiting) {
        uint64_t at = 0;
        auto before = taken.begin();
        while (before != taken.end() && held_[*before].allotment.first_texel < at + held_[light].texels()) {
            at = held_[*before].allotment.first_texel + held_[*before].texels();
            ++before;
        }
        held_[light].allotment.first_texel = static_cast<uint32_t>(at);
        taken.insert(before, light);
    }
    if (end_texel() <= budget_texels) {
        return;
    }
    // Free places lie scattered: all move together.
    uint64_t at = 0;
    for (const size_t light : taken) {
        held_[light].allotment.first_texel = static_cast<uint32_t>(at);
        at += held_[light].texels();
    }
}

std::vector<Allotment> Atlas::allot(std::span<const AtlasRequest> requests, const AtlasBudget& budget)
{
    place(sizes(requests, budget), requests, budget.texels);
    std::vector<Allotment> result;
    for (const Held& held : held_) {
        result.push_back(held.allotment);
    }
    return result;
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
