#include "formats/volume/hdf5_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <span>

#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/hdf5_check.h"
#include "formats/volume/hdf5_heap.h"
#include "formats/volume/hdf5_object.h"
#include "formats/volume/hdf5_storage.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr hssize_t kMostOfAttribute = 65536;
constexpr std::size_t kMostBytesOfAttribute = std::size_t{16} << 20;

/// What HDF5 says about the innermost cause of its last error.
std::string last_hdf5_error() {
    std::string text;
    const auto keep = [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
        if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &text);
    return text;
}

/// An attribute with its type and the number of its elements; count 0: there is none, or too much of it.
struct OpenAttribute {
    Hdf5Handle attribute, type, space;
    hssize_t count = 0;
};

OpenAttribute open_attribute(Hdf5File::Data& data, const std::string& object, const std::string& name) {
    OpenAttribute open;
    if (!data.damage(object).empty()) return open;
    if (H5Aexists_by_name(data.file, object.c_str(), name.c_str(), data.links) <= 0) return open;
    open.attribute = {H5Aopen_by_name(data.file, object.c_str(), name.c_str(), H5P_DEFAULT, data.links), H5Aclose};
    if (open.attribute < 0) return open;
    open.type = {H5Aget_type(open.attribute), H5Tclose};
    open.space = {H5Aget_space(open.attribute), H5Sclose};
    if (open.type < 0 || open.space < 0) return open;
    const hssize_t count = H5Sget_simple_extent_npoints(open.space);
    const std::size_t bytes = H5Tget_size(open.type);
    const bool is_bounded =
        count > 0 && count <= kMostOfAttribute && bytes > 0 && bytes <= kMostBytesOfAttribute / static_cast<std::size_t>(count);
    if (is_bounded && H5Aget_storage_size(open.attribute) > 0) open.count = count;
    return open;
}

std::vector<std::string> texts_of_any_length(const OpenAttribute& open) {
    std::vector<std::string> texts;
    for (const std::vector<std::byte>& bytes : read_hdf5_lists(open.attribute, 1)) {
        std::string text;
        for (const std::byte byte : bytes) text += static_cast<char>(byte);
        texts.push_back(text.substr(0, text.find('\0')));
    }
    return texts;
}

std::vector<std::string> texts_of_one_length(const OpenAttribute& open) {
    const std::size_t size = H5Tget_size(open.type);
    std::string read(size * static_cast<std::size_t>(open.count), '\0');
    std::vector<std::string> texts;
    if (H5Aread(open.attribute, open.type, static_cast<void*>(read.data())) < 0) return texts;
    const bool is_padded = H5Tget_strpad(open.type) == H5T_STR_SPACEPAD;
    for (std::size_t i = 0; i < read.size(); i += size) {
        std::string_view text = std::string_view(read).substr(i, size);
        text = text.substr(0, text.find('\0'));
        while (is_padded && size > 1 && text.ends_with(' ')) text.remove_suffix(1);
        texts.emplace_back(text);
    }
    return texts;
}

/// Locks again at the end: what was opened is closed under the lock.
class Relock {
public:
    explicit Relock(std::unique_lock<std::mutex>& lock) : lock_(lock) {}
    Relock(const Relock&) = delete;
    Relock& operator=(const Relock&) = delete;
    ~Relock() { lock_.lock(); }

private:
    std::unique_lock<std::mutex>& lock_;
};

/// All numbers of an array of at most two dimensions.
void read_line(Hdf5Storage& storage, std::span<double> values) {
    const std::size_t rank = storage.dims().size();
    if (values.empty()) return;
    if (rank == 0) return storage.read({}, {}, std::as_writable_bytes(values));
    const bool is_line = rank == 1;
    const std::int64_t rows = is_line ? 1 : storage.dims()[0], columns = storage.dims()[rank - 1];
    const std::int64_t high = is_line ? 1 : storage.chunk()[0], wide = storage.chunk()[rank - 1];
    std::vector<double> part;
    for (std::int64_t y = 0; y < rows; y += high) {
        for (std::int64_t x = 0; x < columns; x += wide) {
            const std::int64_t height = std::min(high, rows - y), width = std::min(wide, columns - x);
            part.resize(static_cast<std::size_t>(height * width));
            const std::array<std::int64_t, 2> first{y, x}, count{height, width};
            storage.read(std::span(first).last(rank), std::span(count).last(rank), std::as_writable_bytes(std::span(part)));
            for (std::int64_t row = 0; row < height; ++row)
                std::copy_n(part.begin() + row * width, width, values.begin() + (y + row) * columns + x);
        }
    }
}

}  // namespace

