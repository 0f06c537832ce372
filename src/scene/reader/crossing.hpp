// SPDX-License-Identifier: MIT
#pragma once

// load_scene() decodes files in a child process (core/child/child.hpp), because the files come from
// strangers. The scene then crosses to this process as bytes, and check_received_scene() checks what arrived.
//
// This header lists the members of all structs that a Scene consists of, for send() and receive() of
// core/child/exchange.hpp. Each list is a structured binding, so that a new member that is missing in its
// list is an error of the compiler. The switches over enumerations have no default for the same reason.

#include <tuple>

#include <estampe/scene.hpp>

#include "core/child/exchange.hpp"
#include "core/image_codec.hpp" // lists the members of Image

namespace estampe {

inline bool is_valid(Wrap wrap)
{
    switch (wrap) {
    case Wrap::repeat:
    case Wrap::clamp:
    case Wrap::mirror:
        return true;
    }
    return false;
}

inline bool is_valid(AlphaMode mode)
{
    switch (mode) {
    case AlphaMode::opaque:
    case AlphaMode::mask:
    case AlphaMode::blend:
        return true;
    }
    return false;
}

inline bool is_valid(Topology topology)
{
    switch (topology) {
    case Topology::points:
    case Topology::lines:
    case Topology::triangles:
        return true;
    }
    return false;
}

inline bool is_valid(LightType type)
{
    switch (type) {
    case LightType::directional:
    case LightType::point:
    case LightType::spot:
    case LightType::ambient:
        return true;
    }
    return false;
}

inline bool is_valid(LightFalloff falloff)
{
    switch (falloff) {
    case LightFalloff::inverse_square:
    case LightFalloff::unit_volume:
        return true;
    }
    return false;
}

inline bool is_valid(SpotShape shape)
{
    switch (shape) {
    case SpotShape::cone:
    case SpotShape::pyramid:
        return true;
    }
    return false;
}

inline bool is_valid(Interpolation interpolation)
{
    switch (interpolation) {
    case Interpolation::step:
    case Interpolation::linear:
    case Interpolation::cubic_spline:
        return true;
    }
    return false;
}

inline bool is_valid(AnimatedPath path)
{
    switch (path) {
    case AnimatedPath::translation:
    case AnimatedPath::rotation:
    case AnimatedPath::scale:
    case AnimatedPath::weights:
        return true;
    }
    return false;
}

inline bool is_valid(ClothSolver solver)
{
    switch (solver) {
    case ClothSolver::automatic:
    case ClothSolver::small_steps:
    case ClothSolver::verlet:
    case ClothSolver::block_descent:
        return true;
    }
    return false;
}

inline bool is_valid(ClothCollider collider)
{
    switch (collider) {
    case ClothCollider::none:
    case ClothCollider::box:
    case ClothCollider::ellipsoid:
    case ClothCollider::cylinder:
    case ClothCollider::capsule:
    case ClothCollider::mesh:
        return true;
    }
    return false;
}

template <Either<Texture> T>
auto members(T& texture)
{
    auto& [name, image, wrap_u, wrap_v] = texture;
    return std::tie(name, image, wrap_u, wrap_v);
}

template <Either<TextureRef> T>
auto members(T& reference)
{
    auto& [texture, uv_set, uv_transform] = reference;
    return std::tie(texture, uv_set, uv_transform);
}

template <Either<LightLinks> T>
auto members(T& links)
{
    auto& [lit_by, casts_for, receives_shadows] = links;
    return std::tie(lit_by, casts_for, receives_shadows);
}

template <Either<ToonShade> T>
auto members(T& toon)
{
    auto& [shade_color, shade_texture, shade_shift, shade_toony, outline_width_m, outline_color] = toon;
    return std::tie(shade_color, shade_texture, shade_shift, shade_toony, outline_width_m, outline_color);
}

template <Either<Transmission> T>
auto members(T& transmission)
{
    auto& [share, thickness_m, attenuation_m, attenuation_color, ior] = transmission;
    return std::tie(share, thickness_m, attenuation_m, attenuation_color, ior);
}

template <Either<Cloth> T>
auto members(T& cloth)
{
    auto& [density_kg_m2, stretch_n_m, bending_n_m, fold, drag, lift, damping_per_s, friction, thickness_m,
           self_m, tear, back_material, solver] = cloth;
    return std::tie(density_kg_m2, stretch_n_m, bending_n_m, fold, drag, lift, damping_per_s, friction,
                    thickness_m, self_m, tear, back_material, solver);
}

template <Either<Material> T>
auto members(T& material)
{
    auto& [name, base_color, base_color_texture, normal_texture, normal_scale, occlusion_texture,
           occlusion_strength, emissive, emissive_texture, metallic, roughness, alpha_mode, alpha_cutoff,
           has_clear_parts, is_foliage, double_sided, unlit, toon, transmission, links, cloth] = material;
    return std::tie(name, base_color, base_color_texture, normal_texture, normal_scale, occlusion_texture,
                    occlusion_strength, emissive, emissive_texture, metallic, roughness, alpha_mode,
                    alpha_cutoff, has_clear_parts, is_foliage, double_sided, unlit, toon, transmission, links,
                    cloth);
}

template <Either<MorphTarget> T>
auto members(T& target)
{
    auto& [position_offsets, normal_offsets] = target;
    return std::tie(position_offsets, normal_offsets);
}

template <Either<Primitive> T>
auto members(T& primitive)
{
    auto& [topology, material, positions, normals, tangents, uvs, colors, joints_0, joints_1, weights_0,
           weights_1, indices, edge_marks, morph_targets, held, variant_materials, default_material] =
        primitive;
    return std::tie(topology, material, positions, normals, tangents, uvs, colors, joints_0, joints_1,
                    weights_0, weights_1, indices, edge_marks, morph_targets, held, variant_materials,
                    default_material);
}

template <Either<Mesh> T>
auto members(T& mesh)
{
    auto& [name, primitives, morph_weights] = mesh;
    return std::tie(name, primitives, morph_weights);
}

template <Either<Transform> T>
auto members(T& transform)
{
    auto& [translation, rotation, scale] = transform;
    return std::tie(translation, rotation, scale);
}

template <Either<Node> T>
auto members(T& node)
{
    auto& [name, parent, children, visible, transform, matrix, mesh, skin, camera, light, links, cloth,
           collider, morph_weights, instances] = node;
    return std::tie(name, parent, children, visible, transform, matrix, mesh, skin, camera, light, links,
                    cloth, collider, morph_weights, instances);
}

template <Either<Skin> T>
auto members(T& skin)
{
    auto& [name, joints, joint_from_bind] = skin;
    return std::tie(name, joints, joint_from_bind);
}

template <Either<Light> T>
auto members(T& light)
{
    auto& [name, type, color, intensity, range_m, inner_cone_rad, outer_cone_rad, falloff, shape, radius_m,
           groups, casters] = light;
    return std::tie(name, type, color, intensity, range_m, inner_cone_rad, outer_cone_rad, falloff, shape,
                    radius_m, groups, casters);
}

template <Either<SceneCamera> T>
auto members(T& camera)
{
    auto& [name, orthographic, vertical_fov_rad, half_height_m, near_m] = camera;
    return std::tie(name, orthographic, vertical_fov_rad, half_height_m, near_m);
}

template <Either<AnimationChannel> T>
auto members(T& channel)
{
    auto& [node, path, interpolation, times_s, values] = channel;
    return std::tie(node, path, interpolation, times_s, values);
}

template <Either<Animation> T>
auto members(T& animation)
{
    auto& [name, channels, duration_s, start_s] = animation;
    return std::tie(name, channels, duration_s, start_s);
}

template <Either<SceneCell> T>
auto members(T& cell)
{
    auto& [name, low_m, high_m] = cell;
    return std::tie(name, low_m, high_m);
}

template <Either<ScenePortal> T>
auto members(T& portal)
{
    auto& [corners_m, from, to] = portal;
    return std::tie(corners_m, from, to);
}

/// Leaves out `terrain`, which no scene file describes.
template <Either<Scene> T>
auto members(T& scene)
{
    auto& [name, textures, materials, meshes, nodes, roots, skins, lights, cameras, animations, frames_per_s,
           variants, terrain, extensions_used, extensions_ignored, files, missing_files, file_unit_m,
           warnings, cells, portals] = scene;
    return std::tie(name, textures, materials, meshes, nodes, roots, skins, lights, cameras, animations,
                    frames_per_s, variants, extensions_used, extensions_ignored, files, missing_files,
                    file_unit_m, warnings, cells, portals);
}

/// Checks a scene that another process sent, so that code that draws the scene need not check it again: all
/// indices are in range, the lengths of arrays agree, nodes form a forest. Throws Error with `where` as its
/// place if the scene is damaged. Replaces control characters in texts that are printed. Cost: linear in
/// indices and nodes, about 1 ms for a million triangles.
void check_received_scene(Scene& scene, const std::string& where);

} // namespace estampe
