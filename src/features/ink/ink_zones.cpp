// SPDX-License-Identifier: MIT
#include "features/ink/ink_zones.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "features/common/named_objects.hpp"
#include "style/name_lists.hpp"
#include "style/raw.hpp"
#include "style/surfaces.hpp"

namespace estampe::features {
namespace {

constexpr const char* zones_key = "ink.zones";

void note_if_idle(const Scene& scene, const std::string& pattern, const char* key,
                  std::vector<std::string>& notes)
{
    const auto is_meant = [&](const Node& node) { return style::matches(pattern, node.name); };
    if (std::ranges::none_of(scene.nodes, is_meant)) {
        notes.push_back(fmt::format("{} speaks of objects {}, of which the scene has none", key,
                                    style::in_quotes(pattern)));
    }
}

/// What a zone does, before it is anywhere.
struct ZoneWords {
    float blow_mm_s = 0.0F;
    float turn_deg_s = 0.0F;
    float give = 0.0F;
    float amount = 1.0F;
};

ZoneWords zone_words(const std::string& text)
{
    ZoneWords words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) {
        const size_t colon = word.find(':');
        const std::string name = word.substr(0, colon);
        float* const value = name == "blow"     ? &words.blow_mm_s
                             : name == "turn"   ? &words.turn_deg_s
                             : name == "give"   ? &words.give
                             : name == "amount" ? &words.amount
                                                : nullptr;
        const std::string number = colon == std::string::npos ? "" : word.substr(colon + 1);
        float read = 0.0F;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), read);
        if (value == nullptr || error != std::errc() || end != number.data() + number.size() ||
            !std::isfinite(read) || std::abs(read) > 1e4F) {
            throw Error(fmt::format("{} says nothing of ink", style::in_quotes(word)), zones_key,
                        "allowed: blow:20, turn:90, give:1, amount:0.5, with numbers up to 10000");
        }
        *value = read;
    }
    return words;
}

/// Where on the page a point is, in millimetres; nothing behind the eye.
std::optional<glm::dvec2> place_mm(const ZoneView& view, const glm::dvec3& point)
{
    const glm::dvec4 clip = glm::dmat4(view.page.clip_from_anchor) * glm::dvec4(point - view.anchor, 1.0);
    if (clip.w <= 1e-6) {
        return std::nullopt;
    }
    const glm::dvec2 share = 0.5 * glm::dvec2(clip) / clip.w + 0.5;
    return share * glm::dvec2(view.page.page_px) / static_cast<double>(view.page.pixels_per_mm);
}

std::optional<shared::InkZone> zone_at(const ZoneView& view, const glm::dmat4& world_from_node,
                                       const ZoneWords& words)
{
    const glm::dvec3 middle(world_from_node[3]);
    const double radius_m =
        std::max({glm::length(glm::dvec3(world_from_node[0])), glm::length(glm::dvec3(world_from_node[1])),
                  glm::length(glm::dvec3(world_from_node[2]))});
    const auto middle_mm = place_mm(view, middle);
    if (!middle_mm) {
        return std::nullopt;
    }
    double radius_mm = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 beside(0.0);
        beside[axis] = 0.01 * radius_m;
        if (const auto beside_mm = place_mm(view, middle + beside)) {
            radius_mm = std::max(radius_mm, 100.0 * glm::distance(*middle_mm, *beside_mm));
        }
    }
    const glm::dvec3 ahead = -glm::normalize(glm::dvec3(world_from_node[2]));
    glm::dvec2 blows(0.0);
    if (const auto ahead_mm = place_mm(view, middle + 0.01 * radius_m * ahead)) {
        const glm::dvec2 moved = *ahead_mm - *middle_mm;
        blows = glm::length(moved) > 1e-9 ? glm::normalize(moved) : blows;
    }
    constexpr double smallest_mm = 0.1;
    return shared::InkZone{.middle_mm = glm::vec2(*middle_mm),
                           .radius_mm = static_cast<float>(std::max(radius_mm, smallest_mm)),
                           .amount = words.amount,
                           .velocity_mm_s = words.blow_mm_s * glm::vec2(blows),
                           .turn_rad_s = glm::radians(words.turn_deg_s),
                           .gives = words.give};
}

} // namespace

std::vector<uint32_t> ink_mask(const pose::MeshData& meshes, const Scene& scene, std::string_view patterns,
                               std::vector<std::string>& notes)
{
    const std::vector<std::string> parts = style::between_commas(patterns);
    if (std::ranges::find(parts, "*") != parts.end()) {
        return {};
    }
    for (const std::string& pattern : parts) {
        note_if_idle(scene, pattern, "ink.objects", notes);
    }
    std::vector<uint32_t> mask(std::max<size_t>(meshes.draws.size(), 1), 0);
    for (size_t draw = 0; draw < meshes.sources.size(); ++draw) {
        mask[draw] = std::ranges::any_of(parts, [&](const std::string& pattern) {
            return is_named(scene, meshes.sources[draw].node, pattern);
        });
    }
    return mask;
}

std::vector<shared::InkZone> ink_zones(const ZoneView& view, std::string_view text,
                                       std::vector<std::string>& notes)
{
    std::vector<shared::InkZone> zones;
    for (const style::Assignment& part :
         style::assignments(text, zones_key, "object=words", "Fan=blow:20, Well=give:1")) {
        const ZoneWords words = zone_words(part.value);
        note_if_idle(view.scene, part.name, zones_key, notes);
        for (size_t node = 0; node < view.scene.nodes.size(); ++node) {
            if (!style::matches(part.name, view.scene.nodes[node].name)) {
                continue;
            }
            const auto zone = zone_at(view, view.pose.world_from_node[node], words);
            if (zone && zones.size() < shared::most_ink_zones) {
                zones.push_back(*zone);
            }
        }
    }
    return zones;
}

} // namespace estampe::features
