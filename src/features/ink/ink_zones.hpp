// SPDX-License-Identifier: MIT
#pragma once

// Areas of the page in which nodes of the scene move flowing ink or emit it.

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "features/common/style_tables.hpp"
#include "scene/pose.hpp"
#include "shaders/frame.glsl.h"
#include "techniques/ink/ink.glsl.h"

namespace estampe::features {

/// Returns the position of a point of the world on the page, in millimetres; none for a point behind the eye.
[[nodiscard]] std::optional<glm::dvec2> page_place_mm(const shared::FrameGlobals& page,
                                                      const glm::dvec3& anchor, const glm::dvec3& point);

/// The scene as it appears on the page, for placing ink zones.
struct ZoneView {
    const Scene& scene;
    const ScenePose& pose;
    glm::dvec3 anchor{0.0};
    const shared::FrameGlobals& page;
};

/// Areas of the page in which objects (nodes) move flowing ink or emit it.
struct InkZones {
    std::vector<shared::InkZone> zones;
    std::vector<float> shapes; ///< Shapes of the zones, see ink::Plan::zone_shapes
};

/// Finds the ink zones of the style: nodes whose names match an override by object of `ink.zone`. The zone of
/// a node with a mesh is the area that the mesh at rest covers on the page. The zone of a node without a mesh
/// is a disc, as large as a sphere of one metre radius in the node's space. A node behind the eye gets no
/// zone. At most `most_ink_zones` zones are made, in the order of the overrides. Cost: linear in nodes times
/// overrides, and in the triangles of the meshes.
[[nodiscard]] InkZones ink_zones(const ZoneView& view, const StyleTables& style);

/// One flag per node: whether the style makes the node an ink zone. Empty if the style makes no zones. Meshes
/// of nodes that are ink zones are not drawn.
[[nodiscard]] std::vector<bool> ink_zone_nodes(const Scene& scene, const StyleTables& style);

} // namespace estampe::features
