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
#include <estampe/read_scope.hpp>

namespace estampe::app {

/// Returns whether a file name contains one number field, such as "%d" or "%04d".
[[nodiscard]] bool is_numbered(const std::string& name);

/// Returns whether `file` is a frame of the film with the numbered name `pattern`, such as "folder/%04d.png".
[[nodiscard]] bool is_frame_of(const std::string& pattern, const std::filesystem::path& file);

/// State of a film that was stopped, from which it can be continued.
struct FilmState {
    uint32_t next = 1;             ///< Number of the next frame to draw
    std::vector<std::byte> memory; ///< Result of Renderer::film_memory() after the previous frame
};

/// The frames of a film as files. Numbered pictures stay; frames of a film file lie in FILM.partial/ until
/// the film is complete. A file `film-state` in the same folder records the progress.
class FilmFrames {
public:
    /// Prepares the files of a film. `output` is the pattern of the pictures or the film file. `job` is a
    /// fingerprint of everything that the frames depend on. Throws Error if a file of the film lies outside
    /// of `scope`; so do the functions that read or write one.
    FilmFrames(const std::string& output, uint64_t job, ReadScope scope = {});

    /// Path of the file of a frame.
    [[nodiscard]] std::filesystem::path path_of(uint32_t number) const;

    /// Reads the film's state that an earlier run saved; nothing if there is none. Throws Error when the
    /// state belongs to another job or is damaged, or when a frame from `first` on is missing.
    [[nodiscard]] std::optional<FilmState> state(uint32_t first) const;

    /// Reads a frame that was saved. Throws Error on failure.
    [[nodiscard]] Image load(uint32_t number) const;

    /// Writes a frame to its file. Throws Error on failure.
    void save(uint32_t number, const Image& image) const;

    /// Saves the film's state; the files of all frames up to this state must exist. Throws Error on failure.
    void save_state(const FilmState& state) const;

    /// Deletes temporary files of frames that a killed program left.
    void remove_left_parts() const;

    /// Creates the folder of the frames. Call this before the first save(). Throws Error when the folder
    /// cannot be created.
    void make_folder() const;

    /// Deletes the state of an earlier run, and its frames if they belong to a film file.
    void forget() const;

    /// Deletes the saved state of the film, and the folder with the frames of a film file. Call this function
    /// when all frames are drawn and the film is written.
    void finish() const;

private:
    std::string pattern_;
    std::filesystem::path folder_;
    bool is_of_film_;
    uint64_t job_;
    ReadScope scope_;
};

/// Writes frames in a separate thread while the next frames are drawn.
class FilmQueue {
public:
    struct Frame {
        uint32_t number = 0;
        Image image;
        /// Result of Renderer::film_memory() after this frame, from which a stopped film can be continued;
        /// may be absent.
        std::optional<std::vector<std::byte>> memory;
    };

    /// Starts the thread that writes frames. `frames`, and `film` if `film` is not null, must outlive this
    /// object.
    FilmQueue(const FilmFrames& frames, FilmWriter* film);
    /// Discards the frames that wait to be written.
    ~FilmQueue();
    FilmQueue(const FilmQueue&) = delete;
    FilmQueue& operator=(const FilmQueue&) = delete;

    /// Adds a frame; blocks while several frames are waiting. Throws the Error of an earlier frame that could
    /// not be written.
    void push(Frame frame);

    /// Waits until all frames are written. Throws the Error of a frame that could not be written.
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
