// SPDX-License-Identifier: MIT
#pragma once

// What the command line asks for, one struct a command, and the groups of options that it is read by.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <estampe/bake.hpp>
#include <estampe/error.hpp>
#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>
#include <estampe/views.hpp>

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// A mistake on the command line itself: the program ends with 2 instead of 1.
class UsageError : public Error {
public:
    using Error::Error;
};

/// How large a picture is.
struct PageSize {
    uint32_t width = 1280; ///< pixels
    uint32_t height = 720;
    std::optional<double> width_mm;      ///< of a page in millimetres, exactly
    std::optional<double> height_mm;     ///< of a page in millimetres, which millimetres of the style are of
    std::optional<double> dots_per_inch; ///< of such a page, for the file to tell
};

/// What makes a film of a picture.
struct FilmChoice {
    uint32_t first = 1;
    uint32_t last = 0; ///< with the first; 0: to the end of the animation, of a turn of five seconds, or of
                       ///< the world's own film
    double frames_per_s = 24.0; ///< without --fps that of the scene's file, where it says one
    bool has_rate = false;      ///< --fps was given
    bool turntable = false;     ///< the eye goes once around from the first frame to the last
    bool flies = false;         ///< --film: along the camera path of the world's own film
    bool resume = false;        ///< go on where an earlier run stopped
};

/// Where --camera looks from.
struct CameraChoice {
    enum class Kind : uint8_t {
        automatic, ///< the file's first camera, else framing
        framing,   ///< the whole scene, whatever the file says
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

/// What drawing needs, whether a picture or a graph comes of it.
struct DrawOptions {
    std::string scene;
    std::string input_format; ///< of a scene that comes through a pipe; empty: recognised by its content
    std::string output;
    std::vector<std::string> world; ///< options of the world that `scene` names, as KEY=VALUE
    std::string terrain;            ///< a terrain's file, that the scene is put on; empty: none
    LoadOptions load;               ///< how the scene's file is read
    std::string lightmap;           ///< what `estampe bake` wrote; empty: what the scene's file names
    PageSize page;
    CameraChoice camera;
    double time_s = 0.0;
    bool has_time = false; ///< --time was given
    std::string animation; ///< a name, an index or "all"; empty: the first
    uint32_t samples = 1;
    uint32_t tile_px = 0; ///< see RenderSettings
    Style style;
    std::vector<std::string> assignments; ///< of single parameters, which `style` has already
    bool is_draft = false;                ///< it is for looking: what a world adds to its films is left out
    RendererOptions device;
};

/// In place of the name of a file.
inline constexpr const char* standard_output = "-";

enum class PictureFormat : uint8_t { png, jpeg, webp, exr, openraster, svg };

/// What a picture is written as.
struct PictureChoice {
    PictureFormat format = PictureFormat::png;
    int depth = 8;              ///< bits a channel
    std::optional<int> quality; ///< of JPEG and WebP; none: the usual one, or without loss
    std::string layers;         ///< a folder, or an .exr, for the layers too; empty: none
    std::string layer;          ///< the one that is drawn in place of the picture; empty: all of it
};

struct RenderCommand {
    DrawOptions draw;
    PictureChoice picture;
    bool hidden = false;            ///< .svg only: lines behind something too
    bool plotter = false;           ///< .svg only: for pens that draw
    std::string motion;             ///< .exr to write beside the picture; empty: none
    double since_s = 0.0;           ///< moment that the motion looks back to
    std::optional<FilmChoice> film; ///< nothing: a single picture
    uint32_t repeat = 1;
    bool timings = false;
    bool json = false;
    bool is_quiet = false; ///< what it has to tell goes to stderr
};

/// Opens a window.
struct ViewCommand {
    DrawOptions draw;       ///< size is the window's; without a scene one is dropped on it
    std::string style_name; ///< that --style gave; empty: built-in values
    std::string shaders;    ///< folder whose shaders take the place of those built in; empty: none
    bool verbose = false;
    bool warm_up = false; ///< draws unseen, so that the next window finds its shaders compiled
};

struct GraphCommand {
    DrawOptions draw;
};

struct InfoCommand {
    std::string scene;        ///< empty: list the worlds
    std::string input_format; ///< as in DrawOptions
    std::optional<UpAxis> up;
    std::vector<std::string> world; ///< as in DrawOptions
    bool json = false;
};

struct DevicesCommand {
    bool json = false;
};

/// Lists the presets, draws a scene in all of them, prints one style in full, or the schema of all.
struct StylesCommand {
    std::string style;
    bool schema = false;
    std::optional<DrawOptions> sheet; ///< `output` is a .png of all presets, `scene` may be empty
};

struct StyleManualCommand {};

/// Makes a tonal art map, or converts one.
struct TamCommand {
    Style style;
    std::string from;    ///< a map to convert; empty: one is drawn in `style`
    std::string brush;   ///< a picture of one stroke; empty: tam.tool
    std::string output;  ///< .tam, .dds, or a folder
    std::string preview; ///< .png; empty: none
};

/// Works out light ahead.
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

/// Draws many pictures in one go.
struct BatchCommand {
    std::string jobs;   ///< a TOML file
    std::string report; ///< .json
    uint32_t shard = 1; ///< of the jobs, which are dealt out in runs
    uint32_t shards = 1;
    RendererOptions device;
};

using Command = std::variant<BatchCommand, RenderCommand, GraphCommand, InfoCommand, DevicesCommand,
                             StylesCommand, StyleManualCommand, TamCommand, BakeCommand, ViewCommand>;

/// Reads the command line, the style it names, and its --set assignments. Nothing when it asked for help or
/// the version, which have then been printed. Throws UsageError for a mistake in it, Error for a style file
/// that cannot be read.
[[nodiscard]] std::optional<Command> read_command_line(int argc, const char* const* argv);

/// The options that say how large a picture is: in pixels, or as a page and how finely it is printed.
class PageOptions {
public:
    /// Adds --size to the command, and the others where it draws pictures `for_print`; this object must
    /// outlive the parsing.
    void add_to(CLI::App& command, bool for_print);

