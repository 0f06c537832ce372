// SPDX-License-Identifier: MIT
// estampe.Scene: scenes from files, and scenes built of arrays.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/error.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {

SharedScene& scene_argument(const py::object& value)
{
    if (!py::isinstance<SharedScene>(value)) {
        throw py::type_error("scene: is not a Scene");
    }
    return value.cast<SharedScene&>();
}

AnimationChoice animation_choice_of(const py::object& value)
{
    if (py::isinstance<py::str>(value)) {
        return value.cast<std::string>();
    }
    if (!PyIndex_Check(value.ptr()) || PyBool_Check(value.ptr())) {
        throw py::type_error("animation: is not a name or a number");
    }
    return integer_of(value, "animation");
}

Index find_animation(const AnimationChoice& choice, const Scene& scene)
{
    if (const auto* const chosen = std::get_if<std::string>(&choice)) {
        const std::string& name = *chosen;
        std::string known;
        for (size_t i = 0; i < scene.animations.size(); ++i) {
            if (scene.animations[i].name == name) {
                return static_cast<Index>(i);
            }
            known += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", scene.animations[i].name);
        }
        throw py::value_error(fmt::format("animation: there is no \"{}\"; the scene has {}", name,
                                          known.empty() ? "no animations" : known));
    }
    // A scene without animations shows its rest pose, whatever the number is.
    const size_t count = std::max<size_t>(scene.animations.size(), 1);
    return optional_index(std::get<py::ssize_t>(choice), "animation", count);
}

namespace {

std::optional<UpAxis> up_axis_of(const std::optional<std::string>& text)
{
    if (!text) {
        return std::nullopt;
    }
    return choice_of<UpAxis>(*text, "up",
                             {{"x", UpAxis::x},
                              {"y", UpAxis::y},
                              {"z", UpAxis::z},
                              {"-x", UpAxis::minus_x},
                              {"-y", UpAxis::minus_y},
                              {"-z", UpAxis::minus_z}});
}

SharedScene load(const py::object& path, const std::string& variant, const std::optional<std::string>& up,
                 bool confine, const std::optional<double>& max_memory,
                 const std::optional<double>& max_seconds)
{
    const std::filesystem::path file = path_of(path, "path");
    LoadOptions options{
        .variant = variant, .up = up_axis_of(up), .limits = limits_of(max_memory, max_seconds)};
    if (confine) {
        options.scope = ReadScope::beside(file);
    }
    const Unlocked unlocked;
    const LimitedWork limited(options.limits); // for the scene and its lightmaps together
    LitScene lit{.scene = load_scene(file, options)};
    lit.lightmap = named_lightmap(file, options.scope);
    return SharedScene(std::move(lit));
}

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& things)
{
    std::vector<std::string> names;
    names.reserve(things.size());
    for (const Named& thing : things) {
        names.push_back(thing.name);
    }
    return names;
}

Wrap wrap_of(const std::string& name)
{
    return choice_of<Wrap>(name, "wrap",
                           {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}});
}

size_t add_image(SharedScene& self, const py::object& pixels, const std::string& name,
                 const std::string& wrap)
{
    const Wrap wraps = wrap_of(wrap);
    Texture texture{.name = name, .image = image_of(pixels, "pixels"), .wrap_u = wraps, .wrap_v = wraps};
    Scene& scene = self.edit().scene;
    scene.textures.push_back(std::move(texture));
    return scene.textures.size() - 1;
}

AlphaMode alpha_mode_of(const std::string& name)
{
    return choice_of<AlphaMode>(
        name, "alpha_mode",
        {{"opaque", AlphaMode::opaque}, {"mask", AlphaMode::mask}, {"blend", AlphaMode::blend}});
}

glm::vec4 base_color_of(const py::object& value)
{
    constexpr double most = 1.0;
    const py::array array = numbers_of(value, "base_color", "fiu");
    const py::ssize_t length = array.ndim() == 1 && array.shape(0) == 3 ? 3 : 4;
    const Dense<double> numbers = finite_doubles(array, "base_color", {length});
    glm::vec4 color(1.0F);
    for (py::ssize_t i = 0; i < length; ++i) {
        color[static_cast<int>(i)] =
            static_cast<float>(number_within(numbers.at(i), "base_color", 0.0, most));
    }
    return color;
}

