// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <estampe/film.hpp>
#include <estampe/image.hpp>

namespace estampe::app {

/// Whether a name holds one number to be filled in, "%d" or "%04d".
[[nodiscard]] bool is_numbered(const std::string& name);

/// How far a run came that was stopped.
struct FilmState {
    uint32_t next = 1;             ///< frame to draw
    std::vector<std::byte> memory; ///< Renderer::film_memory() of the frame before
};

/// The frames of a film as files: pictures with numbers in their names, which stay, or those of a film, which
/// lie in FILM.partial/ until it is whole. A file `film-state` beside them tells how far they go.
class FilmFrames {
public:
    /// Of what `output` names. `job` is a fingerprint of all that the frames hang on.
    FilmFrames(const std::string& output, uint64_t job);

    /// Where a frame lies.
    [[nodiscard]] std::filesystem::path path_of(uint32_t number) const;

    /// The state that an earlier run left; nothing where there was none. Throws Error when it was of another
    /// job, is damaged, or a frame from `first` on is missing.
    [[nodiscard]] std::optional<FilmState> state(uint32_t first) const;

    /// Writes a frame. Throws Error when it cannot.
    void save(uint32_t number, const Image& image) const;

    /// Writes how far the frames go, whose files must be there. Throws Error when it cannot.
    void save_state(const FilmState& state) const;

    /// To be called before the first frame is saved. Throws Error when there can be no such folder.
    void make_folder() const;

    /// Forgets what an earlier run left: its state, and where they are of a film its frames.
    void forget() const;

    /// All is drawn and kept elsewhere: as forget(), and the folder of a film's frames goes too.
    void finish() const;

private:
    std::string pattern_;
    std::filesystem::path folder_;
    bool is_of_film_;
    uint64_t job_;
};

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
