// Bytes of strangers become UTF-8, whatever they are.
#include "isoatlas/text.h"

#include <gtest/gtest.h>

#include <random>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

TEST(Text, Utf8StaysAndLatin1IsUnderstood) {
    EXPECT_EQ(header_text("Sch\xc3\xa4"
                          "del \xe2\x82\xac \xf0\x9f\xa6\xb7"),
              "Sch\xc3\xa4"
              "del \xe2\x82\xac \xf0\x9f\xa6\xb7");
    EXPECT_EQ(header_text("\xb5m"), "\xc2\xb5m");
    EXPECT_EQ(header_text("Sch\xe4"
                          "del"),
              "Sch\xc3\xa4"
              "del");
    EXPECT_EQ(header_text("\xb0"
                          "C"),
              "\xc2\xb0"
              "C");
    EXPECT_EQ(header_text("\x80 \x93quoted\x94"), "\xe2\x82\xac \xe2\x80\x9cquoted\xe2\x80\x9d");  // Windows-1252
    EXPECT_EQ(header_text("\xe4\x81"), "\xc3\xa4\\x81");                                           // which has no 0x81
}

TEST(Text, ControlCharactersAreEscaped) {
    EXPECT_EQ(header_text("a\x1b[31mb\nc\x7f"), "a\\x1b[31mb\\x0ac\\x7f");
    EXPECT_EQ(header_text("a\tb\nc\r", true), "a\tb\nc\\x0d");
    EXPECT_EQ(header_text("\xc2\x9b"
                          "31m"),
              "\\x9b31m");  // the one-character form of ESC [
    EXPECT_EQ(header_text(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Text, NamesKeepTheirBytesVisible) {
    EXPECT_EQ(written_name("Sch\xe4"
                           "del.nrrd"),
              "Sch\\xe4"
              "del.nrrd");
    EXPECT_EQ(written_name("a\nb"), "a\nb");
    EXPECT_EQ(shown_name("a\nb\xff"), "a\\x0ab\\xff");
    EXPECT_EQ(shown_name("Sch\xc3\xa4"
                         "del"),
              "Sch\xc3\xa4"
              "del");
    const Error error(ErrorKind::input, {.file = "Sch\xe4"
                                                 "del\x1b.nrrd",
                                         .what = "ends early"});
    EXPECT_STREQ(error.what(),
                 "Sch\\xe4"
                 "del\\x1b.nrrd: ends early");
    EXPECT_EQ(error.text().file,
              "Sch\xe4"
              "del\x1b.nrrd");
}

TEST(Text, PrefixesCutNoCharacter) {
    const std::string text = "a\xc3\xa4\xe2\x82\xac\xf0\x9f\xa6\xb7";
    const std::vector<std::size_t> sizes = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 10};
    for (std::size_t max = 0; max < sizes.size(); ++max) EXPECT_EQ(utf8_prefix(text, max).size(), sizes[max]) << max;
}

TEST(Text, AnyBytesBecomeUtf8AndStayWhatTheyAreThen) {
    std::mt19937 draw(15);
    for (int i = 0; i < 20000; ++i) {
        std::string bytes(draw() % 12, '\0');
        for (char& byte : bytes) byte = static_cast<char>(draw() % 3 == 0 ? draw() % 128 : draw());
        for (const std::string& text :
             {header_text(bytes), header_text(bytes, true), written_name(bytes), shown_name(bytes), decoded_text(bytes)}) {
            ASSERT_TRUE(is_utf8(text));
            ASSERT_EQ(decoded_text(text), text);
            ASSERT_EQ(written_name(text), text);
        }
        ASSERT_EQ(header_text(header_text(bytes)), header_text(bytes));
        ASSERT_EQ(shown_name(shown_name(bytes)), shown_name(bytes));
        ASSERT_TRUE(!is_utf8(bytes) || written_name(bytes) == bytes);
    }
}

TEST(Text, WhatIsNotUtf8) {
    for (const char* bad : {"\x80", "\xc0\x80", "\xc1\xbf", "\xc3", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80",
                            "\xf5\x80\x80\x80"}) {
        EXPECT_FALSE(is_utf8(bad)) << shown_name(bad);
    }
    EXPECT_TRUE(is_utf8("\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf"));
}

TEST(Text, EditDistances) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("abc", ""), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("Saturday", "Sunday"), 3U);
    EXPECT_EQ(edit_distance("--tau", "--tua"), 2U);
}

}  // namespace
}  // namespace isoatlas