/// Reads a colour of light: three numbers of at least 0.
glm::vec3 light_color_of(const py::object& value, const char* argument)
{
    constexpr double most = 1e6;
    const glm::dvec3 color = three_numbers(value, argument);
    for (int i = 0; i < 3; ++i) {
        number_within(color[i], argument, 0.0, most);
    }
    return glm::vec3(color);
}

size_t add_material(SharedScene& self, const std::string& name, const py::object& base_color,
                    const py::object& base_color_image, double metallic, double roughness,
                    const py::object& emissive, const py::object& emissive_image,
                    const py::object& normal_image, const std::string& alpha_mode, double alpha_cutoff,
                    bool double_sided, bool unlit)
{
    const size_t image_count = self.scene().textures.size();
    Material material{.name = name, .base_color = base_color_of(base_color)};
    material.base_color_texture.texture = index_of(base_color_image, "base_color_image", image_count);
    material.emissive_texture.texture = index_of(emissive_image, "emissive_image", image_count);
    material.normal_texture.texture = index_of(normal_image, "normal_image", image_count);
    material.metallic = static_cast<float>(number_within(metallic, "metallic", 0.0, 1.0));
    material.roughness = static_cast<float>(number_within(roughness, "roughness", 0.0, 1.0));
    material.emissive = light_color_of(emissive, "emissive");
    material.alpha_mode = alpha_mode_of(alpha_mode);
    material.alpha_cutoff = static_cast<float>(number_within(alpha_cutoff, "alpha_cutoff", 0.0, 1.0));
    material.double_sided = double_sided;
    material.unlit = unlit;
    LitScene& lit = self.edit();
    lit.scene.materials.push_back(std::move(material));
    if (lit.lightmap && !lit.lightmap->of_material.empty()) {
        lit.lightmap->of_material.resize(lit.scene.materials.size());
    }
    return lit.scene.materials.size() - 1;
}

size_t add_mesh(SharedScene& self, const std::string& name, const py::object& parts)
{
    Mesh mesh{.name = name};
    const auto add = [&](const py::handle& item) {
        if (!py::isinstance<Part>(item)) {
            throw py::type_error("parts: is not a Part, or a sequence of Parts");
        }
        const Primitive& primitive = item.cast<const Part&>().primitive;
        const Scene& scene = self.scene();
        if (scene.materials.empty() && primitive.material == 0) {
            mesh.primitives.push_back(primitive);
            return;
        }
        optional_index(primitive.material, "material", scene.materials.size());
        if (scene.materials[primitive.material].normal_texture.texture != no_index &&
            primitive.tangents.empty() && primitive.topology == Topology::triangles) {
            throw py::value_error("tangents: a part needs tangents, because its material has a normal map");
        }
        mesh.primitives.push_back(primitive);
    };
    if (py::isinstance<Part>(parts)) {
        add(parts);
    } else {
        if (!py::isinstance<py::sequence>(parts) || py::isinstance<py::str>(parts)) {
            throw py::type_error("parts: is not a Part, or a sequence of Parts");
        }
        for (const py::handle& part : parts) {
            add(part);
        }
    }
    if (mesh.primitives.empty()) {
        throw py::value_error("parts: the mesh has no part");
    }
    if (self.scene().materials.empty()) {
        static_cast<void>(self.edit().scene.materials.emplace_back(Material{.name = "default"}));
    }
    Scene& scene = self.edit().scene;
    scene.meshes.push_back(std::move(mesh));
    return scene.meshes.size() - 1;
}

LightType light_type_of(const std::string& name)
{
    return choice_of<LightType>(name, "type",
                                {{"directional", LightType::directional},
                                 {"point", LightType::point},
                                 {"spot", LightType::spot},
                                 {"ambient", LightType::ambient}});
}

