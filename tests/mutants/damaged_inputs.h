// What the probe knows about damaged files: the first promise of the readers that does not hold.
#pragma once

#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <string>

#include "isoatlas/volume.h"
#include "oracle/write_file.h"

namespace mutants {

inline std::string gzip(const std::string& plain) {
    z_stream stream{};
    std::string packed(plain.size() + 100, '\0');
    if (deflateInit2(&stream, 6, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY) != Z_OK) return {};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    stream.avail_in = static_cast<uInt>(plain.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

inline bool is_refused(const std::filesystem::path& path) {
    try {
        (void)isoatlas::load_volume(path.string());
        return false;
    } catch (const isoatlas::Error& error) {
        return error.kind() == isoatlas::ErrorKind::input || error.kind() == isoatlas::ErrorKind::unsupported;
    }
}

/// Empty: all hold.
inline std::string broken_promise_of_readers() {
    std::string name = (std::filesystem::temp_directory_path() / "isoatlas_probe_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return "no folder for files";
    const std::filesystem::path folder = name;
    const std::string samples = "samples of 8 bits, 24 ..", header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: gzip\n";
    std::string damaged = gzip(samples), promise;
    damaged[damaged.size() - 6] = static_cast<char>(damaged[damaged.size() - 6] ^ 1);
    oracle::write_file(folder / "sound.nrrd", header + "\n" + gzip(samples));
    if (is_refused(folder / "sound.nrrd")) promise = "a sound file is read";
    oracle::write_file(folder / "sum.nrrd", header + "\n" + damaged);
    if (!is_refused(folder / "sum.nrrd")) promise = "a wrong checksum is refused";
    oracle::write_file(folder / "longer.nrrd", header + "\n" + gzip(samples + "more"));
    if (!is_refused(folder / "longer.nrrd")) promise = "more than the samples is refused";
    oracle::write_file(folder / "part0", gzip(samples.substr(0, 12) + "more"));
    oracle::write_file(folder / "part1", gzip(samples.substr(12)));
    oracle::write_file(folder / "parts.nhdr", header + "data file: part%d 0 1 1\n");
    if (!is_refused(folder / "parts.nhdr")) promise = "more than its samples in the first of two data files is refused";
    std::filesystem::create_directory(folder / "own");
    std::filesystem::create_symlink("../sound.gz", folder / "own/link.gz");
    oracle::write_file(folder / "sound.gz", gzip(samples));
    oracle::write_file(folder / "own/link.nhdr", header + "data file: link.gz\n");
    if (!is_refused(folder / "own/link.nhdr")) promise = "a link out of the folder is refused";
    const std::string long_number = "NRRD0004\ntype: int64\ndimension: 2\nsizes: 2 1\nencoding: ascii\n\n";
    oracle::write_file(folder / "exact.nrrd", long_number + "1 9007199254740994\n");
    if (is_refused(folder / "exact.nrrd")) promise = "an integer that float64 has is read";
    oracle::write_file(folder / "rounded.nrrd", long_number + "1 9007199254740993\n");
    if (!is_refused(folder / "rounded.nrrd")) promise = "an integer that float64 does not have is refused";
    std::filesystem::remove_all(folder);
    return promise;
}

}  // namespace mutants
