// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/feature_chains.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace estampe::contour {
namespace {

constexpr float smooth_crease_deg = 60.0F;
constexpr float straight_cosine = 0.5F; // 60 degrees
constexpr uint32_t no_end = ~0U;
constexpr size_t most_edges_at_a_point = 64;

bool is_chosen(const FeatureEdge& edge, const FeatureChoice& choice)
{
    if (choice.marked && edge.mark == EdgeMark::marked) {
        return true;
    }
    const bool is_left_out = choice.marked && edge.mark == EdgeMark::plain;
    if (is_left_out && edge.kind != FeatureKind::boundary) {
        return false;
    }
    const float least_deg = edge.is_split ? std::max(choice.crease_deg, least_fold_deg)
                                          : std::max(choice.crease_deg, smooth_crease_deg);
    const bool is_crease = choice.creases && !is_left_out && edge.fold_deg >= least_deg;
    switch (edge.kind) {
    case FeatureKind::border:
        return choice.borders;
    case FeatureKind::boundary:
        return choice.boundaries || is_crease;
    case FeatureKind::crease:
        return is_crease;
    }
    return false;
}

uint32_t line_kind(const FeatureEdge& edge, const FeatureChoice& choice)
{
    return edge.kind == FeatureKind::border                 ? shared::line_border
           : choice.marked && edge.mark == EdgeMark::marked ? shared::line_marked
           : edge.kind == FeatureKind::boundary             ? shared::line_boundary
                                                            : shared::line_crease;
}

class Stringer {
public:
    Stringer(const EdgeMesh& mesh, std::span<const glm::vec3> positions, const FeatureChoice& choice)
        : mesh_(mesh), positions_(positions)
    {
        for (const FeatureEdge& feature : mesh.features) {
            if (is_chosen(feature, choice)) {
                edges_.push_back({feature.side, line_kind(feature, choice), vertex(feature.side, 0),
                                  vertex(feature.side, 1)});
            }
        }
    }

    FeatureChains run()
    {
        join_ends();
        is_linked_.assign(edges_.size(), false);
        for (uint32_t end = 0; end < partner_.size(); ++end) {
            if (partner_[end] == no_end && !is_linked_[end / 2]) {
                string_from(end, false);
            }
        }
        for (uint32_t edge = 0; edge < edges_.size(); ++edge) {
            if (!is_linked_[edge]) {
                string_from(2 * edge, true);
            }
        }
        list_loose();
        return std::move(result_);
    }

private:
    struct Edge {
        uint32_t side = no_side;
        uint32_t kind = shared::line_crease;
        uint32_t from = 0; ///< vertices
        uint32_t to = 0;
    };

    [[nodiscard]] uint32_t vertex(uint32_t side, uint32_t step) const
    {
        return mesh_.triangles[side >> 2U][static_cast<int>(((side & 3U) + step) % 3)];
    }

    /// Vertex at end 2 e or 2 e + 1 of edge e.
    [[nodiscard]] uint32_t vertex_at(uint32_t end) const
    {
        return (end & 1U) == 0 ? edges_[end / 2].from : edges_[end / 2].to;
    }

    /// From the end into its edge.
    [[nodiscard]] glm::vec3 inwards(uint32_t end) const
    {
        const glm::vec3 along = positions_[vertex_at(end ^ 1U)] - positions_[vertex_at(end)];
        const float length = glm::length(along);
        return length > 0.0F ? along / length : glm::vec3(0.0F);
    }

    /// Finds for each end the one it goes on at.
    void join_ends()
    {
        partner_.assign(2 * edges_.size(), no_end);
        std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> ends_at; // by point and kind
        for (uint32_t end = 0; end < partner_.size(); ++end) {
            ends_at[{mesh_.points[vertex_at(end)], edges_[end / 2].kind}].push_back(end);
        }

        struct Joint {
            float cosine = 0.0F;
            uint32_t a = 0;
            uint32_t b = 0;
        };

        std::vector<Joint> joints;
        for (const auto& [place, ends] : ends_at) {
            joints.clear();
            for (size_t i = 0; i < ends.size() && ends.size() <= most_edges_at_a_point; ++i) {
                for (size_t j = i + 1; j < ends.size(); ++j) {
                    joints.push_back({-glm::dot(inwards(ends[i]), inwards(ends[j])), ends[i], ends[j]});
                }
            }
            std::stable_sort(joints.begin(), joints.end(),
                             [](const Joint& x, const Joint& y) { return x.cosine > y.cosine; });
            for (const Joint& joint : joints) {
                if (joint.cosine >= straight_cosine && partner_[joint.a] == no_end &&
                    partner_[joint.b] == no_end) {
                    partner_[joint.a] = joint.b;
                    partner_[joint.b] = joint.a;
                }
            }
        }
    }

    /// Follows edges from `end` to where they go no further, or come back.
    void string_from(uint32_t end, bool is_closed)
    {
        const auto chain = static_cast<uint32_t>(result_.chains.size());
        const auto first = static_cast<uint32_t>(result_.points.size());
        uint32_t last = end;
        while (end != no_end && !is_linked_[end / 2]) {
            is_linked_[end / 2] = true;
            const Edge& edge = edges_[end / 2];
            result_.points.push_back({.vertex = vertex_at(end),
                                      .other_vertex = vertex_at(end),
                                      .share = 0.0F,
                                      .chain = chain,
                                      .kind = edge.kind,
                                      .side = edge.side});
            last = end ^ 1U;
            end = partner_[last];
        }
        shared::FeaturePoint final_point = result_.points.back();
        final_point.vertex = final_point.other_vertex = vertex_at(last);
        result_.points.push_back(final_point);
        result_.chains.push_back({.first_point = first,
                                  .point_count = static_cast<uint32_t>(result_.points.size()) - first,
                                  .is_closed = is_closed ? 1U : 0U});
    }

    void list_loose()
    {
        std::vector<uint32_t> lined;
        lined.reserve(edges_.size());
        for (const Edge& edge : edges_) {
            lined.push_back(edge.side);
        }
        std::sort(lined.begin(), lined.end());
        for (const glm::uvec2& edge : mesh_.hard_edges) {
            if (!std::binary_search(lined.begin(), lined.end(), edge.x)) {
                result_.loose_edges.push_back(edge);
            }
        }
    }

    const EdgeMesh& mesh_;
    std::span<const glm::vec3> positions_;
    std::vector<Edge> edges_;
    std::vector<uint32_t> partner_; ///< one an end
    std::vector<bool> is_linked_;   ///< one an edge
    FeatureChains result_;
};

} // namespace

FeatureChains string_features(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                              const FeatureChoice& choice)
{
    return Stringer(mesh, positions, choice).run();
}

} // namespace estampe::contour
