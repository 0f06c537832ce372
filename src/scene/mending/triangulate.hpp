// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// Triangulates polygons. One object serves a whole file: it reuses its memory and limits the total work.
class Triangulation {
public:
    /// Appends three indices into `corners` to `triangles` for each triangle, with the winding of the
    /// polygon. Triangles and convex polygons become fans from their first corner, others are clipped ear by
    /// ear in their plane of largest area. A corner at the position of the one before it is left out. Cost:
    /// linear for convex polygons, else at most quadratic in corners. After a file has used up its share of
    /// work, later polygons may get wrong triangles, as may those that cross themselves.
    void cut(std::span<const glm::dvec3> corners, std::vector<uint32_t>& triangles);

    /// Number of polygons that could not be triangulated cleanly.
    [[nodiscard]] uint64_t unclean() const { return unclean_; }

private:
    void clip_ears(std::vector<uint32_t>& triangles);
    [[nodiscard]] bool is_ear(size_t at);
    void flatten(std::span<const glm::dvec3> corners);
    void fan(std::vector<uint32_t>& triangles) const;

    std::vector<uint32_t> kept_; ///< corners that are left, in their order
    std::vector<glm::dvec2> flat_;
    std::vector<uint32_t> next_, last_;
    std::vector<uint32_t> reflex_;
    std::vector<bool> is_reflex_;
    uint64_t work_left_ = uint64_t{1} << 29;
    uint64_t unclean_ = 0;
};

} // namespace estampe
