// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "drawing.hpp"
#include "world/world.hpp"

namespace estampe::app {

/// Where a film is seen from. A view of the whole scene stands still, far enough off for all that will move;
/// a camera of the file moves as it does there; on a turntable either goes once around what it looks at; a
/// world's own film has a path of its own.
class FilmCamera {
public:
    /// Of frames from `begin_s` to `end_s`, along `path` where there is one. Throws Error as
    /// choose_camera() does. Cost: of a view of the whole scene that of framing_camera(), and of
    /// scene_bounds() at some moments.
    FilmCamera(const DrawOptions& draw, const Scene& scene, Index animation, double begin_s, double end_s,
               bool turntable, std::shared_ptr<const worlds::CameraPath> path = nullptr);

    /// At a moment, `turn` of 0 to 1 around.
    [[nodiscard]] Camera at(double time_s, double turn) const;

private:
    const DrawOptions& draw_;
    const Scene& scene_;
    Index animation_;
    std::shared_ptr<const worlds::CameraPath> path_;
    std::optional<Camera> still_; ///< nothing: the file's, which may move
};

} // namespace estampe::app
