// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "style/schema.hpp"
#include "style/style_test_support.hpp"
#include "support/folder.hpp"

namespace estampe::style::test {
namespace {

std::string read_error(const std::string& text)
{
    Styles styles;
    const Styles before = styles;
    std::string message = message_of([&] { schema().read_text(styles, text, "ink.toml"); });
    EXPECT_EQ(styles, before) << "a failed read changed a value";
    return message;
}

std::string set_error(const std::string& assignment)
{
    Styles styles;
    return message_of([&] { schema().set(styles, assignment); });
}

/// A folder of its own for one test, removed afterwards.
class StyleFiles : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text)
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    ::estampe::test::Folder folder_;
};

TEST(StyleErrors, ValuesOutOfRange)
{
    EXPECT_EQ(read_error("[hatch]\nwidth_mm = 20"),
              "ink.toml:2:12: hatch.width_mm = 20 is out of range; allowed: 0.02 to 10 mm");
    EXPECT_EQ(read_error("[hatch]\nlayers = 0"),
              "ink.toml:2:10: hatch.layers = 0 is out of range; allowed: 1 to 6");
    EXPECT_EQ(set_error("hatch.width_mm=-1"),
              "--set: hatch.width_mm = -1 is out of range; allowed: 0.02 to 10 mm");
    EXPECT_EQ(set_error("hatch.width_mm=1e300"),
              "--set: hatch.width_mm = 1e+300 is out of range; allowed: 0.02 to 10 mm");
    for (const std::string value : {"nan", "inf", "-inf"}) {
        EXPECT_EQ(
            read_error("hatch.width_mm = " + value),
            fmt::format("ink.toml:1:18: hatch.width_mm = {} is not a finite number; allowed: 0.02 to 10 mm",
                        value));
    }
}

TEST(StyleErrors, ValuesOfTheWrongType)
{
    EXPECT_EQ(read_error("hatch.width_mm = \"thick\""),
              "ink.toml:1:18: hatch.width_mm = \"thick\" is not a number; allowed: 0.02 to 10 mm");
    EXPECT_EQ(read_error("hatch.layers = 2.5"),
              "ink.toml:1:16: hatch.layers = 2.5 is not a whole number; allowed: 1 to 6");
    EXPECT_EQ(read_error("hatch.cross = 1"),
              "ink.toml:1:15: hatch.cross = 1 is neither true nor false; allowed: true or false");
    EXPECT_EQ(read_error("hatch.coordinates = 1"),
              "ink.toml:1:21: hatch.coordinates = 1 is not a name in quotes; allowed: auto, uv, projected");
    EXPECT_EQ(read_error("[hatch.width_mm]\nx = 1"),
              "ink.toml:1:8: hatch.width_mm = a table is not a number; allowed: 0.02 to 10 mm");
    EXPECT_EQ(read_error("hatch.width_mm = 1979-05-27"),
              "ink.toml:1:18: hatch.width_mm = a date or time is not a number; allowed: 0.02 to 10 mm");
    EXPECT_EQ(set_error("hatch.width_mm=thick"),
              "--set: hatch.width_mm = \"thick\" is not a number; allowed: 0.02 to 10 mm");
    EXPECT_EQ(set_error("hatch.width_mm="),
              "--set: hatch.width_mm = \"\" is not a number; allowed: 0.02 to 10 mm");
    EXPECT_EQ(set_error("hatch.width_mm=1\nline.wobble=1"),
              "--set: hatch.width_mm = \"1\\x0aline.wobble=1\" is not a number; allowed: 0.02 to 10 mm");
}