size_t add_light(SharedScene& self, const std::string& type, const std::string& name, const py::object& color,
                 double intensity, double range_m, double inner_cone_deg, double outer_cone_deg,
                 const std::optional<double>& radius_m, bool casts_shadows)
{
    constexpr double most_m = 1e9;
    Light light{.name = name, .type = light_type_of(type), .color = light_color_of(color, "color")};
    light.intensity = static_cast<float>(number_within(intensity, "intensity", 0.0, 1e12));
    light.range_m = static_cast<float>(number_within(range_m, "range_m", 0.0, most_m));
    number_within(outer_cone_deg, "outer_cone_deg", 0.1, 90.0);
    number_within(inner_cone_deg, "inner_cone_deg", 0.0, outer_cone_deg);
    light.inner_cone_rad = static_cast<float>(glm::radians(inner_cone_deg));
    light.outer_cone_rad = static_cast<float>(glm::radians(outer_cone_deg));
    if (radius_m) {
        light.radius_m = static_cast<float>(number_within(*radius_m, "radius_m", 0.0, most_m));
    }
    light.casters = casts_shadows ? all_groups : Groups{0};
    Scene& scene = self.edit().scene;
    scene.lights.push_back(std::move(light));
    return scene.lights.size() - 1;
}

size_t add_camera(SharedScene& self, const std::string& name, double fov_deg,
                  const std::optional<double>& half_height_m, double near_m)
{
    constexpr double most_m = 1e9;
    SceneCamera camera{.name = name};
    camera.vertical_fov_rad = glm::radians(number_within(fov_deg, "fov_deg", 1.0, 170.0));
    camera.near_m = number_within(near_m, "near_m", 1e-9, most_m);
    if (half_height_m) {
        camera.orthographic = true;
        camera.half_height_m = number_within(*half_height_m, "half_height_m", 1e-9, most_m);
    }
    Scene& scene = self.edit().scene;
    scene.cameras.push_back(std::move(camera));
    return scene.cameras.size() - 1;
}

std::vector<glm::mat4> instances_of(const py::object& value)
{
    std::vector<glm::mat4> placed;
    const Dense<double> array = finite_doubles(value, "instances", {any_length, 4, 4});
    for (py::ssize_t i = 0; i < array.shape(0); ++i) {
        placed.emplace_back(placement_of(array[py::make_tuple(i)], "instances"));
    }
    return placed;
}

size_t add_node(SharedScene& self, const std::string& name, const py::object& matrix, const py::object& mesh,
                const py::object& light, const py::object& camera, const py::object& parent, bool visible,
                const py::object& instances)
{
    const Scene& known = self.scene();
    Node node{.name = name, .visible = visible};
    node.mesh = index_of(mesh, "mesh", known.meshes.size());
    node.light = index_of(light, "light", known.lights.size());
    node.camera = index_of(camera, "camera", known.cameras.size());
    // A parent comes before its children, so there are no cycles.
    node.parent = index_of(parent, "parent", known.nodes.size());
    if (!matrix.is_none()) {
        node.matrix = placement_of(matrix, "matrix");
    }
    if (!instances.is_none()) {
        node.instances = instances_of(instances);
    }
    LitScene& lit = self.edit();
    const auto index = static_cast<Index>(lit.scene.nodes.size());
    if (node.parent == no_index) {
        lit.scene.roots.push_back(index);
    } else {
        lit.scene.nodes[node.parent].children.push_back(index);
    }
    lit.scene.nodes.push_back(std::move(node));
    if (lit.lightmap && !lit.lightmap->of_node.empty()) {
        lit.lightmap->of_node.resize(lit.scene.nodes.size());
    }
    return index;
}

void set_matrix(SharedScene& self, const py::object& node, const py::object& matrix)
{
    const Index index = optional_index(integer_of(node, "node"), "node", self.scene().nodes.size());
    const glm::dmat4 parent_from_node = placement_of(matrix, "matrix");
    self.edit().scene.nodes[index].matrix = parent_from_node;
}

py::object bounds_of(const SharedScene& self, double time_s, const py::object& animation)
{
    number_within(time_s, "time_s", -1e9, 1e9);
    const std::shared_ptr<const LitScene> lit = self.snapshot();
    const Index index = find_animation(animation_choice_of(animation), lit->scene);
    Bounds bounds;
    {
        const Unlocked unlocked;
        bounds = scene_bounds(lit->scene, pose_scene(lit->scene, time_s, index));
    }
    if (bounds.empty()) {
        return py::none();
    }
    py::array_t<double> corners({2, 3});
    for (int axis = 0; axis < 3; ++axis) {
        corners.mutable_at(0, axis) = bounds.min[axis];
        corners.mutable_at(1, axis) = bounds.max[axis];
    }
    return corners;
}

