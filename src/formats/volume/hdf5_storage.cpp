#include "formats/volume/hdf5_storage.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "base/check.h"
#include "formats/common/file_access.h"
#include "formats/volume/sample_reader.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr const char* kNeverWritten[] = {"chunk address isn't defined", "storage is not initialized"};

/// What HDF5 says about the innermost cause of its last error.
bool says_never_written() {
    bool found = false;
    const auto look = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
        if (n != 0 || error->desc == nullptr) return 0;
        for (const char* text : kNeverWritten) *static_cast<bool*>(out) |= std::strcmp(error->desc, text) == 0;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &found);
    return found;
}

/// The numbers of an enumeration.
Hdf5Handle numbers_of(hid_t type) {
    return H5Tget_class(type) == H5T_ENUM ? Hdf5Handle(H5Tget_super(type), H5Tclose) : Hdf5Handle(H5Tcopy(type), H5Tclose);
}

/// Whether every field of a number lies inside of it: HDF5 converts what its types say.
bool is_sound(hid_t type) {
    const std::size_t bits = 8 * H5Tget_size(type), precision = H5Tget_precision(type);
    const int offset = H5Tget_offset(type);
    constexpr std::size_t kMostBits = 128;
    if (bits == 0 || bits > kMostBits || precision == 0 || offset < 0 || precision + static_cast<std::size_t>(offset) > bits) return false;
    const H5T_order_t order = H5Tget_order(type);
    if (order != H5T_ORDER_LE && order != H5T_ORDER_BE) return false;
    if (H5Tget_class(type) == H5T_INTEGER) return true;
    std::size_t sign = 0, exponent = 0, exponent_bits = 0, fraction = 0, fraction_bits = 0;
    if (H5Tget_class(type) != H5T_FLOAT || H5Tget_fields(type, &sign, &exponent, &exponent_bits, &fraction, &fraction_bits) < 0)
        return false;
    const auto inside = [&](std::size_t first, std::size_t count) { return count <= precision && first <= precision - count; };
    constexpr std::size_t kMostExponent = 15;
    return inside(sign, 1) && inside(exponent, exponent_bits) && inside(fraction, fraction_bits) && exponent_bits > 0 &&
           fraction_bits > 0 && exponent_bits <= kMostExponent;
}

std::uint64_t product_of(std::span<const std::int64_t> sizes, std::uint64_t bytes, bool& fits) {
    for (const std::int64_t size : sizes) {
        const auto count = static_cast<std::uint64_t>(size);
        fits = fits && (count == 0 || bytes <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) / count);
        bytes = fits ? bytes * count : 0;
    }
    return bytes;
}

}  // namespace

Hdf5Storage::Hdf5Storage(std::shared_ptr<const Hdf5File> file, std::string path, hid_t set, hid_t memory)
    : file_(std::move(file)), path_(std::move(path)), set_(set), memory_(memory) {
    Hdf5File::Data& data = file_->data();
    const Hdf5Handle type(H5Dget_type(set_), H5Tclose), space(H5Dget_space(set_), H5Sclose), creation(H5Dget_create_plist(set_), H5Pclose);
    std::array<hsize_t, H5S_MAX_RANK> dims{};
    const int rank = space < 0 ? -1 : H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    if (type < 0 || creation < 0 || rank < 0) data.fail(path_, "the array cannot be read");
    dims_.assign(dims.begin(), dims.begin() + rank);
    stored_type_ = numbers_of(type);
    stored_bytes_ = H5Tget_size(stored_type_), memory_bytes_ = H5Tget_size(memory_);
    if (!is_sound(stored_type_)) damaged("the type of the numbers is damaged");
    const Hdf5Handle native(H5Tcopy(stored_type_), H5Tclose);
    H5Tset_order(native, H5Tget_order(memory_));
    is_standard_ = H5Tequal(native, memory_) > 0;
    swaps_ = is_standard_ && stored_bytes_ > 1 && H5Tequal(stored_type_, memory_) <= 0;
    bool fits = true;
    const std::uint64_t bytes = product_of(dims_, stored_bytes_, fits);
    const H5D_layout_t layout = H5Pget_layout(creation);
    chunk_ = dims_;
    if (layout == H5D_CHUNKED) {
        open_chunks(creation);
    } else if (layout != H5D_VIRTUAL && H5Pget_external_count(creation) == 0) {
        if (!fits) damaged("the array has more bytes than fit in 63 bits");
        open_bytes(creation, bytes);
    }
    if (is_own()) read_fill(creation);
}

