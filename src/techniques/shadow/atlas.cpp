// SPDX-License-Identifier: MIT
#include "techniques/shadow/atlas.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace estampe::shadow {
namespace {

// Number of doublings by which the wanted size must differ before a light's map size changes. The value 0.5
// would be plain rounding, which flickers.
constexpr float patience = 0.8F;
// Factor on the importance of lights that already have a map, so that equally important lights do not get and
// lose maps in turn.
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
    // Halves the largest maps, the least important first, until all maps fit. Maps of the smallest size are
    // dropped, not halved, the least important first.
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
    // The free space is fragmented, so all maps are moved together.
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

namespace {

// Largest half angle of a spot with one map. A wider map would spend most of its texels near its border.
constexpr float widest_map_rad = 1.1F;
// Near plane's distance as a share of the light's range. The near plane may be so close because reversed
// float depth stays precise at any distance.
constexpr float near_share = 1e-4F;

struct Axes {
    glm::vec3 right, down, along;
};

/// Axes of a face of a cube shadow map, as in local_shadow.glsl. Left-handed axes also work, because
/// triangles are drawn from both sides.
Axes face_axes(uint32_t face)
{
    const auto axis = static_cast<int>(face / 2);
    Axes axes{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    axes.along[axis] = face % 2 == 0 ? 1.0F : -1.0F;
    axes.right[axis == 0 ? 2 : 0] = 1.0F;
    axes.down[axis == 1 ? 2 : 1] = 1.0F;
    return axes;
}

glm::mat4 clip_matrix(const glm::vec3& position, const Axes& axes, float scale, float near_m)
{
    const auto row = [&](const glm::vec3& axis, float factor) {
        return glm::dvec4(glm::dvec3(axis), -glm::dot(glm::dvec3(axis), glm::dvec3(position))) *
               static_cast<double>(factor);
    };
    const glm::dmat4 rows(row(axes.right, scale), row(axes.down, scale),
                          glm::dvec4(0, 0, 0, static_cast<double>(near_m)), row(axes.along, 1.0F));
    return {glm::transpose(rows)};
}

} // namespace

bool LocalLight::is_cube() const
{
    return half_angle_rad <= 0.0F || half_angle_rad > widest_map_rad;
}

shared::LocalShadow local_shadow(const LocalLight& light, uint32_t size, uint32_t first_texel, float radius_m)
{
    const bool is_cube = light.is_cube();
    const auto texels = static_cast<float>(size);
    const float inner_share = (texels - 2.0F * static_cast<float>(rim_texels)) / texels;
    shared::LocalShadow shadow{};
    shadow.right = light.side;
    shadow.down = glm::cross(light.beam, light.side);
    shadow.along = light.beam;
    shadow.scale = is_cube ? inner_share : inner_share / std::tan(light.half_angle_rad);
    shadow.first_texel = first_texel;
    shadow.size = size;
    shadow.near_m = near_share * light.range_m;
    shadow.is_cube = is_cube ? 1U : 0U;
    shadow.radius_m = radius_m;
    return shadow;
}

std::vector<LocalView> local_views(const LocalLight& light, const shared::LocalShadow& shadow)
{
    std::vector<LocalView> views;
    for (uint32_t face = 0; face < light.map_count(); ++face) {
        const Axes axes = light.is_cube() ? face_axes(face) : Axes{shadow.right, shadow.down, shadow.along};
        views.push_back({.clip_from_anchor = clip_matrix(light.position, axes, shadow.scale, shadow.near_m),
                         .first_texel = shadow.first_texel + face * shadow.size * shadow.size});
    }
    return views;
}

} // namespace estampe::shadow
