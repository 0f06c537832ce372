// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include <estampe/film.hpp>

#include "film_frames.hpp"

namespace estampe::app {

/// Writes frames in a thread of its own while the next are drawn.
class FilmQueue {
public:
    struct Frame {
        uint32_t number = 0;
        Image image;
        std::optional<std::vector<std::byte>> memory; ///< to go on after it; nothing: it is not kept
    };

    /// `film`, if there is one, and `frames` must outlive it.
    FilmQueue(const FilmFrames& frames, FilmWriter* film);
    /// Leaves what waits unwritten.
    ~FilmQueue();
    FilmQueue(const FilmQueue&) = delete;
    FilmQueue& operator=(const FilmQueue&) = delete;

    /// Waits while several frames do. Throws the Error of a frame before that could not be written.
    void push(Frame frame);

    /// Waits until all is written. Throws as push() does.
    void finish();

private:
    void work();
    void rethrow_problem();

    const FilmFrames& frames_;
    FilmWriter* film_;
    std::mutex guard_;
    std::condition_variable changed_;
    std::deque<Frame> waiting_;
    std::exception_ptr problem_;
    bool is_closed_ = false;
    bool is_idle_ = true;
    std::thread thread_;
};

} // namespace estampe::app
