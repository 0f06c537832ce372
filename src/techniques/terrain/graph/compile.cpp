// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/compile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include <estampe/error.hpp>

#include "core/read_scope.hpp"
#include <fmt/format.h>

#include "style/names.hpp"
#include "style/wind.hpp"
#include "techniques/terrain/graph/language.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {
namespace {

constexpr size_t most_instructions = 1000;

/// A node of the height graph with its parsed expression.
struct Definition {
    const HeightNode* node = nullptr;
    std::unique_ptr<Expression> expression;
};

/// Visits the nodes of a height graph, from the node "height" on. Tracks the coordinates in which each node
/// is evaluated.
class Compiler {
public:
    explicit Compiler(const TerrainDescription& terrain) : terrain_(terrain)
    {
        for (const HeightNode& node : terrain.nodes) {
            if (find_node_kind(node.name) != nullptr || is_reserved(node.name)) {
                throw Error(fmt::format("\"{}\" is a word of the language and cannot name a node", node.name),
                            node.where, "choose another name");
            }
            if (!is_name(node.name)) {
                throw Error(fmt::format("\"{}\" cannot name a node", node.name), node.where,
                            "a name has letters, digits and _, and begins with no digit");
            }
            if (!definitions_.try_emplace(node.name, Definition{&node, parse_expression(node)}).second) {
                throw Error(fmt::format("there are two nodes \"{}\"", node.name), node.where);
            }
        }
    }

    Program take()
    {
        const auto height = definitions_.find("height");
        if (height == definitions_.end()) {
            throw Error("no node \"height\"", terrain_.name,
                        "say what the height is: height = \"6 * fbm(400)\"");
        }
        const Expression root = reference("height");
        node_ = height->second.node;
        const uint32_t result = value_of(root, Frame{});
        program_.instructions = with_registers(program_.instructions, result, terrain_.name);
        return std::move(program_);
    }

private:
    static bool is_reserved(const std::string& name)
    {
        return name == "x" || name == "z" || name == "time" || name == "wind" || name == "pi";
    }

    static Expression reference(const std::string& name)
    {
        Expression result;
        result.kind = Expression::Kind::name;
        result.word = name;
        return result;
    }

    [[noreturn]] void fail(const Expression& at, const std::string& problem,
                           const std::string& remedy = {}) const
    {
        throw Error(fmt::format("node \"{}\", character {}: {}", node_->name, at.column, problem),
                    node_->where, remedy);
    }

    /// Calls `inside` while the node `name` counts as the current node. Throws Error if the node depends on
    /// itself.
    template <typename Function>
    auto within(const Expression& at, const Function& inside)
    {
        const auto found = definitions_.find(at.word);
        if (found == definitions_.end()) {
            fail_unknown(at);
        }
        if (!open_.insert(at.word).second) {
            fail(at, fmt::format("\"{}\" leads back to itself", at.word),
                 "a height cannot be made of itself");
        }
        const HeightNode* const outer = node_;
        node_ = found->second.node;
        auto result = inside(*found->second.expression);
        node_ = outer;
        open_.erase(at.word);
        return result;
    }

    [[noreturn]] void fail_unknown(const Expression& at) const
    {
        std::vector<std::string> known{"x", "z", "time", "wind", "pi"};
        for (const NodeKind& kind : node_kinds()) {
            known.emplace_back(kind.name);
        }
        for (const auto& [name, definition] : definitions_) {
            known.push_back(name);
        }
        const std::string meant = style::nearest(at.word, known);
        fail(at, fmt::format("there is no node or function \"{}\"", at.word),
             meant.empty() ? "docs/terrain.md lists the functions"
                           : fmt::format("did you mean \"{}\"?", meant));
    }

    uint32_t value_of(const Expression& at, const Frame& frame)
    {
        switch (at.kind) {
        case Expression::Kind::number:
            return constant(at.number);
        case Expression::Kind::text:
            fail(at, "a text is no height");
        case Expression::Kind::name:
            return named(at, frame);
        case Expression::Kind::call:
            break;
        }
        return called(at, frame);
    }

