// SPDX-License-Identifier: MIT
// Finds what is wrong with a scene that a program made, or that another process sent.
#include "scene/scene_limits.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <estampe/error.hpp>

#include "core/image_codec.hpp"

namespace estampe {
namespace {

/// A list of faults. Faults are put into words only when they are found, because a scene without faults is
/// checked much more often.
class FaultList {
public:
    /// Adds a fault unless `holds`. `say` returns its text.
    template <std::invocable Say>
    void expect(bool holds, const Say& say)
    {
        constexpr size_t most_listed = 100; // a scene with one mistake in its code may have millions
        if (!holds && texts_.size() < most_listed)
            texts_.push_back(say());
    }

    [[nodiscard]] std::vector<std::string> take() { return std::move(texts_); }

private:
    std::vector<std::string> texts_;
};

/// Names an item of one of the scene's arrays, such as: meshes[2] "wheel".
std::string item(const char* array, size_t index, const std::string& name)
{
    return name.empty() ? fmt::format("{}[{}]", array, index)
                        : fmt::format("{}[{}] \"{}\"", array, index, name);
}

/// Calls `check` with each material, primitive and node of a scene, and with a function that returns its
/// name.
template <typename Check>
void visit_items(const Scene& scene, Check& check)
{
    for (size_t i = 0; i < scene.materials.size(); ++i)
        check.material(scene.materials[i], [&] { return item("materials", i, scene.materials[i].name); });
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        for (size_t k = 0; k < scene.meshes[i].primitives.size(); ++k)
            check.primitive(scene.meshes[i].primitives[k], [&] {
                return fmt::format("{}, primitives[{}]", item("meshes", i, scene.meshes[i].name), k);
            });
    for (size_t i = 0; i < scene.nodes.size(); ++i)
        check.node(scene.nodes[i], [&] { return item("nodes", i, scene.nodes[i].name); });
}

/// Returns the highest index; 0 if there is none. The loop has no branch, so that the compiler uses vector
/// instructions.
uint32_t highest(std::span<const uint32_t> indices)
{
    uint32_t highest = 0;
    for (const uint32_t index : indices)
        highest = std::max(highest, index);
    return highest;
}

size_t corners_of(Topology topology)
{
    return topology == Topology::triangles ? 3 : topology == Topology::lines ? 2 : 1;
}

/// Finds what would make code that draws the scene read outside of an array or run forever.
class StructureCheck {
public:
    explicit StructureCheck(const Scene& scene) : scene_(scene) {}

    std::vector<std::string> run()
    {
        for (size_t i = 0; i < scene_.textures.size(); ++i)
            faults_.expect(is_well_formed(scene_.textures[i].image), [&] { return texture_fault(i); });
        visit_items(scene_, *this);
        forest();
        for (size_t i = 0; i < scene_.skins.size(); ++i)
            skin(scene_.skins[i], [&] { return item("skins", i, scene_.skins[i].name); });
        for (size_t i = 0; i < scene_.animations.size(); ++i)
            for (size_t k = 0; k < scene_.animations[i].channels.size(); ++k)
                channel(scene_.animations[i].channels[k], [&] {
                    return fmt::format("{}, channels[{}]", item("animations", i, scene_.animations[i].name),
                                       k);
                });
        for (size_t i = 0; i < scene_.portals.size(); ++i) {
            const auto where = [&] { return item("portals", i, {}); };
            index(scene_.portals[i].from, scene_.cells.size(), "from", "cells", where);
            index(scene_.portals[i].to, scene_.cells.size(), "to", "cells", where);
        }
        return faults_.take();
    }

private:
    template <typename Check>
    friend void visit_items(const Scene& scene, Check& check);

    [[nodiscard]] std::string texture_fault(size_t i) const
    {
        const Texture& texture = scene_.textures[i];
        return fmt::format("{}: its image is {} x {} pixels with {} bytes; a picture of 1 to {} pixels along "
                           "each side needs 4 bytes for each pixel",
                           item("textures", i, texture.name), texture.image.width, texture.image.height,
                           texture.image.rgba.size(), max_image_side);
    }

    /// Expects that an index that need not refer to anything is no_index or in range.
    template <typename Where>
    void index(Index value, size_t size, const char* what, const char* array, const Where& where)
    {
        faults_.expect(value == no_index || value < size,
                       [&] { return beyond(value, size, what, array, where); });
    }

