// SPDX-License-Identifier: MIT
#pragma once

// What every feature offers the renderer besides its own functions: to forget, and to outlive a run.

#include <cstdint>
#include <optional>
#include <string_view>

#include "features/common/film_archive.hpp"

namespace estampe::features {

/// What happened that may outdate what a feature keeps between pictures.
enum class Event : uint8_t {
    scene_replaced,    ///< set_scene(): what is drawn from now on is something else
    layout_replaced,   ///< the scene's draws, vertices and triangles are numbered afresh
    triangles_changed, ///< some triangles are flagged otherwise, or torn
    ground_replaced,   ///< the terrain is cut into other triangles, after layout_replaced
    lights_changed,    ///< shadows may fall otherwise
    anchor_moved,      ///< positions on the device are relative to another origin
    film_recalled,     ///< the next frame goes on from a film's memory, which holds nothing of this feature
};

/// The feature's part of a film's memory.
struct FilmSection {
    std::string_view name;
    uint32_t version = 1; ///< of the bytes that save() writes; load() is never given another version
};

/// A part of the renderer that keeps buffers or state from picture to picture. A feature plans on the
/// processor, records its passes into a frame graph, forgets what an event outdates, and saves what a film's
/// next frame goes on from.
class Feature {
public:
    Feature() = default;
    Feature(const Feature&) = delete;
    Feature& operator=(const Feature&) = delete;
    Feature(Feature&&) = delete;
    Feature& operator=(Feature&&) = delete;
    virtual ~Feature() = default;

    /// Forgets what `event` outdates. Cost: nothing worth naming; buffers stay.
    virtual void invalidate(Event event) = 0;

    /// None where nothing of the feature goes on from frame to frame.
    [[nodiscard]] virtual std::optional<FilmSection> film_section() const { return std::nullopt; }

    /// Writes what load() makes the next frame go on from; nothing where the last frame left nothing.
    virtual void save(FilmWriter& /*writer*/) {}

    /// Makes the next frame go on from what save() wrote. Throws Error when that is damaged, or of another
    /// scene; the feature may then have forgotten what it had.
    virtual void load(FilmReader& /*reader*/) {}
};

} // namespace estampe::features