    uint32_t named(const Expression& at, const Frame& frame)
    {
        if (at.word == "x" || at.word == "z") {
            return coordinate(frame, at.word == "x");
        }
        if (at.word == "time") {
            Frame clock;
            clock.u = {.t = 1.0};
            return coordinate(clock, true);
        }
        if (at.word == "wind") {
            return constant(terrain_.wind.speed_m_per_s);
        }
        if (at.word == "pi") {
            return constant(std::numbers::pi);
        }
        if (find_node_kind(at.word) != nullptr) {
            fail(at, fmt::format("\"{}\" wants brackets and what it is to be made of", at.word));
        }
        const std::pair key(at.word, frame.key());
        if (const auto known = named_.find(key); known != named_.end()) {
            return known->second;
        }
        const uint32_t value = within(at, [&](const Expression& inside) { return value_of(inside, frame); });
        named_.emplace(key, value);
        return value;
    }

    uint32_t called(const Expression& at, const Frame& frame)
    {
        const NodeKind* kind = find_node_kind(at.word);
        if (kind == nullptr) {
            fail_unknown(at);
        }
        const auto number = [&](const Expression& inner) { return number_of(inner); };
        const auto problem = [&](const Expression& inner, const std::string& what) { fail(inner, what); };
        const Arguments arguments = bind_arguments(*kind, at, number, problem);
        switch (kind->form) {
        case NodeForm::arithmetic:
            return arithmetic(*kind, arguments, frame);
        case NodeForm::curve:
            return curve(at, arguments, frame);
        case NodeForm::leaf:
            return leaf(*kind, arguments, frame);
        case NodeForm::texture:
        case NodeForm::mask:
            return texture(at, *kind, arguments, frame);
        case NodeForm::sand:
            return sand(at, arguments, frame.turned(wind_rad()));
        case NodeForm::dunes:
            return dunes(arguments, frame.turned(wind_rad()));
        default:
            return value_of(arguments.value("a"), inner_frame(*kind, arguments, frame));
        }
    }

    [[nodiscard]] double wind_rad() const
    {
        return wind::from_x_deg(terrain_.wind.towards_deg) * std::numbers::pi / 180.0;
    }

    Frame inner_frame(const NodeKind& kind, const Arguments& arguments, const Frame& frame)
    {
        switch (kind.form) {
        case NodeForm::translate:
            return translated(arguments, frame);
        case NodeForm::rotate:
            return turned(frame, arguments.number("degrees") * std::numbers::pi / 180.0);
        case NodeForm::downwind:
            return turned(frame, wind_rad());
        case NodeForm::scale: {
            const double x = arguments.number("x");
            const double z = arguments.number("z") > 0.0 ? arguments.number("z") : x;
            return scaled(frame, {1.0 / x, 1.0 / z});
        }
        case NodeForm::polar:
            return polar(arguments, frame);
        default:
            return warped(frame, value_of(arguments.value("x"), frame),
                          value_of(arguments.value("z"), frame));
        }
    }

    /// Rotates a coordinate frame and its warp, if the frame has a warp (a displacement by two values of the
    /// program).
    Frame turned(const Frame& frame, double angle_rad)
    {
        Frame result = frame.turned(angle_rad);
        if (frame.is_warped()) {
            const glm::dvec2 turn = cosine_and_sine(angle_rad);
            const uint32_t cosine = constant(turn.x);
            const uint32_t sine = constant(turn.y);
            const auto [u, v] = frame.warp;
            result.warp = {add(multiply(u, cosine), multiply(v, sine)),
                           subtract(multiply(v, cosine), multiply(u, sine))};
        }
        return result;
    }

    Frame scaled(const Frame& frame, const glm::dvec2& factor)
    {
        Frame result = frame.scaled(factor);
        if (frame.is_warped()) {
            result.warp = {multiply(frame.warp[0], constant(factor.x)),
                           multiply(frame.warp[1], constant(factor.y))};
        }
        return result;
    }

    Frame warped(const Frame& frame, uint32_t u, uint32_t v)
    {
        Frame result = frame;
        result.warp =
            frame.is_warped() ? std::array{add(frame.warp[0], u), add(frame.warp[1], v)} : std::array{u, v};
        return result;
    }

    /// Translates a coordinate frame. Translations by a number or a speed are exact at any distance from the
    /// origin. Other expressions become a warp (a displacement computed by the program).
    Frame translated(const Arguments& arguments, const Frame& frame)
    {
        const auto x = in_time(arguments.value("x"));
        const auto z = in_time(arguments.value("z"));
        if (x && z) {
            return frame.moved(*x, *z);
        }
        const uint32_t zero = constant(0.0);
        return warped(frame, subtract(zero, value_of(arguments.value("x"), frame)),
                      subtract(zero, value_of(arguments.value("z"), frame)));
    }

