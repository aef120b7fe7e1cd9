// HDF5 lays the file out and writes its own structures; the arrays are written to their offsets by plain writes, so they are checked with
// the same eyes that will read them.
#include "store/pack.h"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "isoatlas/error.h"
#include "store/checksum.h"
#include "store/container.h"

namespace isoatlas::store {
namespace {

static_assert(std::endian::native == std::endian::little, "stores are written as the memory is");

[[noreturn]] void cannot_write(const std::string& path, const std::string& what) {
    throw Error(ErrorKind::resource,
                {.file = path, .what = "cannot be written: " + what, .next = "check space and permissions, then build again"});
}

/// An HDF5 identifier that is closed.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the number

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

hid_t hdf5_type(std::string_view type) {
    if (type == "uint8") return H5T_STD_U8LE;
    if (type == "int8") return H5T_STD_I8LE;
    if (type == "uint16") return H5T_STD_U16LE;
    if (type == "int16") return H5T_STD_I16LE;
    if (type == "uint32") return H5T_STD_U32LE;
    if (type == "int32") return H5T_STD_I32LE;
    if (type == "uint64") return H5T_STD_U64LE;
    if (type == "int64") return H5T_STD_I64LE;
    if (type == "float32") return H5T_IEEE_F32LE;
    ISOATLAS_CHECK(type == "float64");
    return H5T_IEEE_F64LE;
}

/// The file as HDF5 sees it: contiguous arrays with their room taken, no times in it, so that the same store has the same bytes.
class Layout {
public:
    Layout(const std::string& partial, std::string path) : path_(std::move(path)), file_(create(partial)) {
        if (file_ < 0) cannot_write(path_, std::strerror(errno != 0 ? errno : EIO));
    }
    Layout(const Layout&) = delete;
    Layout& operator=(const Layout&) = delete;
    ~Layout() {
        if (file_ >= 0) H5Fclose(file_);
    }
    /// Writes what HDF5 has to say about the arrays.
    void close() {
        errno = 0;
        if (H5Fclose(std::exchange(file_, -1)) < 0) cannot_write(path_, std::strerror(errno != 0 ? errno : EIO));
    }
    /// Takes room for an array and returns its offset; -1 when it is empty.
    [[nodiscard]] std::int64_t add(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape) const {
        const std::vector<hsize_t> dims(shape.begin(), shape.end());
        const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
        const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        add_groups(name);
        H5Pset_layout(creation, H5D_CONTIGUOUS);
        H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
        H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
        H5Pset_obj_track_times(creation, 0);
        const Handle set(H5Dcreate2(file_, name.c_str(), hdf5_type(type), space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
        if (set < 0) cannot_write(path_, "no room for the array " + name);
        const haddr_t address = H5Dget_offset(set);
        return address == HADDR_UNDEF ? -1 : static_cast<std::int64_t>(address);
    }

private:
    /// Groups that HDF5 makes by itself carry the time.
    void add_groups(const std::string& name) const {
        const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
        H5Pset_obj_track_times(creation, 0);
        for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1)) {
            const std::string group = name.substr(0, slash);
            if (H5Lexists(file_, group.c_str(), H5P_DEFAULT) > 0) continue;
            const Handle made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
            if (made < 0) cannot_write(path_, "no room for the group " + group);
        }
    }

    static hid_t create(const std::string& path) {
        H5dont_atexit();  // after a full disk its cleanup at the end of the program would crash
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        H5Pset_userblock(creation, static_cast<hsize_t>(kHeaderBytes));
        H5Pset_obj_track_times(creation, 0);
        H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);  // its structures carry checksums
        errno = 0;
        return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
    }

