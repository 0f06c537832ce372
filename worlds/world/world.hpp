// SPDX-License-Identifier: MIT
#pragma once

// A world: a scene that code makes, and the animation of it. docs/how-to/own-world.md explains how to add
// one.

#include <cstdint>
#include <memory>
#include <optional>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

#include "walk/walker.hpp"

namespace worlds {

enum class Occasion : uint8_t { picture, film, walk };

/// The purpose for which a world is drawn.
struct Purpose {
    Occasion occasion = Occasion::picture;
    /// The user wants a quick result: work that only makes a film finer can be left out.
    bool is_draft = false;
};

/// The camera of a world's own film.
class CameraPath {
public:
    CameraPath() = default;
    virtual ~CameraPath() = default;
    CameraPath(const CameraPath&) = delete;
    CameraPath& operator=(const CameraPath&) = delete;

    /// Returns the camera at a time since the film's beginning; before the film, the camera at its first
    /// moment; after the film, the camera at its last moment.
    [[nodiscard]] virtual estampe::Camera camera(double time_s) const = 0;

    /// Returns the time at which the camera reaches the place where the world's ending begins, see
    /// World::end_at(); nothing if the camera does not reach that place.
    [[nodiscard]] virtual std::optional<double> end_s() const { return std::nullopt; }
};

/// A visitor who walks through a world.
class Visit {
public:
    Visit() = default;
    virtual ~Visit() = default;
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

    /// Lets the visitor walk for `seconds`; `time_s` is the scene's time.
    virtual void go(const walk::Intent& intent, double seconds, double time_s) = 0;

    [[nodiscard]] virtual walk::Walker& walker() = 0;

    /// Returns whether the visitor has reached the place where the world's ending begins, see
    /// World::end_at().
    [[nodiscard]] virtual bool has_arrived() const { return false; }
};

/// One world, made with one set of option values. A world in which nothing moves implements scene() alone.
///
/// The program calls scene() on one object and gives the result to a renderer. To draw the scene, the program
/// makes another object with the same values, calls begin() once, and then for each picture go_to(), show(),
/// press() and style(), in this order.
class World {
public:
    World() = default;
    virtual ~World() = default;
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Returns the whole scene of the world at time 0. The same option values give the same scene.
    [[nodiscard]] virtual estampe::Scene scene() const = 0;

    /// Prepares to animate `scene`, which scene() of a world with the same values made.
    virtual void begin(const estampe::Scene& /*scene*/, const Purpose& /*purpose*/) {}

    /// Simulates the world up to a time, as seen by `camera`. Times of a film or a walk follow each other;
    /// the program may also jump to any time.
    virtual void go_to(double /*time_s*/, const estampe::Camera& /*camera*/) {}

    /// Places the world's nodes and sets its lights on the renderer that has the scene, for the time that
    /// go_to() reached.
    virtual void show(estampe::Renderer& /*renderer*/) {}

    /// Deforms the renderer's terrain for the time that go_to() reached. The program leaves this call out
    /// once a user has edited the terrain.
    virtual void press(estampe::Renderer& /*renderer*/) {}

    /// Called when other code has changed the renderer's terrain since the last press(), so that the next
    /// press() sets the terrain again.
    virtual void forget_pressed() {}

    /// Returns the style `base` with the weather and the light of the time that go_to() reached. Values that
    /// the user sets override the result.
    [[nodiscard]] virtual estampe::Style style(const estampe::Style& base,
                                               const estampe::Camera& /*camera*/) const
    {
        return base;
    }

    /// Called when a visitor reaches the end of the world, at `time_s`. If the world has an ending, the
    /// ending starts at this time.
    virtual void end_at(double /*time_s*/) {}

    /// Returns the camera of the world's own film; null if the world has no film. Only called where
    /// Description::film_s is set.
    [[nodiscard]] virtual std::unique_ptr<CameraPath> film_camera(const estampe::Scene& /*scene*/) const
    {
        return nullptr;
    }

    /// Returns a visitor who walks through `scene`; null if the world is not made for walking. The viewer
    /// then walks over its ground without collisions.
    [[nodiscard]] virtual std::unique_ptr<Visit> visit(const estampe::Scene& /*scene*/) const
    {
        return nullptr;
    }
};

} // namespace worlds