    /// Expects that an index is in range.
    template <typename Where>
    void required(Index value, size_t size, const char* what, const char* array, const Where& where)
    {
        faults_.expect(value < size, [&] { return beyond(value, size, what, array, where); });
    }

    template <typename Where>
    static std::string beyond(Index value, size_t size, const char* what, const char* array,
                              const Where& where)
    {
        return value == no_index
                   ? fmt::format("{}: {} is no_index, but must refer to one of the {}", where(), what, array)
                   : fmt::format("{}: {} is {}, but the number of {} is {}", where(), what, value, array,
                                 size);
    }

    /// Expects that an array is empty or has `count` items.
    template <typename Item, typename Where>
    void length(const std::vector<Item>& items, size_t count, const char* what, const Where& where)
    {
        faults_.expect(items.empty() || items.size() == count, [&] {
            return fmt::format("{}: {} has {} items, but must be empty or have {}", where(), what,
                               items.size(), count);
        });
    }

    template <typename Where>
    void texture(const TextureRef& reference, const char* what, const Where& where)
    {
        index(reference.texture, scene_.textures.size(), what, "textures", where);
        faults_.expect(reference.uv_set <= 1, [&] {
            return fmt::format("{}: {} uses UV set {}, but there are sets 0 and 1", where(), what,
                               reference.uv_set);
        });
    }

    template <typename Where>
    void cloth(const std::optional<Cloth>& cloth, const Where& where)
    {
        if (cloth)
            index(cloth->back_material, scene_.materials.size(), "cloth.back_material", "materials", where);
    }

    template <typename Where>
    void material(const Material& material, const Where& where)
    {
        texture(material.base_color_texture, "base_color_texture", where);
        texture(material.normal_texture, "normal_texture", where);
        texture(material.occlusion_texture, "occlusion_texture", where);
        texture(material.emissive_texture, "emissive_texture", where);
        if (material.toon)
            texture(material.toon->shade_texture, "toon.shade_texture", where);
        cloth(material.cloth, where);
    }

    template <typename Where>
    void vertex_arrays(const Primitive& primitive, const Where& where)
    {
        const size_t vertices = primitive.positions.size();
        faults_.expect(vertices < no_index,
                       [&] { return fmt::format("{}: has more vertices than indices can count", where()); });
        length(primitive.normals, vertices, "normals", where);
        length(primitive.tangents, vertices, "tangents", where);
        length(primitive.uvs[0], vertices, "uvs[0]", where);
        length(primitive.uvs[1], vertices, "uvs[1]", where);
        length(primitive.colors, vertices, "colors", where);
        length(primitive.joints_0, vertices, "joints_0", where);
        length(primitive.joints_1, vertices, "joints_1", where);
        length(primitive.held, vertices, "held", where);
        faults_.expect(primitive.weights_0.size() == primitive.joints_0.size() &&
                           primitive.weights_1.size() == primitive.joints_1.size(),
                       [&] { return fmt::format("{}: joints and weights differ in number", where()); });
        faults_.expect(!primitive.joints_0.empty() || primitive.joints_1.empty(),
                       [&] { return fmt::format("{}: has joints_1, but no joints_0", where()); });
        for (const MorphTarget& target : primitive.morph_targets) {
            length(target.position_offsets, vertices, "position_offsets of a morph target", where);
            length(target.normal_offsets, vertices, "normal_offsets of a morph target", where);
        }
    }

    template <typename Where>
    void indices(const Primitive& primitive, const Where& where)
    {
        const size_t corners = corners_of(primitive.topology);
        const size_t vertices = primitive.positions.size();
        faults_.expect(primitive.indices.size() % corners == 0 && primitive.indices.size() < no_index, [&] {
            return fmt::format("{}: the number of indices is {}, but each element has {}", where(),
                               primitive.indices.size(), corners);
        });
        const bool is_in_range = primitive.indices.empty() || highest(primitive.indices) < vertices;
        faults_.expect(is_in_range, [&] {
            const auto wrong =
                std::ranges::find_if(primitive.indices, [&](uint32_t index) { return index >= vertices; });
            return fmt::format("{}: indices[{}] is {}, but the number of positions is {}", where(),
                               wrong - primitive.indices.begin(), *wrong, vertices);
        });
        length(primitive.edge_marks, primitive.indices.size() / corners, "edge_marks", where);
    }

