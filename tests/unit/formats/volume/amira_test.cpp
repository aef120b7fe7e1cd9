// Amira meshes: types, byte orders, encodings, sections, coordinates, components, materials, refusals, damage.
#include <gtest/gtest.h>

#include "isoatlas/segmentation.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

constexpr const char* kLittle = "# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n";
const std::string kUniform =
    "Parameters {\n    Units { Coordinates \"um\" }\n    CoordType \"uniform\",\n    BoundingBox 1 3 10 14 0 1.5\n}\n";

/// A mesh of 3 x 3 x 4 samples, by default uniform, with arrays declared as given and their sections.
std::string mesh(const std::string& arrays, const std::string& sections, const std::string& first = kLittle,
                 const std::string& parameters = kUniform) {
    return first + "\n# a comment { \ndefine Lattice 3 3 4\n\n" + parameters + "\n" + arrays + "\n# Data section follows\n" + sections;
}

/// Runs of up to 127 equal bytes, all others as they are.
std::string run_length_coded(const std::string& plain) {
    std::string packed;
    for (std::size_t i = 0; i < plain.size();) {
        std::size_t run = 1;
        while (i + run < plain.size() && run < 127 && plain[i + run] == plain[i]) ++run;
        if (run > 2) {
            packed += static_cast<char>(run);
            packed += plain[i];
        } else {
            packed += static_cast<char>(128 + run);
            packed += plain.substr(i, run);
        }
        i += run;
    }
    return packed;
}

std::string declared(const std::string& type, const std::string& coding, const std::string& packed) {
    return "Lattice { " + type + " Data } @1" + (coding.empty() ? "" : "(" + coding + "," + std::to_string(packed.size()) + ")");
}

TEST(Amira, EveryTypeByteOrderAndEncoding) {
    const test::TestFolder folder;
    const std::pair<const char*, ValueType> types[] = {{"byte", ValueType::u8}, {"short", ValueType::i16}, {"ushort", ValueType::u16},
                                                       {"int", ValueType::i32}, {"float", ValueType::f32}, {"double", ValueType::f64}};
    for (const auto& [name, type] : types) {
        const std::string samples = test::telling_bytes(36 * size_of(type));
        for (const std::string order : {"BINARY", "BINARY-LITTLE-ENDIAN"}) {
            const std::string plain = order == "BINARY" ? test::swapped(samples, size_of(type)) : samples;
            for (const auto& [coding, packed] :
                 {std::pair<std::string, std::string>{"", plain}, {"HxZip", test::zlib(plain)}, {"HxByteRLE", run_length_coded(plain)}}) {
                SCOPED_TRACE(std::string(name) + " " + order + " " + coding);
                const std::string path =
                    folder.write("v.bin", mesh(declared(name, coding, packed), "@1\n" + packed + "\n", "# Avizo " + order + " 2.1\n"));
                const auto reader = open_volume(path);
                EXPECT_EQ(reader->info().format, "Amira");
                EXPECT_EQ(reader->info().type, type);
                EXPECT_EQ(reader->info().extent, (Extent{3, {3, 3, 4}}));
                EXPECT_EQ(reader->info().slab_readable, coding.empty());
                for (std::int64_t slices = 1; slices <= 4; ++slices) EXPECT_EQ(test::read_all(*reader, slices), samples);
                test::expect_slabs_equal_whole(path);
            }
        }
    }
}

TEST(Amira, UniformCoordinatesAreCentres) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(36);
    const auto geometry = [&](const std::string& parameters) {
        return open_volume(folder.write("v.am", mesh("Lattice { byte Data } = @1", "@1\n" + samples, kLittle, parameters)))
            ->info()
            .geometry;
    };
    const Geometry uniform = geometry(kUniform);
    EXPECT_EQ(uniform.spacing, (Vec3{1, 2, 0.5}));
    EXPECT_EQ(uniform.origin, (Vec3{1, 10, 0}));
    EXPECT_EQ(uniform.unit, "\xc2\xb5m");
    EXPECT_EQ(geometry("").spacing, (Vec3{1, 1, 1}));
    const Geometry turned = geometry("Parameters { BoundingBox 0 2 0 2 0 3, TransformationMatrix 0 2 0 0 -1 0 0 0 0 0 1 0 5 6 7 1 }\n");
    EXPECT_EQ(turned.spacing, (Vec3{2, 1, 1}));
    EXPECT_EQ(to_physical(turned, {1, 0, 0}), (Vec3{5, 8, 7}));
    EXPECT_EQ(to_physical(turned, {0, 1, 1}), (Vec3{4, 6, 8}));
    const Geometry backwards = geometry("Parameters { BoundingBox 2 0 0 2 0 3 }\n");
    EXPECT_EQ(to_physical(backwards, {2, 0, 0}), (Vec3{0, 0, 0}));
}

