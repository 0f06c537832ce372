// SPDX-License-Identifier: MIT
#pragma once

// Static geometry that blocks a walker: triangles in a bounding volume hierarchy.

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

/// A point on an upward-facing surface.
struct Support {
    float height_m = 0.0F;
    glm::vec3 normal{0.0F, 1.0F, 0.0F}; ///< unit, upwards
};

/// Triangles with queries for nearby ones. Both sides of each triangle are solid. Coordinates are floats,
/// which are precise enough within a few kilometres of the origin.
class Solids {
public:
    Solids() = default;
    /// Cost: n log n.
    explicit Solids(std::vector<Triangle> triangles);
    /// Takes all triangles of the scene at rest, of nodes for which `is_solid` returns true. Cloth and meshes
    /// that skins or morph targets deform are never included.
    explicit Solids(const estampe::Scene& scene,
                    const std::function<bool(const estampe::Node& node)>& is_solid = {});

    /// Appends the triangles whose boxes touch the given box. Cost: logarithmic, and linear in triangles
    /// found.
    void find(const glm::vec3& low_m, const glm::vec3& high_m, std::vector<Triangle>& found) const;

    /// The highest upward-facing surface straight below a place, at most `reach_m` away.
    [[nodiscard]] std::optional<Support> below(const glm::vec3& place_m, float reach_m) const;

    /// Whether the straight segment between two places hits anything.
    [[nodiscard]] bool blocks(const glm::vec3& from_m, const glm::vec3& to_m) const;

    /// Removes the triangles of a node, or restores them.
    void set_gone(estampe::Index node, bool is_gone);

    [[nodiscard]] size_t count() const { return triangles_.size(); }

private:
    struct Box {
        glm::vec3 low_m{0.0F};
        glm::vec3 high_m{0.0F};
        uint32_t first = 0; ///< first triangle; of an inner box, the second child (the first follows it)
        uint32_t count = 0; ///< number of triangles; 0 for an inner box with two children
    };

    void build();
    uint32_t add_box(uint32_t first, uint32_t last);
    /// Calls `visit` for each triangle that is not removed, in boxes for which `touches` returns true.
    template <typename Touches, typename Visit>
    void search(const Touches& touches, const Visit& visit) const;

    std::vector<Triangle> triangles_;
    std::vector<estampe::Index> owners_; ///< node of each triangle
    std::vector<bool> gone_;             ///< by node
    std::vector<Box> boxes_;
};

/// The closest points of a segment and a triangle.
struct Nearest {
    glm::vec3 on_segment{0.0F};
    glm::vec3 on_triangle{0.0F};
};

[[nodiscard]] Nearest nearest(const glm::vec3& from, const glm::vec3& to, const Triangle& triangle);

} // namespace walk
