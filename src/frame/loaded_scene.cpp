// SPDX-License-Identifier: MIT
#include "frame/loaded_scene.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <utility>

#include <estampe/error.hpp>

#include "core/long_jobs.hpp"
#include "features/cloth/moving_cloth.hpp"
#include "features/common/view.hpp"
#include "features/ink/ink_zones.hpp"
#include "features/terrain/ground_mesh.hpp"
#include "scene/scene_limits.hpp"
#include "scene/visibility.hpp"
#include "techniques/cells/cells.hpp"

namespace estampe::frame {
namespace {

/// Copies those parts of the scene that are needed to compute poses. Geometry and images are left out,
/// because they are already on the device.
Scene without_images(const Scene& scene)
{
    // The structured binding lists all members of Scene, so that the compiler reports a new member that is
    // missing here. Images are not copied, because they may take most of the memory.
    const auto& [name, textures, materials, meshes, nodes, roots, skins, lights, cameras, animations,
                 frames_per_s, variants, terrain, used, ignored, files, missing, unit, warnings, cells,
                 portals] = scene;
    Scene copy{name,    {},      materials,  meshes,       nodes,    roots,   skins,
               lights,  cameras, animations, frames_per_s, variants, terrain, used,
               ignored, files,   missing,    unit,         warnings, cells,   portals};
    for (const Texture& texture : textures) {
        copy.textures.push_back(
            {.name = texture.name, .image = {}, .wrap_u = texture.wrap_u, .wrap_v = texture.wrap_v});
    }
    return copy;
}

/// Returns the primitive with its triangles facing the other way.
Primitive turned_over(const Primitive& primitive, Index material)
{
    Primitive back = primitive;
    back.material = material;
    for (size_t i = 0; i + 2 < back.indices.size(); i += 3) {
        std::swap(back.indices[i + 1], back.indices[i + 2]);
    }
    for (glm::vec3& normal : back.normals) {
        normal = -normal;
    }
    back.edge_marks.clear();
    return back;
}

/// Adds a single-sided copy of a material to the scene.
Index add_one_sided(Scene& scene, Index material)
{
    Material copy = scene.materials.at(material);
    copy.double_sided = false;
    scene.materials.push_back(std::move(copy));
    return static_cast<Index>(scene.materials.size() - 1);
}

/// Adds triangles that face backwards to each primitive of a cloth node, if the back of the cloth has another
/// material than the front.
void part_sides(Scene& scene, Node& node)
{
    Mesh parted = scene.meshes[node.mesh];
    parted.primitives.clear();
    for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
        parted.primitives.push_back(primitive);
        const Cloth* const found = cloth_of(scene, node, primitive);
        if (found == nullptr || found->back_material >= scene.materials.size()) {
            continue;
        }
        Cloth cloth = *found;
        const Index front = add_one_sided(scene, primitive.material);
        const Index back = add_one_sided(scene, cloth.back_material);
        cloth.back_material = back;
        scene.materials[front].cloth = cloth;
        scene.materials[back].cloth = cloth;
        parted.primitives.back().material = front;
        parted.primitives.push_back(turned_over(primitive, back));
    }
    if (parted.primitives.size() > scene.meshes[node.mesh].primitives.size()) {
        node.mesh = static_cast<Index>(scene.meshes.size());
        node.cloth.reset(); // the two materials now describe the cloth, each for one side
        scene.meshes.push_back(std::move(parted));
    }
}

/// Gives each cloth sheet with a separate back material triangles for its front and its back.
Scene with_both_sides(const Scene& scene)
{
    Scene result = scene;
    for (Node& node : result.nodes) {
        if (node.mesh >= result.meshes.size()) {
            continue;
        }
        const Index whole = node.mesh;
        part_sides(result, node);
        if (node.mesh != whole) {
            continue;
        }
        for (const Primitive& primitive : result.meshes[node.mesh].primitives) {
            if (cloth_of(result, node, primitive) != nullptr) {
                result.materials.at(primitive.material).double_sided = true;
            }
        }
    }
    return result;
}

pose::MeshData layout_of(const Scene& scene)
{
    const auto ground_material = static_cast<Index>(scene.materials.size());
    if (!scene.terrain) {
        return pose::build_meshes(scene, ground_material);
    }
    const pose::ForeignMesh ground = features::ground_mesh(scene);
    return pose::build_meshes(scene, ground_material, &ground);
}

/// Uploads a layout (vertices, triangles and draw calls) of the loaded scene, and discards everything that
/// was derived from the previous layout.
void take_layout(gpu::Device& device, LoadedScene& loaded, pose::MeshData layout)
{
    loaded.layout = std::move(layout);
    ++loaded.layout_number;
    if (loaded.scene.terrain) {
        const terrain::TerrainTarget target{.first_vertex = *loaded.layout.foreign_vertex,
                                            .stroke_unit_m = loaded.layout.stroke_unit_m};
        if (loaded.terrain) {
            loaded.terrain->set_mesh(device, target, features::raised_object(loaded.scene));
        } else {
            loaded.terrain = std::make_unique<terrain::TerrainBuffers>(device, *loaded.scene.terrain, target,
                                                                       features::raised_object(loaded.scene));
            loaded.footprints = std::make_unique<terrain::Footprints>(loaded.scene.terrain->description());
        }
    }
    loaded.meshes = pose::upload_meshes(device, loaded.layout);
    loaded.cluster_boxes.forget();
    loaded.baked = features::upload_baked(device, loaded.lightmap ? &*loaded.lightmap : nullptr, loaded.scene,
                                          loaded.layout);
    loaded.has_plain_links = pose::has_plain_links(loaded.layout);
    loaded.still_casters = features::still_casters(loaded.layout, loaded.scene);
    loaded.still_room = {};
    for (const features::StillCaster& caster : loaded.still_casters) {
        loaded.still_room.extend(caster.place.min);
        loaded.still_room.extend(caster.place.max);
    }
    loaded.surface_maps.clear();
    loaded.pose.reset();
    loaded.pose_moved = true;
}

} // namespace

