// SPDX-License-Identifier: MIT
// Stepping by reflection: Zehnder, Narain and Thomaszewski, "An Advection-Reflection Solver for
// Detail-Preserving Fluid Simulation", ACM Transactions on Graphics 37, 2018.
#include "techniques/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "techniques/fluid/motion/motion.hpp"
#include "techniques/fluid/pressure/projection.hpp"
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

bool needs_mass(const FluidStyle& style)
{
    return style.projection.solver == Solver::mass;
}

} // namespace

/// Graph handles that each fluid step passes to the next step.
struct Fluid::Handles {
    gpu::ImageId velocity;
    gpu::ImageId unprojected;
    std::vector<gpu::ImageId> quantities; ///< both images of quantities_ (double buffer), or empty
    gpu::BufferId shapes;
    gpu::BufferId standing;
    SolverTables tables;
    std::optional<gpu::BufferId> mass;
    std::optional<Swelling> swelling = {};
};

class Fluid::Step {
public:
    Step(gpu::Graph& graph, Fluid& fluid, const FluidStyle& style, Handles& handles, float age_s)
        : graph_(graph), fluid_(fluid), grid_(fluid.grid_), style_(style), handles_(handles), age_s_(age_s)
    {
    }

    void add()
    {
        if (fluid_.are_solid()) {
            handles_.tables.solids = add_solids(graph_, grid_, handles_.shapes, shapes_for(0.0F),
                                                handles_.standing, handles_.tables.solids.cells);
            handles_.tables.weights = add_weights(graph_, grid_, handles_.tables.solids);
        }
        if (style_.stepping == Stepping::reflect && !has_mass()) {
            add_quantities(add_reflected(), {});
        } else {
            add_projected();
        }
    }

private:
    /// Adds one step with a single projection. The velocity at the start advects itself and all quantities,
    /// along equal displacements.
    void add_projected()
    {
        const gpu::ImageId carrier = handles_.velocity;
        const bool goes_both_ways = advection_for(grid_, style_.velocity_advection) == Advection::maccormack;
        const std::optional<gpu::ImageId> ways =
            goes_both_ways ? std::optional(add_ways(graph_, grid_, carrier, part_s())) : std::nullopt;
        const gpu::ImageId start = advected(carrier, carrier, ways);
        add_quantities(carrier, ways);
        handles_.velocity = projected(forced(diffused(start)), handles_.velocity, false).velocity;
    }

    /// Adds one step of advection-reflection. Returns the velocity that advects the quantities.
    [[nodiscard]] gpu::ImageId add_reflected()
    {
        const gpu::ImageId start = diffused(handles_.velocity);
        const gpu::ImageId target = graph_.image("fluid/half", velocity_desc(grid_));
        const Projected half = projected(forced(advected(start, start, {})), target, true);
        const gpu::ImageId moved = diffused(forced(advected(half.velocity, half.reflected, {})));
        handles_.velocity = projected(moved, handles_.velocity, false).velocity;
        return half.velocity;
    }

    void add_quantities(gpu::ImageId carrier, std::optional<gpu::ImageId> ways)
    {
        if (fluid_.channels_ == 0) {
            return;
        }
        const uint32_t last = fluid_.newest_quantities_;
        fluid_.newest_quantities_ = 1 - last;
        gpu::ImageId& newest = handles_.quantities[1 - last];
        const Carried carried{carrier, handles_.quantities[last], newest, fluid_.channels_, ways};
        const shared::FluidShapes shapes = shapes_for(style_.step_s);
        if (has_mass()) {
            const gpu::ImageId moved = add_conserving_advection(graph_, grid_, carried, style_.step_s);
            // The conserving advection itself keeps the sums of quantities where the fluid expands.
            MatterStyle matter = style_.matter;
            matter.expands_above = 0.0F;
            newest = add_matter(graph_, grid_, matter, handles_.shapes, shapes, moved);
            return;
        }
        if (advection_for(grid_, style_.quantity_advection) == Advection::maccormack) {
            newest = add_corrected_matter(graph_, grid_, style_.matter, handles_.shapes, shapes,
                                          add_there(graph_, grid_, carried, style_.step_s), newest);
            return;
        }
        const gpu::ImageId moved =
            add_advection(graph_, grid_, style_.quantity_advection, carried, style_.step_s);
        newest = add_matter(graph_, grid_, style_.matter, handles_.shapes, shapes, moved);
    }

