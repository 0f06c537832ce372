// SPDX-License-Identifier: MIT
#pragma once

// The parsed command line, one struct per command, and the groups of options that it is read from.

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

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// A mistake on the command line; the program exits with 2 instead of 1.
class UsageError : public Error {
public:
    using Error::Error;
};

/// Size of a picture.
struct PageSize {
    uint32_t width = 1280; ///< pixels
    uint32_t height = 720;
    std::optional<double> width_mm;      ///< exact width of a page in millimetres
    std::optional<double> height_mm;     ///< exact height of a page; scales the style's millimetres
    std::optional<double> dots_per_inch; ///< resolution of such a page, stored in the file
};

/// Settings of a film.
struct FilmChoice {
    uint32_t first = 1;
    uint32_t last = 0;          ///< inclusive; 0: until the end of animation, turn (5 s) or world's film
    double frames_per_s = 24.0; ///< without --fps the rate of the scene's file, if it gives one
    bool has_rate = false;      ///< --fps was given
    bool turntable = false;     ///< the eye goes once around the scene from the first frame to the last
    bool flies = false;         ///< --film: the camera follows the path of the world's own film
    bool resume = false;        ///< continue where an earlier run stopped
};

/// The camera that --camera asks for.
struct CameraChoice {
    enum class Kind : uint8_t {
        automatic, ///< the file's first camera, or framing if it has none
        framing,   ///< the whole scene, even if the file has cameras
        named,     ///< a camera of the file
        placed,    ///< eye, target and fov
        directed,  ///< a named side, or azimuth and elevation
    };
    Kind kind = Kind::automatic;
    std::string name;
    Camera placed;
    ViewDirection direction;
    bool parallel = false; ///< --ortho
};

/// Settings that every drawing command needs.
struct DrawOptions {
    std::string scene;
    std::string input_format; ///< format of a piped scene; empty: detected from its content
    std::string output;
    std::vector<std::string> world; ///< options of the world that `scene` names, as KEY=VALUE
    std::string terrain;            ///< terrain file that the scene is put on; empty: none
    LoadOptions load;               ///< how the scene's file is read
    std::string lightmap;           ///< a file of `estampe bake`; empty: lightmaps that the scene names
    PageSize page;
    CameraChoice camera;
    double time_s = 0.0;
    bool has_time = false; ///< --time was given
    std::string animation; ///< a name, an index or "all"; empty: the first animation
    uint32_t samples = 1;
    uint32_t tile_px = 0; ///< see RenderSettings
    Style style;
    std::vector<std::string> assignments; ///< assignments to single parameters; `style` already contains them
    bool is_draft = false;                ///< a draft for preview: a world leaves out its additions for films
    RendererOptions device;
};

/// Replaces a file name to write to standard output.
inline constexpr const char* standard_output = "-";

enum class PictureFormat : uint8_t { png, jpeg, webp, exr, openraster, svg };

/// File format of a picture.
struct PictureChoice {
    PictureFormat format = PictureFormat::png;
    int depth = 8;              ///< bits per channel
    std::optional<int> quality; ///< for JPEG and WebP; none: the default, or lossless
    std::string layers;         ///< folder or .exr file for the layers; empty: layers are not written
    std::string layer;          ///< the layer to draw instead of the picture; empty: the whole picture
};

struct RenderCommand {
    DrawOptions draw;
    PictureChoice picture;
    bool hidden = false;            ///< .svg only: also draws hidden lines
    bool plotter = false;           ///< .svg only: output for pen plotters
    std::string motion;             ///< .exr file for motion vectors; empty: none
    double since_s = 0.0;           ///< time from which motion is measured
    std::optional<FilmChoice> film; ///< nothing for a single picture
    uint32_t repeat = 1;
    bool timings = false;
    bool json = false;
    bool is_quiet = false; ///< messages go to stderr only
};

