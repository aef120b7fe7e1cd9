// DICOM: encodings, places, time steps, series, values, refusals; nothing about the patient leaves the file.
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <numbers>

#include "formats/volume/dicom_codec.h"
#include "unit/formats/volume/dicom_files.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::DicomFileBytes;
using test::expect_helpful;
using test::expect_reason;
using test::failure_of_loading;

constexpr const char *kImplicit = "1.2.840.10008.1.2", *kDeflated = "1.2.840.10008.1.2.1.99", *kRle = "1.2.840.10008.1.2.5";

std::string deflated(const std::string& bytes) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

/// A frame of 16-bit samples: the high bytes as literals, then the low bytes.
std::string run_length(const std::string& samples) {
    std::string high, low;
    for (std::size_t i = 0; i + 1 < samples.size(); i += 2) low += samples[i], high += samples[i + 1];
    const auto literal = [](const std::string& bytes) { return static_cast<char>(bytes.size() - 1) + bytes; };
    std::string header =
        DicomFileBytes::u32(2) + DicomFileBytes::u32(64) + DicomFileBytes::u32(static_cast<std::uint32_t>(65 + high.size()));
    header.resize(64, '\0');
    return header + literal(high) + literal(low);
}

/// Slices at these places, named in the order of their samples, which begin at 100 times the index.
void write_series(const test::TestFolder& folder, const std::vector<double>& places) {
    for (std::size_t i = 0; i < places.size(); ++i)
        folder.write("s" + std::to_string(i), DicomFileBytes().at(places[i]).counting(static_cast<std::uint16_t>(100 * i)).bytes());
}

std::string path_of(const test::TestFolder& folder) {
    const std::string inside = folder / "x";
    return inside.substr(0, inside.size() - 2);
}

std::vector<double> first_samples(const Volume& volume) {
    std::vector<double> values;
    for (std::int64_t z = 0; z < volume.info.extent.size[2]; ++z) values.push_back(volume.value(z * volume.info.extent.slice()));
    return values;
}

void expect_no_patient(const std::string& text) { EXPECT_EQ(text.find("SECRET"), std::string::npos) << text; }

TEST(Dicom, EveryEncodingIsTheSamePicture) {
    const test::TestFolder folder;
    const DicomFileBytes slice = DicomFileBytes().counting(1000);
    const auto loaded = [&](const std::string& bytes) { return test::text_of_bytes(load_volume(folder.write("v", bytes))); };
    EXPECT_EQ(loaded(slice.bytes()), slice.pixels());
    EXPECT_EQ(loaded(slice.bytes(kImplicit)), slice.pixels());
    EXPECT_EQ(loaded(slice.bytes().replace(0, 4, std::string("II*\0", 4))), slice.pixels());  // a preamble that is a TIFF header
    EXPECT_EQ(loaded(slice.data_set(true)), slice.pixels());
    EXPECT_EQ(loaded(slice.data_set()), slice.pixels());
    EXPECT_EQ(loaded(DicomFileBytes::meta(kDeflated) + deflated(slice.data_set())), slice.pixels());
    EXPECT_EQ(loaded(DicomFileBytes(slice).fragments({run_length(slice.pixels())}).bytes(kRle)), slice.pixels());
    const std::string packed = run_length(slice.pixels());
    EXPECT_EQ(loaded(DicomFileBytes(slice).fragments({packed.substr(0, 70), packed.substr(70)}).bytes(kRle)), slice.pixels());
}

TEST(Dicom, SlicesAreSortedByPlace) {
    const test::TestFolder folder;
    write_series(folder, {6, -2, 2, 4, 0});
    for (const std::string& path : {path_of(folder), folder / "s3"}) {
        const Volume volume = load_volume(path);
        EXPECT_EQ(volume.info.format, "DICOM");
        EXPECT_EQ(volume.info.extent, (Extent{3, {4, 3, 5}}));
        EXPECT_EQ(first_samples(volume), (std::vector<double>{100, 400, 200, 300, 0}));
        EXPECT_EQ(volume.info.geometry.spacing, (Vec3{0.25, 0.5, 2}));
        EXPECT_EQ(volume.info.geometry.origin, (Vec3{0, 0, -2}));
        EXPECT_EQ(volume.info.geometry.space, "LPS");
        EXPECT_EQ(volume.info.geometry.unit, "mm");
        EXPECT_EQ(handedness(volume.info.geometry), 1);
        EXPECT_TRUE(volume.info.slab_readable);
        EXPECT_TRUE(volume.info.volumes.has_series);
    }
    test::expect_slabs_equal_whole(path_of(folder));
}