TEST(StyleErrors, Colors)
{
    for (const std::string value : {"\"reddest\"", "\"#12345\"", "\"#12345g\"", "\"#+12345\"", "[0.0, 0.5]",
                                    "[0, 0, 1.5]", "[0, 0, nan]", "7"}) {
        const std::string message = read_error("hatch.ink = " + value);
        EXPECT_NE(message.find("is not a colour; allowed: \"#rrggbb\", a name of CSS such as \"ivory\", or "
                               "[r, g, b] of 0 to 1"),
                  std::string::npos)
            << value << " gave " << message;
    }
    EXPECT_EQ(read_error("hatch.ink = [\"a\"]"),
              "ink.toml:1:13: hatch.ink = an array is not a colour; allowed: "
              "\"#rrggbb\", a name of CSS such as \"ivory\", or [r, g, b] of 0 to 1");
}

TEST(StyleErrors, UnknownNamesSuggestTheNearest)
{
    EXPECT_EQ(read_error("[hatch]\nwidht_mm = 1"),
              "ink.toml:2:1: unknown key \"hatch.widht_mm\"; did you mean \"hatch.width_mm\"?");
    EXPECT_EQ(set_error("hatch.width=1"),
              "--set: unknown key \"hatch.width\"; did you mean \"hatch.width_mm\"?");
    EXPECT_EQ(read_error("[hatches]"), "ink.toml:1:2: unknown section \"hatches\"; did you mean \"hatch\"?");
    EXPECT_EQ(read_error("[weather]"), "ink.toml:1:2: unknown section \"weather\"; sections are hatch, line");
    EXPECT_EQ(read_error("hatch.coordinates = \"uvs\""),
              "ink.toml:1:21: hatch.coordinates = \"uvs\" is not one of its choices; did you mean \"uv\"? "
              "allowed: auto, uv, projected");
    EXPECT_EQ(read_error("extend = \"pencil\""),
              "ink.toml:1:1: unknown key \"extend\"; did you mean \"extends\"?");
    EXPECT_EQ(set_error("hatch.qqqqqqqq=1"),
              "--set: unknown key \"hatch.qqqqqqqq\"; estampe --help-style all lists every key");
}

TEST(StyleErrors, MisplacedKeysAreFoundInOtherSections)
{
    EXPECT_EQ(read_error("[line]\ntone_floor = 0.1"),
              "ink.toml:2:1: unknown key \"line.tone_floor\"; did you mean \"hatch.tone_floor\"?");
    EXPECT_EQ(read_error("wobble = 0.1"),
              "ink.toml:1:1: unknown key \"wobble\"; did you mean \"line.wobble\"?");
    EXPECT_EQ(set_error("width_mm=1"), "--set: unknown key \"width_mm\"; did you mean \"hatch.width_mm\"?");
    EXPECT_EQ(read_error("hatch = 3"),
              "ink.toml:1:1: \"hatch\" is a section, not a key; put its keys below a line [hatch]");
    EXPECT_EQ(read_error("[[hatch]]\nlayers = 3"),
              "ink.toml:1:3: \"hatch\" is a section, not a key; put its keys below a line [hatch]");
}

TEST(StyleErrors, TheFirstMistakeOfTheTextIsTold)
{
    EXPECT_EQ(read_error("[line]\nzz = 1\n[hatch]\naa = 1").substr(0, 13), "ink.toml:2:1:");
    EXPECT_EQ(read_error("[line]\nzz = 1\naa = 1").substr(0, 13), "ink.toml:2:1:");
}

TEST(StyleErrors, NotToml)
{
    for (const std::string text :
         {"hatch", "[hatch", "= 3", "hatch.layers = 3\nhatch.layers = 4", "[hatch]\n[hatch]",
          "a = \"\xff\xfe\"", "a = 99999999999999999999", "a = \"\n\"", "a = {", "\x01"}) {
        const std::string message = read_error(text);
        EXPECT_TRUE(message.starts_with("ink.toml:")) << message;
        EXPECT_NE(message.find("not TOML"), std::string::npos) << message;
    }
    EXPECT_NE(read_error(std::string(100000, '[')).find("not TOML"), std::string::npos);
    EXPECT_NE(read_error("a = " + std::string(100000, '[')).find("not TOML"), std::string::npos);
    EXPECT_EQ(read_error("[hatch]\n [=]"), "ink.toml:2:2: not TOML: a table header without a name");
    EXPECT_TRUE(read_error("hatch.layers = 3\nhatch.layers = 4").starts_with("ink.toml:2:")) << "a key twice";
}

