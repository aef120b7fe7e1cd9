// Descriptions of types in HDF5: types contain types, which a stack follows.
#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "formats/volume/hdf5_check.h"
#include "formats/volume/hdf5_cursor.h"

namespace isoatlas {
namespace {

constexpr std::size_t kDeepestType = 32;

enum class Class : std::uint8_t { integer, real, time, text, bits, opaque, compound, reference, enumeration, list, array };

/// The beginning of a type.
struct Type {
    std::uint64_t version = 0, flags = 0, size = 0, left = 0;  ///< left: members of a compound that still come
    Class kind{};
};

/// The members before the type of one.
void skip_member(Hdf5Cursor& cursor, const Type& compound) {
    constexpr std::uint64_t kOldDimensions = 28;
    cursor.skip_name(compound.version);
    const int bits = std::max(static_cast<int>(std::bit_width(compound.size)) - 1, 0);
    cursor.skip(compound.version >= 3 ? static_cast<std::uint64_t>(bits / 8 + 1) : 4);
    if (compound.version == 1) cursor.skip(kOldDimensions);
}

/// Whether the bits of a number lie in its bytes.
bool is_sound_number(Hdf5Cursor& cursor, const Type& type) {
    const std::uint64_t bits = 8 * type.size, first = cursor.number(2), count = cursor.number(2);
    bool fits = count > 0 && first + count <= bits;
    if (type.kind == Class::real) {
        const std::uint64_t exponent = cursor.number(1), exponent_bits = cursor.number(1), fraction = cursor.number(1),
                            fraction_bits = cursor.number(1);
        fits = fits && exponent_bits > 0 && fraction_bits > 0 && exponent + exponent_bits <= bits && fraction + fraction_bits <= bits &&
               (type.flags >> 8 & 0xff) < bits;
        cursor.skip(4);
    }
    return fits && cursor.is_sound;
}

void skip_dimensions(Hdf5Cursor& cursor, std::uint64_t version) {
    const std::uint64_t count = cursor.number(1);
    if (count == 0 || count > 32) cursor.is_sound = false;
    cursor.skip((version < 3 ? 3 : 0) + (version < 3 ? 8 : 4) * count);
}

std::optional<Type> begin_type(Hdf5Cursor& cursor) {
    const std::uint64_t word = cursor.number(4), size = cursor.number(4);
    const Type type{
        .version = word >> 4 & 15, .flags = word >> 8, .size = size, .left = word >> 8 & 0xffff, .kind = static_cast<Class>(word & 15)};
    return cursor.is_sound ? std::optional(type) : std::nullopt;
}

/// HDF5 looks at these two itself, and refuses others.
bool is_known(const Type& type) { return type.version >= 1 && type.version <= 4 && type.kind <= Class::array; }

/// What follows the beginning, up to a type inside.
bool has_sound_rest(Hdf5Cursor& cursor, const Type& type) {
    switch (type.kind) {
        case Class::integer:
        case Class::bits:
        case Class::real: return is_sound_number(cursor, type);
        case Class::time: return cursor.skip(2);
        case Class::opaque: return cursor.skip(type.flags & 0xff);
        case Class::compound: skip_member(cursor, type); return cursor.is_sound && type.left > 0;
        case Class::array: skip_dimensions(cursor, type.version); return cursor.is_sound;
        default: return true;
    }
}

bool has_type_inside(const Type& type) { return type.kind == Class::compound || type.kind >= Class::enumeration; }

/// What follows the type inside of an enumeration.
bool has_sound_names(Hdf5Cursor& cursor, const Type& type, const Type& inside) {
    if (inside.kind != Class::integer || inside.size != type.size || type.size > 8) return false;
    for (std::uint64_t i = 0; i < type.left && cursor.is_sound; ++i) cursor.skip_name(type.version);
    return cursor.skip(type.left * type.size);
}

}  // namespace

bool is_sound_hdf5_type(std::span<const std::byte> bytes) {
    Hdf5Cursor cursor{bytes};
    std::vector<Type> open;
    for (;;) {
        const std::optional<Type> begun = begin_type(cursor);
        if (begun && !is_known(*begun)) return true;
        if (!begun || !has_sound_rest(cursor, *begun) || open.size() == kDeepestType) return false;
        if (has_type_inside(*begun)) {
            open.push_back(*begun);
            continue;
        }
        for (Type ended = *begun;; ended = open.back(), open.pop_back()) {
            if (open.empty()) return true;
            Type& outer = open.back();
            if (outer.kind == Class::enumeration && !has_sound_names(cursor, outer, ended)) return false;
            if (outer.kind != Class::compound || --outer.left == 0) continue;
            skip_member(cursor, outer);
            if (!cursor.is_sound) return false;
            break;
        }
    }
}

}  // namespace isoatlas