void Hdf5Storage::damaged(const std::string& what, const std::string& where) const {
    throw Error(ErrorKind::input, {.file = file_->path(),
                                   .where = shown_name(path_) + (where.empty() ? "" : ", " + where),
                                   .what = what,
                                   .next = "the file is damaged or cut off: get it again"});
}

void Hdf5Storage::open_chunks(hid_t creation) {
    std::array<hsize_t, H5S_MAX_RANK> chunk{};
    if (H5Pget_chunk(creation, H5S_MAX_RANK, chunk.data()) != static_cast<int>(dims_.size())) damaged("the chunks have other dimensions");
    chunk_.assign(chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(dims_.size()));
    if (std::ranges::find(chunk_, 0) != chunk_.end()) damaged("a chunk has no samples");
    bool fits = true;
    chunk_bytes_ = product_of(chunk_, std::max(stored_bytes_, memory_bytes_), fits);
    if (!fits) damaged("a chunk has more bytes than fit in 63 bits");
    chunk_bytes_ = product_of(chunk_, stored_bytes_, fits);
    const int count = H5Pget_nfilters(creation);
    bool are_known = true;
    for (int i = 0; i < count; ++i) {
        constexpr std::size_t kMostSettings = 32;
        std::array<unsigned, kMostSettings> settings{};
        std::size_t many = settings.size();
        unsigned flags = 0;
        const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &many, settings.data(), 0, nullptr, nullptr);
        filters_.push_back({id, {settings.begin(), settings.begin() + static_cast<std::ptrdiff_t>(std::min(many, kMostSettings))}});
        are_known = are_known && is_known_hdf5_filter(filters_.back());
        const std::vector<std::uint32_t>& set = filters_.back().settings;  // HDF5 trusts its numbers of elements and their size
        constexpr std::size_t kCount = 2, kElement = 4;
        if (id == H5Z_FILTER_SCALEOFFSET && (set.size() <= kElement || std::uint64_t{set[kCount]} * set[kElement] != chunk_bytes_))
            damaged("the settings of the filter scale-offset do not fit the chunks");
    }
    H5D_space_status_t state = H5D_SPACE_STATUS_ERROR;  // the size of the storage is 0 as well where the index is damaged
    if (H5Dget_space_status(set_, &state) < 0) file_->data().fail(path_, "the index of the chunks cannot be read");
    if (are_known) kind_ = state == H5D_SPACE_STATUS_NOT_ALLOCATED ? Kind::empty : Kind::chunks;
}

void Hdf5Storage::open_bytes(hid_t creation, std::uint64_t bytes) {
    const hsize_t stored = H5Dget_storage_size(set_);
    kind_ = Kind::bytes;
    if (H5Pget_layout(creation) == H5D_COMPACT) {
        if (stored != bytes) damaged("the samples take " + std::to_string(stored) + " bytes instead of " + std::to_string(bytes));
        const Hdf5Handle type(H5Dget_type(set_), H5Tclose);
        value_.resize(static_cast<std::size_t>(bytes));
        if (H5Dread(set_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value_.data()) < 0) file_->data().fail(path_, "the samples cannot be read");
        return;
    }
    const haddr_t begin = offset_of_samples(set_);
    if (begin == HADDR_UNDEF) {
        kind_ = Kind::empty;
        return;
    }
    const Hdf5Handle own(H5Iget_file_id(set_), H5Fclose);
    place_ = {file_of_hdf5(own), begin, bytes};
    if (place_.file == nullptr) file_->data().fail(path_, "the array cannot be read");
    const auto size = static_cast<std::uint64_t>(place_.file->size());
    if (stored < bytes || begin > size || bytes > size - begin)
        damaged("the samples take " + std::to_string(bytes) + " bytes from " + std::to_string(begin) + " on, and the file has " +
                std::to_string(size));
}