TEST(Dicom, ObliqueSlicesLieWhereTheFilesSay) {
    const test::TestFolder folder;
    const double c = std::cos(0.3), s = std::sin(0.3);
    for (int i = 0; i < 4; ++i) {
        DicomFileBytes slice;
        slice.text(0x00200037, "DS",
                   "0\\" + DicomFileBytes::digits(c) + "\\" + DicomFileBytes::digits(s) + "\\0\\" + DicomFileBytes::digits(-s) + "\\" +
                       DicomFileBytes::digits(c));
        folder.write("s" + std::to_string(i), slice.at(10 - 3 * i, 20, 30).counting(static_cast<std::uint16_t>(i)).bytes());
    }
    const Volume volume = load_volume(path_of(folder));
    EXPECT_EQ(first_samples(volume), (std::vector<double>{3, 2, 1, 0}));
    EXPECT_NEAR(volume.info.geometry.spacing[2], 3, 1e-9);
    const Vec3 place = to_physical(volume.info.geometry, {2, 1, 3});
    EXPECT_NEAR(place[0], 10, 1e-8);
    EXPECT_NEAR(place[1], 20 + 0.5 * c - 0.5 * s, 1e-8);
    EXPECT_NEAR(place[2], 30 + 0.5 * s + 0.5 * c, 1e-8);
}

TEST(Dicom, GapsAndDoublesAreRefusedWithTheirPlaces) {
    const test::TestFolder gap, doubled;
    write_series(gap, {0, 2, 8, 10});
    const test::Failure missing = failure_of_loading(path_of(gap));
    expect_helpful(missing, ErrorKind::input, "2 slices are missing");
    EXPECT_NE(missing.message.find("(0, 0, 2) and (0, 0, 8) mm"), std::string::npos) << missing.message;
    write_series(doubled, {0, 2, 2, 4});
    const test::Failure twice = failure_of_loading(path_of(doubled));
    expect_helpful(twice, ErrorKind::input, "1 place has more");
    EXPECT_NE(twice.message.find("(0, 0, 2) mm"), std::string::npos) << twice.message;
    expect_no_patient(missing.message + twice.message);
}

TEST(Dicom, CopiesOfOneInstanceAreOneSlice) {
    const test::TestFolder folder;
    const std::string slice = DicomFileBytes().counting(7).bytes();
    folder.write("a", slice), folder.write("b", slice);
    const Volume volume = load_volume(folder / "a");
    EXPECT_EQ(volume.info.extent, (Extent{2, {4, 3, 1}}));
    EXPECT_EQ(volume.info.notes.size(), 1U);
}

TEST(Dicom, UnevenDistancesAreCoordinates) {
    const test::TestFolder folder;
    write_series(folder, {0, 2, 4.3, 6.3});
    const VolumeInfo info = open_volume(path_of(folder))->info();
    ASSERT_EQ(info.geometry.coordinates[2].size(), 4U);
    EXPECT_NEAR(to_physical(info.geometry, {0, 0, 2})[2], 4.3, 1e-12);
    EXPECT_NE(info.notes.at(0).find("differ"), std::string::npos);
    const test::TestFolder nearly;
    write_series(nearly, {0, 2, 4.001, 6});
    EXPECT_TRUE(open_volume(path_of(nearly))->info().geometry.coordinates[2].empty());
}

