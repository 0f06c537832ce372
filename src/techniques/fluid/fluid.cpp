// SPDX-License-Identifier: MIT
// Stepping by reflection: Zehnder, Narain and Thomaszewski, "An Advection-Reflection Solver for
// Detail-Preserving Fluid Simulation", ACM Transactions on Graphics 37, 2018.
#include "techniques/fluid/fluid.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "techniques/fluid/motion/diffusion.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
namespace {

gpu::Image start_image(gpu::Device& device, const char* name, const gpu::ImageDesc& desc,
                       std::span<const float> start)
{
    gpu::Image image(device, name, desc);
    const size_t layer_size = size_t{desc.width} * desc.height;
    gpu::upload_layers(device, image, [&](uint32_t layer) {
        std::vector<std::byte> bytes(layer_size * sizeof(float));
        if ((layer + 1) * layer_size <= start.size()) {
            std::ranges::copy(std::as_bytes(start.subspan(layer * layer_size, layer_size)), bytes.begin());
        }
        return gpu::LayerPixels{.levels = {std::move(bytes)}};
    });
    return image;
}

void check_start(const Grid& grid, uint32_t channels, std::span<const float> start)
{
    if (!start.empty() && start.size() != grid.cell_count() * channels) {
        throw std::logic_error("the start of a fluid has as many numbers as its grid has");
    }
}

/// Leaves an image as the next graph takes it in.
gpu::ImageId handed_on(gpu::Graph& graph, gpu::ImageId image)
{
    auto pass = graph.custom("fluid/keep");
    pass.touch(image, gpu::Access::compute_sampled);
    pass.keep();
    pass.execute([](gpu::Recorder&) {});
    return image;
}

} // namespace

/// What the steps of one graph hand on to each other.
struct Fluid::Handles {
    gpu::ImageId velocity;
    std::vector<gpu::ImageId> quantities; ///< both of quantities_, or none
    Solids solids;
    SolverTables tables;
};

Fluid::Fluid(gpu::Device& device, const Grid& grid, uint32_t channels, std::span<const float> velocity,
             std::span<const float> quantities)
    : grid_(grid), channels_(channels)
{
    check_grid(grid);
    check_start(grid, grid.dimensions(), velocity);
    check_start(grid, channels, quantities);
    velocity_ = start_image(device, "fluid velocity", velocity_desc(grid), velocity);
    if (channels > 0) {
        for (gpu::Image& image : quantities_) {
            image = start_image(device, "fluid quantities", field_desc(grid, channels), quantities);
        }
    }
    solids_ = gpu::upload_buffer(device, "fluid solids", std::vector<uint32_t>(grid.cell_count()));
    angles_ = upload_angles(device, grid);
}

void Fluid::add_step(gpu::Graph& graph, const FluidStyle& style, Handles& handles)
{
    const bool reflects = style.stepping == Stepping::reflect;
    const float part_s = reflects ? 0.5F * style.step_s : style.step_s;
    const std::optional<gpu::ImageId> weighing = channels_ > shared::fluid_temperature
                                                     ? std::optional(handles.quantities[newest_quantities_])
                                                     : std::nullopt;
    const auto diffused = [&](gpu::ImageId velocity) {
        return style.viscosity_m2_s > 0.0F
                   ? add_diffusion(graph, grid_, velocity, style.viscosity_m2_s, part_s)
                   : velocity;
    };
    const auto moved = [&](gpu::ImageId carrier, gpu::ImageId velocity) {
        const gpu::ImageId advected =
            add_advection(graph, grid_, style.velocity_advection,
                          {carrier, velocity, graph.image("fluid/moved", velocity_desc(grid_))}, part_s);
        return add_forces(graph, grid_, style.forces, advected, weighing, part_s);
    };
    const auto projected = [&](gpu::ImageId velocity, gpu::ImageId target, bool is_reflected) {
        return add_projection(graph, grid_, style.projection,
                              {velocity, handles.solids, handles.tables, target}, is_reflected);
    };
    gpu::ImageId carrier = handles.velocity;
    if (reflects) {
        const gpu::ImageId start = diffused(handles.velocity);
        const Projected half =
            projected(moved(start, start), graph.image("fluid/half", velocity_desc(grid_)), true);
        carrier = half.velocity;
        handles.velocity =
            projected(diffused(moved(half.velocity, half.reflected)), handles.velocity, false).velocity;
    } else {
        handles.velocity =
            projected(diffused(moved(handles.velocity, handles.velocity)), handles.velocity, false).velocity;
        carrier = handles.velocity;
    }
    if (channels_ > 0) {
        const uint32_t last = newest_quantities_;
        newest_quantities_ = 1 - last;
        handles.quantities[newest_quantities_] = add_advection(
            graph, grid_, style.quantity_advection,
            {carrier, handles.quantities[last], handles.quantities[newest_quantities_], channels_},
            style.step_s);
    }
}

FluidFields Fluid::add_steps(gpu::Graph& graph, const FluidStyle& style, uint32_t count)
{
    const Solids solids{gpu::import_whole(graph, "fluid/solids", solids_)};
    Handles handles{gpu::import_uploaded(graph, "fluid/velocity", velocity_),
                    {},
                    solids,
                    {add_weights(graph, grid_, solids), gpu::import_whole(graph, "fluid/angles", angles_)}};
    if (channels_ > 0) {
        for (gpu::Image& image : quantities_) {
            handles.quantities.push_back(gpu::import_uploaded(graph, "fluid/quantities", image));
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        add_step(graph, style, handles);
    }
    FluidFields fields{handed_on(graph, handles.velocity)};
    for (const gpu::ImageId quantities : handles.quantities) {
        handed_on(graph, quantities);
    }
    if (channels_ > 0) {
        fields.quantities = handles.quantities[newest_quantities_];
    }
    return fields;
}

} // namespace estampe::fluid
