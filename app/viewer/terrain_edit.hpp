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

/// Whether a TOML file is a terrain's, right or wrong, and no style's.
[[nodiscard]] bool is_terrain(const std::filesystem::path& path);

/// A terrain's file as it is to be written.
struct TerrainText {
    std::string text;
    bool keeps_comments = true; ///< those of the text before, where it had any
};

/// `before`, the text of a terrain's file, changed where it says otherwise than `terrain`: comments, blank
/// lines and the order stay. A text in which values cannot be told apart line by line is written anew.
[[nodiscard]] TerrainText text_with(const std::string& before, const TerrainDescription& terrain);

/// The ground in hand: as it is typed, as it last made sense, and how to go back.
class TerrainEdit {
public:
    /// Why the text makes no ground.
    struct Problem {
        std::optional<size_t> node; ///< whose line is wrong, where it is one's
        std::string text;
    };

    /// As it was read from its file.
    explicit TerrainEdit(const Terrain& terrain);

    /// The file that it came from, and is saved to.
    [[nodiscard]] const std::string& name() const { return draft_.name; }

    /// As it is typed, right or wrong.
    [[nodiscard]] const TerrainDescription& draft() const { return draft_; }

    /// The last that was right.
    [[nodiscard]] const Terrain& terrain() const { return terrain_; }

    [[nodiscard]] const std::optional<Problem>& problem() const { return problem_; }

    /// Grows with every terrain().
    [[nodiscard]] uint64_t revision() const { return revision_; }

    /// Whether it is another than the file's.
    [[nodiscard]] bool is_changed() const;

    // Changes count at once where they make sense; finish_change() makes a step of the last that did, which
    // can be undone.

    void set_expression(size_t node, const std::string& expression);
    /// Every node that asks for it asks by the new name. "height" keeps its own, and no other gets it.
    void rename(size_t node, const std::string& name);
    /// A level one, with a name that is free.
    void add_node();
    void remove_node(size_t node);
    /// All but the nodes.
    void set_settings(const TerrainDescription& settings);
    /// The same, which counts when the change is finished: what is costly to draw.
    void hold_settings(const TerrainDescription& settings);
    void finish_change();

    [[nodiscard]] bool can_undo() const;

    [[nodiscard]] bool can_redo() const { return history_.can_redo(); }

    /// What is typed and makes no sense is undone first.
    void undo();
    void redo();

    /// Takes the file of that name, in one step. Throws Error as load_terrain() and Terrain do, and is then
    /// as before.
    void load(const std::filesystem::path& path);
    /// Reads its textures again.
    void read_textures();
    /// Whether the file has another terrain than it had when it was read or saved. Throws Error as
    /// load_terrain() does.
    [[nodiscard]] bool differs_from_file() const;

    /// Writes it to a file, which is then its own; comments stay where they were. Returns false where they
    /// could not. Throws Error when what is typed makes no sense, when its textures are not to be found from
    /// there, and when the file cannot be written.
    bool save(const std::filesystem::path& path);

    /// The file, and the textures that its terrain looks up.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

private:
    void take_draft();
    void take_step(const TerrainDescription& step);

    TerrainDescription draft_;
    std::vector<std::string> known_as_; ///< what others call each node
    Terrain terrain_;
    std::optional<Problem> problem_;
    bool holds_settings_ = false;
    History<TerrainDescription> history_;
    std::string file_text_; ///< as it was read or saved
    std::string saved_;     ///< the same, as terrain_toml() writes it
    uint64_t revision_ = 1;
};

} // namespace estampe::viewer