TEST(Dicom, TiltedStacksAreOblique) {
    const test::TestFolder folder;
    for (int i = 0; i < 3; ++i)
        folder.write("s" + std::to_string(i), DicomFileBytes().at(0, i, 2 * i).counting(static_cast<std::uint16_t>(i)).bytes());
    const VolumeInfo info = open_volume(path_of(folder))->info();
    EXPECT_NEAR(skew_of(info.geometry, 3), 2 / std::sqrt(5), 1e-12);
    EXPECT_NEAR(to_physical(info.geometry, {0, 0, 2})[1], 2, 1e-12);
    EXPECT_NE(info.notes.at(0).find("tilt of 26.5651 degrees"), std::string::npos) << info.notes.at(0);
    folder.write("s3", DicomFileBytes().at(0, 0, 6).counting(3).bytes());
    expect_helpful(failure_of_loading(path_of(folder)), ErrorKind::input, "line");
}

TEST(Dicom, RepeatedPlacesAreTimeSteps) {
    const test::TestFolder folder;
    for (int echo = 0; echo < 2; ++echo) {
        for (int z = 0; z < 3; ++z)
            folder.write(std::to_string(z) + std::to_string(echo), DicomFileBytes()
                                                                       .at(z)
                                                                       .text(0x00180081, "DS", echo == 0 ? "12.5" : "5")
                                                                       .counting(static_cast<std::uint16_t>(10 * echo + z))
                                                                       .bytes());
    }
    expect_reason(failure_of_loading(path_of(folder)), ErrorKind::usage, Reason::time_step_needed, "1");
    OpenOptions options;
    options.time_step = 0;
    const Volume volume = load_volume(path_of(folder), options);
    EXPECT_EQ(first_samples(volume), (std::vector<double>{10, 11, 12}));
    EXPECT_EQ(volume.info.volumes.times, (std::vector<double>{5, 12.5}));
    EXPECT_EQ(volume.info.volumes.time_unit, "ms");
    folder.write("extra", DicomFileBytes().at(0).text(0x00180081, "DS", "5").bytes());
    EXPECT_EQ(failure_of_loading(path_of(folder), options).kind, ErrorKind::input);
}

TEST(Dicom, SeriesAreChosen) {
    const test::TestFolder folder;
    write_series(folder, {0, 1, 2});
    folder.write("other", DicomFileBytes().text(0x0020000E, "UI", "1.2.9").text(0x0008103E, "LO", "scout").counting(50).bytes());
    folder.write("readme.txt", "no picture, but a text that is long enough");
    const test::Failure failure = failure_of_loading(path_of(folder));
    EXPECT_EQ(failure.text.reason, Reason::series_needed);
    ASSERT_EQ(failure.text.choices.size(), 2U);
    EXPECT_EQ(failure.text.choices[0].word, "1.2.3");
    EXPECT_EQ(failure.text.choices[0].about, "MR, 3 slices, 4 x 3, 0.25 x 0.5 x 1 mm, axial");
    EXPECT_EQ(failure.text.choices[1].about, "MR, 1 slice, 4 x 3, 0.25 x 0.5 mm, axial, scout");
    OpenOptions options;
    options.series = "1.2.3";
    EXPECT_EQ(load_volume(path_of(folder), options).info.extent.size[2], 3);
    options.series = "1";
    EXPECT_EQ(load_volume(path_of(folder), options).value(0), 50);
    options.series = "7";
    EXPECT_EQ(failure_of_loading(path_of(folder), options).text.reason, Reason::no_such_series);
    EXPECT_EQ(load_volume(folder / "other").value(0), 50);
}

TEST(Dicom, ValuesOfSlices) {
    const test::TestFolder folder;
    const auto write = [&](int z, const char* slope, const char* intercept) {
        folder.write("s" + std::to_string(z), DicomFileBytes()
                                                  .at(z)
                                                  .text(0x00080060, "CS", "CT")
                                                  .text(0x00281052, "DS", intercept)
                                                  .text(0x00281053, "DS", slope)
                                                  .counting(100)
                                                  .bytes());
    };
    write(0, "2", "-1024"), write(1, "2", "-1024");
    const Volume same = load_volume(path_of(folder));
    EXPECT_EQ(same.info.type, ValueType::u16);
    EXPECT_EQ(same.reported(0), -824);
    EXPECT_EQ(same.info.value_unit, "HU");
    write(1, "0.5", "1");
    const Volume other = load_volume(path_of(folder));
    EXPECT_EQ(other.info.type, ValueType::f32);
    EXPECT_EQ(first_samples(other), (std::vector<double>{-824, 51}));
    EXPECT_TRUE(other.info.calibration.is_identity());
    test::expect_slabs_equal_whole(path_of(folder));
}