    Frame polar(const Arguments& arguments, const Frame& frame)
    {
        const Frame centred =
            frame.moved({.constant = arguments.number("x")}, {.constant = arguments.number("z")});
        const uint32_t u = coordinate(centred, true);
        const uint32_t v = coordinate(centred, false);
        Frame result;
        result.u = {};
        result.v = {};
        result.stretch = frame.stretch;
        result.warp = {binary(shared::height_radius, u, v),
                       multiply(binary(shared::height_angle, u, v), constant(arguments.number("radius")))};
        return result;
    }

    /// Converts an expression to a linear function of time, if the expression is linear in time, such as a
    /// number or a speed. Returns none for other expressions.
    std::optional<Linear> in_time(const Expression& at)
    {
        if (at.kind == Expression::Kind::number) {
            return Linear{.constant = at.number};
        }
        if (at.kind == Expression::Kind::name && at.word == "time") {
            return Linear{.t = 1.0};
        }
        if (at.kind == Expression::Kind::name && definitions_.contains(at.word)) {
            if (const auto known = times_.find(at.word); known != times_.end()) {
                return known->second;
            }
            const auto found = within(at, [&](const Expression& inside) { return in_time(inside); });
            times_.emplace(at.word, found);
            return found;
        }
        if (at.kind == Expression::Kind::call && at.arguments.size() == 2) {
            const auto a = in_time(*at.arguments[0].value);
            const auto b = in_time(*at.arguments[1].value);
            if (a && b && (at.word == "+" || at.word == "-")) {
                const double sign = at.word == "+" ? 1.0 : -1.0;
                return Linear{.t = a->t + sign * b->t, .constant = a->constant + sign * b->constant};
            }
            if (a && b && at.word == "*" && (a->t == 0.0 || b->t == 0.0)) {
                return Linear{.t = a->t * b->constant + b->t * a->constant,
                              .constant = a->constant * b->constant};
            }
        }
        const std::optional<double> number = known_number(value_of(at, Frame{}));
        return number ? std::optional(Linear{.constant = *number}) : std::nullopt;
    }

    double number_of(const Expression& at)
    {
        const std::optional<double> number = known_number(value_of(at, Frame{}));
        if (!number) {
            fail(at, "this must be a number that stands still and is the same everywhere");
        }
        return *number;
    }

    [[nodiscard]] std::optional<double> known_number(uint32_t value) const
    {
        const Instruction& made_by = program_.instructions[value];
        if (made_by.op != shared::height_constant) {
            return std::nullopt;
        }
        return program_.parameters[made_by.parameter];
    }

    uint32_t arithmetic(const NodeKind& kind, const Arguments& arguments, const Frame& frame)
    {
        Instruction instruction = blank(kind.op);
        size_t input = 0;
        for (const NodeParameter& parameter : kind.parameters) {
            const uint32_t made = parameter.form == ParameterForm::value
                                      ? value_of(arguments.value(parameter.name), frame)
                                      : constant(arguments.number(parameter.name));
            instruction.inputs[static_cast<glm::length_t>(input++)] = made;
        }
        if (kind.op == shared::height_power) {
            instruction.parameter = parameters({arguments.number("exponent")});
            instruction.inputs[1] = shared::height_no_register;
        }
        return append(instruction);
    }

    uint32_t curve(const Expression& at, const Arguments& arguments, const Frame& frame)
    {
        std::vector<glm::dvec2> points;
        for (size_t i = 0; i + 1 < arguments.rest.size(); i += 2) {
            points.emplace_back(arguments.rest[i], arguments.rest[i + 1]);
        }
        if (points.size() < 2 || points.size() > 64 || arguments.rest.size() % 2 != 0) {
            fail(at, "a curve wants 2 to 64 points, each an x and a y");
        }
        for (size_t i = 1; i < points.size(); ++i) {
            if (!(points[i].x > points[i - 1].x)) {
                fail(at, "the points of a curve go from left to right");
            }
        }
        Instruction instruction = blank(shared::height_curve);
        instruction.inputs[0] = value_of(arguments.value("a"), frame);
        instruction.parameter = parameters(monotone_curve(points));
        instruction.count = static_cast<uint32_t>(points.size());
        return append(instruction);
    }

