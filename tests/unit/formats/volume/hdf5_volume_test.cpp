// HDF5: types, chunks, filters, choices, links, conventions; what is damaged or lies is refused.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "formats/volume/half_source.h"
#include "unit/formats/volume/hdf5_files.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;
using test::Hdf5Maker;

OpenOptions with_dataset(const std::string& path) {
    OpenOptions options;
    options.dataset = path;
    return options;
}

std::string samples_of(const std::string& path, const OpenOptions& options = {}) {
    const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
    return test::read_all(*reader, reader->info().extent.size[2]);
}

TEST(Hdf5Volume, EveryTypeAndByteOrder) {
    const test::TestFolder folder;
    const std::array<std::tuple<hid_t, hid_t, hid_t, ValueType>, 8> types{
        {{H5T_STD_U8LE, H5T_STD_U8BE, H5T_NATIVE_UINT8, ValueType::u8},
         {H5T_STD_I8LE, H5T_STD_I8BE, H5T_NATIVE_INT8, ValueType::i8},
         {H5T_STD_U16LE, H5T_STD_U16BE, H5T_NATIVE_UINT16, ValueType::u16},
         {H5T_STD_I16LE, H5T_STD_I16BE, H5T_NATIVE_INT16, ValueType::i16},
         {H5T_STD_U32LE, H5T_STD_U32BE, H5T_NATIVE_UINT32, ValueType::u32},
         {H5T_STD_I32LE, H5T_STD_I32BE, H5T_NATIVE_INT32, ValueType::i32},
         {H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_NATIVE_FLOAT, ValueType::f32},
         {H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_NATIVE_DOUBLE, ValueType::f64}}};
    for (const auto& [little, big, memory, type] : types) {
        const std::string samples = test::telling_bytes(24 * size_of(type));
        for (const hid_t stored : {little, big}) {
            SCOPED_TRACE(name_of(type));
            {
                Hdf5Maker(folder / "v.bin").array("/a/v", {4, 3, 2}, stored, memory, samples.data());
            }
            const auto reader = open_volume(folder / "v.bin");
            EXPECT_EQ(reader->info().format, "HDF5");
            EXPECT_EQ(reader->info().type, type);
            EXPECT_EQ(reader->info().big_endian, stored == big && size_of(type) > 1);
            EXPECT_EQ(reader->info().extent, (Extent{3, {2, 3, 4}}));
            EXPECT_TRUE(reader->info().slab_readable);
            EXPECT_EQ(test::read_all(*reader, 4), samples);
            test::expect_slabs_equal_whole(folder / "v.bin");
        }
    }
}

TEST(Hdf5Volume, HalvesAreReadInAnySlabs) {
    const test::TestFolder folder;
    for (const bool big : {false, true}) {
        const hid_t half = H5Tcopy(big ? H5T_IEEE_F32BE : H5T_IEEE_F32LE);
        H5Tset_fields(half, 15, 10, 5, 0, 10);
        H5Tset_size(half, 2);
        H5Tset_ebias(half, 15);
        std::vector<std::uint16_t> bits;
        std::vector<float> expected;
        for (std::uint16_t i = 0; i < 24; ++i)
            bits.push_back(static_cast<std::uint16_t>(37 * i + 0x3c00 - 600)), expected.push_back(float_of_half(bits.back()));
        {
            Hdf5Maker(folder / "v.h5").array("/v", {4, 3, 2}, half, half, test::swapped(test::bytes_of(bits), big ? 2 : 1).data());
        }
        EXPECT_EQ(open_volume(folder / "v.h5")->info().type, ValueType::f32);
        EXPECT_EQ(samples_of(folder / "v.h5"), test::bytes_of(expected));
        test::expect_slabs_equal_whole(folder / "v.h5");
    }
}

