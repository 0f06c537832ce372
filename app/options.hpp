// SPDX-License-Identifier: MIT
#pragma once

// The parsed command line: one struct per command, and the groups of options from which it is read.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <estampe/bake.hpp>
#include <estampe/error.hpp>
#include <estampe/normal_map.hpp>
#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>
#include <estampe/views.hpp>
#include <estampe/work_limits.hpp>

#include "confine.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// Reports a mistake on the command line; the program then exits with 2 instead of 1.
class UsageError : public Error {
public:
    using Error::Error;
};

/// Size of a picture in pixels, and for print in millimetres.
struct PageSize {
    uint32_t width = 1280; ///< Width of the picture in pixels
    uint32_t height = 720;
    std::optional<double> width_mm; ///< exact width of a page in millimetres
    /// Exact height of a page in millimetres; scales the style's millimetres.
    std::optional<double> height_mm;
    std::optional<double> dots_per_inch; ///< Resolution of a page in print, stored in the file
};

/// Largest number of a film's frame.
inline constexpr uint32_t most_frames = 1000000;

/// Settings of a film, from the command line.
struct FilmChoice {
    uint32_t first = 1;
    /// Number of the last frame, inclusive; 0: until the end of the animation, of the turn (5 s) or of the
    /// world's film.
    uint32_t last = 0;
    double frames_per_s = 24.0; ///< Frame rate; without --fps the rate of the scene's file, if it gives one
    bool has_rate = false;      ///< --fps was given on the command line
    bool turntable = false;     ///< The camera goes once around the scene from the first frame to the last
    bool flies = false;         ///< --film was given: the camera follows the path of the world's own film
    bool resume = false;        ///< The film continues where an earlier run stopped
};

/// The camera that the option --camera selects.
struct CameraChoice {
    enum class Kind : uint8_t {
        automatic, ///< Camera: the file's first camera, or a view of the whole scene if the file has none
        framing,   ///< Camera: a view of the whole scene, even if the file has cameras
        named,     ///< Camera of the scene's file, by its name
        placed,    ///< Camera at a given eye, with target and field of view
        directed,  ///< Camera that looks from a named side, or from an azimuth and elevation
    };
    Kind kind = Kind::automatic;
    std::string name;
    Camera placed;
    ViewDirection direction;
    bool parallel = false; ///< --ortho was given: parallel projection
};

/// Settings that every command needs that draws a scene.
struct DrawOptions {
    std::string scene;
    std::string input_format; ///< format of a piped scene; empty: detected from its content
    std::string output;
    std::vector<std::string> world; ///< Options of the world that `scene` names, as KEY=VALUE
    std::string terrain;            ///< Terrain file on which the scene is put; empty: none
    LoadOptions load;               ///< Options for reading the scene's file; `confine` sets their scope
    Confinement confine;            ///< Limits the files that are read
    /// The options stand in a jobs file. Messages then quote no text of the files that they name.
    bool is_of_job = false;
    /// Lightmap file made by `estampe bake`; empty: the lightmaps that the scene's file names.
    std::string lightmap;
    PageSize page;
    CameraChoice camera;
    double time_s = 0.0;
    bool has_time = false; ///< --time was given on the command line
    std::string animation; ///< Animation to play: a name, an index or "all"; empty: the first animation
    uint32_t samples = 1;
    uint32_t tile_px = 0; ///< Longest side of a tile, see RenderSettings::tile_px
    Style style;
    /// Assignments of single style parameters; `style` already contains them.
    std::vector<std::string> assignments;
    WorkLimits limits;     ///< Limits the memory and the time of the whole command
    bool is_draft = false; ///< The picture is a draft: a world leaves out its additions for films
    RendererOptions device;
};

/// Name that the user types instead of a file name to write to standard output.
inline constexpr const char* standard_output = "-";

enum class PictureFormat : uint8_t { png, jpeg, webp, exr, openraster, svg };

