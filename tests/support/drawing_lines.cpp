// SPDX-License-Identifier: MIT
#include <functional>

#include <glm/gtc/packing.hpp>

#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::test {

void Drawing::prepare_lines(const contour::ContourStyle& style, float pixels_per_mm)
{
    features->lines.invalidate(features::Event::layout_replaced); // `features` may come from another drawing
    features->lines.ensure(shared_device(), layout, style);
    plan_.page.pixels_per_mm = pixels_per_mm;
    plan_.variants.lines = style;
    prepare_light(line_light);
}

contour::ContourInputs Drawing::add_lit_lines(const Stage& stage)
{
    contour::ContourInputs inputs = frame::contour_inputs(
        stage.context, stage.scene, stage.visibility, stage.surface, add_light(stage, line_light),
        frame::add_transparency(stage.context, stage.scene, stage.visibility));
    inputs.execution = line_execution.value_or(inputs.execution);
    return inputs;
}

std::vector<float> Drawing::lines(const contour::ContourStyle& style, float pixels_per_mm, bool remembers)
{
    prepare_lines(style, pixels_per_mm);
    plan_.lines.are_remembered = remembers;
    gpu::Graph graph;
    const Stage stage = add_surface(graph);
    const gpu::ImageId ink = frame::add_lines(stage.context, add_lit_lines(stage));
    std::vector<float> result;
    for (const uint32_t packed : run_and_read_as<uint32_t>(graph, ink)) {
        result.push_back(glm::unpackUnorm4x8(packed).w);
    }
    return result;
}

void Drawing::begin_film_frame(bool continues, bool has_hidden)
{
    features->lines.history().begin_frame(shared_device(), size_px, continues, has_hidden);
}

std::vector<shared::ListSize> Drawing::chain_sizes(const contour::ContourStyle& style)
{
    prepare_lines(style, 1.0F);
    contour::LineMesh& mesh = *features->lines.mesh();
    gpu::Graph graph;
    const contour::ChainInputs inputs =
        contour::chain_inputs(graph, add_lit_lines(add_surface(graph)), mesh, style);
    const bool along_edges = style.silhouettes == contour::Silhouettes::edges;
    return run_and_read_as<shared::ListSize>(graph,
                                             contour::add_chains(graph, inputs, mesh, along_edges).sizes);
}

ChainLists Drawing::chains(const contour::ContourStyle& style, contour::LineClass wanted)
{
    prepare_lines(style, 1.0F);
    ChainLists lists;
    contour::LineMesh& mesh = *features->lines.mesh();
    const bool along_edges = style.silhouettes == contour::Silhouettes::edges;
    gpu::Graph graph;
    const contour::ChainInputs inputs =
        contour::chain_inputs(graph, add_lit_lines(add_surface(graph)), mesh, style);
    const contour::Chains chains = contour::add_chains(graph, inputs, mesh, along_edges);
    const auto grid =
        graph.buffer("grid", contour::list_of(contour::grid_cell_count(size_px), sizeof(glm::uvec2)));
    const contour::ChainSamples samples = contour::add_samples(graph, inputs, chains);
    const contour::ChainStrokes strokes = contour::add_strokes(graph, inputs, samples, grid, wanted);
    std::vector<gpu::BufferId> buffers;
    std::vector<std::function<void(const std::vector<std::byte>&)>> takers;
    const auto read = [&]<class T>(std::vector<T>& list, gpu::BufferId buffer) {
        buffers.push_back(buffer);
        takers.emplace_back([&list](const std::vector<std::byte>& bytes) { list = items_of<T>(bytes); });
    };
    read(lists.marks, chains.marks);
    read(lists.facing, chains.facing);
    if (mesh.bending_count > 0) {
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
