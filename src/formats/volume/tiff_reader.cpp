// A VolumeReader of slices that are pages of TIFF files.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/check.h"
#include "formats/volume/choose.h"
#include "formats/volume/chunk_reader.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/tiff_stack.h"

namespace isoatlas {
namespace {

/// One file is open at a time, because of the limit of open files.
class TiffSlices {
public:
    TiffSlices(TiffVolume volume, std::unique_ptr<TiffFile> first) : volume_(std::move(volume)), open_(std::move(first)) {}

    [[nodiscard]] TiffFile& file(std::uint32_t number) {
        if (!open_ || number_ != number) {
            open_.reset();
            open_ = std::make_unique<TiffFile>(volume_.files[number], volume_.skip_rest);
            number_ = number;
        }
        return *open_;
    }
    [[nodiscard]] const TiffVolume& volume() const { return volume_; }

    /// Checks every slice; false: their strips or tiles differ.
    bool check(const TiffPage& page, std::int64_t level) {
        bool is_alike = true;
        for (const TiffSlice& slice : volume_.slices) {
            if (slice.raw >= 0) continue;
            const TiffPage other = file(slice.file).page_at(slice.directory, slice.number, level, level > 0 || volume_.files.size() > 1);
            require_same(page, other, volume_.files[slice.file]);
            is_alike = is_alike && page.same_layout(other);
            offsets_.push_back(file(slice.file).contiguous_offset(other));
        }
        page_ = page, level_ = level, by_pieces_ = is_alike && volume_.slices[0].raw < 0;
        // A file that is opened again may have changed: then its directories are read again.
        if (!by_pieces_ || volume_.files.size() > 1 || std::ranges::find(offsets_, -1) != offsets_.end()) offsets_.clear();
        return by_pieces_;
    }

    void read(const Index3& chunk, std::span<std::byte> out) {
        const TiffSlice& slice = volume_.slices[static_cast<std::size_t>(chunk[2])];
        TiffFile& from = file(slice.file);
        if (slice.raw >= 0) return read_raw(from, slice.raw, out);
        if (!offsets_.empty()) {
            const std::int64_t row = chunk[1] * page_.piece_height, rows = std::min(page_.piece_height, page_.height - row);
            const std::int64_t row_bytes = page_.width * static_cast<std::int64_t>(size_of(page_.type));
            return read_raw(from, offsets_[static_cast<std::size_t>(chunk[2])] + row * row_bytes * page_.pixel.samples,
                            out.first(static_cast<std::size_t>(rows * row_bytes)));
        }
        const TiffPage page = page_again(from, slice);
        if (!page.same_shape(page_) || (by_pieces_ && !page.same_layout(page_))) changed(slice, "");
        if (by_pieces_) return from.read_piece(page, chunk[0], chunk[1], volume_.pixel, out);
        from.read(page, volume_.pixel, out);
    }

private:
    [[noreturn]] void changed(const TiffSlice& slice, const std::string& why) const {
        throw Error(ErrorKind::input, {.file = volume_.files[slice.file],
                                       .what = "the file has changed since the volume was opened" + (why.empty() ? "" : ": " + why),
                                       .next = "open the volume again"});
    }
    /// A page whose directory was sound before.
    [[nodiscard]] TiffPage page_again(TiffFile& from, const TiffSlice& slice) const {
        try {
            return from.page_at(slice.directory, slice.number, level_, false);
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::unsupported) throw;
            changed(slice, error.text().what);
        }
    }
    void require_same(const TiffPage& page, const TiffPage& other, const std::string& path) const {
        if (other.same_shape(page)) return;
        const bool in_one = volume_.files.size() == 1;
        throw Error(ErrorKind::input,
                    {.file = path,
                     .where = "page " + std::to_string(other.number),
                     .what = "the page is " + other.shape(),
                     .expected = page.shape() + " like " + (in_one ? "page " + std::to_string(page.number) : "the first slice"),
                     .next = "all pages of a volume must have one size and type: move other images to other files"});
    }

    void read_raw(TiffFile& from, std::int64_t offset, std::span<std::byte> out) {
        const auto samples = static_cast<std::size_t>(page_.pixel.samples);
        pixels_.resize(samples > 1 ? out.size() * samples : 0);
        const std::span<std::byte> bytes = samples > 1 ? std::span<std::byte>(pixels_) : out;
        from.read_raw(offset, bytes);
        if (needs_swap(from.big_endian())) swap_bytes(bytes, size_of(page_.type));
        if (samples > 1) take_values(pixels_, page_.pixel.samples, page_.type, volume_.pixel, out);
    }

    TiffVolume volume_;
    std::unique_ptr<TiffFile> open_;
    std::uint32_t number_ = 0;
    TiffPage page_;
    std::int64_t level_ = 0;
    bool by_pieces_ = false;
    std::vector<std::int64_t> offsets_;  ///< of the pixels of each slice, where they can be read without libtiff; else empty
    std::vector<std::byte> pixels_;
};

/// A reduced image of a page; nullopt: it cannot be read.
std::optional<TiffPage> reduced_image(TiffFile& file, std::uint64_t directory, std::int64_t number, std::int64_t level) {
    try {
        return file.page_at(directory, number, level, true);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::unsupported) throw;
        return std::nullopt;
    }
}