/// File format and content of a picture.
struct PictureChoice {
    PictureFormat format = PictureFormat::png;
    int depth = 8;              ///< Bits per channel in the picture's file
    std::optional<int> quality; ///< Quality of JPEG and WebP; none: the default of JPEG, lossless WebP
    std::string layers; ///< Folder or .exr file that receives the layers; empty: layers are not written
    std::string layer;  ///< Name of the layer to draw instead of the picture; empty: the whole picture
};

struct RenderCommand {
    DrawOptions draw;
    PictureChoice picture;
    bool hidden = false;            ///< Lines behind surfaces (hidden lines) are drawn as well; only for .svg
    bool plotter = false;           ///< The output is for pen plotters; only for .svg
    std::string motion;             ///< File that receives motion vectors, .exr; empty: none
    double since_s = 0.0;           ///< Time from which motion vectors are measured
    std::optional<FilmChoice> film; ///< Settings of the film; nothing for a single picture
    uint32_t repeat = 1;
    bool timings = false;
    bool json = false;
    bool is_quiet = false; ///< Texts for the user go to stderr instead of stdout, as in a batch
};

/// `estampe view`: opens a window in which the user explores and edits a scene.
struct ViewCommand {
    DrawOptions draw;       ///< Settings of the view; the window sets the size, and the scene may be empty
    std::string style_name; ///< Name of the style as typed after --style; empty: built-in values
    std::string shaders;    ///< Folder with shaders that replace the built-in shaders; empty: none
    bool verbose = false;
    bool warm_up = false; ///< Draws without a window, so that the next window finds its shaders compiled
};

struct GraphCommand {
    DrawOptions draw;
};

struct InfoCommand {
    std::string scene;        ///< Scene to report on; empty: lists the worlds
    std::string input_format; ///< Format of a piped scene; empty: detected from its content
    std::optional<UpAxis> up;
    std::vector<std::string> world; ///< Options of the world that `scene` names, as KEY=VALUE
    Confinement confine;            ///< Limits the files that are read
    bool json = false;
};

struct DevicesCommand {
    bool json = false;
};

/// `estampe styles`: lists the presets, draws a scene in all of them, prints one style in full, or the JSON
/// schema of all styles.
struct StylesCommand {
    std::string style;
    bool schema = false;
    Confinement confine; ///< Limits the files that are read
    /// Settings of a contact sheet of all presets; its `output` is a .png, its `scene` may be empty.
    std::optional<DrawOptions> sheet;
};

/// `--help-style`: prints the manual of a style's parameters.
struct StyleManualCommand {
    std::string section; ///< Name of the section to print, or "all"; empty: the manual's first page
};

/// `estampe tam`: makes a tonal art map, or converts one.
struct TamCommand {
    Style style;
    std::string from;    ///< Tonal art map to convert; empty: a map is drawn in `style`
    std::string brush;   ///< Picture of one stroke; empty: the style's tam.tool draws the strokes
    std::string output;  ///< File or folder that receives the map: .tam, .dds, or a folder
    std::string preview; ///< File that receives a contact sheet of the map, .png; empty: none
    Confinement confine; ///< Limits the files that are read
};

/// `estampe normalmap`: makes a normal map from a picture of heights.
struct NormalMapCommand {
    std::string picture; ///< Picture that holds the heights
    std::string output;  ///< File that receives the normal map, .png
    NormalMapSettings settings;
    Confinement confine; ///< Limits the files that are read
};

/// `estampe normalmap --from`: makes a normal map of a detailed mesh for a plain mesh.
struct NormalBakeCommand {
    std::string plain;    ///< Scene that gets the map
    std::string detailed; ///< Scene that gives the normals
    std::string output;   ///< File that receives the normal map, .png
    NormalBakeSettings settings;
    Confinement confine; ///< Limits the files that are read
};

