// SPDX-License-Identifier: MIT
#pragma once

// Cloth: what sheets are made of, and what they run into.

#include <cstdint>
#include <limits>

namespace estampe {

/// How cloth is kept from stretching. All take the same sheets and may be swapped while a film goes on.
enum class ClothSolver : uint8_t {
    automatic,     ///< small_steps
    small_steps,   ///< extended position-based dynamics: many short steps of one iteration each
    verlet,        ///< one step and many relaxations, as Zanuttini, "Recherches en rendu non réaliste temps
                   ///< réel", Université Paris 8, 2008, chapter 7: stretches more the finer the mesh
    block_descent, ///< Chen, Liu, Yang and Yuksel, "Vertex Block Descent", SIGGRAPH 2024: each vertex in turn
                   ///< goes to where its share of the energy is least, by colours
};

/// What a sheet is made of; the defaults are a light cotton.
struct Cloth {
    float density_kg_m2 = 0.15F;
    float stretch_n_m = 8000.0F; ///< newtons on a metre of width that would make it twice as long
    float bending_n_m = 3e-5F;   ///< flexural rigidity: torque on a metre of width for a curvature of 1 / m
    float fold = 0.9F; ///< how near what lies two vertices apart may come, as a share of how far it lay:
                       ///< sharp creases at 0, none at 1
    float drag = 1.2F; ///< of air that meets it flat
    float lift = 0.8F; ///< of air that meets it aslant
    float damping_per_s = 0.4F; ///< share of its speed that it loses in a second by itself
    float friction = 0.4F;      ///< on what it lies on
    float thickness_m = 0.006F; ///< how far from things it is held
    float self_m = 0.0F; ///< how far from each other its vertices are held, where they are more than twice
                         ///< that apart at rest; it passes through itself at less than their spacing, and
                         ///< at 0 nobody looks
    float tear = 0.0F;   ///< how many times as long as at rest its threads are when they tear, more than 1;
                         ///< they never do at 0. Such a sheet has four times as many small steps
    uint32_t back_material =
        std::numeric_limits<uint32_t>::max(); ///< the scene's material of its other side; else the same
    ClothSolver solver = ClothSolver::automatic;

    bool operator==(const Cloth& other) const = default;
};

/// What of an object cloth runs into: the smallest such solid about its mesh, or the mesh as it rests, which
/// goes along with its node.
enum class ClothCollider : uint8_t {
    none,
    box,
    ellipsoid,
    cylinder, ///< upright, along y
    capsule,  ///< the same with round ends
    mesh ///< its very form, if it is closed, to a fortieth of its length; neither skins nor morph targets
         ///< bend it
};

} // namespace estampe
