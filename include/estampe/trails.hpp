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
    /// Depth of the imprint below level ground; ground that is already lower stays as it is.
    float depth_m = 0.04F;
    /// Width of the rim of sand around the imprint; the rim's height follows from the displaced volume.
    float rim_m = 0.08F;

    bool operator==(const TrailStamp&) const = default;

    /// Makes a round imprint in the ground.
    [[nodiscard]] static TrailStamp disc(glm::dvec2 place_m, float radius_m, float depth_m);
    /// Makes the mark of an object that is dragged in a straight line.
    [[nodiscard]] static TrailStamp drag(glm::dvec2 from_m, glm::dvec2 to_m, float radius_m, float depth_m);
    /// Makes a shoe print that is `length_m` long, centred on `place_m` and narrower at the heel. The vector
    /// `towards` points to the toes; its length does not matter.
    [[nodiscard]] static TrailStamp foot(glm::dvec2 place_m, glm::dvec2 towards, float length_m = 0.3F,
                                         float depth_m = 0.04F);
};

/// How trails in the sand look, and how the wind fills them.
struct TerrainTrails {
    float half_life_s = 90.0F; ///< Time in which the wind fills half of a trail's depth
    float repose_deg = 33.0F;  ///< Steepest slope of a trail's rim; steeper sand slumps
    float extent_m = 48.0F;    ///< Side of the square in front of the camera in which trails are visible

    bool operator==(const TerrainTrails&) const = default;
};

/// A path across the ground of somebody who walks or drags something.
struct TerrainTrack {
    std::string name;
    /// Points of the path as world x and z; a smooth curve passes through them.
    std::vector<glm::dvec2> path_m;
    double pace_m_per_s = 1.4; ///< Speed of the walker along the path
    /// Time at which the walk begins; empty: chosen so that the walk ends at time 0.
    std::optional<double> start_s;
    double stride_m = 0.75; ///< Distance between the prints of the left and the right foot
    double foot_m = 0.4;    ///< Length of a footprint in loose sand
    double depth_m = 0.07;  ///< Depth of a footprint or drag mark
    double drag_m = 0.0;    ///< Width of the dragged object; 0: footprints instead of a drag mark

    bool operator==(const TerrainTrack&) const = default;
};

/// Parses a track from a text of the form "x,z x,z ... [pace=m/s] [start=s] [stride=m] [foot=m] [depth=m]
/// [drag=m]", separated by blanks; at least two points. Throws Error with `where` if the text is not valid.
[[nodiscard]] TerrainTrack parse_track(const std::string& text, const std::string& name,
                                       const std::string& where);

/// Writes a track as text that parse_track() reads. The text does not include the track's name.
[[nodiscard]] std::string track_text(const TerrainTrack& track);

} // namespace estampe
