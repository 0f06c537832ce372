// SPDX-License-Identifier: MIT
#pragma once

// Where the lens of a picture is focused.

#include <optional>
#include <string>
#include <vector>

#include "frame/loaded_scene.hpp"
#include "frame/plan.hpp"
#include "techniques/lens/lens.hpp"

namespace estampe::frame {

struct LensSetting {
    const LoadedScene& loaded;
    const ScenePose& pose;
    const Camera& camera;
    const features::StyleTables& style;
    const PagePlan& page;
    float line_half_px = 1.0F;
};

/// How far before the eye, along the view, the plane in focus stands: as far as the style says, or the middle
/// of the objects that it names, or the middle of the scene. Adds a note for a name of nothing.
[[nodiscard]] double focus_distance_m(const LensSetting& in, std::vector<std::string>& notes);

/// The lens of a picture; none where the style has none, and in parallel projection, which adds a note.
[[nodiscard]] std::optional<shared::LensConstants> plan_lens(const LensSetting& in,
                                                             std::vector<std::string>& notes);

} // namespace estampe::frame
