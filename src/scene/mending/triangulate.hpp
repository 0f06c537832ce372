// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// Cuts polygons into triangles. One object serves a whole file: it keeps its memory, and counts its work.
class Triangulation {
public:
    /// Appends to `triangles` three numbers for each triangle, each a place in `corners`, wound as the
    /// polygon. Triangles and convex polygons are cut from their first corner, others by clipping ears in
    /// their plane of largest area. A corner that repeats the place of the one before it is left out. Cost:
    /// linear for convex polygons; the square of the number of corners at worst, until a file has used up its
    /// share of work: later polygons, and those that cross themselves, may come out with wrong triangles.
    void cut(std::span<const glm::dvec3> corners, std::vector<uint32_t>& triangles);

    /// How many polygons could not be cut cleanly.
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
