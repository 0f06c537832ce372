// SPDX-License-Identifier: MIT
#pragma once

// Ink that fades: the ink of earlier pictures remains visible, paler with time.

#include <optional>

#include "features/common/feature.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/shared.hpp"

namespace estampe::features {

struct AfterglowStyle {
    float half_life_s = 0.25F; ///< time in which the ink fades to half
};

/// Values that are computed on the CPU before the frame.
struct AfterglowPlan {
    glm::uvec2 size_px{0};
    double time_s = 0.0;
    float kept = 0.0F; ///< share of the previous ink that remains; 0 without a previous picture
};

class Afterglow final : public Feature {
public:
    /// Plans a picture at a moment of the scene, and allocates its memory. The ink of the previous picture
    /// continues if `follows` is true, the page size is unchanged, and time did not go back.
    [[nodiscard]] AfterglowPlan plan(gpu::Device& device, glm::uvec2 size_px, double time_s, bool follows,
                                     const AfterglowStyle& style);

    /// Writes  r16f: the larger of `ink` and the faded ink of the previous pictures
    /// Cost    one full-screen dispatch
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const AfterglowPlan& plan, gpu::ImageId ink);

    /// Must be called after the graph has run.
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
    std::optional<double> time_s_; ///< time of the picture that `ink_` holds; none if `ink_` is not usable
};

} // namespace estampe::features
