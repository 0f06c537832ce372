// SPDX-License-Identifier: MIT
#pragma once

// A terrain on the GPU: computes the positions of the vertices of the terrain's mesh around the eye.

#include <future>
#include <memory>
#include <optional>

#include <estampe/terrain.hpp>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/terrain/graph/program.hpp"
#include "techniques/terrain/mesh/mesh_method.hpp"
#include "techniques/terrain/slabs/slabs.hpp"

namespace estampe::terrain {

/// How the GPU evaluates the height graph.
enum class HeightSource : uint8_t {
    /// A shader that is compiled for the height graph evaluates the graph; falls back to `interpreted` if
    /// there is no compiler.
    compiled,
    interpreted,       ///< a general shader interprets the graph: slower, but ready immediately
    compiled_meanwhile ///< interprets the graph until a background thread has compiled its shader
};

/// Shaders that contain a compiled height graph; null if the compilation failed.
struct CompiledShaders {
    const gpu::Shader* vertices = nullptr;
    const gpu::Shader* heights = nullptr;
    std::string problem; ///< error message of the compiler if the compilation failed
};

/// Time and eye position of a frame.
struct TerrainMoment {
    EyePlace eye;
    glm::dvec3 anchor_m{0.0}; ///< origin of positions on the device; x and z are whole multiples of 64
    double time_s = 0.0;
    /// Time since the previous frame in seconds; empty if positions of the previous frame are not needed.
    std::optional<double> before_s;
};

/// Position of the terrain's vertices in the buffer of all meshes: the vertices start at `first_vertex`.
struct TerrainTarget {
    uint32_t first_vertex = 0;
    double stroke_unit_m = 1.0;
};

/// Square fields whose heights are computed in one dispatch.
using HeightFields = InlineVector<shared::TerrainField, shared::terrain_fields_most>;

class TerrainBuffers {
public:
    /// Uploads the data that does not change from frame to frame. Throws Error if the data does not fit on
    /// the device.
    TerrainBuffers(gpu::Device& device, const Terrain& terrain, const TerrainTarget& target,
                   const ObjectTriangles& object = {});

    /// Replaces the height graph, or changes numbers in the graph. Changes of the mesh must also be passed to
    /// set_mesh(). Throws Error and changes nothing if the graph does not fit on the device.
    void set_graph(gpu::Device& device, const Terrain& terrain);

    /// Sets the mesh that the terrain describes. Heights, sand and compiled shaders are kept. Throws Error if
    /// the mesh does not fit on the device.
    void set_mesh(gpu::Device& device, const TerrainTarget& target, const ObjectTriangles& object = {});

    /// Sets how the GPU evaluates the height graph from now on.
    void set_source(HeightSource source);

    [[nodiscard]] const Terrain& terrain() const { return terrain_; }

    /// Updates the mesh's levels of detail and the coordinates of the height graph for the time and eye
    /// position of a frame. Returns whether any vertex may have changed since the last call.
    bool prepare(gpu::Device& device, const TerrainMoment& moment);

    /// Simulates the sand up to the moment that was passed to prepare(), and writes the sand's heights.
    /// Returns the buffer of texels (textures, masks and sand) that add_vertices() and add_heights() read.
    /// Call once per graph.
    [[nodiscard]] gpu::BufferId add_texels(gpu::Graph& graph);

    /// Returns whether more sand steps are missing than one frame graph can simulate. If so, first run graphs
    /// that contain only add_catching_up().
    [[nodiscard]] bool is_behind() const;
    void add_catching_up(gpu::Graph& graph);

    /// Computes the terrain's vertices and writes them into the meshes' buffers `posed_vertices`, `before`
    /// and `stroke_coordinates`.
    ///
    /// Writes  posed vertices of this frame and of the previous frame, stroke coordinates
    /// Cost    one dispatch, one thread per vertex; up to three evaluations of the height graph per vertex
    ///         near a ring's edge
    /// Source  Losasso and Hoppe, "Geometry Clipmaps", SIGGRAPH 2004, for the rings
    struct Posed {
        gpu::BufferId vertices;
        gpu::BufferId before;
        gpu::BufferId stroke_coordinates;
    };

    [[nodiscard]] Posed add_vertices(gpu::Graph& graph, const Posed& meshes, gpu::BufferId texels);

    /// Computes the ground's heights above the anchor (a nearby origin) on several fields: r32f, `size`
    /// texels per field, stacked vertically. Leaves out details that are too fine for a field. Texels outside
    /// `wanted` get a very low height.
    ///
    /// Cost    one dispatch, one thread per texel
    [[nodiscard]] gpu::ImageId add_heights(gpu::Graph& graph, const HeightFields& fields, glm::uvec2 size,
                                           gpu::BufferId texels, const shared::FieldSector& wanted = {});

    /// The reason why the height graph is interpreted although a compiled shader was requested; else empty.
    [[nodiscard]] const std::string& problem() const;

    /// Returns whether the height graph is interpreted only until its shader is compiled. When it is
    /// compiled, vertices are posed again.
    [[nodiscard]] bool is_compiling();

    /// A number that increases whenever the shape of the ground changes, including changes by animation.
    [[nodiscard]] uint64_t form() const { return form_; }

private:
    enum class Task : uint8_t { vertices, heights };

    void take_sand(gpu::Device& device);
    void begin_compiling();
    void finish_compiling();
    [[nodiscard]] const gpu::Shader& shader(Task task);

    Terrain terrain_;
    TerrainTarget target_;
    std::unique_ptr<MeshMethod> method_;
    HeightSource source_ = HeightSource::compiled;
    uint32_t vertex_count_ = 0;
    gpu::Buffer vertices_;
    gpu::Buffer places_; ///< positions of vertices that are in no grid
    bool has_places_ = false;
    std::future<CompiledShaders> compiling_;
    /// The terrain whose shader is being compiled; may be an older terrain than the current terrain.
    std::optional<Terrain> compiling_of_;
    /// Shaders of the current height graph; none while it is interpreted.
    std::optional<CompiledShaders> compiled_;
    gpu::Buffer texels_;
    gpu::Buffer words_;
    gpu::Buffer levels_;
    gpu::Buffer globals_;
    std::vector<uint32_t> words_now_;
    bool keeps_before_ = false;
    uint64_t form_ = 0;
    std::optional<SandSource> sand_source_;
    SlabStyle sand_style_;
    std::unique_ptr<SlabField> sand_; ///< the simulated sand; null if the height graph has no sand
    uint32_t first_sand_texel_ = 0;
    double sand_moment_ = 0.0; ///< the moment of the current frame, counted in simulation steps
    bool is_sand_stale_ = false;
    std::vector<shared::TerrainLevel> levels_now_;
};

} // namespace estampe::terrain
