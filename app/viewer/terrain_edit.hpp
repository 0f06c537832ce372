// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/terrain.hpp>

#include "viewer/history.hpp"

namespace estampe::viewer {

/// Returns whether a TOML file describes a terrain, valid or not, rather than a style.
[[nodiscard]] bool is_terrain(const std::filesystem::path& path);

/// The text of a terrain file to be written.
struct TerrainText {
    std::string text;
    bool keeps_comments = true; ///< Comments of the previous text, if any, are kept
};

/// Returns `before`, the text of a terrain file, with the values of `terrain`. Comments, blank lines and the
/// order are preserved. If the values in a text cannot be changed line by line, a new text is generated.
[[nodiscard]] TerrainText text_with(const std::string& before, const TerrainDescription& terrain);

/// The terrain that the user edits: the current input, the last valid terrain, and the undo history.
class TerrainEdit {
public:
    /// The reason why the input is not a valid terrain.
    struct Problem {
        std::optional<size_t> node; ///< Node whose line is wrong, if it is a single node
        std::string text;
    };

    /// Starts to edit a terrain as read from its file.
    explicit TerrainEdit(const Terrain& terrain);

    /// Returns the name of the file from which the terrain came, and to which it is saved.
    [[nodiscard]] const std::string& name() const { return draft_.name; }

    /// Returns the current input, valid or not.
    [[nodiscard]] const TerrainDescription& draft() const { return draft_; }

    /// Returns the last valid terrain.
    [[nodiscard]] const Terrain& terrain() const { return terrain_; }

    [[nodiscard]] const std::optional<Problem>& problem() const { return problem_; }

    /// Returns a number that increases with every change of terrain().
    [[nodiscard]] uint64_t revision() const { return revision_; }

    /// Returns whether the terrain differs from its file.
    [[nodiscard]] bool is_changed() const;

    // Functions that change the terrain. Valid changes apply at once; finish_change() then makes the last
    // valid terrain an undo step.

    void set_expression(size_t node, const std::string& expression);
    /// Renames a node, and updates all nodes that refer to it. The node "height" cannot be renamed, and no
    /// other node can be named "height".
    void rename(size_t node, const std::string& name);
    /// Adds a node of constant height to the terrain, with an unused name.
    void add_node();
    void remove_node(size_t node);
    /// Replaces everything in the terrain except its nodes.
    void set_settings(const TerrainDescription& settings);
    /// Replaces everything in the terrain except its nodes, but applies the change only when it is finished,
    /// because the terrain is slow to draw.
    void hold_settings(const TerrainDescription& settings);
    void finish_change();

    [[nodiscard]] bool can_undo() const;

    [[nodiscard]] bool can_redo() const { return history_.can_redo(); }

    /// Undoes the last change of the terrain. If the current input is invalid, undoes only this input.
    void undo();
    void redo();

    /// Loads a terrain file as one undo step. Throws Error as load_terrain() and Terrain do, and then changes
    /// nothing.
    void load(const std::filesystem::path& path);
    /// Reads the terrain's textures again.
    void read_textures();
    /// Returns whether the terrain in the file has changed since it was read or saved. Throws Error as
    /// load_terrain() does.
    [[nodiscard]] bool differs_from_file() const;

    /// Writes the terrain to a file, which becomes the terrain's file; comments keep their places. Returns
    /// false if comments could not be kept. Throws Error when the input is invalid, when its textures cannot
    /// be found from the file's folder, and when the file cannot be written.
    bool save(const std::filesystem::path& path);

    /// Returns the terrain's file and its textures, for watching.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

private:
    [[nodiscard]] ReadScope scope_of(const std::filesystem::path& path) const;
    void take_draft();
    void take_step(const TerrainDescription& step);

    TerrainDescription draft_;
    std::vector<std::string> known_as_; ///< Name by which other nodes refer to each node
    Terrain terrain_;
    std::optional<Problem> problem_;
    bool holds_settings_ = false;
    History<TerrainDescription> history_;
    std::string file_text_; ///< Text of the file when it was last read or saved
    std::string saved_;     ///< Terrain when it was last read or saved, as terrain_toml() writes it
    uint64_t revision_ = 1;
};

} // namespace estampe::viewer
