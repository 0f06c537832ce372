// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/scene.hpp>

namespace estampe::features {

/// Whether a pattern of a style speaks of a node, or of one that it belongs to.
[[nodiscard]] bool is_named(const Scene& scene, Index node, const std::string& pattern);

} // namespace estampe::features
