// RAW files: options, sidecar, telling names, and what the messages suggest.
#include <gtest/gtest.h>

#include "formats/volume/raw_description.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

OpenOptions options_of(std::vector<std::int64_t> dims, ValueType type) {
    OpenOptions options;
    options.dims = std::move(dims);
    options.type = type;
    return options;
}

TEST(Raw, OptionsForEveryType) {
    const test::TestFolder folder;
    for (const ValueType type :
         {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::i16, ValueType::u32, ValueType::i32, ValueType::f32, ValueType::f64}) {
        const std::string samples = test::telling_bytes(24 * size_of(type)), big = test::swapped(samples, size_of(type));
        OpenOptions options = options_of({2, 3, 4}, type);
        const auto little = open_volume(folder.write("v.raw", samples), options);
        EXPECT_EQ(little->info().extent, (Extent{3, {2, 3, 4}}));
        for (std::int64_t slices = 1; slices <= 4; ++slices) EXPECT_EQ(test::read_all(*little, slices), samples);
        options.big_endian = true;
        options.skip_bytes = 5;
        options.spacing = Vec3{1, 2, 3};
        options.origin = Vec3{4, 5, 6};
        const auto other = open_volume(folder.write("v.dat", "12345" + big), options);
        EXPECT_EQ(test::read_all(*other, 3), samples);
        EXPECT_EQ(other->info().geometry.spacing, (Vec3{1, 2, 3}));
        EXPECT_EQ(other->info().geometry.origin, (Vec3{4, 5, 6}));
    }
    EXPECT_EQ(open_volume(folder.write("v.raw", "123456"), options_of({2, 3}, ValueType::u8))->info().extent, (Extent{2, {2, 3, 1}}));
    EXPECT_EQ(open_volume(folder.write("v.raw", "123456"), options_of({2, 3, 1}, ValueType::u8))->info().extent, (Extent{3, {2, 3, 1}}));
}

TEST(Raw, Names) {
    const auto name = [](const std::string& path) { return description_from_name(path); };
    const auto scivis = name("/data/foo_512x512x100_float32.raw");
    EXPECT_EQ(scivis.dims, (std::vector<std::int64_t>{512, 512, 100}));
    EXPECT_EQ(scivis.type, ValueType::f32);
    EXPECT_EQ(name("tooth_103x94x161_uint8.raw").type, ValueType::u8);
    EXPECT_EQ(name("a-7x8_int16_be.raw").big_endian, true);
    EXPECT_EQ(name("a-7x8_int16_be.raw").dims, (std::vector<std::int64_t>{7, 8}));
    EXPECT_EQ(name("x_1x2x3_u16.bin").type, ValueType::u16);
    EXPECT_EQ(name("X_1X2X3_F64.RAW").type, ValueType::f64);
    EXPECT_FALSE(name("x_0x2x3_u8.raw").dims);
    EXPECT_FALSE(name("x_1x2x3x4_u8.raw").dims);
    EXPECT_FALSE(name("box_12.raw").dims);
    EXPECT_FALSE(name("512x512x100_float32/plain.raw").dims);
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(12);
    const Volume volume = load_volume(folder.write("v_3x2_uint16.raw", samples));
    EXPECT_EQ(test::text_of_bytes(volume), samples);
    EXPECT_EQ(volume.info.notes.size(), 3U);  // dims and type from the name, byte order assumed
    EXPECT_EQ(test::text_of_bytes(load_volume(folder.write("v_3x2_uint16_big.bin", test::swapped(samples, 2)))), samples);
    EXPECT_EQ(load_volume(folder.write("w_3x2_uint16.raw", samples), options_of({2, 3}, ValueType::i16)).info.extent,
              (Extent{2, {2, 3, 1}}));
}

