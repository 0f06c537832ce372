// SPDX-License-Identifier: MIT
#pragma once

// A terrain on the device: what poses the vertices of its mesh about the eye.

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

/// Who runs the graph on the GPU.
enum class HeightSource : uint8_t {
    compiled,          ///< a shader of its own; interpreted where there is no compiler
    interpreted,       ///< the one that takes any graph: slower, but there at once
    compiled_meanwhile ///< interpreted until the compiler, in a thread of its own, has done
};

/// Shaders with a graph in them; null where they could not be made.
struct CompiledShaders {
    const gpu::Shader* vertices = nullptr;
    const gpu::Shader* heights = nullptr;
    std::string problem; ///< why not
};

/// When and from where the ground is looked at.
struct TerrainMoment {
    EyePlace eye;
    glm::dvec3 anchor_m{0.0}; ///< x and z whole multiples of 64
    double time_s = 0.0;
    std::optional<double> before_s; ///< how long ago the frame before was, where places then are wanted
};

/// Where its vertices go: into those of all meshes, from `first_vertex` on.
struct TerrainTarget {
    uint32_t first_vertex = 0;
    double stroke_unit_m = 1.0;
};

/// Lattices whose heights are asked for together.
using HeightFields = InlineVector<shared::TerrainField, shared::terrain_fields_most>;

class TerrainBuffers {
public:
    /// Uploads what does not change. Throws Error when it does not fit the device.
    TerrainBuffers(gpu::Device& device, const Terrain& terrain, const TerrainTarget& target,
                   const ObjectTriangles& object = {});

    /// Takes another graph, or other numbers in it, for the same mesh: what differs in the mesh has to be
    /// handed to set_mesh(). Throws Error when it does not fit, and is then as before.
    void set_graph(gpu::Device& device, const Terrain& terrain);

    /// Takes the mesh that the terrain asks for; heights, sand and compiled shaders stay. Throws Error when
    /// it does not fit.
    void set_mesh(gpu::Device& device, const TerrainTarget& target, const ObjectTriangles& object = {});

    /// Says who runs the graph from now on.
    void set_source(HeightSource source);

    [[nodiscard]] const Terrain& terrain() const { return terrain_; }

    /// Brings levels and places to a moment; returns whether any vertex may have changed since the last.
    bool prepare(gpu::Device& device, const TerrainMoment& moment);

    /// The texels of textures, masks and sand, the last brought to the moment. What add_vertices() and
    /// add_heights() read; once a graph.
    [[nodiscard]] gpu::BufferId add_texels(gpu::Graph& graph);

    /// Whether sand is more steps behind its moment than one graph takes: then graphs with add_catching_up()
    /// alone are to be run first.
    [[nodiscard]] bool is_behind() const;
    void add_catching_up(gpu::Graph& graph);

    /// Poses the vertices, into what poses `posed_vertices`, `before` and `stroke_coordinates` hold of the
    /// meshes besides.
    ///
    /// Writes  posed vertices of this frame and of the one before, stroke coordinates
    /// Cost    one dispatch, one thread a vertex; near the rim of a ring up to three times the graph
    /// Source  Losasso and Hoppe, "Geometry Clipmaps", SIGGRAPH 2004, for the rings
    struct Posed {
        gpu::BufferId vertices;
        gpu::BufferId before;
        gpu::BufferId stroke_coordinates;
    };

    [[nodiscard]] Posed add_vertices(gpu::Graph& graph, const Posed& meshes, gpu::BufferId texels);

    /// Heights above the anchor on lattices, r32f, of `size` texels each, one under another; what a lattice
    /// cannot show is left out of it. Where no texels are `wanted` the ground is as good as bottomless.
    ///
    /// Cost    one dispatch, one thread a texel
    [[nodiscard]] gpu::ImageId add_heights(gpu::Graph& graph, const HeightFields& fields, glm::uvec2 size,
                                           gpu::BufferId texels, const shared::FieldSector& wanted = {});

    /// Why the graph is interpreted where it should have been compiled; empty when it is not.
    [[nodiscard]] const std::string& problem() const;

    /// Whether the graph is interpreted until its shader is compiled. Once it is, vertices are posed anew.
    [[nodiscard]] bool is_compiling();

    /// Counts up whenever the ground takes another form, be it that time has gone on.
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
    gpu::Buffer places_; ///< of vertices in no grid
    bool has_places_ = false;
    std::future<CompiledShaders> compiling_;
    std::optional<Terrain> compiling_of_;     ///< whose graph that is, which may be one of before
    std::optional<CompiledShaders> compiled_; ///< of this graph
    gpu::Buffer texels_;
    gpu::Buffer words_;
    gpu::Buffer levels_;
    gpu::Buffer globals_;
    std::vector<uint32_t> words_now_;
    bool keeps_before_ = false;
    uint64_t form_ = 0;
    std::optional<SandSource> sand_source_;
    SlabStyle sand_style_;
    std::unique_ptr<SlabField> sand_; ///< where the graph has any
    uint32_t first_sand_texel_ = 0;
    double sand_moment_ = 0.0; ///< in steps
    bool is_sand_stale_ = false;
    std::vector<shared::TerrainLevel> levels_now_;
};

} // namespace estampe::terrain