TEST(Amira, RectilinearCoordinates) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(36);
    const std::vector<float> places{0, 1, 3, 5, 6, 9, -4, -3, -1, 8};
    const std::string parameters = "define Coordinates 10\nParameters { CoordType \"rectilinear\" }\n";
    const std::string arrays = "Coordinates { float xyz } @2\nLattice { byte Data } @1\n";
    const auto info = [&](const std::vector<float>& all) {
        return open_volume(
                   folder.write("v.am", mesh(arrays, "@1\n" + samples + "\n@2\n" + test::bytes_of(all) + "\n", kLittle, parameters)))
            ->info();
    };
    const Geometry geometry = info(places).geometry;
    EXPECT_EQ(geometry.coordinates[0], (std::vector<double>{0, 1, 3}));
    EXPECT_EQ(geometry.coordinates[1], (std::vector<double>{5, 6, 9}));
    EXPECT_EQ(geometry.coordinates[2], (std::vector<double>{-4, -3, -1, 8}));
    std::vector<float> unsorted = places;
    std::swap(unsorted[3], unsorted[4]);
    expect_helpful(test::failure_of([&] { static_cast<void>(info(unsorted)); }), ErrorKind::unsupported, "ascend");
}

TEST(Amira, ArraysAndComponents) {
    const test::TestFolder folder;
    const std::string first = test::telling_bytes(36), second = test::bytes_of(std::vector<float>(3 * 36, 2.0F));
    const std::string path = folder.write(
        "v.am",
        mesh("Lattice { byte Labels } @1(HxByteRLE," + std::to_string(run_length_coded(first).size()) + ")\nLattice { float[3] Flow } @2",
             "@1\n" + run_length_coded(first) + "\n@2\n" + second + "\n"));
    expect_reason(failure_of_loading(path), ErrorKind::usage, Reason::dataset_needed);
    EXPECT_EQ(failure_of_loading(path).text.choices.size(), 2U);
    EXPECT_EQ(test::text_of_bytes(load_volume(path + ":/Labels")), first);
    expect_reason(failure_of_loading(path + ":/Flow"), ErrorKind::usage, Reason::channel_needed);
    std::vector<float> flow(3 * 36), y;
    for (std::size_t i = 0; i < flow.size(); ++i) flow[i] = static_cast<float>(i);
    for (std::size_t i = 0; i < 36; ++i) y.push_back(flow[3 * i + 1]);
    OpenOptions options;
    options.channel = "y";
    const std::string vectors = folder.write("w.am", mesh("Lattice { float[3] Flow } @1", "@1\n" + test::bytes_of(flow)));
    EXPECT_EQ(test::text_of_bytes(load_volume(vectors, options)), test::bytes_of(y));
    test::expect_slabs_equal_whole(vectors, options);
}

TEST(Amira, Text) {
    const test::TestFolder folder;
    std::string numbers, others;
    for (int i = 0; i < 36; ++i) numbers += std::to_string(i) + " \n", others += std::to_string(-i) + " 0.5\n";
    const std::string path = folder.write("v.am", mesh("Lattice { ushort A } @1\nLattice { float[2] B } @2",
                                                       "@1\n" + numbers + "\n@2\n" + others, "# AmiraMesh 3D ASCII 2.0\n"));
    const Volume volume = load_volume(path + ":/A");
    for (std::int64_t i = 0; i < 36; ++i) EXPECT_EQ(volume.value(i), static_cast<double>(i));
    OpenOptions options;
    options.channel = "0";
    EXPECT_EQ(load_volume(path + ":/B", options).value(7), -7);
    options.channel = "1";
    EXPECT_EQ(load_volume(path + ":/B", options).value(7), 0.5);
}