TEST(StyleErrors, CharactersBeyondAsciiOutsideOfQuotes)
{
    const std::string message =
        "not TOML: a character beyond ASCII outside of quotes; only strings and comments may "
        "hold it";
    EXPECT_EQ(read_error("# \u00e9\nx = \u00e9"), "ink.toml:2:5: " + message);
    EXPECT_EQ(read_error("hatch.width_mm = 1 \ufefb"), "ink.toml:1:20: " + message);
    EXPECT_EQ(read_error("[\u00a1]"), "ink.toml:1:2: " + message);
    EXPECT_EQ(read_error("\ufeff# a mark of byte order"), "");
    for (const std::string quoted :
         {"\"\u00e9\"", "'\u00e9'", "\"\\\"\u00e9\"", "\"\"\"\n\"\u00e9\"\"\"", "'''\n\u00e9'''"}) {
        EXPECT_NE(read_error("hatch.coordinates = " + quoted).find("is not one of its choices"),
                  std::string::npos)
            << quoted;
        EXPECT_NE(read_error("hatch.coordinates = " + quoted + " \u00e9").find(message), std::string::npos)
            << quoted;
    }
    EXPECT_NE(set_error("hatch.width_mm=\u00e9").find("is not a number"), std::string::npos);
    // Up to two quotes before the closing three belong to the string.
    EXPECT_EQ(read_error("a = \"\"\"a\"\"\"\"\u00e9\""), "ink.toml:1:13: " + message);
    EXPECT_EQ(read_error("a = ''''''''\u00e9'"), "ink.toml:1:13: " + message);
}

TEST(StyleErrors, CharactersBeyondAsciiWithinValuesWithoutQuotes)
{
    for (const std::string text : {"a = +\"\u00e9\"", "a = 3x\"\"\"\u00e9", "a=+sV'\ufefd ",
                                   "a = \"b\"'\u00e9'", "a=+s='\u00e9", "a = 5.'\u0494", "m=+s='\u0414V"}) {
        EXPECT_NE(read_error(text).find("not TOML"), std::string::npos) << text << ": " << read_error(text);
    }
    EXPECT_NE(read_error("\ufeff\"hatch\".nothing = 1").find("nothing"), std::string::npos)
        << "a quoted key after a mark of byte order";
    EXPECT_NE(read_error("a.\"b\".'c' = [\"\u00e9\",'\u00e9',{\"d\"=\"\u00e9\"}]").find("unknown"),
              std::string::npos)
        << "keys and values in quotes";
}

TEST(StyleErrors, CharactersBeyondAsciiMayBeginAJoinedLine)
{
    for (const std::string line : {"\u00e9", "b\u00e9"}) {
        EXPECT_NE(
            read_error("hatch.coordinates = \"\"\"a \\\n  " + line + "\"\"\"").find("is not one of its"),
            std::string::npos);
    }
}

TEST(StyleErrors, NotUtf8)
{
    const std::string remedy = " begins no character of UTF-8; save the file as UTF-8";
    EXPECT_EQ(read_error("# \u00e9\u20ac\U0001f58b\n\u00e9 \xf4\x90\x80\x80 = 1"),
              "ink.toml:2:3: not TOML: byte 0xf4" + remedy)
        << "the first character beyond Unicode";
    for (const std::string text :
         {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xe0\x80\x80", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf",
          "\xed\xa0\x80", "\xed\xbf\xbf", "\xf5\x80\x80\x80", "\xf7\xbf\xbf\xbf", "\xf8\x88\x80\x80\x80",
          "\xff", "\xc3", "\xe2\x82", "\xf0\x9f\x96", "\xe2\x82 ", "\xc3\n"}) {
        const auto byte = static_cast<unsigned char>(text.front());
        const std::string message = fmt::format("not TOML: byte 0x{:02x}{}", byte, remedy);
        EXPECT_EQ(read_error("# " + text), "ink.toml:1:3: " + message);
        EXPECT_EQ(read_error("hatch.coordinates = \"" + text), "ink.toml:1:22: " + message);
        EXPECT_NE(set_error("hatch.width_mm=" + text).find("is not a number"), std::string::npos);
        EXPECT_NE(set_error("hatch.coordinates=\"" + text + "\"").find("is not one of its choices"),
                  std::string::npos);
    }
    for (const std::string text :
         {"\u0080", "\u07ff", "\u0800", "\ud7ff", "\ue000", "\uffff", "\U00010000", "\U0010ffff"}) {
        EXPECT_EQ(read_error("# " + text), "");
    }
}

