// SPDX-License-Identifier: MIT
#include "scene/input/input.hpp"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe {
namespace {

std::vector<std::string> lines_of(const std::string& text)
{
    Input input(std::as_bytes(std::span(text)), "text");
    input.detect_encoding();
    std::vector<std::string> lines;
    std::string_view line;
    while (input.next_line(line))
        lines.emplace_back(line);
    EXPECT_EQ(input.line_number(), lines.size());
    return lines;
}

using Lines = std::vector<std::string>;

std::string utf16(const std::u16string& text, bool is_big_endian)
{
    std::string bytes;
    for (const char16_t unit : text) {
        const char high = static_cast<char>(unit >> 8);
        const char low = static_cast<char>(unit & 0xFF);
        bytes += is_big_endian ? high : low;
        bytes += is_big_endian ? low : high;
    }
    return bytes;
}

TEST(Input, LinesEndInAnyWay)
{
    EXPECT_EQ(lines_of("a\nb\r\nc\rd"), (Lines{"a", "b", "c", "d"}));
    EXPECT_EQ(lines_of("a\n\nb\r\r\nc\r"), (Lines{"a", "", "b", "", "c"}));
    EXPECT_EQ(lines_of("\n"), (Lines{""}));
    EXPECT_EQ(lines_of(""), Lines{});
}

TEST(Input, LinesAreWholeWhereverTheBufferEnds)
{
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text;
        Lines expected;
        for (size_t i = 0; i < 60000; ++i) {
            expected.push_back(std::string(i % 23, 'x') + std::to_string(i));
            text += expected.back() + end;
        }
        EXPECT_EQ(lines_of(text), expected);
    }
    const std::string long_line(3'000'000, 'y');
    EXPECT_EQ(lines_of(long_line + "\nz"), (Lines{long_line, "z"}));
}

TEST(Input, SaysWhetherTheLastLineHasAnEnd)
{
    const std::string text = "a\nb";
    Input input(std::as_bytes(std::span(text)), "text");
    std::string_view line;
    ASSERT_TRUE(input.next_line(line));
    EXPECT_TRUE(input.line_was_ended());
    ASSERT_TRUE(input.next_line(line));
    EXPECT_FALSE(input.line_was_ended());
    EXPECT_EQ(input.place(), "text:2");
}

TEST(Input, ByteOrderMarksAndUtf16)
{
    EXPECT_EQ(lines_of("\xEF\xBB\xBFmtllib a.mtl\nb"), (Lines{"mtllib a.mtl", "b"}));
    const std::u16string text = u"g caf\u00E9 \U0001F409\r\nf 1 2 3\n";
    const Lines expected{"g caf\xC3\xA9 \xF0\x9F\x90\x89", "f 1 2 3"};
    for (const bool is_big_endian : {false, true}) {
        EXPECT_EQ(lines_of(utf16(u"\uFEFF" + text, is_big_endian)), expected);
        EXPECT_EQ(lines_of(utf16(u"v 0 0 0\nv 1 0 0\n", is_big_endian)), (Lines{"v 0 0 0", "v 1 0 0"}));
    }
    const std::u16string lone{u'a', char16_t{0xD800}, u'b', char16_t{0xDC00}};
    EXPECT_EQ(lines_of(utf16(u"\uFEFF" + lone, false)), (Lines{"a\xEF\xBF\xBD"
                                                               "b\xEF\xBF\xBD"}));
}

TEST(Input, BytesComeInAnySizes)
{
    std::string bytes(700000, '\0');
    for (size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(i * 31);
    Input input(std::as_bytes(std::span(bytes)), "bytes");
    std::string read;
    for (size_t size = 1; input.bytes_left() > 0; size = size * 3 + 1) {
        const std::string_view some = input.peek(size);
        ASSERT_GE(some.size(), std::min<uint64_t>(size, input.bytes_left()));
        const size_t taken = std::min(size, some.size());
        read += some.substr(0, taken);
        input.skip(taken);
    }
    EXPECT_EQ(read, bytes);
    EXPECT_TRUE(input.peek(1).empty());
}

TEST(Input, OnlyRegularFilesAreOpened)
{
    const test::Folder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const std::filesystem::path& path :
         {folder / "absent", folder / "pipe", folder.path(), std::filesystem::path("/dev/zero")}) {
        try {
            const Input input(path);
            ADD_FAILURE() << path;
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), path.string());
        }
    }
}