    uint32_t leaf(const NodeKind& kind, const Arguments& arguments, const Frame& frame)
    {
        Instruction instruction = blank(kind.op);
        const double wavelength_m = arguments.number("wavelength");
        if (kind.op == shared::height_fbm || kind.op == shared::height_ridged) {
            instruction.parameter =
                parameters({std::floor(arguments.number("seed")), std::floor(arguments.number("octaves")),
                            arguments.number("gain")});
        } else if (kind.op != shared::height_wave) {
            instruction.parameter = parameters({std::floor(arguments.number("seed"))});
        }
        return append_leaf(instruction, frame, {1.0 / wavelength_m, 1.0 / wavelength_m});
    }

    uint32_t texture(const Expression& at, const NodeKind& kind, const Arguments& arguments,
                     const Frame& frame)
    {
        const bool is_mask = kind.form == NodeForm::mask;
        TextureRequest request{.name = arguments.text(is_mask ? "name" : "file"), .is_mask = is_mask};
        double wrap = 2.0;
        bool is_cubic = true;
        if (is_mask) {
            request.texels = static_cast<uint32_t>(arguments.number("texels"));
        } else {
            wrap =
                arguments.text("wrap") == "repeat" ? 0.0 : (arguments.text("wrap") == "mirror" ? 1.0 : 2.0);
            is_cubic = arguments.text("filter") == "bicubic";
        }
        const TextureInProgram found = [&] {
            try {
                return texture_in(program_, request, terrain_);
            } catch (const OutsideScope&) {
                throw;
            } catch (const Error& error) {
                fail(at, error.what());
            }
        }();
        const HeightTexture& held = program_.textures[found.index];
        Instruction instruction = blank(shared::height_texture);
        instruction.parameter =
            parameters({static_cast<double>(held.first_texel), static_cast<double>(held.columns),
                        static_cast<double>(held.rows), wrap, is_cubic ? 1.0 : 0.0, found.mean});
        const double size_m = arguments.number("size");
        const double height_m = size_m * held.rows / held.columns;
        Frame placed = frame;
        if (is_mask) {
            placed = frame.moved({.constant = -0.5 * size_m}, {.constant = -0.5 * size_m});
        }
        return append_leaf(instruction, placed, {1.0 / size_m, 1.0 / height_m});
    }

    uint32_t sand(const Expression& at, const Arguments& arguments, const Frame& downwind)
    {
        const auto side = static_cast<uint32_t>(arguments.number("side"));
        if (!std::has_single_bit(side) || arguments.number("side") != side) {
            fail(at, "the side of sand is 64, 128, 256, 512 or 1024 cells");
        }
        if (std::ranges::any_of(program_.textures,
                                [](const HeightTexture& t) { return t.sand.has_value(); })) {
            fail(at, "a ground has one sand; give it a name among the nodes and use that twice");
        }
        const TextureInProgram found =
            texture_in(program_,
                       {.name = "sand",
                        .texels = side,
                        .sand = SandSource{.cell_m = arguments.number("cell"),
                                           .depth_m = arguments.number("depth"),
                                           .start_steps = arguments.number("start"),
                                           .steps_per_s = arguments.number("rate"),
                                           .seed = static_cast<uint32_t>(arguments.number("seed"))}},
                       terrain_);
        const HeightTexture& held = program_.textures[found.index];
        Instruction instruction = blank(shared::height_texture);
        instruction.parameter = parameters({static_cast<double>(held.first_texel), static_cast<double>(side),
                                            static_cast<double>(side), 0.0, 1.0, 0.0});
        const double units_per_m = 1.0 / (arguments.number("cell") * side);
        return append_leaf(instruction, downwind, {units_per_m, units_per_m});
    }

    uint32_t dunes(const Arguments& arguments, const Frame& downwind)
    {
        const double wavelength_m = arguments.number("wavelength");
        const double height_m = arguments.number("height");
        const double crest_m =
            arguments.number("crest") > 0.0 ? arguments.number("crest") : 3.0 * wavelength_m;
        Instruction instruction = blank(shared::height_dunes);
        instruction.parameter =
            parameters({std::floor(arguments.number("seed")), height_m, wavelength_m,
                        std::tan(arguments.number("repose") * std::numbers::pi / 180.0),
                        arguments.number("windward") * wavelength_m, arguments.number("meander"),
                        arguments.number("variation"), crest_m, 0.05 * height_m});
        const Frame moving = downwind.moved({.t = arguments.number("celerity")}, {});
        return append_leaf(instruction, moving, {1.0 / wavelength_m, 1.0 / crest_m});
    }

