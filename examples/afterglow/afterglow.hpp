// SPDX-License-Identifier: MIT
#pragma once

// Ink that fades: what was drawn in the pictures before is still there, paler with time.

#include <optional>

#include "features/common/feature.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/shared.hpp"

namespace estampe::features {

struct AfterglowStyle {
    float half_life_s = 0.25F; ///< after which half of the ink is left
};

/// What is decided on the processor before the frame.
struct AfterglowPlan {
    glm::uvec2 size_px{0};
    double time_s = 0.0;
    float kept = 0.0F; ///< share of the ink before that is still there; 0 where the picture goes on from none
};

class Afterglow final : public Feature {
public:
    /// Plans a picture at a moment of the scene, and makes room for it. It goes on from the picture before
    /// when `follows`, the page is as large, and time did not go back.
    [[nodiscard]] AfterglowPlan plan(gpu::Device& device, glm::uvec2 size_px, double time_s, bool follows,
                                     const AfterglowStyle& style);

    /// Writes  r16f: `ink`, or what is left of the picture before where that is more
    /// Cost    one full-screen dispatch
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const AfterglowPlan& plan, gpu::ImageId ink);

    /// To be called when the graph has run.
    void drawn(const AfterglowPlan& plan);

    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override
    {
        return FilmSection{"afterglow", 1};
    }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

private:
    gpu::Buffer ink_; ///< one float per pixel
    glm::uvec2 size_px_{0};
    std::optional<double> time_s_; ///< of the picture that `ink_` is of; none where it is of no use
};

} // namespace estampe::features