TEST(StyleErrors, NotAnAssignment)
{
    for (const std::string text : {"", "=", "=1", "hatch.width_mm"}) {
        EXPECT_NE(set_error(text).find("write section.key=value"), std::string::npos) << text;
    }
    EXPECT_FALSE(set_error(".=1").empty());
    EXPECT_FALSE(set_error(std::string(100000, 'x') + "=1").empty());
}

TEST_F(StyleFiles, ExtendsPutsTheBaseFirst)
{
    write("base.toml", "[hatch]\nlayers = 5\ncross = false\n");
    write("sub/middle.toml", "extends = \"../base.toml\"\nline.wobble = 0.25\n");
    const auto top = write("top.toml", "hatch.layers = 2\n");
    const auto path = write("sub/top.toml", "line.width_mm = 1\nextends = \"./middle.toml\"");
    Styles styles;
    schema().read(styles, path.string());
    EXPECT_EQ(styles.hatch.layers, 5);
    EXPECT_FALSE(styles.hatch.cross);
    EXPECT_EQ(styles.line.wobble, 0.25F);
    EXPECT_EQ(styles.line.width_mm, 1.0F);
    schema().read(styles, top.string());
    EXPECT_EQ(styles.hatch.layers, 2);
}

TEST_F(StyleFiles, ExtendsMayNotGoInACircle)
{
    const auto itself = write("itself.toml", "extends = \"itself.toml\"");
    const auto first = write("first.toml", "\nextends = \"./second.toml\"");
    write("second.toml", "extends = \"first.toml\"");
    Styles styles;
    EXPECT_EQ(message_of([&] { schema().read(styles, itself.string()); }),
              fmt::format("{0}:1:11: extends goes in a circle: {0} -> {0}; remove one extends line",
                          itself.string()));
    EXPECT_NE(message_of([&] { schema().read(styles, first.string()); }).find("in a circle"),
              std::string::npos);
}

TEST_F(StyleFiles, AChainOfExtendsHasAnEnd)
{
    std::filesystem::path path = write("0.toml", "");
    for (int i = 1; i < 16; ++i)
        path = write(fmt::format("{}.toml", i), fmt::format("extends = \"{}.toml\"", i - 1));
    Styles styles;
    schema().read(styles, path.string());
    const auto longest = write("16.toml", "extends = \"15.toml\"");
    const std::string message = message_of([&] { schema().read(styles, longest.string()); });
    EXPECT_NE(message.find("1.toml:1:11: is the 17th style of a chain of extends; 16 are the most"),
              std::string::npos)
        << message;
    EXPECT_EQ(message.find("circle"), std::string::npos);
}

TEST_F(StyleFiles, ExtendsOfNothing)
{
    const auto path = write("a.toml", "extends = \"missing.toml\"");
    Styles styles;
    const std::string message = message_of([&] { schema().read(styles, path.string()); });
    EXPECT_TRUE(message.starts_with(path.string() + ":1:11: ")) << message;
    EXPECT_NE(message.find("missing.toml: cannot open"), std::string::npos) << message;
    EXPECT_NE(read_error("extends = 3").find("is not a name"), std::string::npos);
    EXPECT_NE(read_error("extends = \"\"").find("is not a name"), std::string::npos);
    EXPECT_NE(read_error("[extends]").find("unknown section"), std::string::npos);
}