    std::string path_;
    hid_t file_;
};

/// The same file for plain writes.
class RawFile {
public:
    RawFile(const std::string& partial, std::string path)
        : path_(std::move(path)), descriptor_(::open(partial.c_str(), O_RDWR | O_CLOEXEC)) {
        if (descriptor_ < 0) cannot_write(path_, std::strerror(errno));
    }
    RawFile(const RawFile&) = delete;
    RawFile& operator=(const RawFile&) = delete;
    ~RawFile() { ::close(descriptor_); }
    void write(std::int64_t offset, std::span<const std::byte> bytes) const {
        while (!bytes.empty()) {
            const ::ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
            if (done < 0 && errno == EINTR) continue;
            if (done <= 0) cannot_write(path_, std::strerror(done < 0 ? errno : EIO));
            bytes = bytes.subspan(static_cast<std::size_t>(done));
            offset += done;
        }
    }
    void sync() const {
        if (::fsync(descriptor_) != 0) cannot_write(path_, std::strerror(errno));
    }
    [[nodiscard]] std::int64_t size() const { return ::lseek(descriptor_, 0, SEEK_END); }

private:
    std::string path_;
    int descriptor_;
};

/// Writes an array as it comes and sums up its blocks.
class ArrayWriter {
public:
    ArrayWriter(const RawFile& file, const StoredArray& array) : file_(file), array_(array) {}
    void put(std::span<const std::byte> bytes) {
        ISOATLAS_CHECK(written_ + static_cast<std::int64_t>(bytes.size()) <= array_.bytes());
        file_.write(array_.offset + written_, bytes);
        while (!bytes.empty()) {
            const std::int64_t room = array_.block == 0 ? array_.bytes() - written_ : array_.block - written_ % array_.block;
            const std::span<const std::byte> part = bytes.first(std::min<std::size_t>(bytes.size(), static_cast<std::size_t>(room)));
            XXH3_64bits_update(&state_, part.data(), part.size());
            written_ += static_cast<std::int64_t>(part.size());
            bytes = bytes.subspan(part.size());
            if (array_.block != 0 && (written_ % array_.block == 0 || written_ == array_.bytes())) finish_block();
        }
    }
    [[nodiscard]] const std::vector<std::uint64_t>& sums() const {
        ISOATLAS_CHECK(written_ == array_.bytes());
        return sums_;
    }

private:
    void finish_block() {
        sums_.push_back(XXH3_64bits_digest(&state_));
        XXH3_64bits_reset(&state_);
    }

    struct State : XXH3_state_t {
        State() { XXH3_64bits_reset(this); }
    };

    const RawFile& file_;
    const StoredArray& array_;
    std::int64_t written_ = 0;
    State state_;
    std::vector<std::uint64_t> sums_;
};

/// PATH.partial, removed unless it was finished.
class PartialName {
public:
    explicit PartialName(std::string path) : path_(std::move(path)), partial_(path_ + ".partial") {}
    PartialName(const PartialName&) = delete;
    PartialName& operator=(const PartialName&) = delete;
    ~PartialName() {
        if (!finished_) ::unlink(partial_.c_str());
    }
    [[nodiscard]] const std::string& name() const { return partial_; }
    void finish() {
        if (::rename(partial_.c_str(), path_.c_str()) != 0) cannot_write(path_, std::strerror(errno));
        finished_ = true;
        const std::size_t slash = path_.rfind('/');
        const std::string folder = slash == std::string::npos ? "." : slash == 0 ? "/" : path_.substr(0, slash);
        const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) return;
        ::fsync(descriptor);  // some file systems cannot: the name is then as durable as they make it
        ::close(descriptor);
    }

private:
    std::string path_, partial_;
    bool finished_ = false;
};

void write_array(const RawFile& file, const PackedArray& source, StoredArray& array) {
    ArrayWriter writer(file, array);
    source.feed([&](std::span<const std::byte> bytes) { writer.put(bytes); });
    const std::span<const std::byte> sums = std::as_bytes(std::span(writer.sums()));
    if (array.block == 0) return;
    file.write(array.checksums, sums);
    array.sum = checksum(sums);
}

}  // namespace

void pack_store(const std::string& path, Contents contents, const std::vector<PackedArray>& arrays) {
    PartialName partial(path);
    Header header;
    {
        Layout layout(partial.name(), path);
        contents.arrays.clear();
        for (const PackedArray& source : arrays) {
            StoredArray array{source.name, source.type, source.shape, 0, source.block, 0, 0};
            array.offset = std::max<std::int64_t>(layout.add("/" + source.name, source.type, source.shape), 0);
            if (array.blocks() > 0) array.checksums = layout.add("/checksums/" + source.name, "uint64", {array.blocks()});
            contents.arrays.push_back(std::move(array));
        }
        const RawFile file(partial.name(), path);
        for (std::size_t i = 0; i < arrays.size(); ++i) write_array(file, arrays[i], contents.arrays[i]);
        const std::string text = to_json(contents);
        header.contents_bytes = static_cast<std::int64_t>(text.size());
        header.contents_offset = layout.add("/contents", "uint8", {header.contents_bytes});
        const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
        header.contents_checksum = checksum(bytes);
        file.write(header.contents_offset, bytes);
        layout.close();
    }
    const RawFile file(partial.name(), path);
    header.file_size = file.size();
    file.write(0, bytes_of_header(header));
    file.sync();
    partial.finish();
}

}  // namespace isoatlas::store
