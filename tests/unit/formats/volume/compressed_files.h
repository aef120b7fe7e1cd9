// Small compressed volumes of every format that has them, for tests that damage them.
#pragma once

#include <string>
#include <vector>

#include "unit/formats/volume/bzip2_stream.h"
#include "unit/formats/volume/tiff_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas::test {

struct CompressedSeed {
    std::string name;             ///< of the file in the folder that is opened
    std::string damaged;          ///< of the file that is damaged: the same, or the one with the samples
    bool has_checksum = true;     ///< LZW and PackBits have none
    std::string content{};        ///< of `damaged`
    std::int64_t time_step = -1;  ///< to be chosen; -1: there is one volume
};

inline std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

template <class T>
void put_number(std::string& bytes, std::size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// A NIfTI-1 header of 352 bytes for 4 x 3 x 4 samples of 16 bits; of a pair: without the 4 bytes behind it.
inline std::string nifti_header(bool pair) {
    std::string bytes(pair ? 348 : 352, '\0');
    put_number<std::int32_t>(bytes, 0, 348);
    const std::vector<std::int16_t> dim = {3, 4, 3, 4, 1, 1, 1, 1};
    for (std::size_t i = 0; i < dim.size(); ++i) put_number(bytes, 40 + 2 * i, dim[i]);
    put_number<std::int16_t>(bytes, 70, 512);
    put_number<std::int16_t>(bytes, 72, 16);
    for (std::size_t i = 0; i < 4; ++i) put_number(bytes, 76 + 4 * i, 1.0F);
    put_number(bytes, 108, pair ? 0.0F : 352.0F);
    bytes.replace(344, 4, std::string(pair ? "ni1" : "n+1") + '\0');
    return bytes;
}

/// A .vti with two zlib blocks of 48 bytes: appended raw, or inline in base64.
inline std::string vti(const std::string& samples, bool is_inline) {
    const std::string first = zlib(samples.substr(0, 48)), second = zlib(samples.substr(48));
    std::string words(5 * 4, '\0');
    const std::vector<std::size_t> values = {2, 48, 0, first.size(), second.size()};
    for (std::size_t i = 0; i < values.size(); ++i) put_number(words, 4 * i, static_cast<std::uint32_t>(values[i]));
    const std::string begin =
        "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
        "compressor=\"vtkZLibDataCompressor\">"
        "<ImageData WholeExtent=\"0 3 0 2 0 3\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 3 0 2 0 3\">"
        "<PointData Scalars=\"v\"><DataArray type=\"UInt16\" Name=\"v\" format=";
    const std::string end = "</PointData></Piece></ImageData>";
    if (is_inline) return begin + "\"binary\">" + base64(words) + base64(first + second) + "</DataArray>" + end + "</VTKFile>\n";
    return begin + "\"appended\" offset=\"0\"/>" + end + "<AppendedData encoding=\"raw\">_" + words + first + second +
           "</AppendedData></VTKFile>\n";
}

/// 4 x 3 x 4 samples of 16 bits.
inline std::string compressed_samples() { return telling_bytes(96); }

inline void add_tiff(const TestFolder& folder, const std::string& name, const TiffRecipe& recipe, bool has_checksum,
                     std::vector<CompressedSeed>& seeds) {
    write_tiff_file(folder / name, recipe, compressed_samples());
    seeds.push_back({.name = name, .damaged = name, .has_checksum = has_checksum});
}

/// Writes the files and lists them.
inline std::vector<CompressedSeed> compressed_seeds(const TestFolder& folder) {
    const std::string samples = compressed_samples();
    const std::string nrrd = "NRRD0004\n# made for a test\ntype: ushort\ndimension: 3\nsizes: 4 3 4\nspacings: 1 1 2\nendian: little\n";
    const std::string meta =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = True\nCompressedData = True\nElementSpacing = 1 1 2\n"
        "DimSize = 4 3 4\nElementType = MET_USHORT\n";
    const std::string big = swapped(samples, 2);
    std::vector<CompressedSeed> seeds;
    const auto add = [&](const std::string& name, const std::string& content) {
        folder.write(name, content);
        seeds.push_back({.name = name, .damaged = name});
    };
    add("gzip.nrrd", nrrd + "encoding: gzip\n\n" + gzip(samples));
    add("members.nrrd", nrrd + "encoding: gzip\n\n" + gzip(samples.substr(0, 50)) + gzip(samples.substr(50)));
    add("bzip2.nrrd", nrrd + "encoding: bzip2\n\n" + bzip2(samples));
    add("streams.nrrd", nrrd + "encoding: bzip2\n\n" + bzip2(samples.substr(0, 50)) + bzip2(samples.substr(50)));
    add("zlib.mha", meta + "ElementDataFile = LOCAL\n" + zlib(big));
    add("gzip.nii.gz", gzip(nifti_header(false) + samples));
    add("raw.vti", vti(samples, false));
    add("inline.vti", vti(samples, true));
    folder.write("detached.nhdr", nrrd + "encoding: gzip\ndata file: part%d.gz 0 1 1 3\n");
    folder.write("part0.gz", gzip(samples.substr(0, 48)));
    folder.write("part1.gz", gzip(samples.substr(48)));
    seeds.push_back({.name = "detached.nhdr", .damaged = "part1.gz"});
    seeds.push_back({.name = "detached.nhdr", .damaged = "part0.gz"});
    folder.write("blocks.nhdr", nrrd + "encoding: bzip2\ndata file: part%d.bz2 0 1 1 3\n");
    folder.write("part0.bz2", bzip2(samples.substr(0, 48)));
    folder.write("part1.bz2", bzip2(samples.substr(48)));
    seeds.push_back({.name = "blocks.nhdr", .damaged = "part1.bz2"});
    folder.write("zraw.mhd", meta + "ElementDataFile = v.zraw\n");
    folder.write("v.zraw", zlib(big));
    seeds.push_back({.name = "zraw.mhd", .damaged = "v.zraw"});
    seeds.push_back({.name = "zraw.mhd", .damaged = "zraw.mhd"});
    folder.write("pair.hdr", nifti_header(true));
    folder.write("pair.img.gz", gzip(samples));
    seeds.push_back({.name = "pair.hdr", .damaged = "pair.img.gz"});
    folder.write("time.nrrd",
                 "NRRD0004\ntype: ushort\ndimension: 4\nsizes: 4 3 2 2\nkinds: space space space time\nendian: little\n"
                 "encoding: gzip\n\n" +
                     gzip(samples));
    seeds.push_back({.name = "time.nrrd", .damaged = "time.nrrd", .time_step = 0});
    TiffRecipe recipe{.width = 4, .height = 3, .pages = 4, .compression = COMPRESSION_ADOBE_DEFLATE};
    add_tiff(folder, "strips.tif", recipe, true, seeds);
    recipe.predictor = PREDICTOR_HORIZONTAL;
    add_tiff(folder, "predictor.tif", recipe, true, seeds);
    recipe.tile = 16;
    add_tiff(folder, "tiles.tif", recipe, true, seeds);
    recipe = {.width = 4, .height = 3, .pages = 4, .compression = COMPRESSION_LZW};
    add_tiff(folder, "lzw.tif", recipe, false, seeds);
    recipe.compression = COMPRESSION_PACKBITS;
    add_tiff(folder, "packbits.tif", recipe, false, seeds);
    for (CompressedSeed& seed : seeds) seed.content = read_file(folder / seed.damaged);
    return seeds;
}

}  // namespace isoatlas::test