    template <typename Where>
    void primitive(const Primitive& primitive, const Where& where)
    {
        vertex_arrays(primitive, where);
        indices(primitive, where);
        const size_t materials = scene_.materials.size();
        required(primitive.material, materials, "material", "materials", where);
        index(primitive.default_material, materials, "default_material", "materials", where);
        length(primitive.variant_materials, scene_.variants.size(), "variant_materials", where);
        for (const Index material : primitive.variant_materials)
            index(material, materials, "an item of variant_materials", "materials", where);
    }

    void forest()
    {
        std::vector<bool> is_seen(scene_.nodes.size(), false);
        std::vector<std::pair<Index, Index>> open; // node and its parent
        size_t count = 0;
        const auto open_all = [&](const std::vector<Index>& nodes, Index parent) {
            for (const Index node : nodes) {
                const auto where = [&] {
                    return parent == no_index ? std::string("roots")
                                              : item("nodes", parent, scene_.nodes[parent].name);
                };
                required(node, scene_.nodes.size(), parent == no_index ? "an item" : "a child", "nodes",
                         where);
                if (node >= is_seen.size())
                    continue;
                faults_.expect(!is_seen[node], [&] {
                    return fmt::format("{}: has a second parent, or is its own ancestor",
                                       item("nodes", node, scene_.nodes[node].name));
                });
                faults_.expect(scene_.nodes[node].parent == parent, [&] {
                    return fmt::format("{}: its parent is not the node that lists it as a child",
                                       item("nodes", node, scene_.nodes[node].name));
                });
                if (is_seen[node])
                    continue;
                is_seen[node] = true;
                ++count;
                open.emplace_back(node, parent);
            }
        };
        open_all(scene_.roots, no_index);
        while (!open.empty()) {
            const Index node = open.back().first;
            open.pop_back();
            open_all(scene_.nodes[node].children, node);
        }
        faults_.expect(count == scene_.nodes.size(), [&] {
            const auto lost = std::ranges::find(is_seen, false) - is_seen.begin();
            const auto place = static_cast<size_t>(lost);
            return fmt::format("{}: is neither in roots nor below a node of roots",
                               item("nodes", place, scene_.nodes[place].name));
        });
    }

    template <typename Where>
    void node(const Node& node, const Where& where)
    {
        index(node.mesh, scene_.meshes.size(), "mesh", "meshes", where);
        index(node.skin, scene_.skins.size(), "skin", "skins", where);
        index(node.camera, scene_.cameras.size(), "camera", "cameras", where);
        index(node.light, scene_.lights.size(), "light", "lights", where);
        cloth(node.cloth, where);
        if (node.mesh >= scene_.meshes.size() || node.skin >= scene_.skins.size())
            return;
        const size_t joints = scene_.skins[node.skin].joints.size();
        uint32_t most = 0;
        for (const Primitive& primitive : scene_.meshes[node.mesh].primitives)
            for (const auto* const set : {&primitive.joints_0, &primitive.joints_1})
                for (const glm::u16vec4& four : *set)
                    most = std::max<uint32_t>({most, four.x, four.y, four.z, four.w});
        faults_.expect(most < std::max<size_t>(joints, 1), [&] {
            return fmt::format("{}: its mesh uses joint {}, but the number of joints of its skin is {}",
                               where(), most, joints);
        });
    }

    template <typename Where>
    void skin(const Skin& skin, const Where& where)
    {
        faults_.expect(!skin.joints.empty() && skin.joints.size() == skin.joint_from_bind.size(), [&] {
            return fmt::format("{}: needs joints, and a joint_from_bind for each; there are {} and {}",
                               where(), skin.joints.size(), skin.joint_from_bind.size());
        });
        for (const Index joint : skin.joints)
            required(joint, scene_.nodes.size(), "a joint", "nodes", where);
    }

    template <typename Where>
    void channel(const AnimationChannel& channel, const Where& where)
    {
        required(channel.node, scene_.nodes.size(), "node", "nodes", where);
        const size_t parts = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
        const size_t keys = parts * channel.times_s.size();
        const size_t floats = channel.values.size();
        const size_t width = keys == 0 ? 0 : floats / keys;
        const size_t wanted = channel.path == AnimatedPath::rotation ? 4 : 3;
        const bool fits = (keys == 0) == (floats == 0) && width * keys == floats &&
                          (channel.path == AnimatedPath::weights || width == 0 || width == wanted);
        faults_.expect(fits, [&] {
            return fmt::format("{}: its {} values do not fit its {} times", where(), floats,
                               channel.times_s.size());
        });
        faults_.expect(std::ranges::is_sorted(channel.times_s),
                       [&] { return fmt::format("{}: times_s is not in ascending order", where()); });
    }

