// SPDX-License-Identifier: MIT
#pragma once

// Culling by cells and portals: finds the rooms that an eye sees through doors and other openings, and the
// clusters of triangles in these rooms. All work is done on the CPU; nothing that is visible is culled.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "core/inline_vector.hpp"

namespace estampe::cells {

/// Unit normals, pointing inwards, of planes through the eye. The planes bound a pyramid with the eye as its
/// apex. Without planes, the pyramid is all of space.
using Sides = InlineVector<glm::dvec3, 12>;

/// An eye with a perspective, in world space.
struct Eye {
    glm::dvec3 place_m{0.0};
    /// Distance from the eye to the corners of the near plane. Surfaces between the eye and the near plane
    /// are not drawn, so the view begins in each cell within this distance.
    double near_m = 0.0;
    /// Half a pixel at a distance of 1 m. Views through portals are widened by this tangent, because a
    /// rasteriser moves the corners of triangles by a part of a pixel.
    double margin = 0.0;
    Sides sides; ///< sides of the page
};

/// Returns the eye of a projection from anchor space (positions relative to `anchor`), for a picture of
/// `size_px`; none for a parallel projection, which has no eye.
[[nodiscard]] std::optional<Eye> eye_of(const glm::mat4& clip_from_anchor, const glm::dvec3& anchor,
                                        glm::uvec2 size_px);

/// A part of the view: what the eye sees of one cell through one row of portals.
struct Beam {
    Index cell = no_index; ///< no_index: outdoors
    Sides sides;
};

/// Throws Error if a cell of the scene is empty or not finite, or if a portal has too few or too many
/// corners, no area, corners beside its plane, or an index of no cell.
void check_cells(const Scene& scene);

/// Cells and portals of a scene, and what was wrong with some of them.
struct NamedCells {
    std::vector<SceneCell> cells;
    std::vector<ScenePortal> portals;
    std::vector<std::string> notes;
};

/// Makes cells and portals from the names of nodes without mesh, light and camera, in the rest pose. Each
/// node whose name begins with `cell` becomes the box around the node's cube, which reaches from -1 to 1
/// along the node's axes. Each node whose name begins with `portal` becomes the rectangle that halves the
/// node's cube across its shortest side; it joins the cells before and behind this cube. Leaves out cells
/// without volume, portals without area and portals that join no two cells, with a note. Cost: linear in
/// nodes.
[[nodiscard]] NamedCells named_cells(const Scene& scene);

/// Finds the visible cells of a scene. Keeps the memory of its lists from picture to picture.
///
/// Source  Luebke and Georges, "Portals and Mirrors: Simple, Fast Evaluation of Potentially Visible Sets",
///         1995; here portals are clipped exactly as polygons, in place of their rectangles on the page
class SeenCells {
public:
    /// Finds the beams of an eye. The view begins with the sides of the page in the eye's own cell, and goes
    /// on through each portal with the planes through the eye and the edges of the portal's visible part. A
    /// cell is in the result if any line of sight enters it. If the search takes 4,096
    /// steps or finds 512 beams, it gives up, and each cell is visible on the whole page.
    ///
    /// Cost    linear in portals per step; less than 0.2 ms for a house of twenty rooms, with find_seen()
    void find(std::span<const SceneCell> cells, std::span<const ScenePortal> portals, const Eye& eye);

    [[nodiscard]] std::span<const Beam> beams() const { return beams_; }

    /// Returns whether a cell is visible; no_index asks for outdoors.
    [[nodiscard]] bool is_seen(Index cell) const;

private:
    void enter(Index cell, const Sides& sides, const ScenePortal* through);

    std::span<const SceneCell> cells_;
    std::span<const ScenePortal> portals_;
    Eye eye_;
    std::vector<Beam> beams_;
    std::vector<bool> on_path_; ///< cells through which the present line of sight has passed
    uint32_t steps_ = 0;
};

/// Returns whether a beam of the eye may contain any part of a box. Never returns false if it does.
[[nodiscard]] bool may_show(const Eye& eye, const Beam& beam, const Bounds& box);

/// The clusters of triangles in each cell. A cluster belongs to each cell that its box touches.
class CellsOfClusters {
public:
    /// Assigns clusters to cells by their boxes. A cluster without a box may move and is always drawn.
    /// Cost: linear in clusters times cells.
    CellsOfClusters(std::span<const SceneCell> cells, std::vector<std::optional<Bounds>> boxes);

    /// Sets in `bits` one bit for each cluster that the beams may show, in words of 32 clusters.
    /// Cost: for each beam, linear in the clusters of its cell.
    void find_seen(const Eye& eye, const SeenCells& seen, std::vector<uint32_t>& bits) const;

private:
    std::vector<std::optional<Bounds>> boxes_;
    std::vector<std::vector<uint32_t>> clusters_; ///< clusters of each cell; outdoors is last
    std::vector<uint32_t> always_;                ///< bits of the clusters without a box
};

} // namespace estampe::cells