/// `estampe view`: opens a window.
struct ViewCommand {
    DrawOptions draw;       ///< the window sets the size; the scene may be empty
    std::string style_name; ///< the argument of --style; empty: built-in values
    std::string shaders;    ///< folder with shaders that replace the built-in ones; empty: none
    bool verbose = false;
    bool warm_up = false; ///< draws without a window, so that the next window finds its shaders compiled
};

struct GraphCommand {
    DrawOptions draw;
};

struct InfoCommand {
    std::string scene;        ///< empty: lists the worlds
    std::string input_format; ///< as in DrawOptions
    std::optional<UpAxis> up;
    std::vector<std::string> world; ///< as in DrawOptions
    bool json = false;
};

struct DevicesCommand {
    bool json = false;
};

/// `estampe styles`: lists the presets, draws a scene in all of them, prints one style in full, or the schema
/// of all.
struct StylesCommand {
    std::string style;
    bool schema = false;
    std::optional<DrawOptions> sheet; ///< `output` is a .png of all presets, `scene` may be empty
};

/// `--help-style`: prints the manual of a style's parameters.
struct StyleManualCommand {
    std::string section; ///< "all", or the name of one; empty: the first page
};

/// `estampe tam`: makes a tonal art map, or converts one.
struct TamCommand {
    Style style;
    std::string from;    ///< tonal art map to convert; empty: one is drawn in `style`
    std::string brush;   ///< picture of one stroke; empty: tam.tool
    std::string output;  ///< .tam, .dds, or a folder
    std::string preview; ///< .png; empty: none
};

/// `estampe normalmap`: makes a normal map.
struct NormalMapCommand {
    std::string picture; ///< of heights
    std::string output;  ///< .png
    NormalMapSettings settings;
};

/// `estampe bake`: computes a lightmap.
struct BakeCommand {
    std::string scene;
    std::string input_format; ///< as in DrawOptions
    std::optional<UpAxis> up;
    std::vector<std::string> world; ///< as in DrawOptions
    std::string output;             ///< .exr
    Style style;
    BakeSettings settings;
    bool resume = true;
};

/// `estampe batch`: draws many pictures in one run.
struct BatchCommand {
    std::string jobs;   ///< a TOML file
    std::string report; ///< .json
    uint32_t shard = 1; ///< the shard to draw, from 1; each shard is a run of consecutive jobs
    uint32_t shards = 1;
    RendererOptions device;
};

using Command =
    std::variant<BatchCommand, RenderCommand, GraphCommand, InfoCommand, DevicesCommand, StylesCommand,
                 StyleManualCommand, TamCommand, NormalMapCommand, BakeCommand, ViewCommand>;

/// Reads the command line, the style it names, and its --set assignments. Returns nothing after it has
/// printed help or the version. Throws UsageError for a mistake on the command line, Error for a style file
/// that cannot be read.
[[nodiscard]] std::optional<Command> read_command_line(int argc, const char* const* argv);

/// The options for the size of a picture: in pixels, or as a page with a resolution.
class PageOptions {
public:
    /// Adds --size to the command, and the page options if it draws pictures `for_print`; this object must
    /// outlive the parsing.
    void add_to(CLI::App& command, bool for_print);

    /// Returns the page size. Throws UsageError for invalid options.
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
    /// Adds the options to the command; this object must outlive the parsing.
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
    /// Adds the options to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Checks and returns the format of a picture of this size that `-o` names `output`. Throws UsageError
    /// for invalid options.
    [[nodiscard]] PictureChoice read(const std::string& output, uint32_t width, uint32_t height) const;

    /// The format of a film's frames. Throws UsageError when an option was typed that does not apply to
    /// films.
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

    /// Inserts the typed option before `assignments` of the style, so that these override it. Throws
    /// UsageError for an invalid word.
    void assign(std::vector<std::string>& assignments) const;

private:
    std::string mode_;
};

/// Whether pictures in this style have an alpha channel.
[[nodiscard]] bool is_transparent(const Style& style);

/// Throws UsageError if the style's paper is transparent and the picture or film has a format without alpha;
/// the message names the formats that have it.
void check_has_alpha(const DrawOptions& draw, const PictureChoice& picture, bool is_film);

} // namespace estampe::app