void Hdf5File::Data::fail(const std::string& where, const std::string& what) {
    const std::string reason = last_hdf5_error();
    const std::optional<Error> cause = access.failure ? access.failure : access.missing;
    access.forget();
    if (cause) throw Error(*cause);
    throw Error(ErrorKind::input, {.file = access.path,
                                   .where = shown_name(where),
                                   .what = what + (reason.empty() ? "" : " (HDF5: " + shown_name(reason) + ")"),
                                   .next = "the file is damaged or cut off: get it again"});
}

bool Hdf5File::Data::find(hid_t in, const std::string& object, Hdf5Info& info) {
    for (std::size_t end = 0; end != std::string::npos;) {
        end = object.find('/', end + 1);
        const std::string part = object.substr(0, end);
        if (H5Oget_info_by_name2(in, part.c_str(), &info, H5O_INFO_BASIC, links) < 0) return false;
        if (info.type != H5O_TYPE_GROUP) continue;
        if (const std::string damage = damage_at(info.fileno, info.addr); !damage.empty()) fail(part, damage);
    }
    return true;
}

std::string Hdf5File::Data::damage(const std::string& object) {
    Hdf5Info info{};
    if (!find(object, info)) return "cannot be found";  // HDF5 would read attributes of what is no object
    return damage_at(info.fileno, info.addr);
}

std::string Hdf5File::Data::damage_at(unsigned long number, haddr_t address) {
    const auto name = access.names.find(number);
    if (name == access.names.end() || sound.contains({number, address})) return {};
    std::string damage = "its file cannot be read again";
    try {
        const std::unique_ptr<File> opened = open_file(name->second);
        if (const std::optional<Hdf5Frame> frame = hdf5_frame_of(*opened)) damage = damage_of_hdf5_header(*frame, address);
    } catch (const Error& error) {
        access.failure = error;
    }
    if (damage.empty()) sound.emplace(number, address);
    return damage;
}

Hdf5Handle Hdf5File::Data::open_array(const std::string& path, hid_t properties) {
    access.forget();
    // The path may lead through links, which H5Dopen2 follows by the properties of the file alone.
    Hdf5Info info{};
    if (!find(path, info)) fail(path, "cannot be found");
    if (info.type != H5O_TYPE_DATASET) fail(path, "is not an array");
    if (const std::string damage = damage_at(info.fileno, info.addr); !damage.empty()) fail(path, damage);
    Hdf5Handle set(H5Dopen2(file, path.c_str(), properties), H5Dclose);
    if (set < 0) fail(path, "cannot be opened");
    return set;
}

Hdf5File::Hdf5File(const std::string& path, bool follow_links) : data_(std::make_unique<Data>()) {
    const std::lock_guard lock(hdf5_mutex());
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    data_->access.path = path;
    data_->access.follow_links = follow_links;
    const Hdf5Handle properties = hdf5_access_properties(data_->access);
    data_->file = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, properties), H5Fclose};
    if (data_->file < 0) data_->fail("superblock", "HDF5 cannot open the file");
    data_->links = {H5Pcreate(H5P_LINK_ACCESS), H5Pclose};
}

Hdf5File::~Hdf5File() {
    const std::lock_guard lock(hdf5_mutex());
    data_.reset();
}

const std::string& Hdf5File::path() const { return data_->access.path; }

Hdf5File::Kind Hdf5File::kind(const std::string& object, std::optional<Error>* refused) const {
    const std::lock_guard lock(hdf5_mutex());
    data_->access.forget();
    Hdf5Info info{};
    if (!data_->find(object, info)) {
        if (refused != nullptr) *refused = data_->access.failure ? data_->access.failure : data_->access.missing;
        return Kind::none;
    }
    return info.type == H5O_TYPE_GROUP ? Kind::group : info.type == H5O_TYPE_DATASET ? Kind::array : Kind::other;
}

