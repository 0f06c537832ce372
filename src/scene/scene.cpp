// SPDX-License-Identifier: MIT
// Functions of estampe/scene.hpp: cloth, material variants, and load_scene(), which selects a reader for the
// file.
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "core/child/child.hpp"
#include "core/file.hpp"
#include "core/job_limits.hpp"
#include "core/long_jobs.hpp"
#include "core/text.hpp"
#include "scene/importers.hpp"
#include "scene/mending/repair.hpp"
#include "scene/reader/crossing.hpp"
#include "scene/scene_limits.hpp"
#include "scene/up_axis.hpp"

namespace estampe {

const Cloth* cloth_of(const Scene& scene, const Node& node, const Primitive& primitive)
{
    if (primitive.topology != Topology::triangles) {
        return nullptr;
    }
    if (node.cloth) {
        return &*node.cloth;
    }
    const bool has_material = primitive.material < scene.materials.size();
    return has_material && scene.materials[primitive.material].cloth
               ? &*scene.materials[primitive.material].cloth
               : nullptr;
}

Primitive cloth_sheet(uint32_t columns, uint32_t rows, const glm::vec3& corner_m, const glm::vec3& along_m,
                      const glm::vec3& down_m)
{
    columns = std::max(columns, 3U);
    rows = std::max(rows, 3U);
    const glm::vec3 across = glm::cross(down_m, along_m);
    const float area_m2 = glm::length(across);
    const glm::vec3 normal = area_m2 > 0.0F ? across / area_m2 : glm::vec3(0.0F, 0.0F, 1.0F);
    Primitive sheet;
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(columns - 1);
            const float v = static_cast<float>(y) / static_cast<float>(rows - 1);
            sheet.positions.push_back(corner_m + u * along_m + v * down_m);
            sheet.normals.push_back(normal);
            sheet.uvs[0].emplace_back(u * glm::length(along_m), v * glm::length(down_m));
            if (x + 1 == columns || y + 1 == rows) {
                continue;
            }
            const uint32_t i = y * columns + x;
            const uint32_t j = i + columns;
            // The diagonals of adjacent quads alternate, so that the cloth is not stiffer in one diagonal
            // direction.
            const auto corners = (x + y) % 2 == 0 ? std::array{i, j, j + 1, i, j + 1, i + 1}
                                                  : std::array{i, j, i + 1, i + 1, j, j + 1};
            sheet.indices.insert(sheet.indices.end(), corners.begin(), corners.end());
        }
    }
    sheet.held.assign(sheet.positions.size(), 0.0F);
    return sheet;
}

namespace {

size_t find_variant(const Scene& scene, const std::string& variant)
{
    const auto named = std::ranges::find(scene.variants, variant);
    if (named != scene.variants.end()) {
        return static_cast<size_t>(named - scene.variants.begin());
    }
    if (const auto number = number_from<size_t>(variant); number && *number < scene.variants.size()) {
        return *number;
    }
    if (scene.variants.empty()) {
        throw Error(fmt::format("no variant \"{}\": the scene has no material variants", variant), scene.name,
                    "leave the variant out");
    }
    std::string list;
    for (size_t i = 0; i < scene.variants.size(); ++i) {
        list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.variants[i]);
    }
    throw Error(fmt::format("no variant \"{}\"", variant), scene.name, "variants of the scene: " + list);
}

} // namespace

void apply_variant(Scene& scene, const std::string& variant)
{
    const bool is_default = variant.empty();
    const size_t number = is_default ? 0 : find_variant(scene, variant);
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.default_material == no_index) {
                primitive.default_material = primitive.material;
            }
            const bool is_mapped = !is_default && number < primitive.variant_materials.size() &&
                                   primitive.variant_materials[number] < scene.materials.size();
            primitive.material = is_mapped ? primitive.variant_materials[number] : primitive.default_material;
        }
    }
}

namespace {

constexpr std::array<std::string_view, 3> gltf_extensions = {".gltf", ".glb", ".vrm"};
constexpr std::array<std::string_view, 5> other_extensions = {".obj", ".ply", ".stl", ".fbx", ".dae"};

bool is_among(std::string_view extension, std::span<const std::string_view> extensions)
{
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

Scene read(const std::filesystem::path& path, const ReadScope& scope)
{
    const std::string extension = lower_extension(path);
    if (is_among(extension, gltf_extensions)) {
        return load_gltf(path, scope);
    }
    if (extension == ".obj") {
        return load_obj(path, scope);
    }
    if (extension == ".ply") {
        return load_ply(path, scope);
    }
    if (extension == ".stl") {
        return load_stl(path, scope);
    }
    if (is_among(extension, other_extensions)) {
        return load_with_assimp(path, scope);
    }
    throw Error(
        extension.empty() ? "has no file name extension"
                          : fmt::format("files of type {} are not read", extension),
        path.string(),
        fmt::format("give one of: {} {}", fmt::join(gltf_extensions, " "), fmt::join(other_extensions, " ")));
}

/// Puts the name of the scene's file before the warnings that do not begin with it.
void name_warnings(std::vector<std::string>& warnings, const std::string& name)
{
    for (std::string& warning : warnings) {
        if (!warning.starts_with(name)) {
            warning = fmt::format("{}: {}", name, warning);
        }
    }
}

/// Reads a scene and makes it ready to be drawn. Runs in a child process.
Scene read_whole(const std::filesystem::path& path, const LoadOptions& options)
{
    Scene scene = read(path, options.scope);
    scene.files.insert(scene.files.begin(), path);
    if (!options.variant.empty()) {
        apply_variant(scene, options.variant);
    }
    report_progress(0.9);
    turn_by_normals(scene);
    turn_outside(scene);
    leave_out_outline_hulls(scene);
    find_cut_out_materials(scene);
    report_progress(0.95);
    if (options.up) {
        turn_up(scene, *options.up);
    }
    name_warnings(scene.warnings, path.string());
    return scene;
}

} // namespace

Scene load_scene(const std::filesystem::path& path, const LoadOptions& options)
{
    const JobLimits limits(options.limits); // The child process has them, too
    const std::string where = path.string();
    Scene scene =
        run_in_child([&] { return read_whole(path, options); }, limits_for_file(path, options.scope), where);
    check_received_scene(scene, where);
    check_drawn_size(scene, where);
    report_progress(1.0);
    return scene;
}

} // namespace estampe