    const Scene& scene_;
    FaultList faults_;
};

/// Returns whether all numbers are finite. A difference of equal finite numbers is zero, and other
/// differences are not a number; the loop has no branch, so that the compiler uses vector instructions.
bool are_finite(std::span<const float> numbers)
{
    float sum = 0.0F;
    for (const float number : numbers)
        sum += number - number;
    return sum == 0.0F;
}

/// Returns the numbers of an array of vectors.
template <typename Vector>
std::span<const float> numbers_of(const std::vector<Vector>& vectors)
{
    static_assert(sizeof(Vector) == sizeof(float) * static_cast<size_t>(Vector::length()));
    return {vectors.empty() ? nullptr : glm::value_ptr(vectors.front()),
            vectors.size() * static_cast<size_t>(Vector::length())};
}

template <glm::length_t size, typename Number>
bool are_finite(const glm::vec<size, Number>& vector)
{
    return vector - vector == glm::vec<size, Number>(0);
}

bool are_finite(const glm::dmat4& matrix)
{
    return are_finite(matrix[0]) && are_finite(matrix[1]) && are_finite(matrix[2]) && are_finite(matrix[3]);
}

/// Returns whether a number is finite and at least zero.
bool is_amount(double number)
{
    return number >= 0.0 && std::isfinite(number);
}

/// Finds numbers that cannot be drawn with.
class ValueCheck {
public:
    explicit ValueCheck(const Scene& scene) : scene_(scene) {}

    std::vector<std::string> run()
    {
        visit_items(scene_, *this);
        for (size_t i = 0; i < scene_.skins.size(); ++i)
            expect(
                std::ranges::all_of(scene_.skins[i].joint_from_bind,
                                    [](const glm::mat4& matrix) { return are_finite(glm::dmat4(matrix)); }),
                [&] { return item("skins", i, scene_.skins[i].name); }, "joint_from_bind is not finite");
        for (size_t i = 0; i < scene_.lights.size(); ++i)
            light(scene_.lights[i], [&] { return item("lights", i, scene_.lights[i].name); });
        for (size_t i = 0; i < scene_.cameras.size(); ++i)
            camera(scene_.cameras[i], [&] { return item("cameras", i, scene_.cameras[i].name); });
        for (size_t i = 0; i < scene_.animations.size(); ++i) {
            const Animation& animation = scene_.animations[i];
            const auto where = [&] { return item("animations", i, animation.name); };
            expect(std::isfinite(animation.duration_s), where, "its duration is not finite");
            for (const AnimationChannel& channel : animation.channels)
                expect(are_finite(std::span(channel.times_s)) && are_finite(std::span(channel.values)), where,
                       "a channel has times or values that are not finite");
        }
        rooms();
        return faults_.take();
    }

private:
    template <typename Check>
    friend void visit_items(const Scene& scene, Check& check);

    template <typename Where>
    void expect(bool holds, const Where& where, const char* what)
    {
        faults_.expect(holds, [&] { return fmt::format("{}: {}", where(), what); });
    }

    template <typename Where>
    void material(const Material& material, const Where& where)
    {
        expect(are_finite(material.base_color) && are_finite(material.emissive), where,
               "its colours are not finite");
        expect(are_finite(std::array{material.normal_scale, material.occlusion_strength, material.metallic,
                                     material.roughness, material.alpha_cutoff}),
               where, "one of its factors is not finite");
        for (const TextureRef* const reference : {&material.base_color_texture, &material.normal_texture,
                                                  &material.occlusion_texture, &material.emissive_texture})
            expect(are_finite(std::span(glm::value_ptr(reference->uv_transform), 9)), where,
                   "the uv_transform of a texture is not finite");
    }