RC_GTEST_PROP(Hdf5Volume, AnyBoxOfAnyChunks, ()) {
    const test::TestFolder folder;
    const auto size = [] { return static_cast<hsize_t>(*rc::gen::inRange(2, 9)); };
    const std::vector<hsize_t> dims{size(), size(), size()};
    Hdf5Maker::Storage storage;
    const int filters = *rc::gen::inRange(0, 8);
    if (filters > 0)
        storage.chunk = {*rc::gen::inRange<hsize_t>(1, dims[0] + 1), *rc::gen::inRange<hsize_t>(1, dims[1] + 1),
                         *rc::gen::inRange<hsize_t>(1, dims[2] + 1)};
    if ((filters & 1) != 0) storage.gzip = 6;
    storage.shuffle = (filters & 2) != 0, storage.fletcher = (filters & 4) != 0;
    if (filters == 0) storage = {};
    std::vector<std::uint16_t> samples(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint16_t>(257 * i + 1);
    {
        Hdf5Maker(folder / "v.h5").array("/v", dims, H5T_STD_U16BE, H5T_NATIVE_UINT16, samples.data(), storage);
    }
    const auto reader = open_volume(folder / "v.h5");
    const Extent& extent = reader->info().extent;
    if (!storage.chunk.empty())
        RC_ASSERT(reader->info().chunk == (Index3{static_cast<std::int64_t>(storage.chunk[2]), static_cast<std::int64_t>(storage.chunk[1]),
                                                  static_cast<std::int64_t>(storage.chunk[0])}));
    SampleBox box;
    for (std::size_t a = 0; a < 3; ++a) {
        box.begin[a] = *rc::gen::inRange<std::int64_t>(0, extent.size[a]);
        box.end[a] = *rc::gen::inRange<std::int64_t>(box.begin[a] + 1, extent.size[a] + 1);
    }
    std::vector<std::uint16_t> got(static_cast<std::size_t>(box.size().product()));
    reader->read_box(box, std::as_writable_bytes(std::span(got)));
    std::size_t i = 0;
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
            for (std::int64_t x = box.begin[0]; x < box.end[0]; ++x)
                RC_ASSERT(got[i++] == samples[static_cast<std::size_t>(extent.index(x, y, z))]);
        }
    }
}

TEST(Hdf5Volume, ChoicesAndRefusals) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.h5", 512);
        maker.bytes("/g/one", {2, 2, 2}, "abcdefgh");
        maker.bytes("/two", {2, 4}, "ABCDEFGH");
        maker.bytes("/flat", {1, 4}, "1234");
        maker.bytes("/line", {4}, "1234");
        maker.bytes("/steps", {2, 2, 2, 2}, "0123456789abcdef");
        maker.array("/long", {2, 2}, H5T_STD_I64LE, H5T_NATIVE_UINT8, nullptr);
        const hid_t compound = H5Tcreate(H5T_COMPOUND, 8);
        H5Tinsert(compound, "re", 0, H5T_IEEE_F32LE), H5Tinsert(compound, "im", 4, H5T_IEEE_F32LE);
        maker.array("/complex", {2, 2}, compound, compound, nullptr);
    }
    const test::Failure several = failure_of_loading(folder / "v.h5");
    EXPECT_EQ(several.kind, ErrorKind::usage);
    EXPECT_EQ(several.text.reason, Reason::dataset_needed);
    EXPECT_EQ(several.text.choices,
              (std::vector<ErrorChoice>{{"/long", "2 x 2 int64"}, {"/two", "4 x 2 uint8"}, {"/g/one", "2 x 2 x 2 uint8"}}));
    EXPECT_EQ(samples_of(folder / "v.h5", with_dataset("/g/one")), "abcdefgh");
    EXPECT_EQ(samples_of(folder / "v.h5", with_dataset("g")), "abcdefgh");
    EXPECT_EQ(samples_of((folder / "v.h5") + ":/two"), "ABCDEFGH");
    EXPECT_EQ(open_volume(folder / "v.h5", with_dataset("/two"))->info().extent, (Extent{2, {4, 2, 1}}));
    EXPECT_EQ(samples_of(folder / "v.h5", with_dataset("/flat")), "1234");
    OpenOptions second = with_dataset("/steps");
    EXPECT_EQ(test::failure_of([&] { (void)open_volume(folder / "v.h5", second); }).text.reason, Reason::time_step_needed);
    second.time_step = 1;
    EXPECT_EQ(samples_of(folder / "v.h5", second), "89abcdef");
    const auto refused = [&](const std::string& dataset, ErrorKind kind, const std::string& says) {
        expect_helpful(test::failure_of([&] { (void)open_volume(folder / "v.h5", with_dataset(dataset)); }), kind, says);
    };
    refused("/line", ErrorKind::unsupported, "4 uint8");
    EXPECT_EQ(open_volume(folder / "v.h5", with_dataset("/long"))->info().type, ValueType::f64);
    EXPECT_EQ(samples_of(folder / "v.h5", with_dataset("/long")), std::string(32, '\0'));  // never written, behind a user block
    refused("/complex", ErrorKind::unsupported, "compound");
    refused("/nothing", ErrorKind::usage, "nothing");
    {
        const Hdf5Maker maker(folder / "lines.h5");
        for (int i = 10; i < 35; ++i) maker.bytes("/line" + std::to_string(i), {4}, "1234");
    }
    expect_helpful(failure_of_loading(folder / "lines.h5"), ErrorKind::unsupported, "/line29 (4 uint8), ...");
}