TEST(Dicom, BitsBesideTheSamplesAreLeftOut) {
    const test::TestFolder folder;
    DicomFileBytes slice;
    slice.number(0x00280101, 12).number(0x00280102, 13).number(0x00280103, 1);
    std::string samples;
    for (std::uint32_t i = 0; i < 12; ++i) samples += DicomFileBytes::u16(0xC003U | (i * 300 & 0xFFFU) << 2);
    const Volume volume = load_volume(folder.write("v", slice.samples(samples).bytes()));
    EXPECT_EQ(volume.info.type, ValueType::i16);
    for (std::int64_t i = 0; i < 12; ++i) EXPECT_EQ(volume.value(i), static_cast<double>(i * 300 >= 2048 ? i * 300 - 4096 : i * 300)) << i;
}

/// Lossless JPEG of 4 x 3 samples of 8 bits, each 128; 7 bits or 8 of them are stored.
TEST(Dicom, BitsBesideTheSamplesOfAPictureAreLeftOut) {
    const test::TestFolder folder;
    const std::string jpeg(
        "\xFF\xD8\xFF\xC3\0\x0B\x08\0\x03\0\x04\x01\x01\x11\0\xFF\xC4\0\x14\0\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"
        "\xFF\xDA\0\x08\x01\x01\0\x01\0\0\0\x0F\xFF\xD9",
        51);
    for (const bool all : {false, true}) {
        DicomFileBytes slice;
        slice.number(0x00280100, 8).number(0x00280101, all ? 8 : 7).number(0x00280102, all ? 7 : 6).fragments({jpeg});
        const std::string path = folder.write("v", slice.bytes("1.2.840.10008.1.2.4.70"));
        try {
            const Volume volume = load_volume(path);
            for (std::int64_t i = 0; i < 12; ++i) EXPECT_EQ(volume.value(i), all ? 128 : 0) << i;
        } catch (const Error& error) {
            if (error.text().reason != Reason::built_without_format) throw;
            GTEST_SKIP() << "built without GDCM";
        }
    }
}

TEST(Dicom, NotesOnValues) {
    const test::TestFolder folder;
    const auto note = [&](DicomFileBytes slice) { return open_volume(folder.write("v", slice.counting(0).bytes()))->info().notes.at(0); };
    EXPECT_NE(note(DicomFileBytes().text(0x00280004, "CS", "MONOCHROME1")).find("MONOCHROME1"), std::string::npos);
    EXPECT_NE(note(DicomFileBytes().number(0x00280120, 63536)).find("63536"), std::string::npos);
    EXPECT_NE(note(DicomFileBytes().number(0x00280103, 1).text(0x00280120, "SS", "\x30\xF8")).find("-2000"), std::string::npos);
    EXPECT_NE(note(DicomFileBytes().without(0x00280030)).find("1 was assumed"), std::string::npos);
    EXPECT_NE(note(DicomFileBytes().without(0x00280030).text(0x00181164, "DS", "0.1\\0.1")).find("detector"), std::string::npos);
}