std::string Hdf5File::identity(const std::string& object) const {
    const std::lock_guard lock(hdf5_mutex());
    Hdf5Info info{};
    if (!data_->find(object, info)) return {};
    return std::to_string(info.fileno) + ":" + std::to_string(info.addr);
}

std::vector<std::string> Hdf5File::names(const std::string& group) const {
    const std::lock_guard lock(hdf5_mutex());
    std::vector<std::string> names;
    Hdf5Info info{};
    if (!data_->find(group, info)) return names;
    if (info.type != H5O_TYPE_GROUP) return names;
    const Hdf5Handle opened(H5Oopen(data_->file, group.c_str(), data_->links), H5Oclose);
    if (opened < 0) return names;
    const auto add = [](hid_t, const char* name, void* out) -> herr_t {
        auto& list = *static_cast<std::vector<std::string>*>(out);
        if (list.size() >= kMostNames) return 1;
        try {
            list.emplace_back(name);
        } catch (const std::bad_alloc&) {
            return -1;
        }
        return 0;
    };
    // libhdf5 1.10 crashes where it lists a group with a link that it cannot read: looking for a name that no link has reads each by
    // itself. Not H5Literate, which asks the classes of links about each, and crashes on external ones without a target.
    int next = 0;
    const bool is_sound = H5Lexists(opened, "\x01", H5P_DEFAULT) >= 0;
    if (!is_sound || H5Giterate(opened, ".", &next, add, &names) < 0) data_->fail(group, "the group cannot be listed");
    std::ranges::sort(names);
    return names;
}

Hdf5Array Hdf5File::array(const std::string& path) const {
    const std::lock_guard lock(hdf5_mutex());
    const Hdf5Handle set = data_->open_array(path);
    const Hdf5Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose), creation(H5Dget_create_plist(set), H5Pclose);
    if (type < 0 || space < 0 || creation < 0) data_->fail(path, "the array cannot be read");
    Hdf5Array array{.path = path, .type = hdf5_type_of(type)};
    std::array<hsize_t, H5S_MAX_RANK> dims{};
    const int rank = H5Sget_simple_extent_type(space) == H5S_NULL ? -1 : H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    if (rank < 0) {
        array.type = {.name = "no numbers"};
        return array;
    }
    for (const hsize_t size : std::span(dims).first(static_cast<std::size_t>(rank))) {
        if (size > static_cast<hsize_t>(std::numeric_limits<std::int64_t>::max())) data_->fail(path, "a dimension does not fit in 63 bits");
        array.dims.push_back(static_cast<std::int64_t>(size));
    }
    if (H5Pget_layout(creation) == H5D_CHUNKED && H5Pget_chunk(creation, rank, dims.data()) == rank)
        array.chunk.assign(dims.begin(), dims.begin() + rank);
    for (const auto& [id, name] : hdf5_filters(creation)) {
        std::string text = id == H5Z_FILTER_DEFLATE ? "gzip" : lower(name);
        if (text.empty()) text = "filter " + std::to_string(id);
        array.encoding += (array.encoding.empty() ? "" : ", ") + text;
    }
    if (array.encoding.empty()) array.encoding = "raw";
    return array;
}

