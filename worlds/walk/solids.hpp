// SPDX-License-Identifier: MIT
#pragma once

// What stands still and cannot be walked through: triangles in a tree of boxes.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace walk {

/// In metres of the world.
struct Triangle {
    glm::vec3 a{0.0F}, b{0.0F}, c{0.0F};
};

/// A place on an upper side.
struct Support {
    float height_m = 0.0F;
    glm::vec3 normal{0.0F, 1.0F, 0.0F}; ///< unit, upwards
};

/// Triangles that are asked for what is near. Both sides of each are hard. Coordinates are floats: a few
/// kilometres about the origin.
class Solids {
public:
    Solids() = default;
    /// Cost: n log n.
    explicit Solids(std::vector<Triangle> triangles);
    /// All triangles of a scene at rest of nodes for which `is_solid`; never cloth, nor what skins or morph
    /// targets bend.
    explicit Solids(const estampe::Scene& scene,
                    const std::function<bool(const estampe::Node& node)>& is_solid = {});

    /// Appends the triangles whose boxes touch that box. Cost: logarithmic, and linear in what is found.
    void find(const glm::vec3& low_m, const glm::vec3& high_m, std::vector<Triangle>& found) const;

    /// The highest upper side straight below a place, at most so far.
    [[nodiscard]] std::optional<Support> below(const glm::vec3& place_m, float reach_m) const;

    /// Whether the straight way between two places meets anything.
    [[nodiscard]] bool blocks(const glm::vec3& from_m, const glm::vec3& to_m) const;

    /// What is there of a node is gone from now on, or there again.
    void set_gone(estampe::Index node, bool is_gone);

    [[nodiscard]] size_t count() const { return triangles_.size(); }

private:
    struct Box {
        glm::vec3 low_m{0.0F};
        glm::vec3 high_m{0.0F};
        uint32_t first = 0; ///< of its triangles, or the box that follows the one right after it
        uint32_t count = 0; ///< of its triangles; 0: it holds two boxes
    };

    void build();
    uint32_t add_box(uint32_t first, uint32_t last);
    /// Calls `visit` with each triangle that is there in boxes which `touches`.
    template <typename Touches, typename Visit>
    void search(const Touches& touches, const Visit& visit) const;

    std::vector<Triangle> triangles_;
    std::vector<estampe::Index> owners_; ///< a node each
    std::vector<bool> gone_;             ///< by node
    std::vector<Box> boxes_;
};

/// The places of a segment and of a triangle that are nearest to each other.
struct Nearest {
    glm::vec3 on_segment{0.0F};
    glm::vec3 on_triangle{0.0F};
};

[[nodiscard]] Nearest nearest(const glm::vec3& from, const glm::vec3& to, const Triangle& triangle);

} // namespace walk
