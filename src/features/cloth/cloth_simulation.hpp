// SPDX-License-Identifier: MIT
#pragma once

// Cloth from picture to picture: the sheets of a scene, and the steps that bring them to a picture's moment.

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

/// What cloth is brought to a picture's moment with.
struct ClothInputs {
    const Scene& scene;
    pose::MeshData& layout;                     ///< whose torn triangles are left out
    pose::MeshBuffers& meshes;                  ///< the buffers of `layout`
    const std::optional<pose::PoseData>& posed; ///< the pose that the device holds
    /// Poses the scene at a moment: afterwards `posed` holds that pose, and add_posed() declares the passes
    /// that are still needed on the device.
    std::function<ScenePose(double time_s)> pose_at;
    std::function<gpu::BufferId(gpu::Graph&)> add_posed;
    const RenderSettings& settings;
    const StyleTables& style;
    std::optional<double> before_s; ///< the moment that motion is told from
};

/// What bringing cloth to a moment did besides.
struct ClothAdvance {
    bool posed_scene = false; ///< the scene was posed on the way, as it stood somewhere there
    bool tore = false;        ///< triangles are left out that were drawn before, or the other way round
};

class ClothSimulation final : public Feature {
public:
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"cloth", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Cuts the sheets of a scene that was laid out afresh; those that were there before go on from where
    /// they stood. Throws Error for sheets that cannot be made.
    void cut(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);

    /// Null where the scene has no cloth.
    [[nodiscard]] MovingCloth* sheets() { return sheets_.get(); }

    /// The draws that are sheets.
    [[nodiscard]] std::span<const uint32_t> draws() const;

    /// Whether the device has yet to pose the sheets' vertices.
    [[nodiscard]] bool has_moved() const { return sheets_ && sheets_->has_moved; }

    /// Takes the steps to the picture's moment but for the last ones, which run in the picture's own graph
    /// beside what does not depend on them. Leaves out what is torn of sheets, and draws again what is whole.
    /// Cost: besides the steps, where sheets may tear, their torn links are read back, and where others are
    /// torn than before, all triangles are uploaded.
    [[nodiscard]] ClothAdvance advance(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in);

    /// Tells sheets where solids are, where steps are left for the picture's graph. Returns the boxes that
    /// sheets were in since the last call (anchor space). To be called when the scene is posed for the
    /// picture.
    [[nodiscard]] std::vector<Bounds> place(gpu::Device& device, const ClothInputs& in,
                                            const ScenePose& pose);

    /// Declares the steps that are left, and the sheets' vertices among `posed`. Until that graph has run and
    /// drawn() says so, sheets count as lost.
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
    std::optional<glm::dvec3> cut_about_;  ///< the anchor of the layout that sheets were cut from
    std::optional<ClothSteps> steps_left_; ///< for the picture's first graph
};

} // namespace estampe::features
