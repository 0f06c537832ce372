// SPDX-License-Identifier: MIT
#pragma once

// Smoke that rises from picture to picture: where its box stands, and how far it has come.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "frame/loaded_scene.hpp"
#include "frame/style_tables.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/light/light.hpp"
#include "techniques/smoke/smoke.hpp"

namespace estampe::fluid {
class Fluid;
}

namespace estampe::frame {

/// The scene's lights as smoke takes them.
[[nodiscard]] std::vector<smoke::Lamp> smoke_lamps(const light::Lighting& lighting);

/// What a picture's smoke is planned from.
struct SmokeInputs {
    const LoadedScene& loaded; ///< posed
    const ScenePose& pose;
    const RenderSettings& settings;
    const StyleTables& style;
    const std::vector<smoke::Lamp>& lamps;
    float ambient = 0.0F; ///< luminance
};

struct SmokePlan {
    smoke::Box box;
    float rise_m = 0.0F; ///< how far strokes have risen with it
};

/// The box of the first node that the pattern names, 2 m wide each way in the node's space and about the
/// middle of its own floor; the sides are powers of two in cells. Nothing where no node is meant.
[[nodiscard]] std::optional<smoke::Box> smoke_box(const Scene& scene, const ScenePose& pose,
                                                  const glm::dvec3& anchor, const std::string& pattern,
                                                  uint32_t cells);

/// What a film's next frame takes from this one.
struct KeptSmoke {
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    double time_s = 0.0;
    std::vector<float> velocity;   ///< three numbers a cell
    std::vector<float> quantities; ///< two
};

/// Throws Error for what no smoke has.
[[nodiscard]] uint64_t kept_cell_count(const KeptSmoke& kept);

class RisingSmoke {
public:
    RisingSmoke();
    ~RisingSmoke();
    RisingSmoke(const RisingSmoke&) = delete;
    RisingSmoke& operator=(const RisingSmoke&) = delete;

    /// Lets the smoke rise to the moment of a picture, lights it there, and plans how it is drawn; nothing
    /// where the style or the scene has none. It goes on from the picture before where that is followed, at
    /// most a second later; else it starts `age_s` ago, and takes 24 steps for each of these seconds.
    /// Patterns that name nothing go into `notes`.
    [[nodiscard]] std::optional<SmokePlan> provide(gpu::Device& device, gpu::Executor& executor,
                                                   const SmokeInputs& in, std::vector<std::string>& notes);

    /// The next picture is of something else.
    void forget();

    [[nodiscard]] std::optional<KeptSmoke> kept(gpu::Device& device, gpu::Executor& executor);

    /// The next picture may go on from that.
    void recall(KeptSmoke kept);

    [[nodiscard]] gpu::Buffer& globals() { return globals_; }

    [[nodiscard]] smoke::VolumeMemory& volume() { return volume_; }

private:
    void start(gpu::Device& device, const smoke::Box& box, const SmokeInputs& in);
    void rise(gpu::Executor& executor, const smoke::Box& box, const smoke::SmokeStyle& style, double time_s);

    std::unique_ptr<fluid::Fluid> fluid_; ///< none where what is recalled was not asked for yet
    KeptSmoke recalled_;
    glm::uvec3 cells_{0};
    float cell_m_ = 1.0F;
    std::optional<double> time_s_;
    gpu::Buffer globals_;
    smoke::VolumeMemory volume_;
};

} // namespace estampe::frame
