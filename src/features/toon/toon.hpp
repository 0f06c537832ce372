// SPDX-License-Identifier: MIT
#pragma once

// Cel shading with two textures: the colours that surfaces have in the shade, from the materials of the
// scene's file and from pictures that the style names.

#include <optional>
#include <string>
#include <vector>

#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "gpu/resources.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/surface/materials.hpp"

namespace estampe::features {

struct ToonPlan {
    bool is_drawn = false;  ///< some surface has a texture for the shade, and paint
    bool has_steps = false; ///< some surface decides by the sun where it is in shade, and the sun shines
};

struct ToonInputs {
    const pose::MeshData& layout;
    const surface::MaterialBuffers& materials;
    const StyleVariants& variants;
    bool has_sun = false;
};

class Toon final : public Feature {
public:
    /// Forgets the records of draw calls when draw calls get new numbers.
    void invalidate(Event event) override;

    /// Loads the pictures that the style names for the shade, and uploads a record for each draw call. Adds a
    /// note if a picture cannot be placed on a surface without UVs. Throws Error with the file's name if a
    /// picture cannot be read. Cost: linear in draw calls if some surface has a texture for the shade, else
    /// linear in style variants; pictures are read when the style names them first.
    [[nodiscard]] ToonPlan ensure(gpu::Device& device, const ToonInputs& in, std::vector<std::string>& notes);

    /// Imports the buffer with a ShadeRecord per draw call, see surface/shade.glsl.h. Only valid if the plan
    /// of ensure() has `is_drawn`.
    [[nodiscard]] gpu::BufferId records(gpu::Graph& graph)
    {
        return gpu::import_whole(graph, "shade records", record_buffer_);
    }

    /// Imports the array image of the pictures that the style names; none without pictures.
    [[nodiscard]] std::optional<gpu::ImageId> pictures(gpu::Graph& graph)
    {
        return pictures_.empty() ? std::nullopt
                                 : std::optional(gpu::import_uploaded(graph, "pictures", picture_layers_));
    }

private:
    struct Picture {
        std::string path;
        glm::vec3 mean_color{1.0F};
    };

    void ensure_pictures(gpu::Device& device, const StyleVariants& variants);
    [[nodiscard]] shared::ShadeRecord record_of(const ToonInputs& in, size_t draw) const;

    std::vector<Picture> pictures_; ///< pictures in `picture_layers_`, in order
    gpu::Image picture_layers_;     ///< only valid if there are pictures
    std::vector<shared::ShadeRecord> records_;
    std::vector<shared::ShadeRecord> records_before_; ///< as on the device
    gpu::Buffer record_buffer_;
};

} // namespace estampe::features
