// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <optional>

#include "techniques/contour/chains/mesh/line_mesh.hpp"
#include "techniques/contour/chains/mesh/ridge_chains.hpp"
#include "techniques/contour/contour.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The line mesh of one scene, made when lines are first drawn as chains.
class LineMeshes {
public:
    /// The line mesh for `style`, or null when lines are not chains. Cost: nothing when neither meshes nor
    /// choice changed; else linear in triangles. Throws Error when memory runs out.
    [[nodiscard]] contour::LineMesh* ensure(gpu::Device& device, const pose::MeshData& layout,
                                            const contour::ContourStyle& style);

    /// Begins that part of it which needs no device, in a thread that ends before what is returned does, and
    /// before which no other function may be called. Nothing to wait for where there is nothing to find.
    [[nodiscard]] std::future<void> find_edges(const pose::MeshData& layout,
                                               const contour::ContourStyle& style);

    /// What the line mesh was made of; null when there is none.
    [[nodiscard]] const contour::EdgeMesh* edges() const { return edges_ ? &*edges_ : nullptr; }

    /// To be called when triangles change, or what they are flagged with.
    void forget();

private:
    struct Choice {
        contour::FeatureChoice features;
        contour::RidgeChoice ridges;
        bool along_edges = false;
        bool suggestive = false;
        bool operator==(const Choice&) const = default;
    };

    void make_lines(gpu::Device& device, const pose::MeshData& layout, const Choice& choice);

    std::optional<contour::EdgeMesh> edges_;
    std::optional<std::vector<contour::Bending>> bendings_; ///< only when some line wants them
    std::optional<Choice> choice_;                          ///< of what `lines_` holds
    std::optional<contour::LineMesh> lines_;
};

/// The edge mesh of the triangles in `layout`. Neither the ground nor anything with holes cut by a texture
/// has lines: their edges are not where they seem to end.
[[nodiscard]] contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout);

} // namespace estampe::features
