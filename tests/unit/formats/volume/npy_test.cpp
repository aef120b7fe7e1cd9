// NumPy files: types, byte orders, axis orders, versions, refusals.
#include <gtest/gtest.h>

#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

std::string npy(const std::string& dictionary, const std::string& samples, int version = 1) {
    std::string text = dictionary + "\n";
    while ((text.size() + 12) % 16 != 0) text.insert(text.size() - 1, " ");
    std::string file = "\x93NUMPY";
    file += static_cast<char>(version);
    file += '\0';
    const std::size_t length_bytes = version == 1 ? 2 : 4;
    for (std::size_t i = 0; i < length_bytes; ++i) file += static_cast<char>(text.size() >> (8 * i));
    return file + text + samples;
}

std::string dictionary(const std::string& type, const std::string& shape, bool fortran = false) {
    return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
}

TEST(Npy, EveryTypeAndByteOrder) {
    const test::TestFolder folder;
    const std::pair<std::string, ValueType> types[] = {{"u1", ValueType::u8},  {"i1", ValueType::i8},  {"u2", ValueType::u16},
                                                       {"i2", ValueType::i16}, {"u4", ValueType::u32}, {"i4", ValueType::i32},
                                                       {"f4", ValueType::f32}, {"f8", ValueType::f64}};
    for (const auto& [name, type] : types) {
        const std::string samples = test::telling_bytes(24 * size_of(type)), big = test::swapped(samples, size_of(type));
        for (const std::string order : {"<", ">", "="}) {
            for (const int version : {1, 2, 3}) {
                SCOPED_TRACE(order + name);
                const std::string path =
                    folder.write("v.npy", npy(dictionary(order + name, "(4, 3, 2)"), order == ">" ? big : samples, version));
                const auto reader = open_volume(path);
                EXPECT_EQ(reader->info().type, type);
                EXPECT_EQ(reader->info().extent, (Extent{3, {2, 3, 4}}));
                EXPECT_TRUE(reader->info().slab_readable);
                for (std::int64_t slices = 1; slices <= 4; ++slices) EXPECT_EQ(test::read_all(*reader, slices), samples);
            }
        }
    }
}

TEST(Npy, AxisOrders) {
    const test::TestFolder folder;
    const auto extent = [&](const std::string& shape, bool fortran) {
        return open_volume(folder.write("v.npy", npy(dictionary("|u1", shape, fortran), std::string(24, 'x'))))->info().extent;
    };
    EXPECT_EQ(extent("(4, 3, 2)", false), (Extent{3, {2, 3, 4}}));
    EXPECT_EQ(extent("(4, 3, 2)", true), (Extent{3, {4, 3, 2}}));
    EXPECT_EQ(extent("(6, 4)", false), (Extent{2, {4, 6, 1}}));
    EXPECT_EQ(extent("(6, 4)", true), (Extent{2, {6, 4, 1}}));
    EXPECT_EQ(extent("(1, 6, 4)", false), (Extent{3, {4, 6, 1}}));
    EXPECT_EQ(extent("(6L, 4L,)", false), (Extent{2, {4, 6, 1}}));
}

TEST(Npy, BooleansAndSeries) {
    const test::TestFolder folder;
    const std::string path = folder.write("v.npy", npy(dictionary("|b1", "(2, 2)"), std::string("\0\1\1\0", 4)));
    EXPECT_EQ(test::text_of_bytes(load_volume(path)), std::string("\0\1\1\0", 4));
    const std::string samples = test::telling_bytes(24);
    for (const bool fortran : {false, true}) {
        const std::string series =
            folder.write("t.npy", npy(dictionary("|u1", fortran ? "(1, 2, 3, 4)" : "(4, 3, 2, 1)", fortran), samples));
        expect_reason(failure_of_loading(series), ErrorKind::usage, Reason::time_step_needed, "3");
        OpenOptions options;
        options.time_step = 2;
        EXPECT_EQ(test::text_of_bytes(load_volume(series, options)), samples.substr(12, 6));
    }
}

TEST(Npy, Refusals) {
    const test::TestFolder folder;
    struct Case {
        std::string text;
        ErrorKind kind;
        std::string words;
    };
    const std::string good = npy(dictionary("|u1", "(2, 2)"), "1234");
    const std::vector<Case> cases = {
        {npy(dictionary("<f2", "(2, 2)"), "12345678"), ErrorKind::unsupported, "astype"},
        {npy(dictionary("|i8", "(2, 2)"), "12345678"), ErrorKind::input, "byte order"},
        {npy(dictionary("<c8", "(2, 2)"), "12345678"), ErrorKind::unsupported, "astype"},
        {npy(dictionary("|O", "(2, 2)"), "12345678"), ErrorKind::input, "'|O'"},
        {npy(dictionary("|f4", "(2, 2)"), "12345678"), ErrorKind::input, "byte order"},
        {npy("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 2), }", "1234"), ErrorKind::unsupported, "structured"},
        {npy("{'fortran_order': False, 'shape': (2, 2), }", "1234"), ErrorKind::input, "'descr' is missing"},
        {npy("{'descr': '|u1', 'fortran_order': False, }", "1234"), ErrorKind::input, "'shape' is missing"},
        {npy("{'descr': '|u1', 'fortran_order': Perhaps, 'shape': (2, 2)}", "1234"), ErrorKind::input, "fortran_order"},
        {npy("{'descr': '|u1', 'shape': (9, 9), 'fortran_order': False, 'shape': (2, 2)}", "1234"), ErrorKind::input, "twice"},
        {npy(dictionary("|u1", "(4,)"), "1234"), ErrorKind::unsupported, "1 axes"},
        {npy(dictionary("|u1", "()"), "1234"), ErrorKind::unsupported, "0 axes"},
        {npy(dictionary("|u1", "(1, 1, 1, 2, 2)"), "1234"), ErrorKind::unsupported, "5 axes"},
        {npy(dictionary("|u1", "(2, x)"), "1234"), ErrorKind::input, "'shape'"},
        {npy(dictionary("|u1", "(2, 2"), "1234"), ErrorKind::input, "'shape'"},
        {npy(dictionary("|u1", "(2, 0)"), "1234"), ErrorKind::input, "0 samples"},
        {npy(dictionary("|u1", "(2, -2)"), "1234"), ErrorKind::input, "-2 samples"},
        {npy(dictionary("|u1", "(1099511627776, 1099511627776)"), "1234"), ErrorKind::input, "63 bits"},
        {npy(dictionary("|u1", "(1099511627776, 1024)"), "1234"), ErrorKind::input, "the file holds 4 bytes"},
        {npy(dictionary("|u1", "(2, 2)"), "1234", 4), ErrorKind::unsupported, "version 4"},
        {good.substr(0, 40), ErrorKind::input, "claims"},
        {good.substr(0, 8), ErrorKind::input, "ends early"},
        {good.substr(0, good.size() - 1), ErrorKind::input, "holds 3 bytes"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        expect_helpful(failure_of_loading(folder.write("v.npy", c.text)), c.kind, c.words);
    }
}

}  // namespace
}  // namespace isoatlas
