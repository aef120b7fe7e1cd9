// Walks a tree of OpenVDB as it is stored: root, nodes of 32^3 and of 16^3 children, leaves of 8^3 voxels; first all masks and the values
// of nodes, then the voxels of all leaves.
#include <array>
#include <bit>
#include <map>

#include "formats/volume/vdb_file.h"
#include "formats/zarr/codecs.h"

namespace isoatlas {
namespace {

constexpr std::uint32_t kVdbZip = 1, kVdbActive = 2, kVdbBlosc = 4;
constexpr std::uint32_t kVdbMasks = 222;  ///< the version from which on values that are not active may be left out
constexpr std::int64_t kVdbLeaf = 512;
constexpr int kVdbTopBits = 5, kVdbMiddleBits = 4, kVdbRootBits = 12;

using VdbPlace = std::array<std::int32_t, 3>;

struct VdbValueType {
    const char* name;
    std::int64_t bytes, half_bytes;
};
constexpr VdbValueType kVdbTypes[] = {{"float", 4, 2}, {"double", 8, 2}, {"int32", 4, 4},  {"int64", 8, 8},
                                      {"bool", 1, 1},  {"vec3s", 12, 6}, {"vec3d", 24, 6}, {"vec3i", 12, 12}};

const VdbValueType* find_vdb_type(const std::string& type) {
    for (const VdbValueType& known : kVdbTypes) {
        if (type == known.name) return &known;
    }
    return nullptr;
}

/// The bits of a mask.
class VdbMask {
public:
    VdbMask(VdbCursor& cursor, std::int64_t size) {
        const std::span<const std::byte> bytes = cursor.bytes(size / 8);
        bytes_.assign(bytes.begin(), bytes.end());
    }
    [[nodiscard]] std::int64_t count() const {
        std::int64_t ones = 0;
        for (const std::byte byte : bytes_) ones += std::popcount(std::to_integer<unsigned>(byte));
        return ones;
    }
    [[nodiscard]] bool meets(const VdbMask& other) const {
        for (std::size_t i = 0; i < bytes_.size(); ++i) {
            if ((bytes_[i] & other.bytes_[i]) != std::byte{0}) return true;
        }
        return false;
    }
    /// Calls use(bit) for the bits that are set, in order.
    template <class Use>
    void each(const Use& use) const {
        for (std::size_t i = 0; i < bytes_.size(); ++i) {
            for (auto rest = std::to_integer<unsigned>(bytes_[i]); rest != 0; rest &= rest - 1)
                use(static_cast<std::int32_t>(8 * i) + std::countr_zero(rest));
        }
    }

private:
    std::vector<std::byte> bytes_;
};

class VdbTreeWalk {
public:
    VdbTreeWalk(VdbCursor& cursor, const VdbTreeForm& form, const VdbValueType& type)
        : cursor_(cursor), form_(form), type_(type), is_bool_(form.type == "bool") {}

    void walk() {
        if (cursor_.number<std::int32_t>() != 1) cursor_.refuse("a tree has one buffer");
        value();
        const auto tiles = cursor_.number<std::uint32_t>(), nodes = cursor_.number<std::uint32_t>();
        for (std::uint32_t i = 0; i < tiles; ++i) {
            static_cast<void>(root_place());
            value();
            if (cursor_.number<std::uint8_t>() > 1) cursor_.refuse("a flag is neither 0 nor 1");
        }
        for (std::uint32_t i = 0; i < nodes; ++i) {
            leaves_ = &root_place();
            top_node();
        }
        for (const auto& [place, leaves] : roots_) {  // by place, as OpenVDB has them
            for (std::int64_t i = 0; i < leaves.count; ++i) leaf(is_bool_ ? &leaves.places[static_cast<std::size_t>(i)] : nullptr);
        }
    }

private:
    struct Leaves {
        VdbPlace root{};
        std::int64_t count = 0;
        std::vector<VdbPlace> places;  ///< of bool, whose leaves have theirs in the file
    };