LoadedScene load_onto_device(gpu::Device& device, const Scene& given, const Lightmap* lightmap)
{
    check_drawn_size(given);
    cells::check_cells(given);
    const bool has_cloth = features::MovingCloth::is_in(given);
    const Scene two_sided = has_cloth ? with_both_sides(given) : Scene{};
    const Scene& whole = has_cloth ? two_sided : given;
    // The terrain's material is added to the scene as the last material.
    const Scene grounded = whole.terrain ? features::with_terrain_node(whole) : Scene{};
    const Scene& scene = whole.terrain ? grounded : whole;
    LoadedScene loaded;
    if (lightmap != nullptr) {
        loaded.lightmap = *lightmap;
    }
    loaded.scene = without_images(scene);
    loaded.given_nodes = given.nodes.size();
    loaded.given_materials = given.materials.size();
    hide_invisible(loaded.scene);
    if (given.cells.empty()) {
        cells::NamedCells named = cells::named_cells(given);
        loaded.scene.cells = std::move(named.cells);
        loaded.scene.portals = std::move(named.portals);
        loaded.notes_of_cells = std::move(named.notes);
    }
    std::future<pose::MeshData> layout =
        std::async(launch_if_possible, [&] { return layout_of(loaded.scene); });
    const surface::TexturePlan textures = surface::plan_textures(scene, device.limits().maxImageArrayLayers);
    loaded.materials = surface::upload_materials(device, scene, textures);
    loaded.needs = surface::scene_needs(scene, textures);
    loaded.notes = surface::notes_of(textures);
    loaded.own_lighting = features::lighting_of(scene);
    loaded.styled_lighting = loaded.own_lighting;
    take_layout(device, loaded, layout.get());
    return loaded;
}

ScenePose pose_at(LoadedScene& loaded, double time_s, Index animation)
{
    loaded.placed.put(loaded.scene, time_s);
    return pose_scene(loaded.scene, time_s, animation);
}

void place_nodes(gpu::Device& device, LoadedScene& loaded, std::span<const NodePlace> places, double time_s)
{
    features::check_places(places, loaded.scene.nodes.size(), time_s);
    if (features::take_over(loaded.scene, places)) {
        lay_out(device, loaded);
    }
    loaded.placed.place(places, time_s);
}

namespace {

/// Takes the meshes of ink zones out of a scene as long as the object lives. The scene keeps them otherwise,
/// because flowing ink needs their shapes.
class HiddenMeshes {
public:
    HiddenMeshes(Scene& scene, const std::vector<bool>& are_hidden) : scene_(scene)
    {
        for (Index node = 0; node < are_hidden.size(); ++node) {
            if (are_hidden[node]) {
                meshes_.emplace_back(node, std::exchange(scene.nodes[node].mesh, no_index));
            }
        }
    }

    ~HiddenMeshes()
    {
        for (const auto& [node, mesh] : meshes_) {
            scene_.nodes[node].mesh = mesh;
        }
    }

