// SPDX-License-Identifier: MIT
#pragma once

// A terrain on the device, which poses the vertices of its mesh around the eye.

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
    compiled,          ///< by a shader compiled for this graph; interpreted without a compiler
    interpreted,       ///< by a general shader: slower, but available at once
    compiled_meanwhile ///< interpreted until a background thread has compiled the shader
};

/// Shaders that contain a compiled graph; null if compilation failed.
struct CompiledShaders {
    const gpu::Shader* vertices = nullptr;
    const gpu::Shader* heights = nullptr;
    std::string problem; ///< reason of the failure
};

/// The time and the eye position of a frame.
struct TerrainMoment {
    EyePlace eye;
    glm::dvec3 anchor_m{0.0}; ///< x and z are whole multiples of 64
    double time_s = 0.0;
    std::optional<double> before_s; ///< time since the previous frame, if previous positions are wanted
};

/// The place of the terrain's vertices in the buffer of all meshes: from `first_vertex` on.
struct TerrainTarget {
    uint32_t first_vertex = 0;
    double stroke_unit_m = 1.0;
};

/// Lattices whose heights are computed in one dispatch.
using HeightFields = InlineVector<shared::TerrainField, shared::terrain_fields_most>;

class TerrainBuffers {
public:
    /// Uploads the constant data. Throws Error when it does not fit the device.
    TerrainBuffers(gpu::Device& device, const Terrain& terrain, const TerrainTarget& target,
                   const ObjectTriangles& object = {});

    /// Sets another graph, or other numbers in the graph. Changes of the mesh must also be passed to
    /// set_mesh(). Throws Error when the graph does not fit, and changes nothing then.
    void set_graph(gpu::Device& device, const Terrain& terrain);

    /// Sets the mesh that the terrain describes; heights, sand and compiled shaders are kept. Throws Error
    /// when it does not fit.
    void set_mesh(gpu::Device& device, const TerrainTarget& target, const ObjectTriangles& object = {});

    /// Sets how the GPU evaluates the graph from now on.
    void set_source(HeightSource source);

    [[nodiscard]] const Terrain& terrain() const { return terrain_; }

    /// Updates levels and places to a moment. Returns whether any vertex may have changed since the last
    /// call.
    bool prepare(gpu::Device& device, const TerrainMoment& moment);

    /// Updates the texels of sand to the moment. Returns the texels of textures, masks and sand, which
    /// add_vertices() and add_heights() read. Call once per graph.
    [[nodiscard]] gpu::BufferId add_texels(gpu::Graph& graph);

    /// Returns whether sand is more steps behind its moment than one graph can simulate. If so, first run
    ///         graphs that contain only add_catching_up().
    [[nodiscard]] bool is_behind() const;
    void add_catching_up(gpu::Graph& graph);

    /// Poses the terrain's vertices and writes them into the meshes' buffers `posed_vertices`, `before` and
    /// `stroke_coordinates`.
    ///
    /// Writes  posed vertices of this frame and of the previous one, stroke coordinates
    /// Cost    one dispatch, one thread per vertex; up to three evaluations of the graph near a ring's edge
    /// Source  Losasso and Hoppe, "Geometry Clipmaps", SIGGRAPH 2004, for the rings
    struct Posed {
        gpu::BufferId vertices;
        gpu::BufferId before;
        gpu::BufferId stroke_coordinates;
    };

    [[nodiscard]] Posed add_vertices(gpu::Graph& graph, const Posed& meshes, gpu::BufferId texels);

    /// Computes heights above the anchor on lattices, r32f, of `size` texels each, stacked vertically. Leaves
    /// out forms that are too fine for a lattice. Texels outside `wanted` are set to a very low height.
    ///
    /// Cost    one dispatch, one thread per texel
    [[nodiscard]] gpu::ImageId add_heights(gpu::Graph& graph, const HeightFields& fields, glm::uvec2 size,
                                           gpu::BufferId texels, const shared::FieldSector& wanted = {});

    /// The reason why the graph is interpreted instead of compiled; empty if it is not.
    [[nodiscard]] const std::string& problem() const;

    /// Returns whether the graph is interpreted until its shader is compiled. After that, vertices are posed
    /// again.
    [[nodiscard]] bool is_compiling();

    /// Incremented whenever the shape of the ground changes, including changes over time.
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
    std::optional<Terrain> compiling_of_;     ///< the terrain being compiled; may be an older one
    std::optional<CompiledShaders> compiled_; ///< shaders of the current graph
    gpu::Buffer texels_;
    gpu::Buffer words_;
    gpu::Buffer levels_;
    gpu::Buffer globals_;
    std::vector<uint32_t> words_now_;
    bool keeps_before_ = false;
    uint64_t form_ = 0;
    std::optional<SandSource> sand_source_;
    SlabStyle sand_style_;
    std::unique_ptr<SlabField> sand_; ///< null if the graph has no sand
    uint32_t first_sand_texel_ = 0;
    double sand_moment_ = 0.0; ///< the moment, counted in steps
    bool is_sand_stale_ = false;
    std::vector<shared::TerrainLevel> levels_now_;
};

} // namespace estampe::terrain