std::vector<double> Hdf5File::line(const std::string& path) const {
    std::unique_lock lock(hdf5_mutex());
    const Hdf5Handle set = data_->open_array(path);
    const Hdf5Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    if (count < 0) data_->fail(path, "the array cannot be read");
    const bool is_line = H5Sget_simple_extent_ndims(space) <= 2 && hdf5_type_of(type).is_number;
    if (!is_line || count > kMostNumbers) {
        throw Error(ErrorKind::unsupported, {.file = data_->access.path,
                                             .where = shown_name(path),
                                             .what = is_line ? "has " + std::to_string(count) + " numbers" : "is not a list of numbers",
                                             .expected = "a list of at most " + std::to_string(kMostNumbers) + " numbers",
                                             .next = "choose another dataset"});
    }
    data_->check_storage(set, path);
    std::vector<double> values(static_cast<std::size_t>(count));
    Hdf5Storage storage({std::shared_ptr<void>(), this}, path, set, H5T_NATIVE_DOUBLE);
    if (storage.is_own()) {
        lock.unlock();
        const Relock relock(lock);
        read_line(storage, values);
    } else if (count > 0 && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        data_->fail(path, "the numbers cannot be read");
    return values;
}

std::vector<std::vector<std::string>> Hdf5File::references(const std::string& object, const std::string& name) const {
    const std::lock_guard lock(hdf5_mutex());
    std::vector<std::vector<std::string>> lists;
    const OpenAttribute open = open_attribute(*data_, object, name);
    Hdf5Info owner{};
    if (open.count == 0 || H5Tget_class(open.type) != H5T_VLEN || H5Oget_info2(open.attribute, &owner, H5O_INFO_BASIC) < 0) return lists;
    const Hdf5Handle element(H5Tget_super(open.type), H5Tclose);
    if (H5Tequal(element, H5T_STD_REF_OBJ) <= 0) return lists;
    for (const std::vector<std::byte>& list : read_hdf5_lists(open.attribute, sizeof(hobj_ref_t))) {
        std::vector<std::string> identities;
        for (std::size_t i = 0; i < std::min<std::size_t>(list.size() / sizeof(hobj_ref_t), 64); ++i) {
            hobj_ref_t reference{};
            std::memcpy(&reference, list.data() + i * sizeof reference, sizeof reference);
            const bool is_sound = data_->damage_at(owner.fileno, reference).empty();
            const Hdf5Handle target(is_sound ? H5Rdereference2(open.attribute, H5P_DEFAULT, H5R_OBJECT, &reference) : -1, H5Oclose);
            Hdf5Info info{};
            const bool is_there = target >= 0 && H5Oget_info2(target, &info, H5O_INFO_BASIC) >= 0;
            identities.push_back(is_there ? std::to_string(info.fileno) + ":" + std::to_string(info.addr) : "");
        }
        lists.push_back(std::move(identities));
    }
    return lists;
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& attribute) const {
    const std::lock_guard lock(hdf5_mutex());
    if (!data_->damage(object).empty()) return false;
    return H5Aexists_by_name(data_->file, object.c_str(), attribute.c_str(), data_->links) > 0;
}

std::vector<std::string> Hdf5File::texts(const std::string& object, const std::string& attribute) const {
    const std::lock_guard lock(hdf5_mutex());
    const OpenAttribute open = open_attribute(*data_, object, attribute);
    if (open.count == 0 || H5Tget_class(open.type) != H5T_STRING) return {};
    return H5Tis_variable_str(open.type) > 0 ? texts_of_any_length(open) : texts_of_one_length(open);
}

std::string Hdf5File::text(const std::string& object, const std::string& attribute) const {
    std::string whole;
    for (const std::string& text : texts(object, attribute)) whole += text;
    return std::string(trim(whole));
}

namespace {

template <class Number>
std::vector<Number> attribute_numbers(Hdf5File::Data& data, const std::string& object, const std::string& attribute, hid_t memory) {
    const std::lock_guard lock(hdf5_mutex());
    const OpenAttribute open = open_attribute(data, object, attribute);
    if (open.count == 0 || !hdf5_type_of(open.type).is_number) return {};
    std::vector<Number> values(static_cast<std::size_t>(open.count));
    if (H5Aread(open.attribute, memory, values.data()) < 0) values.clear();
    return values;
}

}  // namespace

std::vector<double> Hdf5File::numbers(const std::string& object, const std::string& attribute) const {
    return attribute_numbers<double>(*data_, object, attribute, H5T_NATIVE_DOUBLE);
}

std::vector<std::uint64_t> Hdf5File::integers(const std::string& object, const std::string& attribute, WideInteger type) const {
    const hid_t memory = type == WideInteger::int64 ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64;
    return attribute_numbers<std::uint64_t>(*data_, object, attribute, memory);
}

std::string join_path(const std::string& group, const std::string& name) { return group + (group.ends_with('/') ? "" : "/") + name; }

}  // namespace isoatlas
