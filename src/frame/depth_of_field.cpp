// SPDX-License-Identifier: MIT
#include "frame/depth_of_field.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "features/common/named_objects.hpp"
#include "style/raw.hpp"

namespace estampe::frame {
namespace {

/// About where a draw stands in the world.
Bounds place_of(const LoadedScene& loaded, const ScenePose& pose, size_t draw)
{
    const Scene& scene = loaded.scene;
    const pose::DrawSource& source = loaded.layout.sources[draw];
    const Node& node = scene.nodes[source.node];
    Bounds place;
    if (node.skin != no_index) {
        for (const Index joint : scene.skins[node.skin].joints) {
            place.extend(glm::dvec3(pose.world_from_node[joint][3]));
        }
        return place;
    }
    const glm::dmat4 anchor_from_object(loaded.pose->draws[draw].anchor_from_object);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 end((corner & 1) != 0 ? source.local_bounds.max.x : source.local_bounds.min.x,
                             (corner & 2) != 0 ? source.local_bounds.max.y : source.local_bounds.min.y,
                             (corner & 4) != 0 ? source.local_bounds.max.z : source.local_bounds.min.z);
        place.extend(glm::dvec3(anchor_from_object * glm::dvec4(end, 1.0)) + loaded.layout.anchor);
    }
    return place;
}

} // namespace

double focus_distance_m(const LensSetting& in, std::vector<std::string>& notes)
{
    const lens::LensStyle& style = in.style.lens;
    const glm::dvec3 ahead = glm::normalize(in.camera.target - in.camera.eye);
    const auto away_m = [&](const Bounds& place) { return glm::dot(place.center() - in.camera.eye, ahead); };
    Bounds named;
    if (!style.focus_on.empty()) {
        for (size_t draw = 0; draw < in.loaded.layout.sources.size(); ++draw) {
            if (features::is_named(in.loaded.scene, in.loaded.layout.sources[draw].node, style.focus_on)) {
                const Bounds place = place_of(in.loaded, in.pose, draw);
                if (!place.empty()) {
                    named.extend(place.min);
                    named.extend(place.max);
                }
            }
        }
        if (named.empty()) {
            notes.push_back(fmt::format("lens.focus_on speaks of objects {}, of which the scene has none",
                                        style::in_quotes(style.focus_on)));
        }
    }
    const double nearest_m = 2e-3 * static_cast<double>(style.focal_mm);
    if (!named.empty()) {
        return std::max(away_m(named), nearest_m);
    }
    if (style.focus_m > 0.0F) {
        return std::max(static_cast<double>(style.focus_m), nearest_m);
    }
    return std::max(away_m(in.loaded.layout.bounds), nearest_m);
}

std::optional<shared::LensConstants> plan_lens(const LensSetting& in, std::vector<std::string>& notes)
{
    if (in.style.lens.mode == lens::Mode::none) {
        return std::nullopt;
    }
    if (in.page.pixel.is_parallel) {
        notes.emplace_back("a parallel projection has no lens: all of it is in focus");
        return std::nullopt;
    }
    return lens::lens_on(in.style.lens, {.focus_m = focus_distance_m(in, notes),
                                         .near_m = in.camera.near_m,
                                         .pixel_at_one_m = static_cast<double>(in.page.pixel.at_one_m),
                                         .pixels_per_mm = in.page.pixels_per_mm,
                                         .line_half_px = in.line_half_px});
}

} // namespace estampe::frame
