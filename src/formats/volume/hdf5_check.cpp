// Headers of objects: version 1 and 2, with their continuations and the named types that they refer to.
#include "formats/volume/hdf5_check.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/volume/hdf5_cursor.h"
#include "formats/volume/hdf5_message_check.h"

namespace isoatlas {
namespace {

constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{16} << 20, kMaxBytes = std::uint64_t{128} << 20;
constexpr std::size_t kMaxHeaders = 1000, kMaxChunks = 100'000;
constexpr unsigned kSharedFlag = 2;
constexpr std::size_t kTypeSizeAt = 4;

bool begins_with(std::span<const std::byte> bytes, std::string_view text) {
    return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

/// Walks through a header and what it refers to. Throws nothing; the first damage ends it.
class HeaderWalk {
public:
    explicit HeaderWalk(const Hdf5Frame& frame) : frame_(frame) {}

    std::string run(std::uint64_t address) {
        add_header(address);
        while (!headers_.empty() && damage_.empty()) {
            const std::uint64_t next = headers_.front();
            headers_.pop_front();
            walk_header(next);
        }
        if (needs_table_ && !has_table_) damaged("a part of its header lies in a heap that the file has not");
        return damage_;
    }

private:
    struct Chunk {
        std::uint64_t address, bytes;
        bool is_continuation;
    };

    void damaged(std::string what) {
        if (damage_.empty()) damage_ = std::move(what);
    }
    void add_header(std::uint64_t address) {
        if (seen_.size() < kMaxHeaders && seen_.insert(address).second) headers_.push_back(address);
    }

    /// The first bytes of a header, up to its messages.
    bool begin_header(std::uint64_t address, Chunk& first) {
        std::vector<std::byte> bytes(static_cast<std::size_t>(std::min<std::uint64_t>(frame_.rest(address), 64)));
        if (bytes.size() < 16 || !frame_.read(address, bytes)) return false;
        is_new_ = begins_with(bytes, "OHDR\2");
        if (!is_new_) {
            constexpr std::uint64_t kPrefix = 16;
            first = {address + kPrefix, hdf5_number(bytes, 8, 4), false};
            return hdf5_number(bytes, 0, 1) == 1;
        }
        const std::uint64_t flags = hdf5_number(bytes, 5, 1);
        const std::size_t at = 6 + ((flags & 0x20) != 0 ? 16 : 0) + ((flags & 0x10) != 0 ? 4 : 0), width = std::size_t{1} << (flags & 3);
        has_order_ = (flags & 4) != 0;
        if (at + width > bytes.size()) return false;
        first = {address + at + width, hdf5_number(bytes, at, width), false};
        return true;
    }

    void walk_header(std::uint64_t address) {
        Chunk first{};
        is_extension_ = frame_.extension == address;
        if (!begin_header(address, first)) return damaged("the header of the object is not one");
        chunks_.assign(1, first);
        for (std::size_t i = 0; i < chunks_.size() && damage_.empty(); ++i) walk_chunk(chunks_[i]);
    }

    void walk_chunk(Chunk chunk) {
        if (chunk.bytes > frame_.rest(chunk.address) || chunk.bytes > kMaxChunkBytes) return damaged("its header does not lie in the file");
        bytes_ += chunk.bytes;
        if (bytes_ > kMaxBytes || chunks_.size() > kMaxChunks) return damaged("its header has no end");
        std::vector<std::byte> bytes(static_cast<std::size_t>(chunk.bytes));
        if (!frame_.read(chunk.address, bytes)) return damaged("its header cannot be read");
        std::span<const std::byte> messages = bytes;
        if (is_new_ && chunk.is_continuation) {
            if (bytes.size() < 8 || !begins_with(bytes, "OCHK")) return damaged("its header goes on where there is none");
            messages = messages.subspan(4, bytes.size() - 8);  // a checksum at the end
        }
        walk_messages(messages);
    }

    void walk_messages(std::span<const std::byte> bytes) {
        const std::size_t prefix = !is_new_ ? 8 : has_order_ ? 6 : 4;
        for (std::size_t at = 0; bytes.size() - at >= prefix && damage_.empty();) {
            const std::size_t kind_bytes = is_new_ ? 1 : 2;
            const std::uint64_t kind = hdf5_number(bytes, at, kind_bytes), size = hdf5_number(bytes, at + kind_bytes, 2),
                                flags = hdf5_number(bytes, at + kind_bytes + 2, 1);
            at += prefix;
            if (size > bytes.size() - at) return damaged("a message of its header does not lie in it");
            check_message(kind, (flags & kSharedFlag) != 0, bytes.subspan(at, static_cast<std::size_t>(size)));
            at += static_cast<std::size_t>(size);
        }
    }

    void check_message(std::uint64_t number, bool is_shared, std::span<const std::byte> bytes) {
        const auto kind = static_cast<Hdf5Message>(std::min<std::uint64_t>(number, 0xFF));
        if (is_shared) return check_shared(bytes);
        if (kind == Hdf5Message::heap_table && is_extension_) has_table_ = true;
        if (std::string damage = damage_of_hdf5_message(frame_, kind, bytes); !damage.empty()) return damaged(damage);
        if (kind == Hdf5Message::type) return check_type(bytes);
        if (kind == Hdf5Message::layout) return check_sources(bytes);
        if (kind == Hdf5Message::attribute) return check_attribute(bytes);
        if (kind != Hdf5Message::continuation) return;
        Hdf5Cursor cursor{bytes};
        const std::uint64_t address = cursor.number(frame_.address_bytes), size = cursor.number(frame_.length_bytes);
        if (!cursor.is_sound) return damaged("its header goes on nowhere");
        chunks_.push_back({address, size, true});
    }

    void check_type(std::span<const std::byte> bytes) {
        if (!is_sound_hdf5_type(bytes)) return damaged("a type does not fit in its header");
        type_bytes_ = hdf5_number(bytes, kTypeSizeAt, 4);
    }

    /// A message that lies in the header of another object, or in a heap of the file.
    void check_shared(std::span<const std::byte> bytes) {
        if (is_in_heap(bytes)) {
            needs_table_ = true;
            if (frame_.extension) add_header(*frame_.extension);
            return;
        }
        const std::optional<std::uint64_t> address = shared_address(bytes);
        if (!address) return damaged("a part of its header is nowhere");
        add_header(*address);
    }

    static bool is_in_heap(std::span<const std::byte> bytes) {
        Hdf5Cursor cursor{bytes};
        const std::uint64_t version = cursor.number(1), kind = cursor.number(1);
        return version >= 2 && kind == 1;
    }
    [[nodiscard]] std::optional<std::uint64_t> shared_address(std::span<const std::byte> bytes) const {
        Hdf5Cursor cursor{bytes};
        const std::uint64_t version = cursor.number(1);
        cursor.skip(version == 1 ? 7 + frame_.length_bytes : 1);
        const std::uint64_t address = cursor.number(frame_.address_bytes);
        return cursor.is_sound ? std::optional(address) : std::nullopt;
    }

    /// Bytes of an element of a type that another object is; nullopt: it lies in a heap, or is damaged.
    std::optional<std::uint64_t> named_type_bytes(std::span<const std::byte> bytes) {
        const std::optional<std::uint64_t> address = is_in_heap(bytes) ? std::nullopt : shared_address(bytes);
        if (!address || is_nested_) return std::nullopt;
        if (const auto known = named_types_.find(*address); known != named_types_.end()) return known->second;
        HeaderWalk named(frame_);
        named.is_nested_ = true, named.bytes_ = bytes_;
        named.walk_header(*address);
        bytes_ = named.bytes_;
        return named_types_.emplace(*address, named.damage_.empty() ? named.type_bytes_ : std::nullopt).first->second;
    }

    /// Elements of a space whose message is sound.
    [[nodiscard]] double points_of(std::span<const std::byte> bytes) const {
        constexpr std::uint64_t kNone = 2;
        Hdf5Cursor cursor{bytes};
        const std::uint64_t version = cursor.number(1), rank = cursor.number(1);
        cursor.skip(1);
        if (version >= 2 && cursor.number(1) == kNone) return 0;
        if (version == 1) cursor.skip(5);
        double points = 1;
        for (std::uint64_t i = 0; i < rank; ++i) points *= static_cast<double>(cursor.number(frame_.length_bytes));
        return points;
    }

    void check_attribute(std::span<const std::byte> bytes) {
        Hdf5Cursor cursor{bytes};
        const std::uint64_t version = cursor.number(1), flags = cursor.number(1), name = cursor.number(2), type = cursor.number(2),
                            space = cursor.number(2);
        if (version == 3) cursor.skip(1);
        const auto padded = [&](std::uint64_t size) { return version == 1 ? (size + 7) / 8 * 8 : size; };
        const std::size_t name_at = cursor.at;
        cursor.skip(padded(name));
        const std::size_t type_at = cursor.at;
        cursor.skip(padded(type));
        const std::size_t space_at = cursor.at;
        cursor.skip(padded(space));
        if (!cursor.is_sound) return damaged("an attribute does not fit in its header");
        const auto part = [&](std::size_t at, std::uint64_t size) { return bytes.subspan(at, static_cast<std::size_t>(size)); };
        const auto text = part(name_at, name);
        const bool is_named = std::ranges::find(text, std::byte{0}) != text.end();
        const bool has_shared_type = version > 1 && (flags & 1) != 0, has_shared_space = version > 1 && (flags & 2) != 0;
        if (!is_named || (!has_shared_space && !is_sound_hdf5_space(frame_, part(space_at, space))))
            return damaged("an attribute is damaged");
        if (has_shared_space) check_shared(part(space_at, space));
        has_shared_type ? check_shared(part(type_at, type)) : check_type(part(type_at, type));
        if (has_shared_space || !damage_.empty()) return;
        const std::optional<std::uint64_t> size = has_shared_type ? named_type_bytes(part(type_at, type)) : type_bytes_;
        const auto rest = static_cast<double>(bytes.size() - cursor.at);
        if (size && points_of(part(space_at, space)) * static_cast<double>(*size) > rest)
            damaged("the values of an attribute do not fit in it");
    }

    void check_sources(std::span<const std::byte> bytes) {
        constexpr std::uint64_t kVirtual = 3;
        Hdf5Cursor cursor{bytes};
        const std::uint64_t version = cursor.number(1), kind = cursor.number(1);
        if (version < 4 || kind != kVirtual) return;
        const std::uint64_t address = cursor.number(frame_.address_bytes), number = cursor.number(4);
        if (cursor.is_sound && address == hdf5_nowhere(frame_)) return;
        const std::vector<std::byte> collection = cursor.is_sound ? read_hdf5_collection(frame_, address) : std::vector<std::byte>{};
        if (collection.empty() || !is_sound_hdf5_collection(frame_, collection) || number == 0 ||
            !is_sound_hdf5_source_list(frame_, hdf5_object(frame_, collection, number)))
            damaged("the list of its sources is damaged");
    }

    const Hdf5Frame& frame_;
    std::deque<std::uint64_t> headers_;
    std::set<std::uint64_t> seen_;
    std::vector<Chunk> chunks_;  ///< of the header
    std::string damage_;
    std::uint64_t bytes_ = 0;
    std::optional<std::uint64_t> type_bytes_{};  ///< of an element of the last type
    std::map<std::uint64_t, std::optional<std::uint64_t>> named_types_;
    bool is_nested_ = false;  ///< walks a named type alone
    bool is_new_ = false, has_order_ = false, is_extension_ = false;
    bool needs_table_ = false, has_table_ = false;  ///< of shared messages
};

}  // namespace

std::string damage_of_hdf5_header(const Hdf5Frame& frame, std::uint64_t address) { return HeaderWalk(frame).run(address); }

}  // namespace isoatlas