/// Two frames with places of their own, the second one below the first.
std::string enhanced(bool has_undefined_lengths) {
    using F = DicomFileBytes;
    const auto sequence = [&](std::uint32_t tag, const std::vector<std::string>& items) {
        std::string all;
        for (const std::string& one : items)
            all += has_undefined_lengths ? F::u16(0xFFFE) + F::u16(0xE000) + F::u32(0xFFFFFFFF) + one + F::item(0xE00D, "")
                                         : F::item(0xE000, one);
        if (!has_undefined_lengths) return F::encoded(tag, "SQ", all, false);
        return F::u16(tag >> 16) + F::u16(tag & 0xFFFF) + "SQ" + std::string(2, '\0') + F::u32(0xFFFFFFFF) + all + F::item(0xE0DD, "");
    };
    const auto frame = [&](const std::string& place) { return sequence(0x00209113, {F::encoded(0x00200032, "DS", place, false)}); };
    const std::string measures = sequence(0x00289110, {F::encoded(0x00280030, "DS", "3\\2 ", false)});
    const std::string shared = sequence(0x00209116, {F::encoded(0x00200037, "DS", "1\\0\\0\\0\\1\\0 ", false)}) + measures;
    F file = F().number(0x00280010, 3).text(0x00280008, "IS", "2").without(0x00200032).without(0x00200037).without(0x00280030);
    const std::string samples = F().counting(20).pixels() + F().counting(40).pixels();
    const std::string pixels = F::encoded(0x7FE00010, "OW", samples, false);
    const std::string set = file.samples("").data_set();
    return F::meta("1.2.840.10008.1.2.1") + set.substr(0, set.size() - 12) + sequence(0x52009229, {shared}) +
           sequence(0x52009230, {frame("1\\2\\5 "), frame("1\\2\\1 ")}) + pixels;
}

TEST(Dicom, EnhancedFramesHaveTheirPlaces) {
    const test::TestFolder folder;
    for (const bool undefined : {false, true}) {
        const Volume volume = load_volume(folder.write("v", enhanced(undefined)));
        EXPECT_EQ(volume.info.extent, (Extent{3, {4, 3, 2}}));
        EXPECT_EQ(first_samples(volume), (std::vector<double>{40, 20}));
        EXPECT_EQ(volume.info.geometry.origin, (Vec3{1, 2, 1}));
        EXPECT_EQ(volume.info.geometry.spacing, (Vec3{2, 3, 4}));
    }
}

TEST(Dicom, PlainFramesLieAlongTheNormal) {
    const test::TestFolder folder;
    DicomFileBytes file;
    file.text(0x00280008, "IS", "3")
        .samples(DicomFileBytes().counting(1).pixels() + DicomFileBytes().counting(2).pixels() + DicomFileBytes().counting(3).pixels());
    const auto load = [&](const DicomFileBytes& one) { return load_volume(folder.write("v", one.bytes())); };
    EXPECT_EQ(load(file).info.geometry.unit, "");
    EXPECT_EQ(load(DicomFileBytes(file).text(0x00180088, "DS", "5")).info.geometry.spacing[2], 5);
    const Volume dose = load(DicomFileBytes(file).text(0x3004000C, "DS", "0\\-2\\-4"));
    EXPECT_EQ(first_samples(dose), (std::vector<double>{3, 2, 1}));
    EXPECT_EQ(dose.info.geometry.origin, (Vec3{0, 0, -4}));
}

TEST(Dicom, Refusals) {
    const test::TestFolder folder;
    const auto refused = [&](DicomFileBytes slice, ErrorKind kind, const std::string& says,
                             const std::string& syntax = "1.2.840.10008.1.2.1") {
        const test::Failure failure = failure_of_loading(folder.write("v.dcm", slice.bytes(syntax)));
        expect_helpful(failure, kind, says);
        expect_no_patient(failure.message);
    };
    const DicomFileBytes slice = DicomFileBytes().counting(0);
    refused(DicomFileBytes(slice).number(0x00280002, 3), ErrorKind::unsupported, "colour");
    refused(DicomFileBytes(slice).number(0x00280100, 1), ErrorKind::unsupported, "1 bits");
    refused(DicomFileBytes(slice).number(0x00280101, 17), ErrorKind::input, "BitsStored");
    refused(DicomFileBytes(slice).without(0x00280010), ErrorKind::input, "Rows");
    refused(DicomFileBytes(slice).number(0x00280010, 65535), ErrorKind::input, "24 bytes");
    refused(DicomFileBytes(slice).text(0x00280008, "IS", "2000000000"), ErrorKind::input, "24 bytes");
    refused(DicomFileBytes(slice).text(0x00280030, "DS", "0\\1"), ErrorKind::input, "PixelSpacing");
    refused(DicomFileBytes(slice).text(0x00200037, "DS", "1\\0\\0\\1\\0\\0"), ErrorKind::input, "perpendicular");
    refused(DicomFileBytes(slice).text(0x00200032, "DS", "1\\nan\\0"), ErrorKind::input, "ImagePositionPatient");
    refused(DicomFileBytes(slice).fragments({"abcd"}), ErrorKind::unsupported, "HTJ2K", "1.2.840.10008.1.2.4.202");
    refused(DicomFileBytes(slice).fragments({"abcd"}), ErrorKind::input, "RLE", kRle);
    refused(slice, ErrorKind::input, "fragments", kRle);
    const std::string report = DicomFileBytes::meta(kImplicit) + DicomFileBytes::encoded(0x00080060, "CS", "SR", true);
    expect_helpful(failure_of_loading(folder.write("report", report)), ErrorKind::unsupported, "no picture");
    expect_helpful(failure_of_loading(folder.write("scan.dcm", "something")), ErrorKind::input, "named like DICOM");
}

