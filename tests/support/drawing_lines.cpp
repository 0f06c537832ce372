// SPDX-License-Identifier: MIT
#include <functional>

#include <glm/gtc/packing.hpp>

#include "features/lines/lines.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::test {

contour::ContourInputs Drawing::contour_inputs(gpu::Graph& graph, const Stage& stage)
{
    const light::LitPixels lit = add_light(graph, stage, line_light);
    return {.frame = stage.frame,
            .visibility = stage.visibility,
            .triangles = stage.triangles,
            .posed_vertices = stage.posed,
            .draws = stage.draws,
            .materials = stage.materials,
            .own_outlines = needs_.own_outlines,
            .draw = stage.surface.draw,
            .depth = stage.surface.depth,
            .normal = stage.surface.normal,
            .coordinate = stage.surface.coordinate,
            .light = lit.light,
            .sun = line_light.keeps_sun ? std::optional(lit.sun) : std::nullopt,
            .screen_draw = transparency::add_no_transparency(graph).draw,
            .pixel_m_at_one = pixel_.at_one_m,
            .size_px = size_px};
}

std::vector<float> Drawing::lines(const contour::ContourStyle& style, float pixels_per_mm,
                                  contour::LineHistory* history)
{
    gpu::Graph graph;
    const Stage stage = add_surface(graph);
    contour::ContourInputs inputs = contour_inputs(graph, stage);
    inputs.pixels_per_mm = pixels_per_mm;
    features::LineMeshes meshes;
    features::LineBrushes brushes;
    inputs.brushes = brushes.ensure(shared_device(), style);
    inputs.is_moving = true;
    contour::LineMesh* mesh = meshes.ensure(shared_device(), layout, style);
    const gpu::ImageId ink = mesh != nullptr
                                 ? contour::add_chain_contours(graph, inputs, *mesh, history, style)
                                 : contour::add_contours(graph, inputs, style);
    std::vector<float> result;
    for (const uint32_t packed : run_and_read_as<uint32_t>(graph, ink)) {
        result.push_back(glm::unpackUnorm4x8(packed).w);
    }
    return result;
}

void Drawing::begin_film_frame(contour::LineHistory& history, bool continues, bool has_hidden) const
{
    history.begin_frame(shared_device(), size_px, continues, has_hidden);
}

std::vector<shared::ListSize> Drawing::chain_sizes(const contour::ContourStyle& style)
{
    features::LineMeshes meshes;
    contour::LineMesh* mesh = meshes.ensure(shared_device(), layout, style);
    gpu::Graph graph;
    const Stage stage = add_surface(graph);
    const contour::ChainInputs inputs =
        contour::chain_inputs(graph, contour_inputs(graph, stage), *mesh, style);
    const bool along_edges = style.silhouettes == contour::Silhouettes::edges;
    return run_and_read_as<shared::ListSize>(graph,
                                             contour::add_chains(graph, inputs, *mesh, along_edges).sizes);
}

ChainLists Drawing::chains(const contour::ContourStyle& style, contour::LineClass wanted)
{
    ChainLists lists;
    features::LineMeshes meshes;
    contour::LineMesh* mesh = meshes.ensure(shared_device(), layout, style);
    const bool along_edges = style.silhouettes == contour::Silhouettes::edges;
    gpu::Graph graph;
    const Stage stage = add_surface(graph);
    const contour::ChainInputs inputs =
        contour::chain_inputs(graph, contour_inputs(graph, stage), *mesh, style);
    const contour::Chains chains = contour::add_chains(graph, inputs, *mesh, along_edges);
    const auto grid =
        graph.buffer("grid", contour::list_of(contour::grid_cell_count(size_px), sizeof(glm::uvec2)));
    const contour::ChainSamples samples = contour::add_samples(graph, inputs, chains);
    const contour::ChainStrokes strokes = contour::add_strokes(graph, samples, grid, size_px, wanted);
    std::vector<gpu::BufferId> buffers;
    std::vector<std::function<void(const std::vector<std::byte>&)>> takers;
    const auto read = [&]<class T>(std::vector<T>& list, gpu::BufferId buffer) {
        buffers.push_back(buffer);
        takers.emplace_back([&list](const std::vector<std::byte>& bytes) { list = items_of<T>(bytes); });
    };
    read(lists.marks, chains.marks);
    read(lists.facing, chains.facing);
    if (mesh->bending_count > 0) {
        read(lists.view_bends, *chains.view_bends);
    }
    read(lists.sizes, strokes.sizes);
    read(lists.points_before, chains.points_before);
    read(lists.flags_of_slot, chains.flags_of_slot);
    read(lists.points, chains.points);
    read(lists.lengths, chains.lengths);
    read(lists.lengths_before, samples.lengths_before);
    read(lists.samples, strokes.samples);
    read(lists.strokes_before, strokes.strokes_before);
    read(lists.strokes, strokes.strokes);
    const std::vector<std::vector<std::byte>> bytes = run_and_read(graph, buffers);
    for (size_t i = 0; i < bytes.size(); ++i) {
        takers[i](bytes[i]);
    }
    lists.points.resize(lists.sizes[shared::list_points].count);
    lists.lengths.resize(lists.points.size());
    lists.samples.resize(lists.sizes[shared::list_samples].count);
    lists.strokes.resize(lists.sizes[shared::list_strokes].count);
    lists.points_before.resize(lists.sizes[shared::list_slots].count + 1);
    return lists;
}

} // namespace estampe::test
