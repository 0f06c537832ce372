// SPDX-License-Identifier: MIT
#pragma once

// Reads the surfaces that a picture shows back to the host.

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/surface/surface.hpp"

namespace estampe::frame {

/// Host copies of the images of surface::Surface that are read back.
struct SurfaceReading {
    gpu::Buffer draw;
    gpu::Buffer depth;
    gpu::Buffer normal;
};

/// Allocates the buffers for a picture of this size.
[[nodiscard]] SurfaceReading make_surface_reading(gpu::Device& device, glm::uvec2 size_px);

/// Declares the passes that copy the images of `surface` into `reading`, which must outlive the run of
/// `graph`.
void declare_surface_reading(gpu::Graph& graph, const surface::Surface& surface, SurfaceReading& reading);

} // namespace estampe::frame
