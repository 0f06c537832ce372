// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "options.hpp"
#include "world/world.hpp"

namespace estampe::viewer {

/// A loaded scene with the data that the viewer needs to show it.
struct LoadedFile {
    app::DrawOptions draw; ///< Options with which the scene was loaded
    Scene scene;
    Index animation = 0;
    Camera home;
    Bounds bounds;
    double ground_m = 0.0;                ///< Height by which the scene was lifted onto its terrain
    std::shared_ptr<worlds::Visit> visit; ///< Walk through a world; null for other scenes
};

/// Loads scenes in the background.
class SceneLoader {
public:
    /// Creates a loader without starting to load. A thread calls `wake` when a scene is loaded or has failed.
    explicit SceneLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// Waits for threads that still load; see is_busy().
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    /// Starts to load `draw.scene`, and discards any scene that is still being loaded.
    void load(app::DrawOptions draw);
    /// Discards the scene that is being loaded.
    void cancel();

    [[nodiscard]] bool is_loading() const;
    /// Returns the path of the scene that is being loaded.
    [[nodiscard]] std::string path() const;
    /// Returns the share of the scene that is loaded, 0 to 1; nothing if the file does not say how large the
    /// scene is.
    [[nodiscard]] std::optional<double> share() const;
    /// Returns whether a thread is still reading a file, even if the result is no longer wanted.
    [[nodiscard]] bool is_busy() const;

    using Result = std::variant<std::shared_ptr<const LoadedFile>, std::string>;
    /// Returns the loaded scene or an error message, once; nothing while the scene is being loaded.
    [[nodiscard]] std::optional<Result> take();

private:
    struct Reading {
        std::thread thread;
        std::shared_ptr<std::atomic<bool>> is_done;
    };

    void read(const app::DrawOptions& draw, uint64_t number);
    bool heed(uint64_t number, double share);
    void sweep();

    std::function<void()> wake_;
    mutable std::mutex guard_;
    uint64_t wanted_ = 0; ///< number of the newest load; results of older loads are discarded
    bool is_loading_ = false;
    std::optional<double> share_;
    std::string path_;
    std::optional<Result> result_;
    std::list<Reading> readings_;
};

} // namespace estampe::viewer
