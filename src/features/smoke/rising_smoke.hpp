// SPDX-License-Identifier: MIT
#pragma once

// Smoke that rises from picture to picture: where its boxes stand, and how far it has come in each.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

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

/// The scene's lights as smoke takes them; the first that is directional throws the shadow of the sun's map,
/// where there is one.
[[nodiscard]] std::vector<smoke::Lamp> smoke_lamps(const light::Lighting& lighting, bool has_sun_map);

/// The fires that smoke rises from, as lamps among the lights, where the style has them glow. They flicker.
void add_fires(light::Lighting& lighting, const std::vector<smoke::Box>& boxes,
               const smoke::SmokeStyle& style, double time_s);

/// What a picture's smoke is planned from.
struct SmokeInputs {
    const Scene& scene; ///< posed
    const pose::MeshData& layout;
    const ScenePose& pose;
    const RenderSettings& settings;
    const StyleTables& style;
    const std::vector<smoke::Lamp>& lamps;
    float ambient = 0.0F;                           ///< luminance
    const std::vector<smoke::Box>* risen = nullptr; ///< what rise() returned, if it has been called
};

struct SmokePlan {
    std::vector<smoke::Box> boxes; ///< at least one
};

/// The boxes of nodes that the pattern names, 2 m wide each way in the node's space and about the middle of
/// its own floor; the sides are powers of two in cells. Each has the number that its node has among those.
/// Nodes that are scaled to nothing have none.
[[nodiscard]] std::vector<smoke::Box> smoke_boxes(const Scene& scene, const ScenePose& pose,
                                                  const glm::dvec3& anchor, const std::string& pattern,
                                                  uint32_t cells);

class RisingSmoke final : public Feature {
public:
    RisingSmoke();
    ~RisingSmoke() override;

    /// Lets the smoke rise to the moment of a picture, and returns its boxes; none where the style or the
    /// scene has none. The last steps are for the graph that next asks for velocity() or record(), in which
    /// they run beside what hangs on none of them. It goes on from the picture before where that is followed,
    /// at most a second later; else, and where another number of quantities is to rise, it starts `age_s`
    /// ago, and takes steps_per_s() for each of these seconds. Patterns that name nothing, or more than
    /// shared::smoke_most_boxes, go into `notes`.
    [[nodiscard]] std::vector<smoke::Box> rise(gpu::Device& device, gpu::Executor& executor,
                                               const SmokeInputs& in, std::vector<std::string>& notes);

    /// The velocity in a box of those; once a graph.
    [[nodiscard]] gpu::ImageId velocity(gpu::Graph& graph, size_t box);

    /// Plans how the smoke is lit and drawn, which rises before unless it has; nothing where there is none.
    [[nodiscard]] std::optional<SmokePlan> ensure(gpu::Device& device, gpu::Executor& executor,
                                                  const SmokeInputs& in, std::vector<std::string>& notes);

    /// Of the boxes that were measured when they took their last steps, numbered where there are several.
    [[nodiscard]] std::vector<SolverReport> solver_reports() const;

    /// Smoke of another scene is let go. What rises in the world stays where the anchor moves.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"smoke", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Shapes what has risen, and lights it through the `maps` of the scene if the style wants its shadows.
    /// Once a picture; other graphs find it by volume().
    [[nodiscard]] smoke::Volume record(gpu::Graph& graph, const smoke::SmokeStyle& style, gpu::BufferId frame,
                                       const light::ShadowMaps& maps);

    /// What record() left.
    [[nodiscard]] smoke::Volume volume(gpu::Graph& graph) { return volume_.import(graph); }

    /// How a page sees it. `frame`: FrameGlobals; `depth`: r32f, reversed.
    [[nodiscard]] smoke::ViewInputs view(gpu::Graph& graph, gpu::BufferId frame, gpu::ImageId depth,
                                         glm::uvec2 size_px);

private:
    /// The smoke of a box.
    struct Column;
    /// What a film's next frame takes from this one, of a box.
    struct Kept;

    [[nodiscard]] std::unique_ptr<Column> started(gpu::Device& device, gpu::Executor& executor,
                                                  const smoke::Box& box, const SmokeInputs& in);

    std::vector<std::unique_ptr<Column>> columns_;
    gpu::Buffer globals_;
    smoke::VolumeMemory volume_;
};

} // namespace estampe::features
