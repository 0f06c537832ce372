// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include <estampe/scene.hpp>

#include "options.hpp"
#include "world/world.hpp"

namespace estampe::app {

/// The camera of a film. A camera that shows the whole scene does not move; it is so far away that all later
/// movement is in view. A camera of the file moves as in the file. In a turntable film, the camera turns once
/// around its target. A world's own film has its own camera path.
class FilmCamera {
public:
    /// Chooses the camera for the frames from `begin_s` to `end_s`; the camera follows `path` unless `path`
    /// is null. Throws Error as choose_camera() does. For a view of the whole scene the cost is one call of
    /// framing_camera() and several calls of scene_bounds().
    FilmCamera(const DrawOptions& draw, const Scene& scene, Index animation, double begin_s, double end_s,
               bool turntable, std::shared_ptr<const worlds::CameraPath> path = nullptr);

    /// Returns the film's camera at a time. In a turntable film, `turn` is the position in the turn around
    /// the scene, 0 to 1.
    [[nodiscard]] Camera at(double time_s, double turn) const;

private:
    const DrawOptions& draw_;
    const Scene& scene_;
    Index animation_;
    std::shared_ptr<const worlds::CameraPath> path_;
    /// Camera that does not move; nothing if the film uses a camera of the scene's file, which may move.
    std::optional<Camera> still_;
};

} // namespace estampe::app
