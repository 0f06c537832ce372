// SPDX-License-Identifier: MIT
#pragma once

// Rising smoke over several pictures: the boxes in which smoke rises, and the state of the simulation in each
// box.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "features/common/blast.hpp"
#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/light/light.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/smoke/smoke.hpp"

namespace estampe::fluid {
class Fluid;
}

namespace estampe::features {

/// Converts the scene's lights for smoke. If the sun has a shadow map and the first light is directional,
/// this light uses the map.
[[nodiscard]] std::vector<smoke::Lamp> smoke_lamps(const light::Lighting& lighting, bool has_sun_map);

/// Adds the glow of fires at the smoke's sources to the lights, if the style asks for the glow. The fires
/// flicker with time.
void add_fires(light::Lighting& lighting, const std::vector<smoke::Box>& boxes,
               const smoke::SmokeStyle& style, double time_s);

/// Returns the blasts of the first shared::smoke_most_boxes smoke boxes of a scene, for things that the air
/// moves outside of the simulation; empty if the style has none.
[[nodiscard]] std::vector<Blast> smoke_blasts(const Scene& scene, const ScenePose& pose,
                                              const glm::dvec3& anchor, const smoke::SmokeStyle& style);

/// The inputs for the smoke of a picture.
struct SmokeInputs {
    const Scene& scene; ///< Scene in the pose of the picture
    const pose::MeshData& layout;
    const ScenePose& pose;
    const RenderSettings& settings;
    const StyleTables& style;
    const std::vector<smoke::Lamp>& lamps;
    float ambient = 0.0F;                           ///< Luminance of the ambient light
    const std::vector<smoke::Box>* risen = nullptr; ///< Boxes that rise() returned, if it was called
};

struct SmokePlan {
    std::vector<smoke::Box> boxes; ///< Boxes of smoke in the picture; at least one
};

/// Makes one smoke box for each node whose name matches the pattern. The box is 2 m wide along each axis in
/// the node's space, and the node is in the middle of the box's floor. The number of cells along each side is
/// a power of two. Boxes are numbered in the order of matching nodes. Nodes with zero scale get no box.
[[nodiscard]] std::vector<smoke::Box> smoke_boxes(const Scene& scene, const ScenePose& pose,
                                                  const glm::dvec3& anchor, const std::string& pattern,
                                                  uint32_t cells);

class RisingSmoke final : public Feature {
public:
    RisingSmoke();
    ~RisingSmoke() override;

    /// Simulates the smoke up to the time of a picture, and returns its boxes; empty if the style or the
    /// scene has no smoke. The last steps remain for the next graph that calls velocity() or record(), where
    /// they run in parallel with independent passes. The simulation continues from the previous picture, if
    /// that picture is at most a second earlier and has the same number of quantities. Otherwise the
    /// simulation starts `age_s` before the picture, with steps_per_s() steps per second. Patterns that match
    /// nothing, and more boxes than shared::smoke_most_boxes, are reported in `notes`.
    [[nodiscard]] std::vector<smoke::Box> rise(gpu::Device& device, gpu::Executor& executor,
                                               const SmokeInputs& in, std::vector<std::string>& notes);

    /// Returns the air's velocity in a smoke box that rise() returned. Call at most once per graph.
    [[nodiscard]] gpu::ImageId velocity(gpu::Graph& graph, size_t box);

    /// Plans light and drawing of the smoke; calls rise() unless rise() was already called. Returns none if
    /// the picture has no smoke.
    [[nodiscard]] std::optional<SmokePlan> ensure(gpu::Device& device, gpu::Executor& executor,
                                                  const SmokeInputs& in, std::vector<std::string>& notes);

    /// Returns the solver reports of the smoke boxes whose last steps were measured, with numbers in their
    /// names if there are several boxes.
    [[nodiscard]] std::vector<SolverReport> solver_reports() const;

    /// Forgets the smoke of a replaced scene. A moved anchor (origin of positions on the device) has no
    /// effect, because smoke is stored relative to its box.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"smoke", 2}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Records the smoke's density volume and its lighting, with shadows from the scene's `maps` if the style
    /// asks for them. Call once per picture; other graphs use volume().
    [[nodiscard]] smoke::Volume record(gpu::Graph& graph, const smoke::SmokeStyle& style, gpu::BufferId frame,
                                       const light::ShadowMaps& maps);

    /// Returns the smoke volume that record() made, for another graph.
    [[nodiscard]] smoke::Volume volume(gpu::Graph& graph) { return volume_.import(graph); }

    /// Returns the inputs for drawing the smoke on a page. `frame` is the buffer of FrameGlobals, `depth` is
    /// an r32f image of reversed depth.
    [[nodiscard]] smoke::ViewInputs view(gpu::Graph& graph, gpu::BufferId frame, gpu::ImageId depth,
                                         glm::uvec2 size_px);

private:
    /// The simulated smoke of a box.
    struct Column;
    /// The saved state of a smoke box, from which the next frame of a film continues.
    struct Kept;

    [[nodiscard]] std::unique_ptr<Column> started(gpu::Device& device, gpu::Executor& executor,
                                                  const smoke::Box& box, const SmokeInputs& in);

    std::vector<std::unique_ptr<Column>> columns_;
    gpu::Buffer globals_;
    smoke::VolumeMemory volume_;
};

} // namespace estampe::features