void bind_building(py::class_<SharedScene>& scene)
{
    scene
        .def("add_image", &add_image, py::arg("pixels"), py::kw_only(), py::arg("name") = "",
             py::arg("wrap") = "repeat",
             "Add an image for materials, and return its number.\n\n"
             "`pixels` is a (h, w, 3) or (h, w, 4) uint8 array: sRGB colours and straight alpha, rows from "
             "top\n"
             "to bottom. `wrap` is \"repeat\", \"clamp\" or \"mirror\". The pixels are copied.")
        .def("add_material", &add_material, py::arg("name") = "", py::kw_only(),
             py::arg("base_color") = py::make_tuple(1.0, 1.0, 1.0, 1.0),
             py::arg("base_color_image") = py::none(), py::arg("metallic") = 0.0, py::arg("roughness") = 1.0,
             py::arg("emissive") = py::make_tuple(0.0, 0.0, 0.0), py::arg("emissive_image") = py::none(),
             py::arg("normal_image") = py::none(), py::arg("alpha_mode") = "opaque",
             py::arg("alpha_cutoff") = 0.5, py::arg("double_sided") = false, py::arg("unlit") = false,
             "Add a material, and return its number.\n\n"
             "`base_color` is 3 or 4 linear numbers from 0 to 1, `emissive` 3 linear numbers; images are "
             "numbers\n"
             "that add_image() returned. `alpha_mode` is \"opaque\", \"mask\" (parts below `alpha_cutoff` "
             "are cut\n"
             "out) or \"blend\". An unlit material shows its base colour without light and shade.")
        .def(
            "add_mesh", &add_mesh, py::arg("name"), py::arg("parts"),
            "Add a mesh of one Part or of several, and return its number.\n\n"
            "Any number of nodes may show one mesh. Parts with the material 0 in a scene without materials "
            "get a "
            "white\n"
            "one, which is named \"default\". A material that does not exist raises IndexError. Cost: a copy "
            "of the\n"
            "parts.")
        .def(
            "add_light", &add_light, py::arg("type"), py::kw_only(), py::arg("name") = "",
            py::arg("color") = py::make_tuple(1.0, 1.0, 1.0), py::arg("intensity") = 1.0,
            py::arg("range_m") = 0.0, py::arg("inner_cone_deg") = 0.0, py::arg("outer_cone_deg") = 45.0,
            py::arg("radius_m") = py::none(), py::arg("casts_shadows") = true,
            "Add a light, and return its number.\n\n"
            "`type` is \"directional\", \"point\", \"spot\" or \"ambient\". A light shines along the -z axis "
            "of its\n"
            "node. `intensity` is in lux (directional, ambient) or candela (point, spot), `color` is "
            "linear.\n"
            "`range_m` of 0 is unlimited; the cone angles are half the opening of a spot. `radius_m` is the\n"
            "radius of the glowing sphere, which softens shadows; None: the style decides.")
        .def("add_camera", &add_camera, py::arg("name") = "", py::kw_only(), py::arg("fov_deg") = 45.0,
             py::arg("half_height_m") = py::none(), py::arg("near_m") = 0.01,
             "Add a camera, and return its number.\n\n"
             "A camera looks along the -z axis of its node, with y up. `fov_deg` is the vertical angle of "
             "view,\n"
             "1 to 170. With `half_height_m` the projection is parallel, and twice as many metres high.")
        .def("add_node", &add_node, py::arg("name") = "", py::arg("matrix") = py::none(), py::kw_only(),
             py::arg("mesh") = py::none(), py::arg("light") = py::none(), py::arg("camera") = py::none(),
             py::arg("parent") = py::none(), py::arg("visible") = true, py::arg("instances") = py::none(),
             "Add a node, which places a mesh, a light or a camera, and return its number.\n\n"
             "`matrix` is a (4, 4) array that transforms column vectors from the node's space to its "
             "parent's, in\n"
             "metres; None is the identity. `parent` is the number of a node. `instances` is a (k, 4, 4) "
             "array:\n"
             "the mesh is drawn k times, at these places in the node's space.")
        .def(
            "set_matrix", &set_matrix, py::arg("node"), py::arg("matrix"),
            "Move a node: give it another matrix, as in add_node(). A node with a matrix is not animated.\n\n"
            "Renderer.place() moves the nodes of the scene that is drawn, which is faster.");
}

} // namespace