TEST(Hdf5Volume, LinksAndCyclesEnd) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.h5");
        maker.bytes("/g/v", {2, 4}, "ABCDEFGH");
        H5Lcreate_hard(maker.file, "/g", maker.file, "/g/again", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_hard(maker.file, "/g/v", maker.file, "/g/zz", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_soft("/g", maker.file, "/soft", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_soft("/loop", maker.file, "/loop", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_external("v.h5", "/", maker.file, "/self", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_external("other.h5", "/v", maker.file, "/missing", H5P_DEFAULT, H5P_DEFAULT);
    }
    EXPECT_EQ(samples_of(folder / "v.h5"), "ABCDEFGH");
    EXPECT_EQ(samples_of(folder / "v.h5", with_dataset("/self/soft/again/zz")), "ABCDEFGH");
    expect_helpful(test::failure_of([&] { (void)open_volume(folder / "v.h5", with_dataset("/missing")); }), ErrorKind::input, "other.h5");
}

TEST(Hdf5Volume, LinksOutOfTheFolderNeedPermission) {
    const test::TestFolder folder;
    std::filesystem::create_directory(folder / "in");
    {
        Hdf5Maker(folder / "secret.h5").bytes("/v", {2, 4}, "ABCDEFGH");
    }
    {
        const Hdf5Maker maker(folder / "in/v.h5");
        H5Lcreate_external("../secret.h5", "/v", maker.file, "/linked", H5P_DEFAULT, H5P_DEFAULT);
        maker.bytes("/own", {2, 2}, "1234");
    }
    EXPECT_EQ(samples_of(folder / "in/v.h5"), "1234");
    const test::Failure failure = test::failure_of([&] { (void)open_volume(folder / "in/v.h5", with_dataset("/linked")); });
    EXPECT_EQ(failure.text.reason, Reason::file_outside_folder);
    OpenOptions trusting = with_dataset("/linked");
    trusting.follow_links = true;
    EXPECT_EQ(samples_of(folder / "in/v.h5", trusting), "ABCDEFGH");
}

TEST(Hdf5Volume, HugeClaimsTakeNoMemory) {
    const test::TestFolder folder;
    const hsize_t many = hsize_t{1} << 20;
    {
        Hdf5Maker(folder / "v.h5")
            .array("/v", {many, many, many}, H5T_STD_U8LE, H5T_NATIVE_UINT8, nullptr, {.chunk = {16, 16, 16}, .gzip = 1});
    }
    const auto reader = open_volume(folder / "v.h5");
    std::string box(8, '?');
    const auto last = static_cast<std::int64_t>(many);
    reader->read_box({{last - 2, last - 2, last - 2}, {last, last, last}}, std::as_writable_bytes(std::span(box)));
    EXPECT_EQ(box, std::string(8, '\0'));  // samples that were never written
    const hsize_t more = hsize_t{1} << 40;
    {
        Hdf5Maker(folder / "v.h5")
            .array("/v", {more, more}, H5T_STD_U8LE, H5T_NATIVE_UINT8, nullptr,
                   {.chunk = {16, 16}, .most = {H5S_UNLIMITED, H5S_UNLIMITED}});
    }
    EXPECT_NE(failure_of_loading(folder / "v.h5").kind, ErrorKind::internal);
}

TEST(Hdf5Volume, WhatIsCutOffIsRefused) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.h5");
        maker.array("/v", {4, 4, 4}, H5T_STD_U8LE, H5T_NATIVE_UINT8, test::telling_bytes(64).data(),
                    {.chunk = {2, 2, 2}, .gzip = 6, .fletcher = true});
    }
    const std::string content = test::file_content(folder / "v.h5");
    const std::string path = folder.write("cut.h5", "");
    for (std::size_t size = 0; size < content.size(); size += size < 128 ? 1 : 61) {
        const test::Replaced cut(path, content.substr(0, size));
        const test::Failure failure = test::failure_of_reading(path, 1 << 20);
        ASSERT_FALSE(failure.message.empty()) << size;
        test::expect_user_error(failure, "cut at " + std::to_string(size));
    }
}

TEST(Hdf5Volume, DamagedChunksAreRefused) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(4096);
    {
        Hdf5Maker(folder / "v.h5")
            .array("/v", {16, 16, 16}, H5T_STD_U8LE, H5T_NATIVE_UINT8, samples.data(),
                   {.chunk = {16, 16, 16}, .gzip = 6, .fletcher = true});
    }
    const std::string content = test::file_content(folder / "v.h5");
    std::size_t at = content.find("\x78\x5e");
    if (at == std::string::npos) at = content.find("\x78\x9c");
    ASSERT_NE(at, std::string::npos);
    for (std::size_t i = at; i < content.size() && i < at + 1000; i += 37) {
        std::string damaged = content;
        damaged[i] = static_cast<char>(damaged[i] ^ 4);
        const test::Replaced replaced(folder / "v.h5", damaged);
        expect_helpful(failure_of_loading(folder / "v.h5"), ErrorKind::input, "/v");
    }
}

}  // namespace
}  // namespace isoatlas
