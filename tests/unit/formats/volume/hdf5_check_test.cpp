// What is checked before HDF5 decodes it.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/volume/hdf5_check.h"
#include "formats/volume/hdf5_message_check.h"

namespace isoatlas {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::initializer_list<int> numbers, const std::string& text = {}) {
    Bytes bytes;
    for (const int number : numbers) bytes.push_back(static_cast<std::byte>(number));
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
    return bytes;
}

Bytes operator+(Bytes one, const Bytes& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

Bytes uint8_type() { return bytes_of({0x10, 0, 0, 0, 1, 0, 0, 0, 0, 0, 8, 0}); }

/// Of two names, in version 3.
Bytes enumeration(int members, int bytes, const Bytes& base) {
    return bytes_of({0x38, members, 0, 0, bytes, 0, 0, 0}) + base + bytes_of({}, std::string("no\0yes\0", 7)) + bytes_of({0, 1});
}

TEST(Hdf5Check, NoPrefixOfATypeIsSound) {
    const Bytes member = bytes_of({}, std::string("a\0", 2)) + bytes_of({0}) + enumeration(2, 1, uint8_type());
    const Bytes compound = bytes_of({0x36, 2, 0, 0, 2, 0, 0, 0}) + member + member;
    const Bytes list = bytes_of({0x19, 0, 0, 0, 16, 0, 0, 0}) + compound;
    for (const Bytes& type : {uint8_type(), enumeration(2, 1, uint8_type()), compound, list}) {
        EXPECT_TRUE(is_sound_hdf5_type(type));
        for (std::size_t size = 0; size < type.size(); ++size) EXPECT_FALSE(is_sound_hdf5_type(std::span(type).first(size))) << size;
    }
}

TEST(Hdf5Check, EnumerationsFitTheirMessage) {
    EXPECT_FALSE(is_sound_hdf5_type(enumeration(3, 1, uint8_type())));
    EXPECT_FALSE(is_sound_hdf5_type(enumeration(2, 2, uint8_type())));
    EXPECT_FALSE(is_sound_hdf5_type(enumeration(2, 1, bytes_of({0x13, 0, 0, 0, 1, 0, 0, 0}))));  // of a text
    EXPECT_FALSE(is_sound_hdf5_type(bytes_of({0x10, 0, 0, 0, 1, 0, 0, 0, 4, 0, 8, 0})));         // bits beyond its bytes
}

TEST(Hdf5Check, TypesInsideOfTypesEnd) {
    Bytes lists;
    for (int i = 0; i < 1000; ++i) lists = lists + bytes_of({0x19, 0, 0, 0, 16, 0, 0, 0});
    EXPECT_FALSE(is_sound_hdf5_type(lists + uint8_type()));
}

/// Addresses and lengths of 8 bytes, none of which may lie in the file.
TEST(Hdf5Check, NoPrefixOfAMessageIsSound) {
    const Hdf5Frame frame{nullptr, 0, 8, 8};
    const Bytes nowhere(8, std::byte{0xFF}), eight(8);
    const auto zeros = [](std::size_t count) { return Bytes(count); };
    const std::vector<std::pair<Hdf5Message, Bytes>> messages{
        {Hdf5Message::space, bytes_of({1, 2, 1, 0, 0, 0, 0, 0}) + zeros(32)},
        {Hdf5Message::space, bytes_of({2, 3, 0, 1}) + zeros(24)},
        {Hdf5Message::places_of_links, bytes_of({0, 3}) + eight + nowhere + nowhere + nowhere},
        {Hdf5Message::places_of_attributes, bytes_of({0, 1, 0, 0}) + nowhere + nowhere},
        {Hdf5Message::old_fill_value, bytes_of({2, 0, 0, 0, 7, 7})},
        {Hdf5Message::fill_value, bytes_of({1, 1, 1, 0, 2, 0, 0, 0, 7, 7})},
        {Hdf5Message::fill_value, bytes_of({2, 1, 1, 0})},
        {Hdf5Message::fill_value, bytes_of({2, 1, 1, 1, 1, 0, 0, 0, 7})},
        {Hdf5Message::fill_value, bytes_of({3, 0x2A, 1, 0, 0, 0, 7})},
        {Hdf5Message::link, bytes_of({1, 0, 1, 'a'}) + eight},
        {Hdf5Message::link, bytes_of({1, 0x18, 64, 1, 1, 'a', 5, 0, 0, 'f', 0, 'o', 0})},
        {Hdf5Message::layout, bytes_of({1, 2, 1, 0, 0, 0, 0, 0}) + eight + zeros(8)},
        {Hdf5Message::layout, bytes_of({3, 0, 2, 0, 7, 7})},
        {Hdf5Message::layout, bytes_of({3, 1}) + eight + eight},
        {Hdf5Message::layout, bytes_of({3, 2, 2}) + eight + zeros(8)},
        {Hdf5Message::layout, bytes_of({4, 2, 0, 2, 1, 9, 9, 5}) + zeros(6) + eight},
        {Hdf5Message::group, bytes_of({0, 3}) + eight},
        {Hdf5Message::filters, bytes_of({1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 8, 0, 0, 0, 1, 0}, "deflate") + zeros(1 + 8)},
        {Hdf5Message::filters, bytes_of({2, 1, 1, 0, 0, 0, 1, 0}) + zeros(4)},
        {Hdf5Message::comment, bytes_of({}, std::string("why\0", 4))},
        {Hdf5Message::time, eight},
        {Hdf5Message::driver, bytes_of({0}, "NCSAfami") + bytes_of({2, 0, 7, 7})},
        {Hdf5Message::references, zeros(5)},
        {Hdf5Message::file_space, bytes_of({1, 1, 1}) + zeros(16 + 2 + 13 * 8)},
        {Hdf5Message::cache_image, zeros(17)},
    };
    for (const auto& [kind, whole] : messages) {
        EXPECT_EQ(damage_of_hdf5_message(frame, kind, whole), "") << static_cast<int>(kind);
        for (std::size_t size = 0; size < whole.size(); ++size)
            EXPECT_NE(damage_of_hdf5_message(frame, kind, std::span(whole).first(size)), "") << static_cast<int>(kind) << ", " << size;
    }
}

TEST(Hdf5Check, SourcesNeedTheirChecksum) {
    const Hdf5Frame frame{nullptr, 0, 8, 8};
    // One source: file ".", array "p", all samples of both; the checksum is that which HDF5 writes.
    const Bytes all = bytes_of({3, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const Bytes list = bytes_of({0, 1, 0, 0, 0, 0, 0, 0, 0}) + bytes_of({}, std::string(".\0p\0", 4)) + all + all;
    const Bytes whole = list + bytes_of({0x75, 0xca, 0x59, 0x50});
    EXPECT_TRUE(is_sound_hdf5_source_list(frame, whole));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        Bytes damaged = whole;
        damaged[i] ^= std::byte{1};
        EXPECT_FALSE(is_sound_hdf5_source_list(frame, damaged)) << i;
        EXPECT_FALSE(is_sound_hdf5_source_list(frame, std::span(whole).first(i)));
    }
}

}  // namespace
}  // namespace isoatlas