    uint32_t coordinate(const Frame& frame, bool along_u)
    {
        return append_leaf(blank(along_u ? shared::height_coordinate_u : shared::height_coordinate_v), frame,
                           {1.0, 1.0});
    }

    uint32_t append_leaf(Instruction instruction, const Frame& frame, const glm::dvec2& units_per_m)
    {
        instruction.place = place(frame.place(units_per_m));
        instruction.warp = {frame.warp[0], frame.warp[1]};
        return append(instruction);
    }

    uint32_t place(const PlaceSource& wanted)
    {
        const auto found = std::ranges::find(program_.places, wanted);
        if (found != program_.places.end()) {
            return static_cast<uint32_t>(found - program_.places.begin());
        }
        program_.places.push_back(wanted);
        return static_cast<uint32_t>(program_.places.size() - 1);
    }

    uint32_t constant(double number)
    {
        Instruction instruction = blank(shared::height_constant);
        instruction.parameter = parameters({number});
        return append(instruction);
    }

    uint32_t multiply(uint32_t a, uint32_t b) { return binary(shared::height_multiply, a, b); }

    uint32_t add(uint32_t a, uint32_t b) { return binary(shared::height_add, a, b); }

    uint32_t subtract(uint32_t a, uint32_t b) { return binary(shared::height_subtract, a, b); }

    uint32_t binary(uint32_t op, uint32_t a, uint32_t b)
    {
        Instruction instruction = blank(op);
        instruction.inputs = {a, b, shared::height_no_register};
        return append(instruction);
    }

    static Instruction blank(uint32_t op)
    {
        return {.op = op,
                .target = 0,
                .inputs = glm::uvec3(shared::height_no_register),
                .warp = glm::uvec2(shared::height_no_register),
                .parameter = 0,
                .place = 0,
                .count = 0};
    }

    /// Returns the index at which `numbers` are stored in the program's parameters. Equal lists are stored
    /// only once.
    uint32_t parameters(const std::vector<double>& numbers)
    {
        const auto [found, is_new] =
            parameters_.try_emplace(numbers, static_cast<uint32_t>(program_.parameters.size()));
        if (is_new) {
            program_.parameters.insert(program_.parameters.end(), numbers.begin(), numbers.end());
        }
        return found->second;
    }

    /// Appends an instruction and returns the number of its value; registers are assigned later. Values that
    /// were computed before are reused, and instructions on constants are evaluated immediately.
    uint32_t append(Instruction instruction)
    {
        if (instruction.op != shared::height_constant && depends_on_constants(program_, instruction)) {
            const double number = evaluate_one(program_, instruction);
            if (!std::isfinite(number)) {
                throw Error(fmt::format("node \"{}\": the result is no number", node_->name), node_->where,
                            "look for a division by 0");
            }
            return constant(number);
        }
        const auto& w = instruction;
        const std::array key{w.op,     w.inputs.x,  w.inputs.y, w.inputs.z, w.warp.x,
                             w.warp.y, w.parameter, w.place,    w.count};
        const auto [found, is_new] =
            known_.try_emplace(key, static_cast<uint32_t>(program_.instructions.size()));
        if (!is_new) {
            return found->second;
        }
        const size_t words = shared::height_words_a_place * program_.places.size() +
                             program_.parameters.size() + 4 * (program_.instructions.size() + 1);
        if (program_.instructions.size() >= most_instructions || words > shared::height_words_most) {
            throw Error(fmt::format("the graph takes more than {} operations, or {} numbers",
                                    most_instructions, shared::height_words_most),
                        node_->where, "make it simpler");
        }
        instruction.target = found->second;
        program_.instructions.push_back(instruction);
        return found->second;
    }

    const TerrainDescription& terrain_;
    std::map<std::string, Definition> definitions_;
    const HeightNode* node_ = nullptr; ///< the node whose expression is being compiled
    std::set<std::string> open_;       ///< names of the nodes on the path to `node_`, to detect cycles
    Program program_;
    std::map<std::vector<double>, uint32_t> parameters_;
    std::map<std::array<uint32_t, 9>, uint32_t> known_;
    /// Index of the value that a node computes in a coordinate frame, by the node's name and that frame.
    std::map<std::pair<std::string, Frame::Key>, uint32_t> named_;
    /// For each node: its linear function of time; none if the node is not linear in time.
    std::map<std::string, std::optional<Linear>> times_;
};

} // namespace

Program compile_program(const TerrainDescription& terrain)
{
    return Compiler(terrain).take();
}

} // namespace estampe::terrain