    [[nodiscard]] bool has_mass() const { return needs_mass(style_); }

    [[nodiscard]] float part_s() const
    {
        return style_.stepping == Stepping::reflect && !has_mass() ? 0.5F * style_.step_s : style_.step_s;
    }

    [[nodiscard]] shared::FluidShapes shapes_for(float time_s) const
    {
        return fluid_.shapes_.constants(grid_, age_s_, time_s, fluid_.channels_);
    }

    [[nodiscard]] gpu::ImageId advected(gpu::ImageId carrier, gpu::ImageId velocity,
                                        std::optional<gpu::ImageId> ways)
    {
        const gpu::ImageId target = graph_.image("fluid/moved", velocity_desc(grid_));
        return add_advection(graph_, grid_, style_.velocity_advection, {carrier, velocity, target, 0, ways},
                             part_s());
    }

    [[nodiscard]] gpu::ImageId diffused(gpu::ImageId velocity)
    {
        return style_.viscosity_m2_s > 0.0F
                   ? add_diffusion(graph_, grid_, velocity,
                                   {style_.viscosity_m2_s, style_.forces.acceleration_m_s2, part_s()})
                   : velocity;
    }

    [[nodiscard]] gpu::ImageId forced(gpu::ImageId velocity)
    {
        ForceStyle forces = style_.forces;
        if (style_.viscosity_m2_s > 0.0F) {
            // The function add_diffusion(), not the forces pass, applies the acceleration.
            forces.acceleration_m_s2 = glm::vec3(0.0F);
        }
        const auto weighing = fluid_.channels_ > shared::fluid_temperature
                                  ? std::optional(handles_.quantities[fluid_.newest_quantities_])
                                  : std::nullopt;
        return add_forces(graph_, grid_, forces, velocity, weighing, part_s());
    }

    [[nodiscard]] Projected projected(gpu::ImageId velocity, gpu::ImageId target, bool reflects)
    {
        if (fluid_.shapes_.are_pushing() || fluid_.are_solid()) {
            velocity = add_push(graph_, grid_, handles_.shapes, shapes_for(part_s()), handles_.tables.solids,
                                velocity);
        }
        handles_.unprojected = velocity;
        if (is_expanding(style_.matter, fluid_.channels_) && !has_swelling_) {
            handles_.swelling = add_swelling(graph_, grid_, style_.matter,
                                             {.quantities = handles_.quantities[fluid_.newest_quantities_],
                                              .solids = handles_.tables.solids,
                                              .mass = has_mass() ? handles_.mass : std::nullopt,
                                              .step_s = style_.step_s});
            has_swelling_ = true;
        }
        if (has_mass()) {
            if (handles_.swelling) {
                handles_.mass = add_swelling_to_mass(graph_, grid_, *std::exchange(handles_.swelling, {}),
                                                     *handles_.mass);
            }
            const MassAndVelocity now =
                add_mass_pressure(graph_, grid_, handles_.tables.solids, {handles_.mass.value(), velocity},
                                  target, style_.step_s);
            handles_.mass = now.mass;
            return {now.velocity, now.velocity};
        }
        return add_projection(graph_, grid_, fluid_.trusted(style_.projection),
                              {velocity, handles_.tables, target, handles_.swelling}, reflects);
    }

    gpu::Graph& graph_;
    Fluid& fluid_;
    const Grid& grid_;
    const FluidStyle& style_;
    Handles& handles_;
    float age_s_;               ///< time since the uploaded positions of obstacles and sources were valid
    bool has_swelling_ = false; ///< the expansion of this step is known
};

