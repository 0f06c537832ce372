// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "options.hpp"
#include "output/child.hpp"

namespace estampe::viewer {

/// Shortens the first start of the viewer after an installation. The first run compiles shaders without
/// optimisation. A process of low priority compiles optimised shaders for the next run. A file in the user's
/// cache records whether optimised shaders exist, see warmth_file().
class WarmUp {
public:
    /// Decides how this run compiles shaders. Call this before a device is opened and before threads start.
    explicit WarmUp(const app::ViewCommand& command);

    /// Returns whether this run compiles shaders without optimisation.
    [[nodiscard]] bool is_quick() const { return is_quick_; }

    /// Starts the process that compiles optimised shaders for the next run. Only the first call has an
    /// effect. Call this when the window shows this scene, drawn on the CPU. The destructor ends the process
    /// if it has not finished.
    void begin(const std::string& scene);

private:
    bool is_quick_ = false;
    bool has_scene_;
    std::unique_ptr<output::Child> process_;
};

/// Work of the low-priority process. Draws the scene without a window in all ways in which the window draws.
/// At the end, records in a file that the shaders are compiled. Throws Error as `estampe render` does.
void warm_up(const app::ViewCommand& command);

/// Returns the file that records for which program and which cache of Mesa the shaders were compiled with
/// optimisation; empty when the user has no home folder.
[[nodiscard]] std::filesystem::path warmth_file();

} // namespace estampe::viewer
