// Headers beside RAW files: .dat of volume libraries and Inviwo, .xml of MIPAV; opened themselves, and through the file of samples.
#include <gtest/gtest.h>

#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

const std::string kDat =
    "ObjectFileName:\tv.raw\nTaggedFileName: ---\nResolution:\t2 3 4\nSliceThickness:\t1 2 0.5\nFormat:\tUSHORT\n"
    "NbrTags: 0\nObjectType: TEXTURE_VOLUME_OBJECT\nObjectModel: I\nGridType: EQUIDISTANT\n";
const std::string kInviwo =
    "Rawfile: v.raw\nResolution: 2 3 4\nFormat: UINT16\nByteOffset: 2\nLittleEndian: false\n"
    "BasisVector1: 0 4 0\nBasisVector2: -6 0 0\nBasisVector3: 0 0 2\nOffset: 10 20 30\nValueUnit: HU\n";
const std::string kMipav =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- MIPAV header file -->\n"
    "<image xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" filename=\"v.raw\" nDimensions=\"3\">\n<Dataset-attributes>\n"
    "<Image-offset>0</Image-offset><Data-type>Unsigned Short</Data-type><Endianess>Little</Endianess>\n"
    "<Extents>2</Extents><Extents>3</Extents><Extents>4</Extents>\n"
    "<Resolutions><Resolution>1</Resolution><Resolution>2</Resolution><Resolution>0.5</Resolution></Resolutions>\n"
    "<Units>Millimeters</Units><Units>Millimeters</Units><Compression>none</Compression>\n"
    "<Origin>5</Origin><Origin>6</Origin><Origin>7</Origin></Dataset-attributes></image>\n";

TEST(RawHeader, DatOfVolumeLibraries) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(48), header = folder.write("v.dat", kDat), raw = folder.write("v.raw", samples);
    for (const std::string& path : {header, raw}) {
        const auto reader = open_volume(path);
        EXPECT_EQ(reader->info().path, path);
        EXPECT_EQ(reader->info().type, ValueType::u16);
        EXPECT_EQ(reader->info().extent, (Extent{3, {2, 3, 4}}));
        EXPECT_EQ(reader->info().geometry.spacing, (Vec3{1, 2, 0.5}));
        EXPECT_EQ(test::read_all(*reader, 3), samples);
        test::expect_slabs_equal_whole(path);
    }
    OpenOptions options;
    options.dims = std::vector<std::int64_t>{4, 3, 2};
    expect_reason(failure_of_loading(raw, options), ErrorKind::usage, Reason::contradicts_header, "dims");
    options.type = ValueType::u16;  // said completely: the header is not looked at
    EXPECT_EQ(load_volume(raw, options).info.extent, (Extent{3, {4, 3, 2}}));
    folder.write("w.raw", samples);
    folder.write("w.dat", kDat);  // of another file
    expect_reason(failure_of_loading(folder / "w.raw"), ErrorKind::usage, Reason::raw_layout_unknown, "w.raw.json");
}

TEST(RawHeader, DatOfInviwo) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(48), header = folder.write("other.dat", kInviwo);
    folder.write("v.raw", "ab" + test::swapped(samples, 2));
    const Volume volume = load_volume(header);
    EXPECT_EQ(test::text_of_bytes(volume), samples);
    EXPECT_EQ(volume.info.geometry.spacing, (Vec3{2, 2, 0.5}));
    EXPECT_EQ(to_physical(volume.info.geometry, {0, 0, 0}), (Vec3{9, 21, 30.25}));
    EXPECT_EQ(to_physical(volume.info.geometry, {1, 0, 0}), (Vec3{9, 23, 30.25}));
    EXPECT_EQ(volume.info.value_unit, "HU");
}

TEST(RawHeader, TimeStepsAndComponents) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(48);
    folder.write("a.raw", samples.substr(0, 24));
    folder.write("b.raw", samples.substr(24));
    const std::string steps = folder.write("t.dat", "Rawfile: a.raw\nRawfile: b.raw\nResolution: 2 3 4\nFormat: UINT8\n");
    expect_reason(failure_of_loading(steps), ErrorKind::usage, Reason::time_step_needed, "1");
    OpenOptions options;
    options.time_step = 1;
    EXPECT_EQ(test::text_of_bytes(load_volume(steps, options)), samples.substr(24));
    folder.write("v.raw", samples);
    for (const std::string format : {"Format: UCHAR2\n", "Format: Vec2UINT8\n", "Format: UCHAR\nObjectModel: LA\n"}) {
        const std::string vectors = folder.write("c.dat", "ObjectFileName: v.raw\nResolution: 2 3 4\n" + format);
        expect_reason(failure_of_loading(vectors), ErrorKind::usage, Reason::channel_needed);
        OpenOptions second;
        second.channel = "1";
        const std::string got = test::text_of_bytes(load_volume(vectors, second));
        for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(got[i], samples[2 * i + 1]) << format;
    }
}