    HiddenMeshes(const HiddenMeshes&) = delete;
    HiddenMeshes& operator=(const HiddenMeshes&) = delete;

private:
    Scene& scene_;
    std::vector<std::pair<Index, Index>> meshes_; ///< Node, and its mesh
};

/// The layout of the scene without the meshes of ink zones.
pose::MeshData layout_without_zones(LoadedScene& loaded)
{
    const HiddenMeshes hidden(loaded.scene, loaded.ink_zones);
    return layout_of(loaded.scene);
}

} // namespace

void lay_out(gpu::Device& device, LoadedScene& loaded)
{
    take_layout(device, loaded, layout_without_zones(loaded));
}

bool hide_ink_zones(gpu::Device& device, LoadedScene& loaded, const features::StyleTables& style)
{
    std::vector<bool> wanted = features::ink_zone_nodes(loaded.scene, style);
    for (size_t node = 0; node < wanted.size(); ++node) {
        wanted[node] = wanted[node] && loaded.scene.nodes[node].mesh != no_index;
    }
    if (std::ranges::find(wanted, true) == wanted.end()) {
        wanted.clear();
    }
    if (wanted == loaded.ink_zones) {
        return false;
    }
    const auto is_drawn = [&](const Node& node) {
        const auto index = static_cast<size_t>(&node - loaded.scene.nodes.data());
        return node.mesh != no_index && !wanted[index];
    };
    if (!wanted.empty() && !loaded.scene.terrain && std::ranges::none_of(loaded.scene.nodes, is_drawn)) {
        throw Error("nothing is left to draw: the style makes all meshes ink zones", "[object] ink.zone",
                    "name only the objects that shall drive the ink");
    }
    loaded.ink_zones = std::move(wanted);
    lay_out(device, loaded);
    return true;
}

bool swap_terrain(gpu::Device& device, LoadedScene& loaded, const Terrain& terrain)
{
    const Terrain before = *loaded.scene.terrain;
    const Bounds bounds_before = loaded.layout.bounds;
    const features::TerrainChange change = features::change_of(loaded.layout, before, terrain);
    const auto take = [&](const Terrain& taken, const Bounds& bounds) {
        loaded.scene.terrain = taken;
        loaded.terrain->set_graph(device, taken);
        loaded.footprints->set(taken.description());
        if (change.is_cut_otherwise) {
            lay_out(device, loaded);
        }
        loaded.layout.bounds = bounds;
        glm::vec4& color = loaded.scene.materials.back().base_color;
        const glm::vec4 wanted(taken.description().look.color, 1.0F);
        if (color != wanted) {
            const auto material = static_cast<Index>(loaded.scene.materials.size() - 1);
            surface::recolor(device, loaded.materials, material, taken.description().look.color);
            color = wanted;
        }
    };
    try {
        take(terrain, change.bounds);
    } catch (const Error&) {
        take(before, bounds_before);
        throw;
    }
    return change.is_cut_otherwise;
}

bool style_lighting(gpu::Device& device, LoadedScene& loaded, const features::StyleTables& style)
{
    if (loaded.styled_by && loaded.styled_by->are_of(style)) {
        return false;
    }
    features::LightingOfScene wanted = features::styled_lighting(loaded.own_lighting, loaded.scene, style);
    loaded.styled_by.emplace(style);
    if (wanted == loaded.styled_lighting) {
        return false;
    }
    const bool stands_otherwise = !features::same_links(wanted, loaded.styled_lighting);
    const bool is_brightness_alone = features::same_but_for_brightness(wanted, loaded.styled_lighting);
    features::set_lighting(loaded.scene, wanted);
    loaded.styled_lighting = std::move(wanted);
    if (stands_otherwise) {
        lay_out(device, loaded);
    }
    return !is_brightness_alone;
}

float nearby_m(const pose::MeshData& layout, const glm::dvec3& eye)
{
    constexpr float near_ground_m = 20.0F;
    const auto unit_m = static_cast<float>(layout.stroke_unit_m);
    const glm::vec3 eye_rest(eye - layout.rest_anchor);
    const std::span places(layout.stroke_coordinates);
    if (!layout.foreign_vertex) {
        return unit_m * features::nearby(places, eye_rest / unit_m);
    }
    const float objects_m =
        unit_m * features::nearby(places.first(*layout.foreign_vertex), eye_rest / unit_m);
    return objects_m > 0.0F ? std::min(objects_m, near_ground_m) : near_ground_m;
}

} // namespace estampe::frame
