// SPDX-License-Identifier: MIT
#pragma once

// Static geometry that blocks a walker: triangles in a bounding volume hierarchy (a tree of boxes).

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace walk {

/// A triangle in world space, in metres.
struct Triangle {
    glm::vec3 a{0.0F}, b{0.0F}, c{0.0F};
};

/// A point on an upward-facing surface, which can support a foot.
struct Support {
    float height_m = 0.0F;
    glm::vec3 normal{0.0F, 1.0F, 0.0F}; ///< Normal of the surface, a unit vector that points upwards
};

/// Solid triangles, with a search for the triangles near a place. Each triangle is solid on its two sides.
/// Coordinates are floats, which are precise enough within a few kilometres of the origin.
class Solids {
public:
    Solids() = default;
    /// Builds the bounding volume hierarchy. Cost: n log n in triangles.
    explicit Solids(std::vector<Triangle> triangles);
    /// Collects solid triangles from a scene in its rest pose: takes the triangles of all nodes for which
    /// `is_solid` returns true. Cloth and meshes that skins or morph targets deform are never included.
    explicit Solids(const estampe::Scene& scene,
                    const std::function<bool(const estampe::Node& node)>& is_solid = {});

    /// Appends the triangles whose boxes touch the given box. Cost: logarithmic, and linear in the triangles
    /// that are found.
    void find(const glm::vec3& low_m, const glm::vec3& high_m, std::vector<Triangle>& found) const;

    /// Finds the highest upward-facing surface straight below a place, at most `reach_m` away.
    [[nodiscard]] std::optional<Support> below(const glm::vec3& place_m, float reach_m) const;

    /// Returns whether the straight segment between two places hits any triangle.
    [[nodiscard]] bool blocks(const glm::vec3& from_m, const glm::vec3& to_m) const;

    /// Removes the triangles of a node from the solids, or restores them.
    void set_gone(estampe::Index node, bool is_gone);

    [[nodiscard]] size_t count() const { return triangles_.size(); }

private:
    struct Box {
        glm::vec3 low_m{0.0F};
        glm::vec3 high_m{0.0F};
        /// For a leaf box: index of its first triangle. For an inner box: index of its second child; the
        /// first child is stored directly after the box.
        uint32_t first = 0;
        uint32_t count = 0; ///< Number of triangles in the box; 0 for an inner box with two children
    };

    void build();
    uint32_t add_box(uint32_t first, uint32_t last);
    /// Calls `visit` for each triangle that is not removed, in boxes for which `touches` returns true.
    template <typename Touches, typename Visit>
    void search(const Touches& touches, const Visit& visit) const;

    std::vector<Triangle> triangles_;
    std::vector<estampe::Index> owners_; ///< Node to which each triangle belongs
    std::vector<bool> gone_;             ///< True for each node whose triangles are removed
    std::vector<Box> boxes_;
};

/// The closest points of a segment and a triangle.
struct Nearest {
    glm::vec3 on_segment{0.0F};
    glm::vec3 on_triangle{0.0F};
};

[[nodiscard]] Nearest nearest(const glm::vec3& from, const glm::vec3& to, const Triangle& triangle);

} // namespace walk