TEST(Raw, Sidecar) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(48);
    const std::string path = folder.write("v.raw", "abc" + test::swapped(samples, 2));
    const std::string json = R"({"dims": [2, 3, 4], "type": "int16", "endian": "big", "skip": 3, "spacing": [1, 2, 0.5],
                                 "origin": [1, 2, 3], "unit": "um", "space": "RAS", "author": "me"})";
    for (const char* name : {"v.raw.json", "v.json"}) {
        const std::string sidecar = folder.write(name, json);
        const Volume volume = load_volume(path);
        EXPECT_EQ(test::text_of_bytes(volume), samples);
        EXPECT_EQ(volume.info.geometry.spacing, (Vec3{1, 2, 0.5}));
        EXPECT_EQ(volume.info.geometry.origin, (Vec3{1, 2, 3}));
        EXPECT_EQ(volume.info.geometry.unit, "\u00b5m");
        EXPECT_EQ(volume.info.geometry.space, "RAS");
        EXPECT_EQ(volume.info.notes.size(), 2U);  // the sidecar, its unknown key
        EXPECT_EQ(test::text_of_bytes(load_volume(path, options_of({2, 3, 4}, ValueType::i16))), samples);
        expect_reason(failure_of_loading(path, options_of({4, 3, 2}, ValueType::i16)), ErrorKind::usage, Reason::contradicts_sidecar,
                      "dims");
        std::filesystem::remove(sidecar);
    }
    for (const char* bad : {"{",
                            "[]",
                            "",
                            "{\"dims\": 5}",
                            "{\"dims\": [1]}",
                            "{\"dims\": [1, 2, 3, 4]}",
                            "{\"dims\": [1, 2.5]}",
                            "{\"dims\": [0, 2]}",
                            "{\"dims\": [2, 18446744073709551615]}",
                            "{\"type\": \"long\"}",
                            "{\"type\": 5}",
                            "{\"endian\": \"middle\"}",
                            "{\"skip\": -1}",
                            "{\"skip\": \"1\"}",
                            "{\"spacing\": [1, \"2\"]}",
                            "{\"origin\": 3}",
                            "{\"unit\": 3}",
                            "{\"unit\": null}",
                            "{\"spacing\": [1e999, 1]}",
                            "{\"a\": [[[[[[[[[[1]]]]]]]]]]}"}) {
        SCOPED_TRACE(bad);
        folder.write("v.raw.json", bad);
        const test::Failure failure = failure_of_loading(path);
        expect_helpful(failure, ErrorKind::input, "v.raw.json");
    }
}

TEST(Raw, SizesThatDoNotFit) {
    const test::TestFolder folder;
    const std::string path = folder.write("v.raw", std::string(1000, 'x'));
    const auto reason = [&](std::vector<std::int64_t> dims, ValueType type) {
        const test::Failure failure = failure_of_loading(path, options_of(std::move(dims), type));
        EXPECT_EQ(static_cast<int>(failure.kind), static_cast<int>(ErrorKind::input));
        EXPECT_NE(failure.text.what.find("1000 bytes"), std::string::npos);
        EXPECT_NE(failure.text.next.find(failure.text.value), std::string::npos);
        return std::pair(failure.text.reason, failure.text.value);
    };
    EXPECT_EQ(reason({10, 10, 5}, ValueType::u8), std::pair(Reason::raw_type_differs, std::string("uint16 or int16")));
    EXPECT_EQ(reason({10, 10, 9}, ValueType::u8), std::pair(Reason::raw_last_size_differs, std::string("10")));
    EXPECT_EQ(reason({3, 3, 3}, ValueType::u8), std::pair(Reason::raw_has_more, std::string("973")));
    EXPECT_EQ(reason({11, 11, 11}, ValueType::u8), std::pair(Reason::raw_sizes_differ, std::string("10x10x10")));
    EXPECT_EQ(reason({7, 7, 77}, ValueType::f64), std::pair(Reason::raw_sizes_differ, std::string("5x5x5")));
    EXPECT_EQ(reason({7, 7, 77}, ValueType::f32), std::pair(Reason::raw_size_differs, std::string()));
}

TEST(Raw, Refusals) {
    const test::TestFolder folder;
    const std::string path = folder.write("v.raw", std::string(64, 'x'));
    expect_reason(failure_of_loading(path), ErrorKind::usage, Reason::raw_layout_unknown, "v.raw.json");
    OpenOptions only_dims;
    only_dims.dims = std::vector<std::int64_t>{4, 4, 4};
    expect_helpful(failure_of_loading(path, only_dims), ErrorKind::usage, "its type is not known");
    expect_helpful(failure_of_loading(path, options_of({64}, ValueType::u8)), ErrorKind::usage, "2 or 3");
    expect_helpful(failure_of_loading(path, options_of({4, 4, 2, 2}, ValueType::u8)), ErrorKind::usage, "4 sizes");
    expect_helpful(failure_of_loading(path, options_of({4, 0, 4}, ValueType::u8)), ErrorKind::input, "0 samples");
    expect_helpful(failure_of_loading(path, options_of({4, -4, -4}, ValueType::u8)), ErrorKind::input, "-4 samples");
    expect_helpful(failure_of_loading(path, options_of({std::int64_t{1} << 40, std::int64_t{1} << 40}, ValueType::u8)), ErrorKind::input,
                   "63 bits");
    OpenOptions skip = options_of({4, 4, 4}, ValueType::u8);
    skip.skip_bytes = 65;
    expect_helpful(failure_of_loading(path, skip), ErrorKind::input, "cannot skip 65");
    skip.skip_bytes = -1;
    expect_helpful(failure_of_loading(path, skip), ErrorKind::input, "cannot skip -1");
    OpenOptions step = options_of({4, 4, 4}, ValueType::u8);
    step.time_step = 1;
    expect_helpful(failure_of_loading(path, step), ErrorKind::usage, "no time step 1");
    folder.write("v.mhd", "ObjectType = Image\n");
    expect_helpful(failure_of_loading(path), ErrorKind::usage, "v.mhd");
}

}  // namespace
}  // namespace isoatlas