TEST(RawHeader, XmlOfMipav) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(48), header = folder.write("v.xml", kMipav), raw = folder.write("v.raw", samples);
    for (const std::string& path : {header, raw}) {
        const Volume volume = load_volume(path);
        EXPECT_EQ(test::text_of_bytes(volume), samples);
        EXPECT_EQ(volume.info.type, ValueType::u16);
        EXPECT_EQ(volume.info.geometry.spacing, (Vec3{1, 2, 0.5}));
        EXPECT_EQ(volume.info.geometry.origin, (Vec3{5, 6, 7}));
        EXPECT_EQ(volume.info.geometry.unit, "mm");
    }
}

TEST(RawHeader, Refusals) {
    const test::TestFolder folder;
    folder.write("v.raw", std::string(48, 'x'));
    const auto refused = [&](const std::string& name, std::string header, const std::string& from, const std::string& to, ErrorKind kind,
                             const std::string& says) {
        const std::size_t at = header.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        expect_helpful(failure_of_loading(folder.write(name, header.replace(at, from.size(), to))), kind, says);
    };
    refused("v.dat", kDat, "USHORT", "COLOURS", ErrorKind::unsupported, "COLOURS");
    refused("v.dat", kDat, "USHORT", "UCHAR", ErrorKind::input, "24 bytes");
    refused("v.dat", kDat, "2 3 4", "2 3", ErrorKind::input, "Resolution");
    refused("v.dat", kDat, "2 3 4", "2 0 4", ErrorKind::input, "0 samples");
    refused("v.dat", kDat, "2 3 4", "4000000000 4000000000 4", ErrorKind::input, "63 bits");
    refused("v.dat", kDat, "EQUIDISTANT", "TETRAHEDRA", ErrorKind::unsupported, "tetrahedra");
    refused("v.dat", kDat, "SliceThickness", "SliceThicknesz", ErrorKind::input, "slicethickness");
    refused("v.dat", kInviwo, "false", "perhaps", ErrorKind::input, "LittleEndian");
    refused("v.dat", kInviwo, "ByteOffset: 2", "ByteOffset: -2", ErrorKind::input, "negative");
    refused("v.xml", kMipav, "<Extents>2", "<Extents>-2", ErrorKind::input, "Extents");
    refused("v.xml", kMipav, "Unsigned Short", "Complex Float", ErrorKind::unsupported, "Complex");
    refused("v.xml", kMipav, ">none<", ">zip<", ErrorKind::unsupported, "zip");
    refused("v.xml", kMipav, "</image>", "", ErrorKind::input, "XML");
    refused("v.xml", kMipav, "<Resolution>1<", "<Resolution>inf<", ErrorKind::input, "Resolution");
    for (const auto& [name, header] : {std::pair{"v.dat", kDat}, {"v.xml", kMipav}}) {
        std::string outside = header;
        outside.replace(outside.find("v.raw"), 5, "../v.raw");
        expect_reason(failure_of_loading(folder.write(name, outside)), ErrorKind::input, Reason::file_outside_folder);
    }
}

TEST(RawHeader, Damage) {
    for (const auto& [name, header] : {std::pair{"v.dat", kDat}, {"v.dat", kInviwo}, {"v.xml", kMipav}}) {
        const test::TestFolder folder;
        folder.write("v.raw", test::telling_bytes(48));
        for (std::size_t bit = 0; bit < 8 * header.size(); ++bit) {
            std::string damaged = header;
            damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
            const std::string path = folder.write(name, damaged);
            for (const std::string& opened : {path, folder / "v.raw"}) {
                const test::Failure failure = test::failure_of_reading(opened, 1 << 20);
                if (!failure.message.empty()) test::expect_user_error(failure, std::string(name) + " bit " + std::to_string(bit));
            }
            if (testing::Test::HasFailure()) return;
        }
        for (std::size_t size = 0; size < header.size(); ++size) {
            const test::Failure failure = test::failure_of_reading(folder.write(name, header.substr(0, size)), 1 << 20);
            if (!failure.message.empty()) test::expect_user_error(failure, std::string(name) + " cut at " + std::to_string(size));
        }
    }
}

}  // namespace
}  // namespace isoatlas
