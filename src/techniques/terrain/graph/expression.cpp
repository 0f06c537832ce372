// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/language.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include <estampe/error.hpp>
#include <fmt/format.h>

namespace estampe::terrain {
namespace {

constexpr size_t longest_text = 100'000;
constexpr size_t most_calls = 1'000;
constexpr int deepest_level = 200;

bool begins_name(char c)
{
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool continues_name(char c)
{
    return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Recursive descent parser for height expressions.
class Reader {
public:
    explicit Reader(const HeightNode& node) : text_(node.expression), node_(node) {}

    std::unique_ptr<Expression> whole()
    {
        auto result = sum();
        if (at_ < text_.size()) {
            fail(fmt::format("\"{}\" was not expected here", text_.substr(at_, 1)));
        }
        return result;
    }

private:
    /// Counts the depth of nesting, to limit it.
    struct Level {
        explicit Level(Reader& reader) : reader_(reader)
        {
            if (++reader_.level_ > deepest_level) {
                reader_.fail(fmt::format("more than {} levels of brackets and signs", deepest_level));
            }
        }

        ~Level() { --reader_.level_; }

        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

        Reader& reader_;
    };

    [[noreturn]] void fail(const std::string& problem) const
    {
        throw Error(fmt::format("node \"{}\", character {}: {}", node_.name, at_ + 1, problem), node_.where);
    }

    void skip_blanks()
    {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
            ++at_;
        }
    }

    /// Skips blanks and returns the next character; 0 at the end of the text.
    char next()
    {
        skip_blanks();
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    bool take(char wanted)
    {
        if (next() != wanted) {
            return false;
        }
        ++at_;
        return true;
    }

    void count_call()
    {
        if (++calls_ > most_calls) {
            fail(fmt::format("more than {} signs and calls", most_calls));
        }
    }

    std::unique_ptr<Expression> call(std::string word, size_t column, std::unique_ptr<Expression> first,
                                     std::unique_ptr<Expression> second)
    {
        count_call();
        auto result = std::make_unique<Expression>();
        result->kind = Expression::Kind::call;
        result->word = std::move(word);
        result->column = column;
        result->arguments.push_back({{}, std::move(first), column});
        result->arguments.push_back({{}, std::move(second), column});
        return result;
    }

    std::unique_ptr<Expression> sum()
    {
        const Level level(*this);
        auto left = product();
        for (char sign = next(); sign == '+' || sign == '-'; sign = next()) {
            const size_t column = ++at_;
            left = call(std::string(1, sign), column, std::move(left), product());
        }
        return left;
    }

    std::unique_ptr<Expression> product()
    {
        auto left = signed_power();
        for (char sign = next(); sign == '*' || sign == '/'; sign = next()) {
            const size_t column = ++at_;
            left = call(std::string(1, sign), column, std::move(left), signed_power());
        }
        return left;
    }

    std::unique_ptr<Expression> signed_power()
    {
        const Level level(*this);
        if (take('-')) {
            const size_t column = at_;
            auto zero = std::make_unique<Expression>();
            zero->column = column;
            return call("-", column, std::move(zero), signed_power());
        }
        auto base = primary();
        if (take('^')) {
            const size_t column = at_;
            return call("^", column, std::move(base), signed_power());
        }
        return base;
    }

    std::unique_ptr<Expression> primary()
    {
        const char c = next();
        if (take('(')) {
            auto inner = sum();
            if (!take(')')) {
                fail("a closing bracket is missing");
            }
            return inner;
        }
        if (c == '"' || c == '\'') {
            return quoted(c);
        }
        if (begins_name(c)) {
            return named();
        }
        return number();
    }

    std::unique_ptr<Expression> quoted(char quote)
    {
        auto result = std::make_unique<Expression>();
        result->kind = Expression::Kind::text;
        result->column = at_ + 1;
        const size_t end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) {
            fail("a text has no end");
        }
        result->word = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        return result;
    }

    std::unique_ptr<Expression> number()
    {
        auto result = std::make_unique<Expression>();
        result->column = at_ + 1;
        const char* begin = text_.data() + at_;
        const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), result->number);
        if (problem != std::errc() || !std::isfinite(result->number)) {
            fail(at_ < text_.size() ? "a number, a name or a bracket is missing" : "something is missing");
        }
        at_ += static_cast<size_t>(end - begin);
        return result;
    }

    std::unique_ptr<Expression> named()
    {
        auto result = std::make_unique<Expression>();
        result->kind = Expression::Kind::name;
        result->column = at_ + 1;
        result->word = word();
        if (take('(')) {
            count_call();
            result->kind = Expression::Kind::call;
            while (!take(')')) {
                if (!result->arguments.empty() && !take(',')) {
                    fail("a comma or a closing bracket is missing");
                }
                result->arguments.push_back(argument());
            }
        }
        return result;
    }

    std::string word()
    {
        const size_t first = at_;
        while (at_ < text_.size() && continues_name(text_[at_])) {
            ++at_;
        }
        return std::string(text_.substr(first, at_ - first));
    }

    Argument argument()
    {
        skip_blanks();
        Argument result;
        result.column = at_ + 1;
        const size_t first = at_;
        if (begins_name(next())) {
            result.name = word();
            if (!take('=')) {
                result.name.clear();
                at_ = first;
            }
        }
        result.value = sum();
        return result;
    }

    std::string_view text_;
    const HeightNode& node_;
    size_t at_ = 0;
    size_t calls_ = 0;
    int level_ = 0;
};

} // namespace

bool is_name(std::string_view text)
{
    return !text.empty() && begins_name(text.front()) && std::ranges::all_of(text, continues_name);
}

std::unique_ptr<Expression> parse_expression(const HeightNode& node)
{
    if (node.expression.size() > longest_text) {
        throw Error(
            fmt::format("node \"{}\" has an expression of more than {} characters", node.name, longest_text),
            node.where, "give its parts names of their own");
    }
    return Reader(node).whole();
}

} // namespace estampe::terrain
