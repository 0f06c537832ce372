// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// Triangulates polygons. One Triangulation object is used for all polygons of a file: the object reuses its
/// memory and limits the total work.
class Triangulation {
public:
    /// Triangulates a polygon. Appends three indices into `corners` per triangle to `triangles`, with the
    /// winding of the polygon. Convex polygons become fans from their first corner. Other polygons are
    /// projected into the axis plane where their area is largest, and their ears are clipped. A corner at the
    /// same position as the corner before it is skipped. Cost: linear for convex polygons, else at most
    /// quadratic in corners. Polygons that cross themselves may get wrong triangles. Later polygons of a file
    /// that has used up its work limit may get wrong triangles too.
    void cut(std::span<const glm::dvec3> corners, std::vector<uint32_t>& triangles);

    /// Returns the number of polygons whose triangulation may be wrong.
    [[nodiscard]] uint64_t unclean() const { return unclean_; }

private:
    void clip_ears(std::vector<uint32_t>& triangles);
    [[nodiscard]] bool is_ear(size_t at);
    void flatten(std::span<const glm::dvec3> corners);
    void fan(std::vector<uint32_t>& triangles) const;

    std::vector<uint32_t> kept_; ///< indices of corners that are not cut off yet, in polygon order
    std::vector<glm::dvec2> flat_;
    std::vector<uint32_t> next_, last_;
    std::vector<uint32_t> reflex_;
    std::vector<bool> is_reflex_;
    uint64_t work_left_ = uint64_t{1} << 29;
    uint64_t unclean_ = 0;
};

} // namespace estampe