    Leaves& root_place() {
        constexpr std::int32_t kWithin = (1 << kVdbRootBits) - 1;
        VdbPlace place{};
        for (std::int32_t& coordinate : place) {
            coordinate = cursor_.number<std::int32_t>();
            if ((coordinate & kWithin) != 0) cursor_.refuse("a node of the root is not at a multiple of 4096");
        }
        const auto [found, is_new] = roots_.try_emplace(place);
        if (!is_new) cursor_.refuse("a node of the root is there twice");
        found->second.root = place;
        return found->second;
    }
    static VdbPlace moved(const VdbPlace& from, std::int32_t bit, int bits, int below) {
        const std::int32_t within = (1 << bits) - 1;
        return {from[0] + ((bit >> 2 * bits & within) << below), from[1] + ((bit >> bits & within) << below),
                from[2] + ((bit & within) << below)};
    }
    void top_node() {
        const VdbPlace root = leaves_->root;
        node(kVdbTopBits).each([&](std::int32_t bit) { middle_node(moved(root, bit, kVdbTopBits, kVdbMiddleBits + 3)); });
    }
    void middle_node(const VdbPlace& from) {
        const VdbMask leaves = node(kVdbMiddleBits);
        leaves.each([&](std::int32_t bit) {
            cursor_.skip(kVdbLeaf / 8);
            ++leaves_->count;
            if (is_bool_) leaves_->places.push_back(moved(from, bit, kVdbMiddleBits, 3));
        });
    }
    /// Masks and values of a node; returns the mask of its children.
    VdbMask node(int bits) {
        const std::int64_t size = std::int64_t{1} << 3 * bits;
        VdbMask children(cursor_, size);
        const VdbMask active(cursor_, size);
        if (children.meets(active)) cursor_.refuse("a node has a child and a value in one place");
        values(form_.version < kVdbMasks ? size - children.count() : size, active);
        return children;
    }
    void leaf(const VdbPlace* place) {
        const VdbMask active(cursor_, kVdbLeaf);
        if (is_bool_ || form_.version < kVdbMasks) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto coordinate = cursor_.number<std::int32_t>();
                if (place != nullptr && coordinate != (*place)[axis]) cursor_.refuse("a leaf is in another place than in its tree");
            }
        }
        if (is_bool_) return cursor_.skip(kVdbLeaf / 8);
        if (form_.version < kVdbMasks && cursor_.number<std::uint8_t>() != 1) cursor_.refuse("a leaf has one buffer");
        values(kVdbLeaf, active);
    }
    void values(std::int64_t count, const VdbMask& active) {
        enum Form : std::uint8_t { one = 2, selected = 3, selected_one = 4, selected_two = 5, all = 6 };
        if (form_.version >= kVdbMasks) {
            const auto form = cursor_.number<std::uint8_t>();
            if (form > all) cursor_.refuse("values of a node have no form of the number " + std::to_string(form));
            for (int i = form == selected_two ? 2 : form == one || form == selected_one ? 1 : 0; i > 0; --i) value();
            if (form >= selected && form <= selected_two) cursor_.skip(count / 8);
            if ((form_.compression & kVdbActive) != 0 && form != all) count = active.count();
        }
        if (form_.is_half && count == 0 && type_.half_bytes != type_.bytes) return;  // no chunk
        chunk(count * (form_.is_half ? type_.half_bytes : type_.bytes));
    }
    /// One value as it is.
    void value() {
        if (!is_bool_) return cursor_.skip(type_.bytes);
        if (cursor_.number<std::uint8_t>() > 1) cursor_.refuse("a value is neither false nor true");
    }
    void chunk(std::int64_t bytes) {
        constexpr std::int64_t kMaxOverhead = 1024;
        if ((form_.compression & (kVdbZip | kVdbBlosc)) == 0) return plain_chunk(bytes);
        const auto size = cursor_.number<std::int64_t>();
        if (size <= 0) {  // not worth it
            if (size != -bytes) cursor_.refuse("values of " + std::to_string(bytes) + " bytes have another size");
            return plain_chunk(bytes);
        }
        if (size > bytes + kMaxOverhead) cursor_.refuse("values of " + std::to_string(bytes) + " bytes take more, compressed");
        if (!form_.is_wanted) return cursor_.skip(size);
        const ByteCodec codec{.kind = (form_.compression & kVdbBlosc) != 0 ? ByteCodec::Kind::blosc : ByteCodec::Kind::inflate};
        const std::string error = decode(codec, cursor_.bytes(size), static_cast<std::size_t>(bytes), plain_);
        if (!error.empty()) cursor_.refuse("compressed values are damaged: " + error);
        if (static_cast<std::int64_t>(plain_.size()) != bytes)
            cursor_.refuse("values of " + std::to_string(bytes) + " bytes are " + std::to_string(plain_.size()) + " bytes, compressed");
        check_bools(plain_);
    }
    void plain_chunk(std::int64_t bytes) {
        if (is_bool_) return check_bools(cursor_.bytes(bytes));
        cursor_.skip(bytes);
    }
    /// The bytes of a bool are 0 and 1.
    void check_bools(std::span<const std::byte> values) const {
        if (is_bool_ && std::ranges::any_of(values, [](std::byte value) { return value > std::byte{1}; }))
            cursor_.refuse("a value is neither false nor true");
    }

    VdbCursor& cursor_;
    const VdbTreeForm& form_;
    const VdbValueType& type_;
    bool is_bool_;
    std::map<VdbPlace, Leaves> roots_;
    Leaves* leaves_ = nullptr;  ///< of the node of the root that is being read
    std::vector<std::byte> plain_;
};

}  // namespace

bool is_known_vdb_type(const std::string& type) { return find_vdb_type(type) != nullptr; }

void check_vdb_tree(VdbCursor& cursor, const VdbTreeForm& form) {
    const VdbValueType* type = find_vdb_type(form.type);
    if (type == nullptr) cursor.refuse("it has values of the type " + form.type);
    VdbTreeWalk(cursor, form, *type).walk();
}

}  // namespace isoatlas
