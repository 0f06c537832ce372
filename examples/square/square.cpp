// SPDX-License-Identifier: MIT
#include "square.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

namespace square {
namespace {

namespace shapes = estampe::shapes;
using estampe::Index;
using estampe::Scene;

/// Collects the scene's nodes: one mesh and one node per object.
class Stage {
public:
    void put(const std::string& name, const Kit& kit, const glm::vec3& place, double turn_degrees = 0.0)
    {
        scene_.meshes.push_back(kit.mesh(name));
        add_node(name, place, turn_about_y(turn_degrees)).mesh = static_cast<Index>(scene_.meshes.size() - 1);
    }

    /// Points the sun's node so that it shines from the right and from behind the scene.
    void light(double azimuth_degrees, double elevation_degrees)
    {
        scene_.lights.push_back({.name = "sun",
                                 .type = estampe::LightType::directional,
                                 .color = {1.0F, 0.96F, 0.88F},
                                 .intensity = 3.4F});
        // A node shines along -z: turn it from "straight ahead" to "from azimuth, downwards".
        const glm::dquat turn = turn_about_y(180.0 - azimuth_degrees);
        const glm::dquat tilt = glm::angleAxis(glm::radians(-elevation_degrees), glm::dvec3(1.0, 0.0, 0.0));
        add_node("sun", {0.0, 30.0, 0.0}, turn * tilt).light = 0;
    }

    void view(const glm::dvec3& eye, double yaw_degrees, double pitch_degrees, double fov_degrees)
    {
        scene_.cameras.push_back(
            {.name = "square", .vertical_fov_rad = glm::radians(fov_degrees), .near_m = 0.1});
        const glm::dquat pitch = glm::angleAxis(glm::radians(pitch_degrees), glm::dvec3(1.0, 0.0, 0.0));
        add_node("square", eye, turn_about_y(-yaw_degrees) * pitch).camera = 0;
    }

    [[nodiscard]] Scene take()
    {
        scene_.name = "square";
        scene_.materials = materials();
        scene_.extensions_used = {"KHR_lights_punctual"};
        return std::move(scene_);
    }

private:
    static glm::dquat turn_about_y(double degrees)
    {
        return glm::angleAxis(glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0));
    }

    estampe::Node& add_node(const std::string& name, const glm::dvec3& place, const glm::dquat& rotation)
    {
        scene_.roots.push_back(static_cast<Index>(scene_.nodes.size()));
        estampe::Node& node = scene_.nodes.emplace_back();
        node.name = name;
        node.transform.translation = place;
        node.transform.rotation = rotation;
        return node;
    }

    Scene scene_;
};

Kit ground()
{
    Kit kit;
    kit.add(Stuff::sand, shapes::plane(400.0F, 400.0F, 16));
    return kit;
}

Kit low_wall()
{
    Kit kit;
    kit.add(Stuff::brick, shapes::box({150.0F, 1.5F, 0.6F}));
    kit.add(Stuff::stone, shapes::box({150.0F, 0.2F, 0.9F}), at({0.0F, 1.5F, 0.0F}));
    return kit;
}

} // namespace

Scene build_square()
{
    Stage stage;
    stage.put("ground", ground(), {0.0F, 0.0F, -100.0F});
    const Arcade palace{.arches = 11};
    stage.put("arcade", build_arcade(palace), {-6.8F, 0.0F, -26.0F}, 90.0);
    const Arcade screen{.arches = 4,
                        .opening = 3.6F,
                        .pier = 1.6F,
                        .springing = 3.0F,
                        .height = 7.4F,
                        .thickness = 1.4F,
                        .depth = 0.0F,
                        .windows = false};
    stage.put("screen", build_arcade(screen), {14.0F, 0.0F, -33.5F}, -90.0);
    stage.put("tower", build_tower(), {1.5F, 0.0F, -100.0F}, -30.0);
    stage.put("low wall", low_wall(), {0.0F, 0.0F, -76.0F});
    stage.put("train", build_train(), {16.0F, 0.9F, -84.0F});
    stage.put("statue", build_statue(), {2.9F, 0.0F, -19.0F}, 28.0);
    stage.put("column", build_column(), {6.1F, 0.0F, -10.4F}, 14.0);
    stage.put("drum", build_drum(), {-1.6F, 0.0F, -11.5F}, 28.0);
    stage.put("person", build_person(false), {-0.2F, 0.0F, -41.0F}, 20.0);
    stage.put("person in red", build_person(true), {2.0F, 0.0F, -41.4F}, -30.0);
    stage.light(80.0, 17.0);
    stage.view({0.0, 3.8, 0.0}, 6.0, -2.5, 46.0);
    return stage.take();
}

Scene build_thing(const std::string& name)
{
    Stage stage;
    if (name == "statue") {
        stage.put(name, build_statue(), {});
    } else if (name == "engine") {
        stage.put(name, build_train(), {});
    } else if (name == "tower") {
        stage.put(name, build_tower(), {});
    } else {
        throw estampe::Error("no thing is named " + name + "; there are statue, engine and tower");
    }
    return stage.take();
}

} // namespace square
