// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "core/child/child.hpp"
#include "core/child/exchange_test_support.hpp"
#include "scene/reader/crossing.hpp"
#include "scene/scene_limits.hpp"

namespace estampe {
namespace {

using Bytes = std::vector<std::byte>;
using test::sent;

Scene received(std::span<const std::byte> bytes, uint64_t budget_bytes = uint64_t{1} << 24U)
{
    ByteReader reader = test::reader_of(bytes, budget_bytes, "there");
    Scene scene;
    receive(reader, scene);
    check_received_scene(scene, "there");
    return scene;
}

// Each value of the sample differs from its default, so that a member that does not cross is found.

Cloth cloth_sample()
{
    return {.density_kg_m2 = 1.5F,
            .stretch_n_m = 2.0F,
            .bending_n_m = 3.0F,
            .fold = 0.5F,
            .drag = 4.0F,
            .lift = 5.0F,
            .damping_per_s = 6.0F,
            .friction = 7.0F,
            .thickness_m = 8.0F,
            .self_m = 9.0F,
            .tear = 10.0F,
            .back_material = 1,
            .solver = ClothSolver::verlet};
}

LightLinks links_sample()
{
    return {.lit_by = 5, .casts_for = 6, .receives_shadows = false};
}

Material material_sample()
{
    const TextureRef reference{.texture = 0, .uv_set = 1, .uv_transform = glm::mat3(2.0F)};
    Material material;
    material.name = "paint";
    material.base_color = {0.1F, 0.2F, 0.3F, 0.4F};
    material.base_color_texture = reference;
    material.normal_texture = reference;
    material.normal_scale = 0.5F;
    material.occlusion_texture = reference;
    material.occlusion_strength = 0.25F;
    material.emissive = {1.0F, 2.0F, 3.0F};
    material.emissive_texture = reference;
    material.metallic = 0.75F;
    material.roughness = 0.125F;
    material.alpha_mode = AlphaMode::blend;
    material.alpha_cutoff = 0.3F;
    material.has_clear_parts = true;
    material.is_foliage = true;
    material.double_sided = true;
    material.unlit = true;
    material.toon = ToonShade{.shade_color = {0.1F, 0.2F, 0.3F},
                              .shade_texture = reference,
                              .shade_shift = 0.1F,
                              .shade_toony = 0.2F,
                              .outline_width_m = 0.3F,
                              .outline_color = {0.4F, 0.5F, 0.6F}};
    material.transmission = Transmission{.share = 0.1F,
                                         .thickness_m = 0.2F,
                                         .attenuation_m = 0.3F,
                                         .attenuation_color = {0.4F, 0.5F, 0.6F},
                                         .ior = 1.4F};
    material.links = links_sample();
    material.cloth = cloth_sample();
    return material;
}

Primitive primitive_sample()
{
    Primitive primitive = shapes::box({1, 2, 3});
    const size_t vertices = primitive.positions.size();
    primitive.material = 1;
    primitive.tangents.assign(vertices, {1, 0, 0, -1});
    primitive.uvs[0].assign(vertices, {0.5F, 0.25F});
    primitive.uvs[1].assign(vertices, {0.25F, 0.5F});
    primitive.colors.assign(vertices, {0.1F, 0.2F, 0.3F, 1.0F});
    primitive.joints_0.assign(vertices, {1, 0, 1, 0});
    primitive.joints_1.assign(vertices, {0, 1, 0, 1});
    primitive.weights_0.assign(vertices, {0.5F, 0.0F, 0.25F, 0.0F});
    primitive.weights_1.assign(vertices, {0.0F, 0.25F, 0.0F, 0.0F});
    primitive.edge_marks.assign(primitive.indices.size() / 3, 3);
    primitive.morph_targets.resize(1);
    primitive.morph_targets[0].position_offsets.assign(vertices, {1, 0, 0});
    primitive.morph_targets[0].normal_offsets.assign(vertices, {0, 1, 0});
    primitive.held.assign(vertices, 0.5F);
    primitive.variant_materials = {0, 1};
    primitive.default_material = 0;
    return primitive;
}

Node node_sample()
{
    Node node;
    node.name = "arm";
    node.parent = 0;
    node.visible = false;
    node.transform = {
        .translation = {1, 2, 3}, .rotation = glm::dquat(0.0, 1.0, 0.0, 0.0), .scale = {4, 5, 6}};
    node.matrix = glm::dmat4(3.0);
    node.mesh = 0;
    node.skin = 0;
    node.camera = 0;
    node.light = 0;
    node.links = links_sample();
    node.cloth = cloth_sample();
    node.collider = ClothCollider::capsule;
    node.morph_weights = {0.5F};
    node.instances = {glm::mat4(2.0F)};
    return node;
}

Scene sample()
{
    Scene scene;
    scene.name = "sample";
    scene.textures = {{.name = "picture",
                       .image = {.width = 2, .height = 1, .rgba = {1, 2, 3, 4, 5, 6, 7, 8}},
                       .wrap_u = Wrap::clamp,
                       .wrap_v = Wrap::mirror}};
    scene.materials = {Material{}, material_sample()};
    scene.meshes = {{.name = "box", .primitives = {primitive_sample()}, .morph_weights = {0.5F}}};
    scene.nodes = {Node{}, node_sample()};
    scene.nodes[0].children = {1};
    scene.roots = {0};
    scene.skins = {{.name = "skin", .joints = {1, 0}, .joint_from_bind = {glm::mat4(2.0F), glm::mat4(3.0F)}}};
    scene.lights = {{.name = "lamp",
                     .type = LightType::spot,
                     .color = {0.1F, 0.2F, 0.3F},
                     .intensity = 3.0F,
                     .range_m = 4.0F,
                     .inner_cone_rad = 0.1F,
                     .outer_cone_rad = 0.2F,
                     .falloff = LightFalloff::unit_volume,
                     .shape = SpotShape::pyramid,
                     .radius_m = 0.5F,
                     .groups = 3,
                     .casters = 4}};
    scene.cameras = {
        {.name = "eye", .orthographic = true, .vertical_fov_rad = 0.5, .half_height_m = 2.0, .near_m = 0.5}};
    AnimationChannel channel;
    channel.node = 1;
    channel.path = AnimatedPath::scale;
    channel.interpolation = Interpolation::step;
    channel.times_s = {0.0F, 2.0F};
    channel.values = {1, 2, 3, 4, 5, 6};
    scene.animations = {{.name = "grow", .channels = {channel}, .duration_s = 2.0F, .start_s = 0.5F}};
    scene.frames_per_s = 30.0;
    scene.variants = {"day", "night"};
    scene.extensions_used = {"A", "B"};
    scene.extensions_ignored = {"B"};
    scene.files = {"a.gltf", "b.png"};
    scene.missing_files = {"c.png"};
    scene.file_unit_m = 0.01;
    scene.warnings = {"mended"};
    scene.cells = {{.name = "hall", .low_m = {1, 2, 3}, .high_m = {4, 5, 6}}};
    scene.portals = {{.corners_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, .from = 0, .to = no_index}};
    return scene;
}

void expect_same(const TextureRef& a, const TextureRef& b)
{
    EXPECT_EQ(a.texture, b.texture);
    EXPECT_EQ(a.uv_set, b.uv_set);
    EXPECT_EQ(a.uv_transform, b.uv_transform);
}

/// Compares the members that `each` points to.
template <typename T, typename... Member>
void expect_same_members(const T& a, const T& b, Member T::*... each)
{
    const bool same[] = {(a.*each == b.*each)...};
    for (size_t i = 0; i < std::size(same); ++i)
        EXPECT_TRUE(same[i]) << "member " << i;
}

void expect_same(const Material& a, const Material& b)
{
    expect_same_members(a, b, &Material::name, &Material::base_color, &Material::normal_scale,
                        &Material::occlusion_strength, &Material::emissive, &Material::metallic,
                        &Material::roughness, &Material::alpha_mode, &Material::alpha_cutoff,
                        &Material::has_clear_parts, &Material::is_foliage, &Material::double_sided,
                        &Material::unlit, &Material::links, &Material::cloth);
    expect_same(a.base_color_texture, b.base_color_texture);
    expect_same(a.normal_texture, b.normal_texture);
    expect_same(a.occlusion_texture, b.occlusion_texture);
    expect_same(a.emissive_texture, b.emissive_texture);
    ASSERT_EQ(a.toon.has_value(), b.toon.has_value());
    if (a.toon) {
        expect_same_members(*a.toon, *b.toon, &ToonShade::shade_color, &ToonShade::shade_shift,
                            &ToonShade::shade_toony, &ToonShade::outline_width_m, &ToonShade::outline_color);
        expect_same(a.toon->shade_texture, b.toon->shade_texture);
    }
    ASSERT_EQ(a.transmission.has_value(), b.transmission.has_value());
    if (a.transmission)
        expect_same_members(*a.transmission, *b.transmission, &Transmission::share,
                            &Transmission::thickness_m, &Transmission::attenuation_m,
                            &Transmission::attenuation_color, &Transmission::ior);
}

void expect_same(const Primitive& a, const Primitive& b)
{
    expect_same_members(a, b, &Primitive::topology, &Primitive::material, &Primitive::positions,
                        &Primitive::normals, &Primitive::tangents, &Primitive::uvs, &Primitive::colors,
                        &Primitive::joints_0, &Primitive::joints_1, &Primitive::weights_0,
                        &Primitive::weights_1, &Primitive::indices, &Primitive::edge_marks, &Primitive::held,
                        &Primitive::variant_materials, &Primitive::default_material);
    ASSERT_EQ(a.morph_targets.size(), b.morph_targets.size());
    for (size_t i = 0; i < a.morph_targets.size(); ++i)
        expect_same_members(a.morph_targets[i], b.morph_targets[i], &MorphTarget::position_offsets,
                            &MorphTarget::normal_offsets);
}

void expect_same(const Node& a, const Node& b)
{
    expect_same_members(a, b, &Node::name, &Node::parent, &Node::children, &Node::visible, &Node::matrix,
                        &Node::mesh, &Node::skin, &Node::camera, &Node::light, &Node::links, &Node::cloth,
                        &Node::collider, &Node::morph_weights, &Node::instances);
    expect_same_members(a.transform, b.transform, &Transform::translation, &Transform::rotation,
                        &Transform::scale);
}

void expect_same(const Mesh& a, const Mesh& b)
{
    expect_same_members(a, b, &Mesh::name, &Mesh::morph_weights);
    ASSERT_EQ(a.primitives.size(), b.primitives.size());
    for (size_t i = 0; i < a.primitives.size(); ++i)
        expect_same(a.primitives[i], b.primitives[i]);
}

void expect_same(const Animation& a, const Animation& b)
{
    expect_same_members(a, b, &Animation::name, &Animation::duration_s, &Animation::start_s);
    ASSERT_EQ(a.channels.size(), b.channels.size());
    for (size_t i = 0; i < a.channels.size(); ++i)
        expect_same_members(a.channels[i], b.channels[i], &AnimationChannel::node, &AnimationChannel::path,
                            &AnimationChannel::interpolation, &AnimationChannel::times_s,
                            &AnimationChannel::values);
}

void expect_same(const Texture& a, const Texture& b)
{
    expect_same_members(a, b, &Texture::name, &Texture::image, &Texture::wrap_u, &Texture::wrap_v);
}

void expect_same(const Skin& a, const Skin& b)
{
    expect_same_members(a, b, &Skin::name, &Skin::joints, &Skin::joint_from_bind);
}

void expect_same(const SceneCamera& a, const SceneCamera& b)
{
    expect_same_members(a, b, &SceneCamera::name, &SceneCamera::orthographic, &SceneCamera::vertical_fov_rad,
                        &SceneCamera::half_height_m, &SceneCamera::near_m);
}

void expect_same(const SceneCell& a, const SceneCell& b)
{
    expect_same_members(a, b, &SceneCell::name, &SceneCell::low_m, &SceneCell::high_m);
}

void expect_same(const ScenePortal& a, const ScenePortal& b)
{
    expect_same_members(a, b, &ScenePortal::corners_m, &ScenePortal::from, &ScenePortal::to);
}

template <typename T>
void expect_same_items(const std::vector<T>& a, const std::vector<T>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i)
        expect_same(a[i], b[i]);
}

void expect_same(const Scene& a, const Scene& b)
{
    expect_same_members(a, b, &Scene::name, &Scene::roots, &Scene::lights, &Scene::frames_per_s,
                        &Scene::variants, &Scene::extensions_used, &Scene::extensions_ignored, &Scene::files,
                        &Scene::missing_files, &Scene::file_unit_m, &Scene::warnings);
    expect_same_items(a.textures, b.textures);
    expect_same_items(a.materials, b.materials);
    expect_same_items(a.meshes, b.meshes);
    expect_same_items(a.nodes, b.nodes);
    expect_same_items(a.skins, b.skins);
    expect_same_items(a.cameras, b.cameras);
    expect_same_items(a.animations, b.animations);
    expect_same_items(a.cells, b.cells);
    expect_same_items(a.portals, b.portals);
}

TEST(Crossing, EveryMemberArrives)
{
    const Scene before = sample();
    const Scene after = received(sent(before));
    expect_same(before, after);
    EXPECT_EQ(sent(after), sent(before));
}

TEST(Crossing, SceneOfAChildIsThatOfThisProcess)
{
    const Scene before = sample();
    expect_same(before, run_in_child([&before] { return before; }, {}, "there"));
}

TEST(Crossing, EveryTruncationIsAnError)
{
    const Bytes bytes = sent(sample());
    for (size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 37)
        EXPECT_THROW((void)received(std::span(bytes).first(size)), Error) << size;
}

/// Uses what a drawing first computes of a scene, so that a bad index that passed is found.
void use(const Scene& scene)
{
    const ScenePose pose = pose_scene(scene, 0.5);
    (void)scene_bounds(scene, pose);
    (void)drawn_size(scene);
    for (const Node& node : scene.nodes)
        if (node.mesh != no_index)
            for (const Primitive& primitive : scene.meshes[node.mesh].primitives)
                (void)cloth_of(scene, node, primitive);
}

TEST(Crossing, DamageIsAnErrorOrAnotherScene)
{
    const Bytes bytes = sent(sample());
    std::mt19937 random(7);
    size_t errors = 0;
    constexpr int rounds = 20'000;
    for (int round = 0; round < rounds; ++round) {
        Bytes damaged = bytes;
        for (unsigned i = 0; i <= random() % 4; ++i)
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        try {
            use(received(damaged));
        } catch (const Error& error) {
            ++errors;
            EXPECT_EQ(error.where(), "there");
        }
    }
    EXPECT_GT(errors, rounds / 20);
    EXPECT_LT(errors, rounds);
}

/// Expects that the check of a received scene refuses the sample after `damage`.
void expect_refused(const std::function<void(Scene&)>& damage)
{
    Scene scene = sample();
    EXPECT_NO_THROW(check_received_scene(scene, "there"));
    damage(scene);
    EXPECT_THROW(check_received_scene(scene, "there"), Error);
}

TEST(Crossing, IndicesOutOfRangeAreRefused)
{
    expect_refused([](Scene& scene) { scene.materials[1].normal_texture.texture = 1; });
    expect_refused([](Scene& scene) { scene.materials[1].emissive_texture.uv_set = 2; });
    expect_refused([](Scene& scene) { scene.materials[1].toon->shade_texture.texture = 1; });
    expect_refused([](Scene& scene) { scene.materials[1].cloth->back_material = 2; });
    expect_refused([](Scene& scene) { scene.nodes[1].cloth->back_material = 2; });
    expect_refused([](Scene& scene) { scene.nodes[1].mesh = 1; });
    expect_refused([](Scene& scene) { scene.nodes[1].skin = 1; });
    expect_refused([](Scene& scene) { scene.nodes[1].camera = 1; });
    expect_refused([](Scene& scene) { scene.nodes[1].light = 1; });
    expect_refused([](Scene& scene) { scene.skins[0].joints[0] = 2; });
    expect_refused([](Scene& scene) { scene.animations[0].channels[0].node = 2; });
    expect_refused([](Scene& scene) { scene.portals[0].from = 1; });
    expect_refused([](Scene& scene) { scene.portals[0].to = 1; });
    const auto of_primitive = [](const std::function<void(Primitive&)>& damage) {
        expect_refused([&damage](Scene& scene) { damage(scene.meshes[0].primitives[0]); });
    };
    of_primitive([](Primitive& primitive) { primitive.material = 2; });
    of_primitive([](Primitive& primitive) { primitive.default_material = 2; });
    of_primitive([](Primitive& primitive) { primitive.variant_materials[1] = 2; });
    of_primitive([](Primitive& primitive) { primitive.indices[3] = 24; });
    of_primitive([](Primitive& primitive) { primitive.joints_1[5].y = 2; });
}

TEST(Crossing, LengthsThatDisagreeAreRefused)
{
    expect_refused([](Scene& scene) { scene.textures[0].image.rgba.pop_back(); });
    expect_refused([](Scene& scene) { scene.textures[0].image = {}; });
    expect_refused([](Scene& scene) { scene = {}; }); // without any material
    expect_refused([](Scene& scene) { scene.skins[0].joint_from_bind.pop_back(); });
    const auto of_channel = [](const std::function<void(AnimationChannel&)>& damage) {
        expect_refused([&damage](Scene& scene) { damage(scene.animations[0].channels[0]); });
    };
    of_channel([](AnimationChannel& channel) { channel.times_s = {2.0F, 0.0F}; });
    of_channel([](AnimationChannel& channel) { channel.times_s.clear(); });
    of_channel([](AnimationChannel& channel) { channel.values.resize(4); });
    of_channel([](AnimationChannel& channel) {
        channel.path = AnimatedPath::weights;
        channel.values.pop_back();
    });
    const auto of_primitive = [](const std::function<void(Primitive&)>& damage) {
        expect_refused([&damage](Scene& scene) { damage(scene.meshes[0].primitives[0]); });
    };
    of_primitive([](Primitive& primitive) { primitive.positions.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.normals.clear(); });
    of_primitive([](Primitive& primitive) { primitive.tangents.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.uvs[0].pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.uvs[1].pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.colors.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.joints_0.clear(); });
    of_primitive([](Primitive& primitive) { primitive.weights_0.clear(); });
    of_primitive([](Primitive& primitive) { primitive.weights_1.clear(); });
    of_primitive([](Primitive& primitive) {
        primitive.joints_0.pop_back();
        primitive.weights_0.pop_back();
    });
    of_primitive([](Primitive& primitive) {
        primitive.joints_1.pop_back();
        primitive.weights_1.pop_back();
    });
    of_primitive([](Primitive& primitive) {
        primitive.joints_0.clear();
        primitive.weights_0.clear();
    });
    of_primitive([](Primitive& primitive) {
        primitive.edge_marks.clear();
        primitive.indices.pop_back();
    });
    of_primitive([](Primitive& primitive) { primitive = {.topology = Topology::points, .indices = {0}}; });
    of_primitive([](Primitive& primitive) {
        primitive = {
            .topology = Topology::points, .positions = {{0, 0, 0}, {1, 0, 0}}, .normals = {{0, 0, 1}}};
    });
    of_primitive([](Primitive& primitive) { primitive.morph_targets[0].position_offsets.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.edge_marks.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.morph_targets[0].normal_offsets.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.held.pop_back(); });
    of_primitive([](Primitive& primitive) { primitive.variant_materials.pop_back(); });
}

TEST(Crossing, NodesThatAreNoForestAreRefused)
{
    expect_refused([](Scene& scene) { scene.roots = {2}; });
    expect_refused([](Scene& scene) { scene.roots = {no_index}; });
    expect_refused([](Scene& scene) { scene.roots = {0, 1}; });
    expect_refused([](Scene& scene) { scene.nodes[1].children = {0}; });
    expect_refused([](Scene& scene) { scene.nodes[1].parent = no_index; });
    expect_refused([](Scene& scene) { scene.nodes[0].children = {1, 1}; });
    expect_refused([](Scene& scene) { scene.nodes[0].children = {}; });
}

TEST(Crossing, WarningsCannotCommandATerminal)
{
    Scene scene = sample();
    scene.warnings = {"red\x1b[31m\nline"};
    check_received_scene(scene, "there");
    EXPECT_EQ(scene.warnings, std::vector<std::string>{"red [31m line"});
}

} // namespace
} // namespace estampe
