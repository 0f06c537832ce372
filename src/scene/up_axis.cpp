// SPDX-License-Identifier: MIT
#include "scene/up_axis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/pose.hpp"

namespace estampe {
namespace {

/// Returns the rotation by a quarter or half turn that maps the axis `up` to +y. The rotation is exact,
/// because it only permutes the axes.
glm::dmat3 rotation_of(UpAxis up)
{
    constexpr glm::dvec3 x(1.0, 0.0, 0.0);
    constexpr glm::dvec3 y(0.0, 1.0, 0.0);
    constexpr glm::dvec3 z(0.0, 0.0, 1.0);
    switch (up) {
    case UpAxis::x:
        return {y, -x, z};
    case UpAxis::minus_x:
        return {-y, x, z};
    case UpAxis::minus_y:
        return {-x, -y, z};
    case UpAxis::z:
        return {x, -z, y};
    case UpAxis::minus_z:
        return {x, z, -y};
    case UpAxis::y:
        break;
    }
    return {x, y, z};
}

} // namespace

void turn_up(Scene& scene, UpAxis up)
{
    if (up == UpAxis::y)
        return;
    const auto turned = static_cast<Index>(scene.nodes.size());
    Node node;
    node.name = "up";
    node.children = scene.roots;
    node.matrix = glm::dmat4(rotation_of(up));
    for (const Index root : scene.roots)
        scene.nodes[root].parent = turned;
    scene.nodes.push_back(std::move(node));
    scene.roots = {turned};
}

namespace {

/// Areas of flat faces at the lower and upper end of the scene along an axis, as shares of the bounding box's
/// cross section.
struct Ends {
    double base_outward = 0.0; ///< faces at the lower end that face outwards: the underside of a solid
    double base_inward = 0.0;  ///< faces at the lower end that face inwards: a floor on which objects stand
    double top = 0.0;          ///< faces at the upper end
    double open_below = 0.0;   ///< projected area that is missing at the lower end to close the surface
};

class Evidence {
public:
    Evidence(const Bounds& bounds, int axis)
        : axis_(axis), size_(bounds.max - bounds.min), lower_(bounds.min[axis]), upper_(bounds.max[axis])
    {
        const double largest = std::max({size_.x, size_.y, size_.z});
        slab_ = flat_share * size_[axis] + 1e-6 * largest;
        across_ = std::max(size_[(axis + 1) % 3] * size_[(axis + 2) % 3], 1e-12 * largest * largest);
    }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
    {
        const glm::dvec3 twice_area = glm::cross(b - a, c - a);
        const double share = 0.5 * twice_area[axis_] / across_;
        ends_.open_below += share;
        constexpr double level = 0.97;
        if (!(std::abs(twice_area[axis_]) > level * glm::length(twice_area))) {
            return;
        }
        const auto [low, high] = std::minmax({a[axis_], b[axis_], c[axis_]});
        if (high <= lower_ + slab_) {
            (share < 0.0 ? ends_.base_outward : ends_.base_inward) += std::abs(share);
        }
        if (low >= upper_ - slab_) {
            ends_.top += std::abs(share);
        }
    }

    /// Limits each share to one, because faces may coincide.
    [[nodiscard]] Ends ends() const
    {
        return {.base_outward = std::min(ends_.base_outward, 1.0),
                .base_inward = std::min(ends_.base_inward, 1.0),
                .top = std::min(ends_.top, 1.0),
                .open_below = std::clamp(ends_.open_below, 0.0, 1.0)};
    }

    [[nodiscard]] bool stands_on_origin() const
    {
        return upper_ > lower_ && std::abs(lower_) <= flat_share * (upper_ - lower_);
    }

    /// Returns whether the scene is thin along this axis. Terrain is thin along its up axis.
    [[nodiscard]] bool is_thin() const
    {
        return size_[axis_] < 0.25 * std::min(size_[(axis_ + 1) % 3], size_[(axis_ + 2) % 3]);
    }

private:
    static constexpr double flat_share = 5e-3;

    int axis_;
    glm::dvec3 size_;
    double lower_;
    double upper_;
    double slab_ = 0.0;
    double across_ = 1.0;
    Ends ends_;
};

double common_score(const Evidence& evidence)
{
    constexpr double for_origin = 0.3;
    constexpr double for_terrain = 0.5;
    return (evidence.stands_on_origin() ? for_origin : 0.0) +
           (evidence.is_thin() ? for_terrain * evidence.ends().open_below : 0.0);
}

} // namespace

std::optional<UpAxis> guess_up_axis(const Scene& scene)
{
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    const Bounds bounds = scene_bounds(scene, pose);
    if (bounds.empty()) {
        return std::nullopt;
    }
    Evidence along_y(bounds, 1);
    Evidence along_z(bounds, 2);
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        if (posed.primitive->topology != Topology::triangles) {
            return;
        }
        const std::vector<uint32_t>& indices = posed.primitive->indices;
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            const glm::dvec3& a = posed.positions[indices[i]];
            const glm::dvec3& b = posed.positions[indices[i + 1]];
            const glm::dvec3& c = posed.positions[indices[i + 2]];
            along_y.add(a, posed.mirrored ? c : b, posed.mirrored ? b : c);
            along_z.add(a, posed.mirrored ? c : b, posed.mirrored ? b : c);
        }
    });
    const Ends y = along_y.ends();
    const Ends z = along_z.ends();
    const double base_y = std::max(y.base_outward, y.base_inward);
    // A room that is open to the viewer has a back wall, which also faces inwards, at the lower end of the z
    // axis. A room that is open to the viewer also has a floor at the lower end of the y axis. The floor
    // shows that y is up.
    constexpr double floor_share = 0.3;
    const double base_z = base_y < floor_share ? std::max(z.base_outward, z.base_inward) : z.base_outward;
    const double score_y = common_score(along_y) + base_y - y.top;
    const double score_z = common_score(along_z) + base_z - z.top;
    constexpr double clearly = 0.25;
    if (score_z - score_y >= clearly && score_z >= clearly) {
        return UpAxis::z;
    }
    if (score_y - score_z >= clearly && score_y >= clearly) {
        return UpAxis::y;
    }
    return std::nullopt;
}

} // namespace estampe