/// Reduced images of the first slice, up to the first that is none of a pyramid; their pages, the slice itself first.
std::vector<TiffPage> levels_of_page(TiffFile& file, const TiffPage& page, std::vector<std::string>& notes) {
    std::vector<TiffPage> levels{page};
    for (std::int64_t level = 1; level <= page.reduced_images; ++level) {
        std::optional<TiffPage> reduced = reduced_image(file, page.directory, page.number, level);
        const TiffPage& finer = levels.back();
        const bool is_level = reduced && reduced->type == page.type && reduced->pixel == page.pixel && reduced->width <= finer.width &&
                              reduced->height <= finer.height;
        if (!is_level) break;
        levels.push_back(std::move(*reduced));
    }
    const std::int64_t left = page.reduced_images + 1 - std::ssize(levels);
    if (left > 0) notes.push_back(std::to_string(left) + " reduced images are not levels of this one, or are damaged; they are ignored");
    return levels;
}

/// Levels that all slices of the first file have: others may be cut off, while the slices themselves are whole.
std::vector<TiffPage> levels_of(TiffFile& file, const TiffPage& page, const TiffVolume& volume, std::vector<std::string>& notes) {
    std::vector<TiffPage> levels = levels_of_page(file, page, notes);
    for (const TiffSlice& slice : volume.slices) {
        for (std::size_t level = 1; level < levels.size() && slice.file == 0; ++level) {
            const std::optional<TiffPage> reduced = reduced_image(file, slice.directory, slice.number, static_cast<std::int64_t>(level));
            if (reduced && reduced->same_shape(levels[level])) continue;
            notes.push_back("the reduced image of level " + std::to_string(level) + " of page " + std::to_string(slice.number) +
                            " is missing or damaged, perhaps the file is truncated: there are no levels from " + std::to_string(level) +
                            " on, the pages themselves are complete");
            levels.resize(level);
        }
    }
    return levels;
}

void add_times(const TiffPlanes& planes, FileVolumes& volumes) {
    constexpr std::int64_t kMaxTimes = 1 << 20;
    if (!(planes.time_increment > 0) || planes.times < 2 || planes.times > kMaxTimes) return;
    for (std::int64_t i = 0; i < planes.times; ++i) volumes.times.push_back(planes.time_increment * static_cast<double>(i));
    volumes.time_unit = planes.time_unit;
}

}  // namespace

TiffChoice choose_planes(const std::string& path, const OpenOptions& options, const TiffPlanes& planes, const TiffPage& page,
                         VolumeInfo& info) {
    TiffChoice choice;
    choice.channel = choose_pixels(path, options, planes.channels, page.pixel, info);
    choice.is_along_time = planes.times > 1 && planes.slices == 1 && !options.time_step;
    if (choice.is_along_time) {
        info.notes.push_back("the " + std::to_string(planes.times) +
                             " time steps of one slice are read as the third axis (a time step chooses one of them)");
        info.extent = {.rank = 3, .size = {page.width, page.height, planes.times}};
        return choice;
    }
    const TimeStep step = choose_time_step(path, options, planes.times);
    choice.time = step.index;
    info.volumes.time_steps = step.count, info.volumes.time_step = step.index;
    add_times(planes, info.volumes);
    info.extent = {.rank = planes.slices == 1 ? 2 : 3, .size = {page.width, page.height, planes.slices}};
    return choice;
}

Geometry geometry_of_level(Geometry geometry, const Index3& whole, const Index3& level) {
    for (std::size_t a = 0; a < 3; ++a) {
        double factor = static_cast<double>(whole[a]) / static_cast<double>(level[a]);
        for (std::int64_t power = 1; power <= whole[a]; power *= 2) {  // the size was rounded
            if (whole[a] / power == level[a] || (whole[a] - 1) / power + 1 == level[a]) {
                factor = static_cast<double>(power);
                break;
            }
        }
        geometry.origin[a] += geometry.spacing[a] * (factor - 1) / 2;
        geometry.spacing[a] *= factor;
    }
    return geometry;
}

std::unique_ptr<VolumeReader> make_tiff_reader(VolumeInfo info, TiffVolume volume, std::unique_ptr<TiffFile> first, const TiffPage& page,
                                               const OpenOptions& options) {
    ISOATLAS_CHECK(!volume.slices.empty() && volume.slices[0].file == 0);
    const std::int64_t slices = std::ssize(volume.slices);
    std::vector<TiffPage> levels{page};
    if (volume.slices[0].raw < 0) levels = levels_of(*first, page, volume, info.notes);
    const std::int64_t level = choose_level(info.path, options, std::ssize(levels));
    const TiffPage& chosen = levels[static_cast<std::size_t>(level)];
    info.encoding = TiffFile::encoding(chosen.compression);
    info.type = page.type;
    info.big_endian = first->big_endian();
    const Index3 whole{page.width, page.height, slices};
    info.extent.size = {chosen.width, chosen.height, slices};
    static_cast<void>(sample_bytes(info.path, info.extent, info.type));
    if (level > 0) info.geometry = geometry_of_level(info.geometry, whole, info.extent.size);
    info.volumes.level = level;
    if (levels.size() > 1) {
        for (const TiffPage& one : levels) info.volumes.levels.push_back({one.width, one.height, slices});
    }
    const auto reader = std::make_shared<TiffSlices>(std::move(volume), std::move(first));
    const bool by_pieces = reader->check(chosen, level);
    info.chunk = by_pieces ? Index3{chosen.piece_width, chosen.piece_height, 1} : Index3{chosen.width, chosen.height, 1};
    return make_chunk_reader(std::move(info), [reader](const Index3& chunk, std::span<std::byte> out) { reader->read(chunk, out); });
}

}  // namespace isoatlas
