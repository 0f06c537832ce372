// SPDX-License-Identifier: MIT
#pragma once

// Simulates the cloth of a scene over the pictures of a film, up to the time of each picture.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "features/cloth/moving_cloth.hpp"
#include "features/common/feature.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/pose/pose.hpp"

namespace estampe::features {

/// The inputs of ClothSimulation for one picture.
struct ClothInputs {
    const Scene& scene;
    pose::MeshData& layout;    ///< Layout of the scene, from which torn triangles are removed
    pose::MeshBuffers& meshes; ///< Vertex and triangle buffers of `layout`
    const std::optional<pose::PoseData>& posed; ///< Pose of the scene that the device holds
    /// Poses the scene at a time. Afterwards `posed` holds that pose, and add_posed() declares the passes
    /// that compute it on the device.
    std::function<ScenePose(double time_s)> pose_at;
    std::function<gpu::BufferId(gpu::Graph&)> add_posed;
    const RenderSettings& settings;
    const StyleTables& style;
    std::optional<double> before_s; ///< Earlier time from which the picture's motion is measured
};

/// Effects of ClothSimulation::advance() on the scene.
struct ClothAdvance {
    bool posed_scene = false; ///< The scene was posed at other times than the picture's time
    bool tore = false;        ///< The set of torn triangles has changed
};

class ClothSimulation final : public Feature {
public:
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"cloth", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Makes the cloth sheets of a new layout. Sheets that existed before keep their state. Throws Error if a
    /// sheet cannot be made.
    void cut(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);

    /// Returns the cloth sheets; null if the scene has no cloth.
    [[nodiscard]] MovingCloth* sheets() { return sheets_.get(); }

    /// Returns the draw calls that are cloth sheets.
    [[nodiscard]] std::span<const uint32_t> draws() const;

    /// Returns whether the vertices of the cloth sheets on the device are out of date.
    [[nodiscard]] bool has_moved() const { return sheets_ && sheets_->has_moved; }

    /// Simulates the cloth up to the picture's time, except for the last steps, which record() puts into the
    /// picture's own graph, parallel to independent passes. Removes torn triangles of sheets and restores
    /// triangles that are no longer torn. Cost: the simulation steps. If sheets may tear, torn links are also
    /// read back, and all triangles are uploaded whenever the set of torn triangles changes.
    [[nodiscard]] ClothAdvance advance(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in);

    /// Places the solids with which cloth sheets collide, if simulation steps remain for the picture's graph.
    /// Returns the boxes that the sheets occupied since the last call. Boxes are relative to the scene's
    /// anchor (the origin of positions on the device). Call this function only after the scene is posed for
    /// the picture.
    [[nodiscard]] std::vector<Bounds> place(gpu::Device& device, const ClothInputs& in,
                                            const ScenePose& pose);

    /// Declares the remaining steps of the cloth, and writes the sheets' vertices into `posed`. The state of
    /// the sheets is invalid until the graph has run and drawn() is called.
    void record(gpu::Graph& graph, const pose::PoseData& pose, const glm::dvec3& anchor,
                gpu::BufferId& posed_vertices, gpu::BufferId& vertices_before);
    void drawn();

private:
    [[nodiscard]] bool tear(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in);
    void place_solids(gpu::Device& device, const ClothInputs& in, const ScenePose& pose, double time_s);
    [[nodiscard]] gpu::BufferId pose_for(gpu::Device& device, gpu::Graph& graph, const ClothInputs& in,
                                         double time_s);
    void start(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in, const ClothRun& run);
    void step(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in, const ClothSteps& steps);

    std::unique_ptr<MovingCloth> sheets_;
    /// Anchor (origin of positions) of the layout from which the cloth sheets were built.
    std::optional<glm::dvec3> cut_about_;
    std::optional<ClothSteps> steps_left_; ///< Simulation steps that run in the picture's first graph
};

} // namespace estampe::features
