// SPDX-License-Identifier: MIT
#pragma once

// A minimal second world, only for tests: a box on a floor.

#include <memory>
#include <utility>

#include "registry.hpp"

namespace worlds::test {

/// A cuboid whose lower face is centred at the node.
inline estampe::Mesh cuboid(const char* name, const glm::vec3& size_m)
{
    estampe::Primitive primitive{.material = 0};
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const glm::vec3 unit(static_cast<float>(corner & 1U) - 0.5F, static_cast<float>((corner >> 1U) & 1U),
                             static_cast<float>((corner >> 2U) & 1U) - 0.5F);
        primitive.positions.push_back(unit * size_m);
    }
    primitive.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                         2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return {.name = name, .primitives = {std::move(primitive)}};
}

class BoxWorld final : public World {
public:
    explicit BoxWorld(double width_m) : width_m_(width_m) {}

    [[nodiscard]] estampe::Scene scene() const override
    {
        estampe::Scene scene{.name = "box", .materials = {estampe::Material{}}};
        scene.meshes = {cuboid("floor", {6.0F, 0.1F, 6.0F}),
                        cuboid("box", {static_cast<float>(width_m_), 1.0F, 1.0F})};
        for (estampe::Index mesh = 0; mesh < 2; ++mesh) {
            estampe::Node node{.name = scene.meshes[mesh].name};
            node.mesh = mesh;
            node.transform.translation.y = mesh == 0 ? -0.1 : 0.0;
            scene.roots.push_back(mesh);
            scene.nodes.push_back(node);
        }
        return scene;
    }

    /// The box rises by a metre per second.
    void go_to(double time_s, const estampe::Camera& /*camera*/) override { time_s_ = time_s; }

    void show(estampe::Renderer& renderer) override
    {
        estampe::NodePlace place{.node = 1};
        place.transform.translation.y = time_s_;
        renderer.place({&place, 1}, time_s_);
    }

    [[nodiscard]] std::unique_ptr<CameraPath> film_camera(const estampe::Scene& /*scene*/) const override
    {
        struct Standing final : CameraPath {
            [[nodiscard]] estampe::Camera camera(double /*time_s*/) const override
            {
                return {.eye = {0.0, 1.5, 8.0}, .target = {0.0, 0.5, 0.0}};
            }
        };

        return std::make_unique<Standing>();
    }

private:
    double width_m_;
    double time_s_ = 0.0;
};

inline Description box_description()
{
    return {.name = "box",
            .summary = "A box on a floor",
            .options = {{.key = "width",
                         .meaning = "Width of the box in metres",
                         .allowed = NumberRange{0.5, 4.0},
                         .initial = "1"}},
            .film_s = 0.2,
            .make = [](const Values& values) {
                return std::make_unique<BoxWorld>(values.number("width").value());
            }};
}

/// Registers the world.
inline void know_box()
{
    if (registry().find("box") == nullptr) {
        registry().add(box_description());
    }
}

} // namespace worlds::test
