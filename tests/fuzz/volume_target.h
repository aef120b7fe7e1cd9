// What the fuzz targets of the volume readers share: the input is the content of every file the reader opens; a volume that comes out
// has a sound extent and geometry and reads the same in slabs; only documented errors refuse it; nothing large is allocated.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/file_system.h"
#include "isoatlas/volume.h"

namespace fuzz {

inline void require_volume(bool condition) {
    if (!condition) std::abort();
}

class OnlyFile final : public isoatlas::File {
public:
    explicit OnlyFile(std::span<const std::byte> content) : content_(content) {}
    std::int64_t size() const override { return static_cast<std::int64_t>(content_.size()); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        require_volume(offset >= 0);
        if (offset >= size()) return 0;
        const std::size_t count = std::min(out.size(), content_.size() - static_cast<std::size_t>(offset));
        std::memcpy(out.data(), content_.data() + offset, count);
        return static_cast<std::ptrdiff_t>(count);
    }

private:
    std::span<const std::byte> content_;
};

/// While it lives, one content is behind every path, for at most so many openings: a series of a billion data files exists on no real disk.
class OnlyContent final : public isoatlas::FileSystem {
public:
    explicit OnlyContent(std::span<const std::byte> content, int most_openings = 200)
        : content_(content), left_(most_openings), in_use_(*this) {}
    isoatlas::FileStatus status(const std::string&) override { return {.kind = isoatlas::FileStatus::Kind::regular}; }
    isoatlas::OpenedFile open(const std::string&) override {
        if (left_ == 0) return {nullptr, -ENOENT};
        --left_;
        return {std::make_unique<OnlyFile>(content_), 0};
    }

private:
    std::span<const std::byte> content_;
    int left_;
    isoatlas::ReplacedFileSystem in_use_;
};

inline void check_info(const isoatlas::VolumeInfo& info) {
    require_volume(info.extent.rank == 2 || info.extent.rank == 3);
    for (const std::int64_t size : info.extent.size) require_volume(size >= 1);
    require_volume(info.extent.rank == 3 || info.extent.size[2] == 1);
    for (const double spacing : info.geometry.spacing) require_volume(std::isfinite(spacing) && spacing > 0);
    for (const double origin : info.geometry.origin) require_volume(std::isfinite(origin));
    for (const auto& row : info.geometry.direction) {
        for (const double entry : row) require_volume(std::isfinite(entry) && std::abs(entry) < 1.001);
    }
    require_volume(std::isfinite(info.calibration.slope) && info.calibration.slope != 0 && std::isfinite(info.calibration.intercept));
}

/// Reads the volume at once and slice by slice, when it is small enough for a fuzzer.
inline void read_twice(isoatlas::VolumeReader& reader) {
    constexpr double kMax = 1 << 22;
    const isoatlas::VolumeInfo& info = reader.info();
    const double bytes = static_cast<double>(info.extent.size[0]) * static_cast<double>(info.extent.size[1]) *
                         static_cast<double>(info.extent.size[2]) * static_cast<double>(isoatlas::size_of(info.type));
    if (bytes > kMax) return;
    const std::int64_t slices = info.extent.size[2];
    const std::size_t slice_bytes = static_cast<std::size_t>(info.extent.slice()) * isoatlas::size_of(info.type);
    std::vector<std::byte> whole(static_cast<std::size_t>(slices) * slice_bytes), slice(slice_bytes);
    reader.read(0, slices, whole);
    for (std::int64_t z = 0; z < std::min<std::int64_t>(slices, 50); ++z) {
        reader.read(z, z + 1, slice);
        require_volume(std::memcmp(slice.data(), whole.data() + static_cast<std::size_t>(z) * slice_bytes, slice_bytes) == 0);
    }
}

template <class Open>
int open_and_read(const Open& open, const std::uint8_t* data, std::size_t size, int most_openings = 200) {
    for (const int step : {-1, 1}) {
        const OnlyContent in_use(std::as_bytes(std::span(data, size)), most_openings);
        try {
            isoatlas::OpenOptions options;
            if (step >= 0) options.time_step = step;
            options.skip_rest = step >= 0;
            const std::unique_ptr<isoatlas::VolumeReader> reader = open(std::string("fuzz"), options);
            check_info(reader->info());
            read_twice(*reader);
        } catch (const isoatlas::Error& error) {
            require_volume(error.kind() == isoatlas::ErrorKind::input || error.kind() == isoatlas::ErrorKind::unsupported ||
                           error.kind() == isoatlas::ErrorKind::usage);
            require_volume(!error.text().file.empty() && !error.text().what.empty());
        }
    }
    return 0;
}

}  // namespace fuzz
