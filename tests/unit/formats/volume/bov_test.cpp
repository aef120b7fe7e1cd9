// BOV, brick of values: types, byte orders, centerings, offsets, components, gzip, refusals, damage.
#include <gtest/gtest.h>

#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

std::string bov(const std::string& format, const std::string& more = "", const std::string& file = "v.values") {
    return "# a brick\nTIME: 2.5\nDATA_FILE: " + file + "\nDATA_SIZE: 2 3 4\nDATA_FORMAT: " + format + "\nVARIABLE: density\n" + more;
}

TEST(Bov, EveryTypeAndByteOrder) {
    const test::TestFolder folder;
    const std::pair<const char*, ValueType> types[] = {
        {"BYTE", ValueType::u8}, {"SHORT", ValueType::i16}, {"INT", ValueType::i32}, {"FLOAT", ValueType::f32}, {"DOUBLE", ValueType::f64}};
    for (const auto& [name, type] : types) {
        const std::string samples = test::telling_bytes(24 * size_of(type));
        for (const bool big : {false, true}) {
            folder.write("v.values", "1234" + (big ? test::swapped(samples, size_of(type)) : samples));
            const std::string path =
                folder.write("v.txt", bov(name, std::string("DATA_ENDIAN: ") + (big ? "BIG" : "LITTLE") + "\nBYTE_OFFSET: 4\n"));
            const auto reader = open_volume(path);
            EXPECT_EQ(reader->info().format, "BOV");
            EXPECT_EQ(reader->info().type, type);
            EXPECT_EQ(reader->info().extent, (Extent{3, {2, 3, 4}}));
            EXPECT_EQ(reader->info().volumes.times, std::vector<double>{2.5});
            EXPECT_TRUE(reader->info().slab_readable);
            EXPECT_EQ(test::read_all(*reader, 3), samples);
            test::expect_slabs_equal_whole(path);
        }
    }
}

TEST(Bov, CenteringDecidesWhereSamplesLie) {
    const test::TestFolder folder;
    folder.write("v.values", std::string(24, 'x'));
    const std::string brick = "BRICK_ORIGIN: 10. 20. 30.\nBRICK_SIZE: 4. 6. 12.\n";
    const auto geometry = [&](const std::string& more) { return open_volume(folder.write("v.bov", bov("BYTE", more)))->info().geometry; };
    for (const std::string nodal : {"", "CENTERING: nodal\n"}) {
        EXPECT_EQ(geometry(brick + nodal).spacing, (Vec3{4, 3, 4}));
        EXPECT_EQ(geometry(brick + nodal).origin, (Vec3{10, 20, 30}));
    }
    EXPECT_EQ(geometry(brick + "CENTERING: zonal\n").spacing, (Vec3{2, 2, 3}));
    EXPECT_EQ(geometry(brick + "CENTERING: zonal\n").origin, (Vec3{11, 21, 31.5}));
    EXPECT_EQ(geometry("").spacing, (Vec3{1, 1, 1}));
}

TEST(Bov, ComponentsAndGzip) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(2 * 48);
    folder.write("v.values.gz", test::gzip("12" + samples));
    const std::string path = folder.write("v.bov", bov("SHORT", "DATA_COMPONENTS: 2\nBYTE_OFFSET: 2\n", "v.values.gz"));
    expect_reason(failure_of_loading(path), ErrorKind::usage, Reason::channel_needed);
    for (const std::size_t component : {0, 1}) {
        std::string expected;
        for (std::size_t i = 0; i < 24; ++i) expected += samples.substr(4 * i + 2 * component, 2);
        OpenOptions options;
        options.channel = std::to_string(component);
        EXPECT_EQ(test::text_of_bytes(load_volume(path, options)), expected);
        test::expect_slabs_equal_whole(path, options);
    }
}

TEST(Bov, Refusals) {
    const test::TestFolder folder;
    folder.write("v.values", std::string(24, 'x'));
    const auto refused = [&](const std::string& header, ErrorKind kind, const std::string& says) {
        expect_helpful(failure_of_loading(folder.write("v.bov", header)), kind, says);
    };
    refused(bov("BYTE", "", "brick%05d.values"), ErrorKind::unsupported, "several files");
    refused(bov("LONG"), ErrorKind::unsupported, "LONG");
    refused(bov("SHORT"), ErrorKind::input, "24 bytes");
    refused(bov("BYTE", "BYTE_OFFSET: 1\n"), ErrorKind::input, "23 bytes");
    refused(bov("BYTE", "BYTE_OFFSET: -1\n"), ErrorKind::input, "negative");
    refused(bov("BYTE", "CENTERING: middle\n"), ErrorKind::input, "CENTERING");
    refused(bov("BYTE", "DATA_ENDIAN: middle\n"), ErrorKind::input, "DATA_ENDIAN");
    refused(bov("BYTE", "DATA_SIZE: 2 3 4\n"), ErrorKind::input, "2 times");
    refused(bov("BYTE", "BRICK_SIZE: 1 nan 1\n"), ErrorKind::input, "BRICK_SIZE");
    refused(bov("BYTE", "DATA_COMPONENTS: 0\n"), ErrorKind::input, "DATA_COMPONENTS");
    refused(bov("BYTE", "BRICK_SIZF: 1 1 1\n"), ErrorKind::input, "brick_size");
    refused(bov("BYTE", "a line\n"), ErrorKind::input, "a line");
    refused(bov("BYTE", "", "missing"), ErrorKind::input, "missing");
    refused("DATA_FILE: v.values\nDATA_SIZE: 4000000000 4000000000 4\n", ErrorKind::input, "63 bits");
    refused("DATA_FILE: v.values\nDATA_SIZE: 2 3\n", ErrorKind::input, "DATA_SIZE");
    expect_reason(failure_of_loading(folder.write("v.bov", bov("BYTE", "", "../v.values"))), ErrorKind::input, Reason::file_outside_folder);
    expect_reason(failure_of_loading(folder.write("v.bov", bov("BYTE", "", "/etc/passwd"))), ErrorKind::input, Reason::file_outside_folder);
}

TEST(Bov, Damage) {
    const test::TestFolder folder;
    folder.write("v.values", test::telling_bytes(48));
    const std::string path = folder / "v.bov";
    const std::string header = bov("SHORT", "DATA_ENDIAN: LITTLE\nBRICK_SIZE: 1 1 1\n");
    for (std::size_t bit = 0; bit < 8 * header.size(); ++bit) {
        std::string damaged = header;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
        folder.write("v.bov", damaged);
        const test::Failure failure = test::failure_of_reading(path, 1 << 20);
        if (!failure.message.empty()) test::expect_user_error(failure, "bit " + std::to_string(bit));
    }
    for (std::size_t size = 0; size < header.find("SHORT") + 5; ++size) {
        folder.write("v.bov", header.substr(0, size));
        test::expect_user_error(test::failure_of_reading(path, 1 << 20), "cut at " + std::to_string(size));
    }
}

}  // namespace
}  // namespace isoatlas