TEST(Amira, Materials) {
    const test::TestFolder folder;
    const std::string materials = "Parameters { Materials { Exterior { Color 0 0 0 }\n\"two words\" { Id 2, Color 1 0.5 0 } Bone { } } }\n";
    const std::vector<NamedLabel> labels =
        named_labels(folder.write("v.am", mesh("Lattice { byte Labels } @1", "@1\n" + std::string(36, 'x'), kLittle, materials)));
    ASSERT_EQ(labels.size(), 3U);
    EXPECT_EQ(labels[1].label, 1);
    EXPECT_EQ(labels[1].name, "two words");
    EXPECT_EQ(labels[1].colour, (std::array<std::uint8_t, 3>{255, 128, 0}));
    EXPECT_EQ(labels[2].name, "Bone");
}

TEST(Amira, Refusals) {
    const test::TestFolder folder;
    const std::string samples(36, 'x');
    const auto refused = [&](const std::string& bytes, ErrorKind kind, const std::string& says) {
        expect_helpful(failure_of_loading(folder.write("v.am", bytes)), kind, says);
    };
    const auto with = [&](const std::string& arrays, const std::string& parameters = kUniform) {
        return mesh(arrays, "@1\n" + samples, kLittle, parameters);
    };
    refused(with("Lattice { complex Data } @1"), ErrorKind::unsupported, "complex");
    refused(with("Lattice { byte Data } @1(HxUnknown,3)"), ErrorKind::unsupported, "HxUnknown");
    refused(with("Lattice { byte Data } @2"), ErrorKind::input, "@2");
    refused(with("Nodes { float[3] Coordinates } @1"), ErrorKind::unsupported, "lattice");
    refused(with("Lattice { byte[70000] Data } @1"), ErrorKind::input, "components");
    refused(with("Lattice { byte[0] Data } @1"), ErrorKind::input, "component");
    refused(with("Lattice { byte Data } @1", "Parameters { CoordType \"stacked\" }\n"), ErrorKind::unsupported, "stacked");
    refused(with("Lattice { byte Data } @1", "Parameters { BoundingBox 1 2 3 }\n"), ErrorKind::input, "BoundingBox");
    refused(with("Lattice { byte Data } @1", "Parameters { BoundingBux 0 1 0 1 0 1 }\n"), ErrorKind::input, "BoundingBox");
    refused(with("Lattice { byte Data } @1", "Parameters { a { a { a { a { a { a { a { a { a { a { a { a { a { a { a { a { a { 1 }\n"),
            ErrorKind::input, "groups");
    refused(with("Lattice { float Data } @1"), ErrorKind::input, "144 bytes");
    refused(with("Lattice { byte Data } @1(HxZip,1000000)"), ErrorKind::input, "truncated");
    refused(std::string(kLittle) + "define Lattice 4000000000 4000000000 4\nLattice { byte Data } @1\n@1\nx", ErrorKind::input, "63 bits");
    refused(std::string(kLittle) + "define Lattice 0 1 1\nLattice { byte Data } @1\n@1\nx", ErrorKind::input, "0 samples");
    refused(std::string(kLittle) + "define Lattice 3 3 4\nLattice { byte Data } @1\n", ErrorKind::input, "@1");
    refused("# AmiraMesh SOMEHOW 2.1\ndefine Lattice 1 1 1\n@1\n", ErrorKind::input, "line 1");
    const std::string cut = run_length_coded(samples);
    refused(mesh(declared("byte", "HxByteRLE", cut.substr(1)), "@1\n" + cut.substr(1)), ErrorKind::input, "");
}

TEST(Amira, Damage) {
    const std::string samples = test::telling_bytes(72), coded = run_length_coded(samples), zipped = test::zlib(samples);
    const std::string raw = mesh("Lattice { short Data } @1", "@1\n" + samples);
    test::expect_truncations_refused("v.am", raw);
    test::expect_bit_flips_harmless("v.am", raw, 0, raw.size(), 2);
    const std::string run = mesh(declared("short", "HxByteRLE", coded), "@1\n" + coded),
                      zip = mesh(declared("short", "HxZip", zipped), "@1\n" + zipped);
    test::expect_truncations_refused("v.am", run);
    test::expect_bit_flips_harmless("v.am", run, 0, run.size(), 64);
    test::expect_truncations_refused("v.am", zip);
    test::expect_bit_flips_harmless("v.am", zip, 0, zip.size(), 1032);
}

}  // namespace
}  // namespace isoatlas
