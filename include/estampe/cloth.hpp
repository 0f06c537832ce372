// SPDX-License-Identifier: MIT
#pragma once

// Cloth: the material of cloth sheets, and the solids that they collide with.

#include <cstdint>
#include <limits>

namespace estampe {

/// Method that keeps cloth from stretching. All methods work on the same sheets; the method may change
/// during a film.
enum class ClothSolver : uint8_t {
    automatic,   ///< Chooses the solver for the program: `small_steps`
    small_steps, ///< Extended position-based dynamics: many short steps with one iteration each
    /// Verlet integration with one long step with many relaxation iterations (Zanuttini, "Recherches en rendu
    /// non réaliste temps réel", Université Paris 8, 2008, chapter 7). Finer meshes stretch more.
    verlet,
    /// Chen, Liu, Yang and Yuksel, "Vertex Block Descent", SIGGRAPH 2024: moves one vertex after another to
    /// the minimum of its part of the energy. Vertices get colour numbers so that vertices of one colour do
    /// not depend on each other. Vertices of one colour are moved in parallel.
    block_descent,
};

/// Physical material of a cloth sheet. The defaults are a light cotton.
struct Cloth {
    float density_kg_m2 = 0.15F;
    float stretch_n_m = 8000.0F; ///< Force per metre of width that would double the length
    float bending_n_m = 3e-5F;   ///< Flexural rigidity: torque per metre of width for a curvature of 1 / m
    /// Smallest distance between two vertices that are two edges apart, as a share of their distance at rest.
    /// 0 allows sharp creases, 1 allows no fold at all.
    float fold = 0.9F;
    float drag = 1.2F; ///< Aerodynamic drag coefficient of the sheet, for air that hits it head-on
    float lift = 0.8F; ///< Aerodynamic lift coefficient of the sheet, for air that hits it at an angle
    /// Share of its speed that the sheet loses per second, apart from air drag.
    float damping_per_s = 0.4F;
    float friction = 0.4F;      ///< Coefficient of friction between the sheet and the solids that it touches
    float thickness_m = 0.006F; ///< Smallest distance between the sheet and the solids that it collides with
    /// Smallest distance between two vertices of the sheet that are more than twice as far apart at rest. If
    /// it is less than the spacing of the vertices, the sheet can pass through itself. 0 turns
    /// self-collision off.
    float self_m = 0.0F;
    /// Stretch at which threads tear, as current length over rest length; more than 1. 0: the sheet never
    /// tears. Simulating a sheet that can tear needs four times as many small steps.
    float tear = 0.0F;
    /// Index of the material of the sheet's back in the scene; the maximum means that both sides have the
    /// same material.
    uint32_t back_material = std::numeric_limits<uint32_t>::max();
    ClothSolver solver = ClothSolver::automatic;

    bool operator==(const Cloth& other) const = default;
};

/// Shape that replaces an object when cloth collides with the object. The shape is the mesh at rest, or the
/// smallest solid of the named kind that contains the mesh. The shape moves with the object's node.
enum class ClothCollider : uint8_t {
    none,
    box,
    ellipsoid,
    cylinder, ///< The smallest upright cylinder around the mesh, with its axis along y
    capsule,  ///< The smallest upright cylinder with hemispherical ends around the mesh
    /// The collider is the mesh itself, sampled on a grid with cells of 1/40 of its longest side. The mesh
    /// should be closed, but small holes do no harm. Skins and morph targets do not deform this collider.
    mesh
};

} // namespace estampe