    /// What was typed. Throws UsageError for a mistake in it.
    [[nodiscard]] PageSize read() const;

private:
    std::string size_;
    std::string page_;
    std::optional<double> dots_per_inch_;
    bool landscape_ = false;
};

/// The options of `estampe render` that are of films alone.
class FilmOptions {
public:
    /// Adds them to the command; this object must outlive its parsing.
    void add_to(CLI::App& command);

    /// What was typed; nothing where `output` is a single picture. Throws UsageError for what contradicts
    /// itself.
    [[nodiscard]] std::optional<FilmChoice> read(const std::string& output) const;

private:
    std::string frames_;
    std::optional<double> frames_per_s_;
    bool turntable_ = false;
    bool flies_ = false;
    bool resume_ = false;
};

/// The options of `estampe render` that say what its picture is written as.
class PictureOptions {
public:
    /// Adds them to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// What was typed, looked at, for a picture that is named by `-o` and of a size. Throws UsageError for a
    /// mistake in it.
    [[nodiscard]] PictureChoice read(const std::string& output, uint32_t width, uint32_t height) const;

    /// That of the frames of a film. Throws UsageError when anything was typed that they do not have.
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
    /// Adds it to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Puts what was typed before `assignments` of the style, which go over it. Throws UsageError for a word
    /// that it does not take.
    void assign(std::vector<std::string>& assignments) const;

private:
    std::string mode_;
};

/// Whether pictures in this style have an alpha channel.
[[nodiscard]] bool is_transparent(const Style& style);

/// Throws UsageError where the style's paper is transparent and the picture or film is written as a format
/// without alpha, naming those that have it.
void check_has_alpha(const DrawOptions& draw, const PictureChoice& picture, bool is_film);

} // namespace estampe::app
