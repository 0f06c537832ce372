// SPDX-License-Identifier: MIT
#pragma once

// Tangent-space normal maps for the normal textures of materials: from pictures of heights, and from detailed
// meshes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe {

/// Heights of a surface: rows from top to bottom, 0 lowest and 1 highest.
struct HeightMap {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> heights; ///< Heights of the surface from 0 to 1, width * height numbers
    /// Number of steps between height 0 and height 1 that the file can store, such as 255 for 8 bits.
    uint32_t steps = 255;
};

/// Largest NormalMapSettings::relief.
inline constexpr double most_relief = 10.0;

struct NormalMapSettings {
    double relief = 0.05; ///< Difference between the heights 0 and 1, as a share of the picture's width
    /// The picture tiles: its left edge continues at the right edge, and its top at the bottom.
    bool wraps = true;
    /// The green channel points down as in Direct3D, not up as in glTF and OpenGL.
    bool is_green_down = false;
};

/// Reads the heights of a picture from its brightness: the stored values of red, green and blue, weighted by
/// ITU-R BT.709 without conversion from sRGB. Alpha is ignored. A PNG with 16 bits per channel is read at
/// full precision. Other pictures are read by load_image(). Throws Error as load_image() does.
[[nodiscard]] HeightMap load_height_map(const std::filesystem::path& path, const ReadScope& scope = {});

/// Makes a normal map: computes the normal at each texel from the slopes of the heights. Red is x, to the
/// right; green is y; blue is z, out of the surface; each component from -1 to 1 is stored as 0 to 255. Alpha
/// is 255. Throws Error if the heights are empty or their number is wrong, or if the relief is not from 0 to
/// `most_relief`. Cost: linear in texels.
///
/// Source  derivatives by the filter of Scharr, "Optimale Operatoren in der digitalen Bildverarbeitung", 2000
[[nodiscard]] Image make_normal_map(const HeightMap& map, const NormalMapSettings& settings = {});

/// Returns the difference between two neighbouring height values that the file can store, in texels of the
/// picture's width. Above about 0.25 texels the normal map shows terraces. A picture with 16 bits per
/// channel, or a smaller relief, avoids the terraces.
[[nodiscard]] double height_step_texels(const HeightMap& map, const NormalMapSettings& settings);

/// Directions to which the red and the green of a baked normal map refer, at each point of the plain mesh.
enum class TangentFrame : uint8_t {
    /// The directions in which u and v of the triangle grow. Estampe draws normal maps in this frame. The
    /// shorter direction has the length that the triangle's UVs give it, relative to the longer direction.
    of_triangle,
    /// Unit tangents at the vertices, averaged over the triangles of a vertex and interpolated between the
    /// vertices. Programs that follow glTF draw normal maps in this frame.
    ///
    /// Source  Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008 (MikkTSpace)
    of_vertices,
};

/// Resolution, reach and selection of bake_normals().
struct NormalBakeSettings {
    uint32_t size = 1024; ///< Texels per side of the map, 16 to 8192
    uint32_t samples = 2; ///< Rays per texel along each side of the texel, 1 to 8; the rays are averaged
    /// Largest distance between the plain and the detailed surface, in metres; more than 0. Empty: 2 % of the
    /// diagonal of the bounding box of the plain mesh.
    std::optional<double> distance_m;
    /// Width of the border in texels by which the covered parts of the map are extended, 0 to 64. Texture
    /// filters then do not mix normals of the mesh with texels that no triangle covers.
    uint32_t border = 8;
    uint32_t uv_set = 0; ///< Set of texture coordinates of the plain mesh: 0 or 1
    /// Plain meshes that take part: those of nodes with this name, or below such nodes. Wildcards are those
    /// of a shell: `brick*`, `pane_?`. Empty: all.
    std::string object;
    /// Plain meshes that take part: those of materials with this name, which may have wildcards. Empty: all.
    std::string material;
    /// Detailed meshes that take part, by the names of their nodes as for `object`.
    std::string detailed_object;
    TangentFrame frame = TangentFrame::of_triangle;
    bool is_green_down = false; ///< As in NormalMapSettings
};

/// A normal map that bake_normals() made, and what was lost on the way.
struct BakedNormals {
    Image map;
    double distance_m = 0.0;     ///< Largest distance between the surfaces that was used
    uint64_t covered_texels = 0; ///< Texels that triangles of the plain mesh cover
    /// Share of the covered texels where no ray hit the detailed mesh. The map is flat there.
    double missed_share = 0.0;
    /// Share of the covered part of the map that several triangles cover. Where triangles overlap, the map
    /// has the detail of the first one.
    double overlapping_share = 0.0;
    uint64_t triangles = 0; ///< Triangles of the plain mesh
    /// Triangles of the plain mesh that have no UVs, or UVs without area. The map has no part for these
    /// triangles.
    uint64_t triangles_without_uvs = 0;
    /// Triangles whose UVs are not finite, or span more than 16 widths of the map. The map has no part for
    /// these triangles.
    uint64_t triangles_of_wild_uvs = 0;
};

/// Bakes a normal map: a plain mesh drawn with this map is shaded like the detailed mesh. Link the CMake
/// target estampe::bake.
///
/// Both meshes are used in their rest pose, and must lie at the same place. For each texel that a triangle
/// of `plain` covers, rays start at the plain surface, moved outwards by the distance along the smooth
/// normal, and go inwards over twice the distance. The first front face of `detailed` on a ray gives the
/// normal, interpolated between the vertices and changed by the normal map of the detailed material. The map
/// stores this normal in the frame NormalBakeSettings::frame; components and alpha are stored as by
/// make_normal_map(). Texels that no triangle covers are flat. UVs outside 0 to 1 are wrapped, as textures
/// that repeat. The result does not depend on the number of threads.
///
/// Throws Error if a setting is out of range, if no mesh has a selected name, if a scene has no triangles, or
/// if the plain mesh has no UVs. Cost: 0.3 us per ray and 1.4 us per detailed triangle on one core, shared by
/// all cores; 0.25 kB of memory per detailed triangle and 17 bytes per texel.
///
/// Source  Cohen, Olano and Manocha, "Appearance-Preserving Simplification", 1998; Cignoni et al., "A General
///         Method for Preserving Attribute Values on Simplified Meshes", 1998; rays by Embree
[[nodiscard]] BakedNormals bake_normals(const Scene& plain, const Scene& detailed,
                                        const NormalBakeSettings& settings = {});

} // namespace estampe
