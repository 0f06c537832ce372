// SPDX-License-Identifier: MIT
#include "techniques/terrain/terrain_buffers.hpp"

#include <algorithm>
#include <cstring>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/terrain_heights_comp.hpp"
#include "shaders/terrain_heights_text.hpp"
#include "shaders/terrain_vertices_comp.hpp"
#include "shaders/terrain_vertices_text.hpp"
#include "techniques/terrain/graph/glsl.hpp"
#include "techniques/terrain/graph/program_words.hpp"

namespace estampe::terrain {
namespace {

template <class T>
gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, const std::vector<T>& items)
{
    gpu::Buffer buffer(device, name, std::max<size_t>(items.size(), 1) * sizeof(T), gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(std::span(items)), buffer.mapped().begin());
    return buffer;
}

bool same(const std::vector<shared::TerrainLevel>& a, const std::vector<shared::TerrainLevel>& b)
{
    return std::ranges::equal(a, b, [](const shared::TerrainLevel& one, const shared::TerrainLevel& other) {
        return std::memcmp(&one, &other, sizeof one) == 0;
    });
}

} // namespace

TerrainBuffers::TerrainBuffers(gpu::Device& device, const Terrain& terrain, const TerrainTarget& target)
    : terrain_(terrain), target_(target), method_(mesh_method(terrain.description().meshing))
{
    const std::vector<uint32_t> vertices = method_->topology().vertices;
    vertex_count_ = static_cast<uint32_t>(vertices.size());
    vertices_ = gpu::upload_buffer(device, "terrain vertices", vertices);
    set_graph(device, terrain);
}

void TerrainBuffers::set_graph(gpu::Device& device, const Terrain& terrain)
{
    terrain_ = terrain;
    const std::vector<float>& texels = terrain.program().texels;
    texels_ = gpu::upload_buffer(device, "terrain texels", texels.empty() ? std::vector<float>(4) : texels);
    words_now_.clear();
}

bool TerrainBuffers::prepare(gpu::Device& device, const TerrainMoment& moment)
{
    const glm::dvec2 anchor_m(moment.anchor_m.x, moment.anchor_m.z);
    const std::vector<shared::TerrainLevel> levels = method_->place(moment.eye, anchor_m);
    ProgramWords program = program_words(terrain_.program(), anchor_m, moment.time_s);
    if (program.words == words_now_ && same(levels, levels_now_)) {
        return false;
    }
    const TerrainMeshing& meshing = terrain_.description().meshing;
    const shared::TerrainGlobals globals{.eye_m = glm::vec2(moment.eye.eye_m - anchor_m),
                                         .anchor_y_m = static_cast<float>(moment.anchor_m.y),
                                         .stroke_unit_m = static_cast<float>(target_.stroke_unit_m),
                                         .planet_radius_m = meshing.planet_radius_m,
                                         .before_s = static_cast<float>(moment.before_s),
                                         .vertex_count = vertex_count_,
                                         .first_vertex = target_.first_vertex,
                                         .first_parameter = program.first_parameter,
                                         .first_instruction = program.first_instruction,
                                         .instruction_count =
                                             static_cast<uint32_t>(terrain_.program().instructions.size())};
    globals_ = mapped_buffer(device, "terrain", std::vector{globals});
    levels_ = mapped_buffer(device, "terrain levels", levels);
    words_ = mapped_buffer(device, "terrain program", program.words);
    form_ += program.words == words_now_ ? 0 : 1;
    words_now_ = std::move(program.words);
    levels_now_ = levels;
    return true;
}

const gpu::Shader& TerrainBuffers::shader(Task task) const
{
    const bool is_interpreted = source_ == HeightSource::interpreted;
    if (task == Task::vertices) {
        return is_interpreted ? shaders::terrain_vertices_comp
                              : compiled_with(terrain_.program(), "terrain_vertices_written",
                                              shaders::terrain_vertices_text);
    }
    return is_interpreted
               ? shaders::terrain_heights_comp
               : compiled_with(terrain_.program(), "terrain_heights_written", shaders::terrain_heights_text);
}

TerrainBuffers::Posed TerrainBuffers::add_vertices(gpu::Graph& graph, const Posed& meshes)
{
    auto pass = graph.compute("terrain", shader(Task::vertices));
    pass.uniform(gpu::import_whole(graph, "terrain", globals_))
        .read(gpu::import_whole(graph, "terrain levels", levels_))
        .read(gpu::import_whole(graph, "terrain vertices", vertices_))
        .read(gpu::import_whole(graph, "terrain program", words_))
        .sample(gpu::import_whole(graph, "terrain texels", texels_), gpu::Format::r32f);
    const Posed posed{.vertices = pass.modify(meshes.vertices),
                      .before = pass.modify(meshes.before),
                      .stroke_coordinates = pass.modify(meshes.stroke_coordinates)};
    pass.dispatch_items(vertex_count_);
    return posed;
}

gpu::ImageId TerrainBuffers::add_heights(gpu::Graph& graph, const shared::TerrainFieldConstants& field)
{
    auto pass = graph.compute("terrain/heights", shader(Task::heights));
    pass.uniform(gpu::import_whole(graph, "terrain", globals_))
        .read(gpu::import_whole(graph, "terrain program", words_))
        .sample(gpu::import_whole(graph, "terrain texels", texels_), gpu::Format::r32f);
    const gpu::ImageId height = pass.write(graph.image(
        "terrain/heights", {.width = field.size.x, .height = field.size.y, .format = gpu::Format::r32f}));
    pass.push(field).dispatch_over(field.size.x, field.size.y);
    return height;
}

} // namespace estampe::terrain