void bind_scene(py::module_& module)
{
    py::class_<SharedScene> scene(
        module, "Scene",
        "A 3D scene: read from a file with Scene.load(), or built of arrays.\n\n"
        "Coordinates are right-handed, y up, in metres. Methods add_...() return the number of what they\n"
        "add. Renderer.set_scene() takes the scene as it is at that time; later changes need another call.");
    scene.def(py::init<>(), "Make an empty scene.")
        .def_static(
            "load", &load, py::arg("path"), py::arg("variant") = "", py::arg("up") = py::none(),
            py::arg("confine") = false, py::arg("max_memory") = py::none(),
            py::arg("max_seconds") = py::none(),
            "Read a .gltf, .glb, .vrm, .obj, .ply, .stl, .fbx or .dae file.\n\n"
            "`variant` is a material variant of the file, by name or number. `up` is the axis of the file\n"
            "that points up: x, y, z, -x, -y or -z; None: as the file says. With `confine` no file outside\n"
            "of the folder of `path` is read, for files of strangers. `max_memory` is in bytes. The file is\n"
            "read in a child process, without Python's global lock. Lightmaps that the file names are\n"
            "loaded, too. Raises Error if the file cannot be read or a limit is exceeded.")
        .def_property_readonly(
            "name", [](const SharedScene& self) { return self.scene().name; }, "Name of the scene.")
        .def_property_readonly(
            "warnings", [](const SharedScene& self) { return self.scene().warnings; },
            "Repairs that were made while the file was read, a list of one line of text each.")
        .def_property_readonly(
            "cameras", [](const SharedScene& self) { return names_of(self.scene().cameras); },
            "Names of the cameras, by their numbers.")
        .def_property_readonly(
            "animations", [](const SharedScene& self) { return names_of(self.scene().animations); },
            "Names of the animations, by their numbers.")
        .def_property_readonly(
            "animation_durations_s",
            [](const SharedScene& self) {
                std::vector<double> durations_s;
                for (const Animation& animation : self.scene().animations) {
                    durations_s.push_back(static_cast<double>(animation.duration_s));
                }
                return durations_s;
            },
            "Durations of the animations in seconds, by their numbers.")
        .def_property_readonly(
            "materials", [](const SharedScene& self) { return names_of(self.scene().materials); },
            "Names of the materials, by their numbers.")
        .def_property_readonly(
            "meshes", [](const SharedScene& self) { return names_of(self.scene().meshes); },
            "Names of the meshes, by their numbers.")
        .def_property_readonly(
            "lights", [](const SharedScene& self) { return names_of(self.scene().lights); },
            "Names of the lights, by their numbers.")
        .def_property_readonly(
            "nodes", [](const SharedScene& self) { return names_of(self.scene().nodes); },
            "Names of the nodes, by their numbers.")
        .def_property_readonly(
            "variants", [](const SharedScene& self) { return self.scene().variants; },
            "Names of the material variants.")
        .def(
            "faults",
            [](const SharedScene& self) {
                const std::shared_ptr<const LitScene> lit = self.snapshot();
                const Unlocked unlocked;
                return faults(lit->scene);
            },
            "Return what is wrong with the scene, a list of one line of text each; empty if it can be "
            "drawn.\n\n"
            "The texts name the place, such as: meshes[2] \"wheel\", primitives[0]. Cost: linear in "
            "vertices.")
        .def("bounds", &bounds_of, py::arg("time_s") = 0.0, py::arg("animation") = 0,
             "Return the box that holds all vertices: a (2, 3) float64 array, its least and its greatest "
             "corner.\n\n"
             "In metres of the world, at `time_s` of an animation (number or name). None without vertices.\n"
             "Cost: linear in vertices.")
        .def("__repr__", [](const SharedScene& self) {
            const Scene& s = self.scene();
            return fmt::format("<estampe.Scene of {} nodes, {} meshes, {} materials>", s.nodes.size(),
                               s.meshes.size(), s.materials.size());
        });
    bind_building(scene);
}

} // namespace estampe::python
