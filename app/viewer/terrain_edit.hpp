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

/// Whether a TOML file describes a terrain, valid or not, rather than a style.
[[nodiscard]] bool is_terrain(const std::filesystem::path& path);

/// The text of a terrain file to be written.
struct TerrainText {
    std::string text;
    bool keeps_comments = true; ///< whether comments of the previous text, if any, are kept
};

/// Returns `before`, the text of a terrain file, with the values of `terrain`. Comments, blank lines and the
/// order are preserved. If the values in a text cannot be changed line by line, a new text is generated.
[[nodiscard]] TerrainText text_with(const std::string& before, const TerrainDescription& terrain);

/// The edited terrain: the current input, the last valid terrain, and the undo history.
class TerrainEdit {
public:
    /// The reason why the input is not a valid terrain.
    struct Problem {
        std::optional<size_t> node; ///< the node whose line is wrong, if it is a single one
        std::string text;
    };

    /// Starts with a terrain as read from its file.
    explicit TerrainEdit(const Terrain& terrain);

    /// The file that the terrain came from, and is saved to.
    [[nodiscard]] const std::string& name() const { return draft_.name; }

    /// The current input, valid or not.
    [[nodiscard]] const TerrainDescription& draft() const { return draft_; }

    /// The last valid terrain.
    [[nodiscard]] const Terrain& terrain() const { return terrain_; }

    [[nodiscard]] const std::optional<Problem>& problem() const { return problem_; }

    /// Increases with every change of terrain().
    [[nodiscard]] uint64_t revision() const { return revision_; }

    /// Whether the terrain differs from its file.
    [[nodiscard]] bool is_changed() const;

    // Valid changes apply at once; finish_change() then makes the last valid terrain an undo step.

    void set_expression(size_t node, const std::string& expression);
    /// Also updates all nodes that refer to this one. The node "height" keeps its name, and no other node can
    /// take it.
    void rename(size_t node, const std::string& name);
    /// Adds a flat node with an unused name.
    void add_node();
    void remove_node(size_t node);
    /// Replaces everything except the nodes.
    void set_settings(const TerrainDescription& settings);
    /// Replaces everything except the nodes, but applies the change only when it is finished, because the
    /// terrain is slow to draw.
    void hold_settings(const TerrainDescription& settings);
    void finish_change();

    [[nodiscard]] bool can_undo() const;

    [[nodiscard]] bool can_redo() const { return history_.can_redo(); }

    /// Undoes invalid input first.
    void undo();
    void redo();

    /// Loads a terrain file as one undo step. Throws Error as load_terrain() and Terrain do, and then changes
    /// nothing.
    void load(const std::filesystem::path& path);
    /// Reads the terrain's textures again.
    void read_textures();
    /// Whether the terrain in the file has changed since it was read or saved. Throws Error as load_terrain()
    /// does.
    [[nodiscard]] bool differs_from_file() const;

    /// Writes the terrain to a file, which becomes the terrain's file; comments keep their places. Returns
    /// false if comments could not be kept. Throws Error when the input is invalid, when its textures cannot
    /// be found from the file's folder, and when the file cannot be written.
    bool save(const std::filesystem::path& path);

    /// The file and the terrain's textures.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

private:
    void take_draft();
    void take_step(const TerrainDescription& step);

    TerrainDescription draft_;
    std::vector<std::string> known_as_; ///< the name by which other nodes refer to each node
    Terrain terrain_;
    std::optional<Problem> problem_;
    bool holds_settings_ = false;
    History<TerrainDescription> history_;
    std::string file_text_; ///< text of the file when it was read or saved
    std::string saved_;     ///< the terrain when it was read or saved, as terrain_toml() writes it
    uint64_t revision_ = 1;
};

} // namespace estampe::viewer