void Hdf5Storage::read_fill(hid_t creation) {
    fill_.assign(memory_bytes_, std::byte{0});
    H5D_fill_value_t state = H5D_FILL_VALUE_UNDEFINED;
    if (H5Pfill_value_defined(creation, &state) < 0 || state != H5D_FILL_VALUE_USER_DEFINED) return;
    if (H5Pget_fill_value(creation, memory_, fill_.data()) < 0) file_->data().fail(path_, "the fill value cannot be read");
}

bool Hdf5Storage::find(std::span<const std::int64_t> index, Hdf5Range& place, std::uint32_t& skipped) {
    const std::lock_guard lock(hdf5_mutex());
    Hdf5File::Data& data = file_->data();
    std::array<hsize_t, H5S_MAX_RANK> first{};
    for (std::size_t d = 0; d < index.size(); ++d) first[d] = static_cast<hsize_t>(index[d]) * static_cast<hsize_t>(chunk_[d]);
    data.access.forget();
    data.access.noted = &place;
    std::byte unused{};
    const herr_t got = H5Dread_chunk(set_, H5P_DEFAULT, first.data(), &skipped, &unused);
    data.access.noted = nullptr;
    if (got >= 0) return true;
    if (!data.access.failure && says_never_written()) return false;
    data.fail(path_, "a chunk cannot be found");
}

bool Hdf5Storage::load(std::span<const std::int64_t> index) {
    if (kind_ == Kind::empty) return false;
    if (std::ranges::equal(index, index_)) return is_stored_;
    index_.clear();
    Hdf5Range place;
    std::uint32_t skipped = 0;
    is_stored_ = find(index, place, skipped);
    if (is_stored_) {
        std::string where = "the chunk";
        for (const std::int64_t at : index) where += " " + std::to_string(at);
        const auto size = place.file == nullptr ? 0 : static_cast<std::uint64_t>(place.file->size());
        if (place.bytes == 0 || place.begin > size || place.bytes > size - place.begin) damaged("lies outside of the file", where);
        // Filters that do not shrink add little: more bytes than that are no chunk.
        if (place.bytes / 2 > chunk_bytes_ + (std::uint64_t{1} << 20)) damaged("is larger than a chunk can be", where);
        value_.resize(static_cast<std::size_t>(place.bytes));
        read_fully(*place.file, file_->path(), static_cast<std::int64_t>(place.begin), value_);
        const std::string error = undo_hdf5_filters(filters_, skipped, chunk_bytes_, value_, scratch_);
        if (!error.empty()) damaged("is damaged: " + error, where);
    }
    index_.assign(index.begin(), index.end());
    return is_stored_;
}

void Hdf5Storage::read(std::span<const std::int64_t> first, std::span<const std::int64_t> count, std::span<std::byte> out) try {
    ISOATLAS_CHECK(first.size() == dims_.size() && count.size() == dims_.size());
    Rows rows{{first.begin(), first.end()}, {count.begin(), count.end()}, std::vector<std::uint64_t>(dims_.size())};
    const bool has_chunks = this->has_chunks();
    std::vector<std::int64_t> index(dims_.size());
    std::uint64_t stride = stored_bytes_;
    for (std::size_t d = dims_.size(); d-- > 0;) {
        rows.stride[d] = stride;
        stride *= static_cast<std::uint64_t>(has_chunks ? chunk_[d] : dims_[d]);
        if (!has_chunks) continue;
        index[d] = first[d] / chunk_[d];
        rows.first[d] -= index[d] * chunk_[d];
        ISOATLAS_CHECK(rows.first[d] + count[d] <= chunk_[d]);
    }
    if (kind_ == Kind::bytes || (has_chunks && load(index))) return take_rows(rows, out);
    for (std::size_t at = 0; at < out.size(); at += memory_bytes_) std::memcpy(out.data() + at, fill_.data(), memory_bytes_);
} catch (const std::bad_alloc&) {
    throw Error(ErrorKind::resource, {.file = file_->path(),
                                      .where = shown_name(path_),
                                      .what = "not enough memory for a chunk of " + std::to_string(chunk_bytes_) + " bytes",
                                      .next = "free some memory, or write the array again in smaller chunks"});
}