Fluid::Fluid(gpu::Device& device, const Grid& grid, uint32_t channels, std::span<const float> velocity,
             std::span<const float> quantities)
    : grid_(grid), channels_(channels), shapes_(device)
{
    check_grid(grid);
    check_start(grid, grid.dimensions(), velocity);
    check_start(grid, channels, quantities);
    if (channels > shared::fluid_most_channels) {
        throw std::logic_error("a fluid carries at most 8 quantities");
    }
    velocity_ = start_image(device, "fluid velocity", velocity_desc(grid), velocity);
    if (channels > 0) {
        for (gpu::Image& image : quantities_) {
            image = start_image(device, "fluid quantities", field_desc(grid, channels), quantities);
        }
    }
    solids_ = gpu::upload_buffer(device, "fluid solids", std::vector<uint32_t>(grid.cell_count()));
    set_standing(device, {});
    angles_ = upload_angles(device, grid);
}

void Fluid::set_standing(gpu::Device& device, std::span<const uint8_t> cells)
{
    if (!cells.empty() && cells.size() != grid_.cell_count()) {
        throw std::logic_error("a fluid's grid has another number of cells");
    }
    std::vector<uint32_t> words(std::max<size_t>(cells.size(), 1));
    std::ranges::transform(cells, words.begin(),
                           [](uint8_t cell) { return cell != 0 ? shared::fluid_stands_still : 0U; });
    standing_ = gpu::upload_buffer(device, "fluid standing", words);
    are_standing_ = std::ranges::any_of(cells, [](uint8_t cell) { return cell != 0; });
}

void Fluid::set_mass(gpu::Device& device, std::span<const float> mass)
{
    mass_.emplace(device, grid_,
                  mass.empty() ? std::vector<float>(grid_.cell_count(), 1.0F)
                               : std::vector<float>(mass.begin(), mass.end()));
}

void Fluid::ensure_mass(gpu::Device& device, const FluidStyle& style)
{
    if (!needs_mass(style)) {
        mass_.reset();
    } else if (!mass_) {
        set_mass(device);
    }
}

double Fluid::check_spectral(gpu::Device& device, gpu::Executor& executor)
{
    constexpr double most = 1e-3;
    if (!is_spectral_possible(grid_)) {
        return 0.0;
    }
    const double residual = measured_residual(device, executor, grid_, {.solver = Solver::spectral});
    is_spectral_right_ = residual <= most;
    return residual;
}

ProjectionStyle Fluid::trusted(const ProjectionStyle& style) const
{
    ProjectionStyle chosen = style;
    if (style.solver == Solver::automatic && !is_spectral_right_) {
        chosen.solver = Solver::multigrid;
    }
    return chosen;
}

uint32_t Fluid::most_steps(const FluidStyle& style) const
{
    // A graph holds at most 256 passes; techniques other than the fluid use the remaining passes.
    constexpr uint32_t most_passes = 240;
    const bool has_mass = needs_mass(style);
    const bool reflects = style.stepping == Stepping::reflect && !has_mass;
    const float share = style.viscosity_m2_s * style.step_s / (grid_.cell_m * grid_.cell_m);
    const uint32_t diffusion =
        style.viscosity_m2_s > 0.0F ? diffusion_stages(grid_, reflects ? 0.5F * share : share) : 0;
    const bool expands = is_expanding(style.matter, channels_);
    const uint32_t pressure =
        has_mass ? passes_of_mass_pressure() + (expands ? 1 : 0)
                 : passes_of_projection(grid_, trusted(style.projection), are_solid(), expands);
    const uint32_t part = passes_of_advection(grid_, style.velocity_advection) + 4 + diffusion + pressure;
    const uint32_t quantities =
        has_mass ? passes_of_conserving_advection : passes_of_advection(grid_, style.quantity_advection);
    const uint32_t step = (reflects ? 2 : 1) * part + 2 + (channels_ > 0 ? 1 + quantities : 0) +
                          (expands ? passes_of_swelling : 0);
    return std::max(most_passes / step, 1U);
}

Fluid::Handles Fluid::import(gpu::Graph& graph)
{
    const Solids solids{.cells = gpu::import_whole(graph, "fluid/solids", solids_)};
    const gpu::ImageId velocity = gpu::import_uploaded(graph, "fluid/velocity", velocity_);
    Handles handles{.velocity = velocity,
                    .unprojected = velocity,
                    .shapes = shapes_.upload(graph),
                    .standing = gpu::import_whole(graph, "fluid/standing", standing_),
                    .tables = {.solids = solids,
                               .weights = add_weights(graph, grid_, solids),
                               .angles = gpu::import_whole(graph, "fluid/angles", angles_)}};
    if (channels_ > 0) {
        for (gpu::Image& image : quantities_) {
            handles.quantities.push_back(gpu::import_uploaded(graph, "fluid/quantities", image));
        }
    }
    if (mass_) {
        handles.mass = mass_->import(graph);
    }
    return handles;
}