/// `estampe bake`: computes a lightmap.
struct BakeCommand {
    std::string scene;
    std::string input_format; ///< Format of a piped scene; empty: detected from its content
    std::optional<UpAxis> up;
    std::vector<std::string> world; ///< Options of the world that `scene` names, as KEY=VALUE
    std::string output;             ///< File that receives the lightmap, .exr
    Style style;
    BakeSettings settings;
    bool resume = true;
    Confinement confine; ///< Limits the files that are read
    WorkLimits limits;   ///< Limits the memory and the time of the whole command
};

/// `estampe batch`: draws many pictures in one run.
struct BatchCommand {
    std::string jobs;   ///< File that lists the jobs, in TOML
    std::string report; ///< File that receives the report, .json
    uint32_t shard = 1; ///< Number of the shard to draw, from 1; each shard is a run of consecutive jobs
    uint32_t shards = 1;
    RendererOptions device;
    Confinement confine; ///< Limits the files that the jobs name to the folder of the jobs file
    WorkLimits limits;   ///< Limits the memory and the time of the whole batch
};

using Command = std::variant<BatchCommand, RenderCommand, GraphCommand, InfoCommand, DevicesCommand,
                             StylesCommand, StyleManualCommand, TamCommand, NormalMapCommand,
                             NormalBakeCommand, BakeCommand, ViewCommand>;

/// Reads the command line, the style that it names, and its --set assignments. Returns nothing after it has
/// printed help or the version. Throws UsageError for a mistake on the command line, Error for a style file
/// that cannot be read. `of_job` is the confinement of a job of a batch, whose options stand in a jobs file;
/// null for the program's own command line.
[[nodiscard]] std::optional<Command> read_command_line(int argc, const char* const* argv,
                                                       const Confinement* of_job = nullptr);

/// The options for the size of a picture: in pixels, or as a page with a resolution.
class PageOptions {
public:
    /// Adds --size to the command, and the page options if the command draws pictures `for_print`; this
    /// object must outlive the parsing.
    void add_to(CLI::App& command, bool for_print);

    /// Returns the page size that the options give. Throws UsageError for invalid options.
    [[nodiscard]] PageSize read() const;

private:
    std::string size_;
    std::string page_;
    std::optional<double> dots_per_inch_;
    bool landscape_ = false;
};

/// The options of `estampe render` that apply only to films.
class FilmOptions {
public:
    /// Adds the options of films to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Returns the film settings; nothing if `output` is a single picture. Throws UsageError for
    /// contradictory options.
    [[nodiscard]] std::optional<FilmChoice> read(const std::string& output) const;

private:
    std::string frames_;
    std::optional<double> frames_per_s_;
    bool turntable_ = false;
    bool flies_ = false;
    bool resume_ = false;
};

/// The options of `estampe render` for the file format of its picture.
class PictureOptions {
public:
    /// Adds the options of the picture's format to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Checks the options of the picture's format and returns the format. `output` is the file name after
    /// `-o`; `width` and `height` are the picture's size in pixels. Throws UsageError for invalid options.
    [[nodiscard]] PictureChoice read(const std::string& output, uint32_t width, uint32_t height) const;

    /// Returns the format of a film's frames. Throws UsageError when an option was typed that does not apply
    /// to films.
    [[nodiscard]] PictureChoice of_film() const;

private:
    std::string format_;
    std::string layers_;
    std::string layer_;
    std::optional<int> quality_;
    std::optional<int> depth_;
};

/// The option --transparent, which sets paper.transparent.
class TransparentOption {
public:
    /// Adds --transparent to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Translates --transparent into an assignment of the style parameter paper.transparent. The function
    /// inserts it before `assignments`, so that `assignments` can override it. Throws UsageError for an
    /// invalid word.
    void assign(std::vector<std::string>& assignments) const;

private:
    std::string mode_;
};

/// Returns whether pictures in this style have an alpha channel.
[[nodiscard]] bool is_transparent(const Style& style);

/// Checks that a transparent picture can be stored. Throws UsageError if the style's paper is transparent and
/// the picture or film has a format without alpha; the message names the formats that have alpha.
void check_has_alpha(const DrawOptions& draw, const PictureChoice& picture, bool is_film);

} // namespace estampe::app
