// SPDX-License-Identifier: MIT
#pragma once

// Ground without an end, made by a graph of heights that is written as text and may be changed while a
// program runs. The same graph answers questions here, on the processor, and poses the vertices on the GPU.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/trails.hpp>

namespace estampe {

/// A named part of a height graph: `swell = "6 * fbm(400)"`.
struct HeightNode {
    std::string name;
    std::string expression; ///< in the language of docs/terrain.md
    std::string where;      ///< file:line:column, for messages; may be empty

    bool operator==(const HeightNode&) const = default;
};

/// The wind over the ground.
struct TerrainWind {
    float direction_deg = 0.0F; ///< where it blows to: 0 is +x, 90 is +z
    float speed_m_s = 5.0F;

    bool operator==(const TerrainWind&) const = default;
};

/// How the plane is cut into triangles.
enum class TerrainMesh : uint8_t {
    rings, ///< nested grids about the eye, each twice as coarse as the one within; vertices stand still
    grid,  ///< one even grid, snapped by its own cell, laid before the eye and turned by right angles
    object ///< a mesh of the scene, raised by the heights
};

/// When the vertices are found anew.
enum class TerrainUpdate : uint8_t {
    moved,  ///< when the eye or the time have gone on
    always, ///< in every picture, for measuring
    still   ///< time stands still for the ground
};

/// How finely the plane is cut into triangles, and how far it goes.
struct TerrainMeshing {
    TerrainMesh method = TerrainMesh::rings;
    std::string object; ///< the name of a node, for the method of that name
    TerrainUpdate update = TerrainUpdate::moved;
    float cell_m = 0.25F;         ///< between vertices, nearest to the eye; rounded to a power of two
    int cells = 128;              ///< along a side of a ring or grid; rounded up to a multiple of 4
    float reach_m = 20000.0F;     ///< how far the ground goes at least (rings)
    float planet_radius_m = 0.0F; ///< of a ground that closes round itself; 0: it is flat

    bool operator==(const TerrainMeshing&) const = default;
};

/// What the ground looks like.
struct TerrainLook {
    glm::vec3 color{0.62F, 0.45F, 0.27F}; ///< of the sand, linear

    bool operator==(const TerrainLook&) const = default;
};

/// What the wind draws on sand, seen from near: normals alone, no heights.
struct TerrainRipples {
    float wavelength_m = 0.12F;
    float height_m = 0.01F; ///< from trough to crest; 0: there are none
    float meander = 0.5F;   ///< 0: straight and unbroken; 1: they wind, fork and end everywhere
    float drift_m_s = 0.0005F;

    bool operator==(const TerrainRipples&) const = default;
};

/// All that a terrain is, as a file has it.
struct TerrainDescription {
    std::string name;              ///< of the file, for messages
    std::filesystem::path folder;  ///< that textures are looked up in
    std::vector<HeightNode> nodes; ///< one is named "height"
    TerrainWind wind;
    TerrainMeshing meshing;
    TerrainLook look;
    TerrainRipples ripples;
    TerrainTrails trails;
    std::vector<TerrainTrack> tracks;
};

/// Reads a terrain's TOML: [terrain] with `height` and `color`, [nodes], [wind], [mesh], [ripples],
/// [trails], [tracks].
/// Throws Error with file, line and column for what is no such thing.
[[nodiscard]] TerrainDescription parse_terrain(std::string_view text, const std::string& name,
                                               const std::filesystem::path& folder = {});

/// The same of a file. Throws Error also where it cannot be read.
[[nodiscard]] TerrainDescription load_terrain(const std::filesystem::path& path);

/// The same terrain as a file: parse_terrain() gives it back. Cost: linear in its text.
[[nodiscard]] std::string terrain_toml(const TerrainDescription& terrain);

/// The ground at a place and time.
struct HeightSample {
    double height_m = 0.0;
    glm::dvec2 slope{0.0};     ///< d height / dx, d height / dz
    double rate_m_per_s = 0.0; ///< d height / dt

    /// Away from the ground, unit.
    [[nodiscard]] glm::dvec3 normal() const;
};

namespace terrain {
struct Program;
}

/// A terrain that can be asked. Copies share the graph. Throws Error from its constructor, with file, line
/// and node, for a graph with a cycle, an unknown node or argument, a missing texture or a height that is no
/// number.
class Terrain {
public:
    explicit Terrain(TerrainDescription description);

    [[nodiscard]] const TerrainDescription& description() const { return *description_; }

    /// The height at (x, z) metres and a time in seconds, and how it changes; exact derivatives of the very
    /// graph (dual numbers). Cost: about 0.1 microseconds a node.
    [[nodiscard]] HeightSample sample(double x_m, double z_m, double time_s = 0.0) const;

    /// Where a ray from `from` along unit `towards` first meets the ground, at most `reach_m` away; nothing
    /// where it does not, or begins below it. Misses what is narrower than a 500th of the way. Cost: about
    /// 500 samples.
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& towards,
                                                double reach_m, double time_s = 0.0) const;

    /// Sets the content of `mask("name", ...)`: as many texels each way as the graph says, row by row along
    /// +x from the corner at -size / 2. Throws Error for an unknown name or another count. Copies made before
    /// keep what they had; a renderer is handed the terrain anew.
    void paint_mask(std::string_view mask, const std::vector<float>& heights);

    /// What is drawn from; of no use outside of the library.
    [[nodiscard]] const terrain::Program& program() const { return *program_; }

private:
    std::shared_ptr<const TerrainDescription> description_;
    std::shared_ptr<const terrain::Program> program_;
};

struct Camera;

/// A view over the ground from a rider's eye on one of the high places near the origin, to where a third of
/// what is seen lies in the shade of a sun towards which the vector points. Cost: 26,000 samples, 0.1 s for a
/// graph of twenty nodes.
[[nodiscard]] Camera terrain_camera(const Terrain& terrain, double time_s = 0.0,
                                    const glm::dvec3& towards_sun = {-0.4, 0.7, 0.6});

} // namespace estampe