FluidFields Fluid::add_steps(gpu::Graph& graph, const FluidStyle& style, uint32_t count)
{
    if (!(style.step_s > 0.0F) || !std::isfinite(style.step_s)) {
        throw std::logic_error("a step of a fluid is longer than 0 seconds");
    }
    if (count > most_steps(style)) {
        throw std::logic_error("more steps of a fluid than one graph takes");
    }
    const bool has_mass = needs_mass(style);
    if (has_mass && !mass_) {
        throw std::logic_error("a fluid without a mass has no solver by mass");
    }
    Handles handles = import(graph);
    for (uint32_t i = 0; i < count; ++i) {
        const float middle_of_step = static_cast<float>(i) + 0.5F;
        Step(graph, *this, style, handles, middle_of_step * style.step_s).add();
    }
    shapes_.advance(static_cast<float>(count) * style.step_s);
    FluidFields fields{
        .velocity = handles.velocity, .unprojected = handles.unprojected, .solids = handles.tables.solids};
    hand_on(graph, fields.velocity);
    for (const gpu::ImageId quantities : handles.quantities) {
        hand_on(graph, quantities);
    }
    if (channels_ > 0) {
        fields.quantities = handles.quantities[newest_quantities_];
    }
    if (has_mass && count > 0) {
        mass_->keep(graph, *handles.mass);
    }
    fields.mass = handles.mass;
    fields.swelling = handles.swelling;
    return fields;
}

void hand_on(gpu::Graph& graph, gpu::ImageId image)
{
    auto pass = graph.custom("fluid/keep");
    pass.touch(image, gpu::Access::compute_sampled);
    pass.keep().execute([](gpu::Recorder&) {});
}

gpu::BufferId add_layers_copy(gpu::Graph& graph, gpu::ImageId image)
{
    const gpu::ImageDesc desc = graph.describe(image);
    const gpu::BufferId target = graph.buffer("fluid/layers", {.size_bytes = gpu::size_bytes(desc)});
    auto copy = graph.custom("fluid/layers");
    copy.touch(image, gpu::Access::transfer_read);
    const gpu::BufferId numbers = copy.touch_write(target, gpu::Access::transfer_write);
    copy.execute([image, numbers, desc](gpu::Recorder& recorder) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, desc.layers},
                                       .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(image).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, recorder.buffer(numbers).handle(), 1,
                               &region);
    });
    hand_on(graph, image);
    return numbers;
}

std::vector<float> run_and_read(gpu::Device& device, gpu::Executor& executor, gpu::Graph& graph,
                                gpu::ImageId image)
{
    const gpu::BufferId numbers = add_layers_copy(graph, image);
    gpu::Buffer host(device, "fluid layers", graph.describe(numbers).size_bytes, gpu::MemoryUse::readback);
    gpu::add_read_back(graph, "fluid/read back", numbers, host);
    executor.run(graph);
    const auto items = gpu::items_of<float>(host);
    return {items.begin(), items.end()};
}

std::vector<float> run_and_read_mass(gpu::Device& device, gpu::Executor& executor, Fluid& fluid)
{
    gpu::Graph graph;
    const FluidFields fields = fluid.add_steps(graph, {}, 0);
    if (!fields.mass) {
        return {};
    }
    gpu::Buffer host(device, "fluid mass", graph.describe(*fields.mass).size_bytes, gpu::MemoryUse::readback);
    gpu::add_read_back(graph, "fluid/read mass", *fields.mass, host);
    executor.run(graph);
    std::vector<float> mass;
    for (const uint32_t units : gpu::items_of<uint32_t>(host)) {
        mass.push_back(static_cast<float>(units) / static_cast<float>(shared::fluid_mass_unit));
    }
    return mass;
}

} // namespace estampe::fluid
