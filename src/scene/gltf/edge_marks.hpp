// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// Reads EXT_mesh_primitive_edge_visibility into `primitive.edge_marks`; nothing for a primitive without it.
///
/// `primitive` has its final triangles, but still the vertices of the file; `indices` are the file's own, in
/// the order of its topology. Values 2 and 3 (hard, hard repeated) and the edges of `lineStrings` are marked;
/// 0 and 1 (hidden, silhouette) are not: outlines are found anyway. An edge is marked on every triangle of
/// the primitive that has its two vertices. Throws Error with a pointer when accessors do not fit; what runs
/// along no triangle is counted in a warning. Cost: n log n in marked edges.
void read_edge_marks(Data& data, const tinygltf::Primitive& source, std::span<const uint32_t> indices,
                     Primitive& primitive, const std::string& pointer);

} // namespace estampe::gltf