    template <typename Where>
    void primitive(const Primitive& primitive, const Where& where)
    {
        expect(are_finite(numbers_of(primitive.positions)), where, "positions are not finite");
        expect(are_finite(numbers_of(primitive.normals)), where, "normals are not finite");
        expect(are_finite(numbers_of(primitive.tangents)), where, "tangents are not finite");
        for (const std::vector<glm::vec2>& uvs : primitive.uvs)
            expect(are_finite(numbers_of(uvs)), where, "uvs are not finite");
        expect(are_finite(numbers_of(primitive.colors)), where, "colors are not finite");
        expect(are_finite(numbers_of(primitive.weights_0)) && are_finite(numbers_of(primitive.weights_1)),
               where, "weights are not finite");
        expect(are_finite(std::span(primitive.held)), where, "held is not finite");
        for (const MorphTarget& target : primitive.morph_targets)
            expect(are_finite(numbers_of(target.position_offsets)) &&
                       are_finite(numbers_of(target.normal_offsets)),
                   where, "a morph target is not finite");
    }

    template <typename Where>
    void node(const Node& node, const Where& where)
    {
        const glm::dmat4 placement = node.matrix.value_or(node.transform.matrix());
        expect(are_finite(placement), where, "its place, turn or size is not finite");
        const glm::dvec4 last_row(placement[0][3], placement[1][3], placement[2][3], placement[3][3]);
        expect(last_row == glm::dvec4(0.0, 0.0, 0.0, 1.0), where,
               "the last row of its matrix is not 0 0 0 1");
        for (const glm::mat4& instance : node.instances)
            expect(are_finite(glm::dmat4(instance)), where, "the matrix of an instance is not finite");
        expect(are_finite(std::span(node.morph_weights)), where, "morph_weights are not finite");
    }

    template <typename Where>
    void light(const Light& light, const Where& where)
    {
        expect(is_amount(light.intensity) && is_amount(light.color.x) && is_amount(light.color.y) &&
                   is_amount(light.color.z),
               where, "its colour or intensity is negative or not finite");
        expect(is_amount(light.range_m) && is_amount(light.radius_m.value_or(0.0F)), where,
               "its range or radius is negative or not finite");
        expect(light.type != LightType::spot ||
                   (is_amount(light.inner_cone_rad) && light.inner_cone_rad <= light.outer_cone_rad &&
                    light.outer_cone_rad <= std::numbers::pi),
               where, "its cone is not 0 <= inner_cone_rad <= outer_cone_rad <= pi");
    }

    template <typename Where>
    void camera(const SceneCamera& camera, const Where& where)
    {
        const bool has_lens = camera.orthographic
                                  ? camera.half_height_m > 0.0 && std::isfinite(camera.half_height_m)
                                  : camera.vertical_fov_rad > 0.0 &&
                                        camera.vertical_fov_rad < std::numbers::pi && camera.near_m > 0.0 &&
                                        std::isfinite(camera.near_m);
        expect(has_lens, where, "its angle of view, height or near plane is out of range");
    }

    void rooms()
    {
        for (size_t i = 0; i < scene_.cells.size(); ++i) {
            const SceneCell& cell = scene_.cells[i];
            expect(
                are_finite(cell.low_m) && are_finite(cell.high_m),
                [&] { return item("cells", i, cell.name); }, "its corners are not finite");
        }
        constexpr size_t least = 3;
        constexpr size_t most = 12;
        for (size_t i = 0; i < scene_.portals.size(); ++i) {
            const std::vector<glm::dvec3>& corners = scene_.portals[i].corners_m;
            const bool is_polygon =
                corners.size() >= least && corners.size() <= most &&
                std::ranges::all_of(corners, [](const glm::dvec3& corner) { return are_finite(corner); });
            expect(
                is_polygon, [&] { return item("portals", i, {}); }, "needs 3 to 12 finite corners");
        }
    }

    const Scene& scene_;
    FaultList faults_;
};

} // namespace

std::vector<std::string> structural_faults(const Scene& scene)
{
    return StructureCheck(scene).run();
}

std::vector<std::string> faults(const Scene& scene)
{
    std::vector<std::string> all = structural_faults(scene);
    const std::vector<std::string> of_values = ValueCheck(scene).run();
    all.insert(all.end(), of_values.begin(), of_values.end());
    return all;
}

void check_faults(const Scene& scene, const std::string& where)
{
    const std::vector<std::string> all = faults(scene);
    if (all.empty())
        return;
    throw Error(all.size() == 1 ? all.front() : fmt::format("{} (and {} more)", all.front(), all.size() - 1),
                where, "correct the scene; faults() lists all that is wrong");
}

} // namespace estampe