TEST_F(StyleFiles, MessagesQuoteNoFileThatIsExtended)
{
    for (const char* text : {"hunter2:x:0:0", "hunter2 = 1", "[hunter2]", "hatch.hunter2 = 1",
                             "hatch.width_mm = \"hunter2\"", "extends = \"hunter2\"", "extends = hunter2"}) {
        const std::string secret = write("secret", text).string();
        const auto top = write("top.toml", "extends = \"./middle.toml\"");
        const auto middle = write("middle.toml", "hatch.layers = 2\nextends = \"./secret\"");
        Styles styles;
        for (const std::filesystem::path& path : {top, middle}) {
            const std::string message = message_of([&] { schema().read(styles, path.string()); });
            EXPECT_EQ(message.find("hunter2"), std::string::npos) << message;
            EXPECT_TRUE(message.starts_with(secret + ":1:")) << message;
            EXPECT_NE(message.find("is no style that can be extended"), std::string::npos) << message;
            EXPECT_NE(message.find(middle.string() + ":2:11"), std::string::npos) << message;
        }
    }
}

TEST_F(StyleFiles, TheStyleThatTheUserNamesIsQuoted)
{
    const auto own = write("own.toml", "hunter2 = 1");
    Styles styles;
    EXPECT_NE(message_of([&] { schema().read(styles, own.string()); }).find("hunter2"), std::string::npos);
}

TEST_F(StyleFiles, AScopeLimitsWhatTheyName)
{
    write("secret.toml", "hatch.layers = 2");
    const std::string absolute = write("in/own.toml", "hatch.layers = 3").string();
    std::filesystem::create_symlink("../secret.toml", folder_ / "in/link.toml");
    const ReadScope scope{{folder_ / "in"}};
    Styles styles;
    schema().read(styles, write("in/a.toml", "extends = \"./own.toml\"").string(), scope);
    EXPECT_EQ(styles.hatch.layers, 3);
    for (const std::string& name : {std::string("../secret.toml"), std::string("./../in/own.toml"), absolute,
                                    std::string("./link.toml"), std::string("..\\\\secret.toml")}) {
        const auto path = write("in/a.toml", "\nextends = \"" + name + "\"");
        const std::string message = message_of([&] { schema().read(styles, path.string(), scope); });
        EXPECT_TRUE(message.starts_with(path.string() + ":2:11: ")) << message;
        EXPECT_NE(message.find("outside the folder " + (folder_ / "in").string()), std::string::npos)
            << message;
    }
    EXPECT_NE(message_of([&] { schema().read(styles, (folder_ / "in/link.toml").string(), scope); }), "");
    EXPECT_NE(message_of([&] { schema().read(styles, (folder_ / "secret.toml").string(), scope); }), "");
}

TEST_F(StyleFiles, FilesThatCannotBeStyles)
{
    Styles styles;
    EXPECT_NE(message_of([&] {
                  schema().read(styles, (folder_ / "none.toml").string());
              }).find("none.toml: cannot open: No such file"),
              std::string::npos);
    EXPECT_NE(
        message_of([&] { schema().read(styles, "no_preset_of_this_name"); }).find("no preset or style file"),
        std::string::npos);
    EXPECT_NE(
        message_of([&] { schema().read(styles, folder_.path().string()); }).find("is not a regular file"),
        std::string::npos);
    const auto huge = write("huge.toml", "");
    std::filesystem::resize_file(huge, uintmax_t{1} << 40);
    EXPECT_NE(
        message_of([&] { schema().read(styles, huge.string()); }).find("more than the limit of 1048576"),
        std::string::npos);
    EXPECT_NE(message_of([&] { schema().read(styles, "/dev/zero/"); }), "");
    EXPECT_NE(message_of([&] { schema().read(styles, ""); }), "");
}

} // namespace
} // namespace estampe::style::test
