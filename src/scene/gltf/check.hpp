// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace estampe::gltf {

/// Checks the parsed JSON of a glTF file against what the importer relies on: every property it reads has its
/// type and range, what is required is there, and every index points into its array. Numbers with a zero
/// fraction where an integer belongs become integers.
///
/// Throws Error with `file#/json/pointer`. After it, reading a property can neither fail nor overflow.
void check_document(nlohmann::json& document, const std::string& file);

} // namespace estampe::gltf
