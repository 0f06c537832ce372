// SPDX-License-Identifier: MIT
#pragma once

// What walks or is dragged over sand leaves there.

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// What is pressed into the ground: a bar from one place to another with round ends. Places are x and z of
/// the world in metres.
struct TrailStamp {
    glm::dvec2 from_m{0.0};
    glm::dvec2 to_m{0.0};
    float from_radius_m = 0.1F;
    float to_radius_m = 0.1F;
    float depth_m = 0.04F; ///< of the sole under level ground; ground that is lower stays
    float rim_m = 0.08F;   ///< width of the rim around it; its height follows from the sand displaced

    bool operator==(const TrailStamp&) const = default;

    [[nodiscard]] static TrailStamp disc(glm::dvec2 place_m, float radius_m, float depth_m);
    [[nodiscard]] static TrailStamp drag(glm::dvec2 from_m, glm::dvec2 to_m, float radius_m, float depth_m);
    /// A shoe so long with its middle at `place_m`, narrower at the heel; `towards` need not be of length 1.
    [[nodiscard]] static TrailStamp foot(glm::dvec2 place_m, glm::dvec2 towards, float length_m = 0.3F,
                                         float depth_m = 0.04F);
};

/// What becomes of trails.
struct TerrainTrails {
    float half_life_s = 90.0F; ///< after which the wind has filled half of a trail's depth
    float repose_deg = 33.0F;  ///< beyond which a rim slumps
    float extent_m = 48.0F;    ///< side of the square before the eye in which trails are seen

    bool operator==(const TerrainTrails&) const = default;
};

/// Somebody's way over the ground, on foot or dragging something.
struct TerrainTrack {
    std::string name;
    std::vector<glm::dvec2> path_m; ///< x and z; a smooth curve runs through them
    double pace_m_s = 1.4;
    std::optional<double> start_s; ///< when it begins; nothing: it has just come to its end at time 0
    double stride_m = 0.75;        ///< from one foot's print to the other's
    double foot_m = 0.4;           ///< length of a print in loose sand
    double depth_m = 0.07;
    double drag_m = 0.0; ///< width of what is dragged along; 0: it walks

    bool operator==(const TerrainTrack&) const = default;
};

/// Reads "x,z x,z ... [pace=m/s] [start=s] [stride=m] [foot=m] [depth=m] [drag=m]", two places at least,
/// parted by blanks. Throws Error with `where` for what is no such thing.
[[nodiscard]] TerrainTrack parse_track(const std::string& text, const std::string& name,
                                       const std::string& where);

/// The same as text, without its name.
[[nodiscard]] std::string track_text(const TerrainTrack& track);

} // namespace estampe