void Hdf5Storage::take_rows(const Rows& rows, std::span<std::byte> out) {
    std::size_t fastest = rows.count.size();  // behind it there is one sample along each dimension
    while (fastest > 0 && rows.count[fastest - 1] == 1) --fastest;
    std::size_t along = fastest > 0 ? fastest - 1 : 0;
    std::int64_t length = fastest > 0 ? rows.count[along] : 1;
    const std::uint64_t step = fastest > 0 ? rows.stride[along] : stored_bytes_;
    while (along > 0 && rows.stride[along - 1] == rows.stride[along] * static_cast<std::uint64_t>(rows.count[along]) &&
           step == stored_bytes_)
        length *= rows.count[--along];  // whole rows, whole slices
    std::vector<std::int64_t> at(along, 0);
    const std::size_t bytes = static_cast<std::size_t>(length) * memory_bytes_;
    for (std::size_t written = 0; written < out.size(); written += bytes) {
        std::uint64_t begin = 0;
        for (std::size_t d = 0; d < rows.first.size(); ++d)
            begin += static_cast<std::uint64_t>(rows.first[d] + (d < along ? at[d] : 0)) * rows.stride[d];
        fetch_row(begin, step, out.subspan(written, bytes));
        for (std::size_t d = along; d-- > 0;) {
            if (++at[d] < rows.count[d]) break;
            at[d] = 0;
        }
    }
}

/// Samples `step` bytes apart.
void Hdf5Storage::fetch_row(std::uint64_t begin, std::uint64_t step, std::span<std::byte> row) {
    constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
    constexpr std::uint64_t kFarApart = 4096;
    const std::size_t samples = row.size() / memory_bytes_;
    const bool is_dense = step == stored_bytes_, is_direct = is_dense && is_standard_;
    const std::size_t reach = is_dense || step < kFarApart ? std::max<std::size_t>(kPieceBytes / static_cast<std::size_t>(step), 1) : 1;
    const std::size_t most = is_direct ? samples : reach;
    for (std::size_t done = 0; done < samples;) {
        const std::size_t some = std::min(most, samples - done), bytes = (some - 1) * static_cast<std::size_t>(step) + stored_bytes_;
        const std::span<std::byte> to = row.subspan(done * memory_bytes_, some * memory_bytes_);
        if (!is_direct) row_.resize(std::max(bytes, to.size()));
        const std::span<std::byte> raw = is_direct ? to : std::span(row_).first(bytes);
        const std::uint64_t from = begin + done * step;
        if (place_.file != nullptr)
            read_fully(*place_.file, file_->path(), static_cast<std::int64_t>(place_.begin + from), raw);
        else
            std::memcpy(raw.data(), value_.data() + from, bytes);
        for (std::size_t i = 1; i < some && !is_dense; ++i)
            std::memmove(raw.data() + i * stored_bytes_, raw.data() + i * step, stored_bytes_);
        is_direct ? (swaps_ ? swap_bytes(to, memory_bytes_) : void()) : convert(raw.first(some * stored_bytes_), to);
        done += some;
    }
}

/// stored: the beginning of row_, which has room for the converted samples.
void Hdf5Storage::convert(std::span<std::byte> stored, std::span<std::byte> out) {
    if (is_standard_) {
        if (swaps_) swap_bytes(stored, stored_bytes_);
    } else {
        const std::lock_guard lock(hdf5_mutex());
        if (H5Tconvert(stored_type_, memory_, out.size() / memory_bytes_, row_.data(), nullptr, H5P_DEFAULT) < 0)
            file_->data().fail(path_, "the samples cannot be converted");
    }
    std::memcpy(out.data(), row_.data(), out.size());
}

}  // namespace isoatlas
