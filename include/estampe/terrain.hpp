// SPDX-License-Identifier: MIT
#pragma once

// Endless ground, defined by a graph of height functions. The graph is written as text and may change while a
// program runs. The CPU evaluates the graph for queries, and the GPU evaluates it for vertices.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/read_scope.hpp>
#include <estampe/trails.hpp>

namespace estampe {

/// A named node of a height graph, such as `swell = "6 * fbm(400)"`.
struct HeightNode {
    std::string name;
    std::string expression; ///< Formula of the node's heights, in the language of docs/terrain.md
    /// Place of the node in its file as file:line:column, for error messages; may be empty.
    std::string where;

    bool operator==(const HeightNode&) const = default;
};

/// Wind that blows over the ground of a terrain.
struct TerrainWind {
    float towards_deg = 90.0F; ///< Direction towards which the wind blows: 0 is +z, 90 is +x
    float speed_m_per_s = 5.0F;

    bool operator==(const TerrainWind&) const = default;
};

/// How the ground is divided into triangles.
enum class TerrainMesh : uint8_t {
    /// Nested grids around the camera. Each grid has cells twice as large as those of the grid inside it. The
    /// grids follow the camera in steps of whole cells, so that vertices do not slide over the ground.
    rings,
    /// One uniform grid in front of the camera. The grid moves in steps of whole cells and rotates in steps
    /// of 90 degrees.
    grid,
    object ///< A mesh of the scene, displaced by the terrain's heights
};

/// Chooses when the heights of the ground's vertices are computed again.
enum class TerrainUpdate : uint8_t {
    moved,  ///< Heights are computed again if the camera has moved or time has advanced
    always, ///< Heights are computed again for every picture, so that this time can be measured
    still   ///< Heights are computed again only if the camera has moved, as for ground that never changes
};

/// Resolution and extent of the terrain mesh.
struct TerrainMeshing {
    TerrainMesh method = TerrainMesh::rings;
    std::string object; ///< Name of the node with the mesh; only used with TerrainMesh::object
    TerrainUpdate update = TerrainUpdate::moved;
    float cell_m = 0.25F; ///< Spacing of the vertices nearest to the camera; rounded to a power of two
    int cells = 128;      ///< Number of cells along a side of a ring or grid; rounded up to a multiple of 4
    /// Smallest distance up to which the ground is drawn; only used with TerrainMesh::rings.
    float reach_m = 20000.0F;
    float planet_radius_m = 0.0F; ///< Radius of a ground that curves like a planet; 0: the ground is flat

    bool operator==(const TerrainMeshing&) const = default;
};

/// Appearance of the ground.
struct TerrainLook {
    glm::vec3 color{0.62F, 0.45F, 0.27F}; ///< Colour of the sand, linear

    bool operator==(const TerrainLook&) const = default;
};

/// Wind ripples of sand, visible from near. Ripples change the normals of the ground, not its heights.
struct TerrainRipples {
    float wavelength_m = 0.12F; ///< Distance from one ripple's crest to the next
    float height_m = 0.01F;     ///< Height of a ripple from trough to crest; 0: no ripples
    /// Irregularity of the ripples, 0: straight and unbroken; 1: ripples wind, fork and end.
    float meander = 0.5F;
    float drift_m_per_s = 0.0005F; ///< Speed at which the ripples move downwind

    bool operator==(const TerrainRipples&) const = default;
};

/// Everything that a terrain file describes.
struct TerrainDescription {
    std::string name;             ///< Name of the terrain's file, for error messages
    std::filesystem::path folder; ///< Folder in which the terrain's textures are
    ReadScope scope;              ///< Limits the files of the terrain's textures
    /// Nodes of the height graph; the value of the node "height" is the ground's height.
    std::vector<HeightNode> nodes;
    TerrainWind wind;
    TerrainMeshing meshing;
    TerrainLook look;
    TerrainRipples ripples;
    TerrainTrails trails;
    std::vector<TerrainTrack> tracks;
};

/// Parses a terrain in TOML: [terrain] with `height` and `color`, [nodes], [wind], [mesh], [ripples],
/// [trails], [tracks]. Textures are looked up in `folder`. Throws Error with file, line and column if the
/// text is not valid.
[[nodiscard]] TerrainDescription parse_terrain(std::string_view text, const std::string& name,
                                               const std::filesystem::path& folder = {});

/// Reads a terrain file. Throws Error as parse_terrain() does, and if the file cannot be read or
/// lies outside of `scope`. The scope also limits the terrain's textures.
[[nodiscard]] TerrainDescription load_terrain(const std::filesystem::path& path, const ReadScope& scope = {});

/// Writes a terrain as TOML that parse_terrain() reads back. Cost: linear in the length of the text.
[[nodiscard]] std::string terrain_toml(const TerrainDescription& terrain);

/// Height, slope and vertical speed of the ground at a point and a time.
struct HeightSample {
    double height_m = 0.0;
    glm::dvec2 slope{0.0};     ///< Slope of the ground: d height / dx and d height / dz
    double rate_m_per_s = 0.0; ///< Vertical speed of the ground: d height / dt

    /// Unit normal, pointing away from the ground.
    [[nodiscard]] glm::dvec3 normal() const;
};

namespace terrain {
struct Program;
}

/// A compiled terrain, whose height can be evaluated at any point. Copies share the graph. The constructor
/// throws Error with file, line and node if the graph has a cycle, an unknown node or argument, a missing
/// texture, or a height that is not a number.
class Terrain {
public:
    /// Reads the textures of `description` and compiles its graph.
    explicit Terrain(TerrainDescription description);

    [[nodiscard]] const TerrainDescription& description() const { return *description_; }

    /// Evaluates height, slope and vertical speed of the ground at (x, z) in metres and a time in seconds.
    /// Derivatives are exact (dual numbers). Cost: about 0.1 microseconds per node.
    [[nodiscard]] HeightSample sample(double x_m, double z_m, double time_s = 0.0) const;

    /// First intersection of the ground with the ray from `from` along the unit vector `towards`, at most
    /// `reach_m` away. Empty if there is no intersection or if the ray starts below the ground. Can miss
    /// features narrower than 1/500 of the ray's length. Cost: about 500 evaluations of the terrain.
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& towards,
                                                double reach_m, double time_s = 0.0) const;

    /// Returns the pictures that the height graph reads.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

    /// Sets the content of the node `mask("name", ...)` of the height graph: `heights` has one number per
    /// texel, in rows along +x. The first row begins at the corner with the smallest x and z. The graph says
    /// how many texels a side has. Throws Error for an unknown name or a wrong number of texels. Earlier
    /// copies of the terrain keep their content; pass the terrain to Renderer::set_terrain() to show the
    /// change.
    void paint_mask(std::string_view mask, const std::vector<float>& heights);

    /// The compiled height graph, as an internal program. For the library only.
    [[nodiscard]] const terrain::Program& program() const { return *program_; }

private:
    std::shared_ptr<const TerrainDescription> description_;
    std::shared_ptr<const terrain::Program> program_;
};

struct Camera;

/// Returns a camera at the eye height of a rider, on a high place near the origin. The camera's direction is
/// chosen so that about a third of the visible ground is in shade. `towards_sun` points to the sun. Cost:
/// 26,000 samples of the terrain, 0.1 s for a graph of twenty nodes.
[[nodiscard]] Camera terrain_camera(const Terrain& terrain, double time_s = 0.0,
                                    const glm::dvec3& towards_sun = {-0.4, 0.7, 0.6});

} // namespace estampe
