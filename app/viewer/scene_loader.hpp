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

/// A scene that was read, with what the viewer has to know of it.
struct LoadedFile {
    app::DrawOptions draw; ///< that it was read for
    Scene scene;
    Index animation = 0;
    Camera home;
    Bounds bounds;
    double ground_m = 0.0;                ///< what the scene was lifted by, to stand on its terrain
    std::shared_ptr<worlds::Visit> visit; ///< who walks through a world; null for other scenes
};

/// Reads scenes while the viewer goes on.
class SceneLoader {
public:
    /// `wake` is called from a thread when something is read or has failed.
    explicit SceneLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// Waits for what is being read; see is_busy().
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    /// Begins to read `draw.scene`, in place of what was being read before.
    void load(app::DrawOptions draw);
    /// What is being read is not wanted any more.
    void cancel();

    [[nodiscard]] bool is_loading() const;
    /// What is being read.
    [[nodiscard]] std::string path() const;
    /// How much of it is read; nothing where the file does not tell.
    [[nodiscard]] std::optional<double> share() const;
    /// Whether any thread still reads, wanted or not.
    [[nodiscard]] bool is_busy() const;

    using Result = std::variant<std::shared_ptr<const LoadedFile>, std::string>;
    /// The scene, or why there is none; nothing while it is being read.
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
    uint64_t wanted_ = 0; ///< number of the reading whose result counts
    bool is_loading_ = false;
    std::optional<double> share_;
    std::string path_;
    std::optional<Result> result_;
    std::list<Reading> readings_;
};

} // namespace estampe::viewer