TEST(Dicom, CodeStreamsMustAgree) {
    DicomPixels pixels;
    pixels.rows = 3, pixels.columns = 4, pixels.allocated = 8, pixels.type = ValueType::u8;
    const auto wrong = [&](const std::string& stream) { return jpeg_contradiction(pixels, std::as_bytes(std::span(stream))); };
    const auto jpeg = [](char bits, char rows, char columns, char components) {
        return std::string("\xFF\xD8\xFF\xC3\x00\x0B", 6) + bits + '\0' + rows + '\0' + columns + components +
               std::string("\x01\x11\x00\xFF\xDA\x00\x08\x01\x01\x00\x01\x00\x00", 13);
    };
    EXPECT_EQ(wrong(jpeg(8, 3, 4, 1)), "");
    EXPECT_NE(wrong(jpeg(8, 3, 4, 1).substr(0, 15) + "\xFF\xD9"), "") << "no scan";
    EXPECT_NE(wrong(jpeg(8, 4, 3, 1)), "");
    EXPECT_NE(wrong(jpeg(12, 3, 4, 1)), "");
    EXPECT_NE(wrong(jpeg(8, 3, 4, 3)), "");
    const std::string whole = jpeg(8, 3, 4, 1);
    for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(wrong(whole.substr(0, size)), "") << size;
    const std::string segment("\x00\x04\x07\x07", 4);
    EXPECT_EQ(wrong(whole.substr(0, 2) + "\xFF\xE1" + segment + whole.substr(2)), "");
    EXPECT_NE(wrong(whole.substr(0, 2) + "\xFF\xD4" + segment + whole.substr(2)), "") << "restart markers have no length";
}

TEST(Dicom, Damage) {
    const std::string plain = DicomFileBytes().counting(300).bytes();
    test::expect_truncations_refused("v.dcm", plain);
    test::expect_bit_flips_harmless("v.dcm", plain, 128, plain.size(), 2);
    const std::string sequences = enhanced(true);
    test::expect_truncations_refused("v.dcm", sequences);
    test::expect_bit_flips_harmless("v.dcm", sequences, 128, sequences.size(), 2);
    const std::string runs = DicomFileBytes().fragments({run_length(DicomFileBytes().counting(5).pixels())}).bytes(kRle);
    test::expect_truncations_refused("v.dcm", runs);
    test::expect_bit_flips_harmless("v.dcm", runs, 128, runs.size(), 64);
    const std::string small = DicomFileBytes::meta(kDeflated) + deflated(DicomFileBytes().counting(9).data_set());
    test::expect_bit_flips_harmless("v.dcm", small, 128, small.size(), 1032);
}

TEST(Dicom, NothingAboutThePatientIsKept) {
    const test::TestFolder folder;
    write_series(folder, {0, 1, 2.5});
    const VolumeInfo info = open_volume(path_of(folder))->info();
    std::string all = info.description + info.value_unit + info.encoding + info.data_file;
    for (const std::string& note : info.notes) all += note;
    expect_no_patient(all);
    EXPECT_EQ(all.find("1.2.3"), std::string::npos) << all;
}

}  // namespace
}  // namespace isoatlas
