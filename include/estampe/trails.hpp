// SPDX-License-Identifier: MIT
#pragma once

// Footprints and drag marks in the sand of a terrain.

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// A shape that is pressed into the ground: a bar with round ends between two places. Places are world x and
/// z in metres.
struct TrailStamp {
    glm::dvec2 from_m{0.0};
    glm::dvec2 to_m{0.0};
    float from_radius_m = 0.1F;
    float to_radius_m = 0.1F;
    float depth_m = 0.04F; ///< Depth of the sole below level ground; lower ground stays as it is
    /// Width of the rim around the print; its height follows from the displaced volume.
    float rim_m = 0.08F;

    bool operator==(const TrailStamp&) const = default;

    /// A round print.
    [[nodiscard]] static TrailStamp disc(glm::dvec2 place_m, float radius_m, float depth_m);
    /// The mark of an object dragged in a straight line.
    [[nodiscard]] static TrailStamp drag(glm::dvec2 from_m, glm::dvec2 to_m, float radius_m, float depth_m);
    /// A shoe print of `length_m` centred on `place_m`, narrower at the heel. `towards` need not have unit
    /// length.
    [[nodiscard]] static TrailStamp foot(glm::dvec2 place_m, glm::dvec2 towards, float length_m = 0.3F,
                                         float depth_m = 0.04F);
};

/// How trails look and decay.
struct TerrainTrails {
    float half_life_s = 90.0F; ///< Time in which the wind fills half of a trail's depth
    float repose_deg = 33.0F;  ///< Steepest slope of a rim; steeper sand slumps
    float extent_m = 48.0F;    ///< Side of the square in front of the camera in which trails are visible

    bool operator==(const TerrainTrails&) const = default;
};

/// A path across the ground of somebody who walks or drags something.
struct TerrainTrack {
    std::string name;
    std::vector<glm::dvec2> path_m; ///< World x and z; a smooth curve passes through the points
    double pace_m_per_s = 1.4;      ///< Speed along the path
    std::optional<double> start_s;  ///< Start time; empty: the track ends at time 0
    double stride_m = 0.75;         ///< Distance between the prints of the two feet
    double foot_m = 0.4;            ///< Length of a print in loose sand
    double depth_m = 0.07;          ///< Depth of a print or drag mark
    double drag_m = 0.0;            ///< Width of the dragged object; 0: footprints

    bool operator==(const TerrainTrack&) const = default;
};

/// Parses "x,z x,z ... [pace=m/s] [start=s] [stride=m] [foot=m] [depth=m] [drag=m]", separated by blanks; at
/// least two points. Throws Error with `where` if the text is not valid.
[[nodiscard]] TerrainTrack parse_track(const std::string& text, const std::string& name,
                                       const std::string& where);

/// Writes a track as text that parse_track() reads. The name is not included.
[[nodiscard]] std::string track_text(const TerrainTrack& track);

} // namespace estampe
