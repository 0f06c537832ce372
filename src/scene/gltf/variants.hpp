// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scene/gltf/data.hpp"

namespace estampe::gltf {

/// The material of a primitive in each variant of the file (KHR_materials_variants), `no_index` where it
/// keeps its own; empty where no variant changes it. Warns of a variant that is mapped twice: the first
/// mapping holds.
[[nodiscard]] std::vector<Index> variant_materials(Data& data, const tinygltf::Primitive& source,
                                                   const std::string& pointer);

} // namespace estampe::gltf