TEST(Scanner, ReadsNumbersAsTheyAreWritten)
{
    const auto number = [](const std::string& word) {
        double value = -1.0;
        EXPECT_TRUE(Scanner(word).number(value)) << word;
        return value;
    };
    for (const char* const word :
         {"0", "-0", "1", "-1.5", "0.1", "123456.789", ".5", "5.", "-.25", "1e5", "1E-5", "123456789012345",
          "1234567890123456", "12345678901234567890", "0.000000000000001", "3.141592653589793238462643",
          "179769313486231570000000000000", "4.9e-324", "0.30000000000000004"}) {
        const double expected = std::strtod(word, nullptr);
        const double value = number(word);
        EXPECT_EQ(std::memcmp(&value, &expected, sizeof value), 0) << word;
    }
    EXPECT_EQ(number("+2.5"), 2.5);
    EXPECT_EQ(number("0,75"), 0.75);
    EXPECT_EQ(number("1e-400"), 0.0);
    EXPECT_TRUE(std::isinf(number("1e400")));
    for (const char* const word :
         {"nan", "x", "-", ".", "1.2.3", "1,2,3", "12a", "1.#QNAN", "--1", "1e", ","})
        EXPECT_TRUE(std::isnan(number(word))) << word;
    double value = 0.0;
    EXPECT_FALSE(Scanner(" \t ").number(value));
}

TEST(Scanner, CutsAtBlanks)
{
    Scanner words("  usemtl\t my red  paint \t");
    EXPECT_EQ(words.word(), "usemtl");
    EXPECT_EQ(words.rest(), "my red  paint");
    EXPECT_FALSE(words.is_done());
    EXPECT_EQ(words.word(), "my");
    EXPECT_EQ(words.word(), "red");
    EXPECT_EQ(words.word(), "paint");
    EXPECT_TRUE(words.is_done());
    EXPECT_EQ(words.word(), "");
}

Bounds box(const glm::dvec3& center, double size)
{
    Bounds bounds;
    bounds.extend(center - glm::dvec3(0.5 * size));
    bounds.extend(center + glm::dvec3(0.5 * size));
    return bounds;
}

TEST(Origin, OnlyWhatLiesFarOffIsMoved)
{
    EXPECT_EQ(file_origin(box({3.0, 1.0, 0.0}, 2.0)), glm::dvec3(0.0));
    EXPECT_EQ(file_origin(box({30.0, 1.0, 0.0}, 2.0)), glm::dvec3(0.0));
    EXPECT_EQ(file_origin(box({12958095.1, 4865500.2, 35.0}, 1.6)), glm::dvec3(12958095.0, 4865500.0, 35.0));
    EXPECT_EQ(file_origin(Bounds{}), glm::dvec3(0.0));
    const glm::dvec3 tiny = file_origin(box({0.3, 0.0, 0.0}, 1e-3));
    EXPECT_NEAR(tiny.x, 0.3, 1e-3);
    EXPECT_EQ(file_origin(box({0.3, 0.0, 0.0}, 0.0)), glm::dvec3(0.0)) << "a single point";
}

TEST(Origin, ASmallObjectFarFromTheOthersHasItsOwn)
{
    const glm::dvec3 file(100.0, 0.0, 0.0);
    EXPECT_EQ(object_origin(box({150.0, 0.0, 0.0}, 1.0), file), file);
    EXPECT_EQ(object_origin(box({5e6, 0.0, 0.0}, 1.0), file), glm::dvec3(5e6, 0.0, 0.0));
}

} // namespace
} // namespace estampe
