// Labels of images in the private tags of ImageJ.
#include "formats/volume/imagej_labels.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace isoatlas {
namespace {

using Bytes = std::vector<std::byte>;
using Texts = std::vector<std::string>;

void add(Bytes& bytes, std::uint32_t value, int size, bool big_endian) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> 8 * (big_endian ? size - 1 - i : i)));
}

struct Tags {
    std::vector<std::uint32_t> counts;
    Bytes texts;
};

/// kinds: "labl" and others, with their texts, in UTF-16.
Tags tags_of(const std::vector<std::pair<std::uint32_t, std::vector<std::u16string>>>& kinds, bool big_endian) {
    Tags tags;
    add(tags.texts, 0x494a494a, 4, big_endian);
    for (const auto& [kind, texts] : kinds) {
        add(tags.texts, kind, 4, big_endian);
        add(tags.texts, static_cast<std::uint32_t>(texts.size()), 4, big_endian);
    }
    tags.counts.push_back(static_cast<std::uint32_t>(tags.texts.size()));
    for (const auto& [kind, texts] : kinds) {
        for (const std::u16string& text : texts) {
            tags.counts.push_back(static_cast<std::uint32_t>(2 * text.size()));
            for (const char16_t unit : text) add(tags.texts, unit, 2, big_endian);
        }
    }
    return tags;
}

constexpr std::uint32_t kLabel = 0x6c61626c, kInfo = 0x696e666f;

TEST(ImagejLabels, TextsOfBothByteOrders) {
    for (const bool big_endian : {false, true}) {
        const Tags tags = tags_of({{kInfo, {u"about"}}, {kLabel, {u"DAPI", u"", u"\u00b5m \u2192 \U0001f52c"}}}, big_endian);
        EXPECT_EQ(imagej_labels(tags.counts, tags.texts, big_endian), (Texts{"DAPI", "", "\u00b5m \u2192 \U0001f52c"}));
        EXPECT_TRUE(imagej_labels(tags.counts, tags.texts, !big_endian).empty());
    }
}

TEST(ImagejLabels, HalvesOfACharacterAreReplaced) {
    const Tags tags =
        tags_of({{kLabel, {std::u16string{u'a', 0xd83d}, std::u16string{0xdd2c, u'b'}, std::u16string{0xd83d, u'c'}}}}, false);
    EXPECT_EQ(imagej_labels(tags.counts, tags.texts, false), (Texts{"a?", "?b", "?c"}));
}

TEST(ImagejLabels, WhatIsNotSoundHasNoLabels) {
    const Tags sound = tags_of({{kInfo, {u"about"}}, {kLabel, {u"one", u"two"}}}, false);
    EXPECT_EQ(imagej_labels(sound.counts, sound.texts, false).size(), 2U);
    EXPECT_TRUE(imagej_labels({}, {}, false).empty());
    for (std::size_t size = 0; size < sound.texts.size(); ++size)
        EXPECT_TRUE(imagej_labels(sound.counts, std::span(sound.texts).first(size), false).empty()) << size;
    for (std::size_t count = 0; count < sound.counts.size(); ++count)
        EXPECT_TRUE(imagej_labels(std::span(sound.counts).first(count), sound.texts, false).empty()) << count;
    for (std::size_t i = 0; i < sound.texts.size(); ++i) {
        for (const std::uint32_t damage : {1U, 0x80U, 0xffU}) {
            Bytes texts = sound.texts;
            texts[i] ^= static_cast<std::byte>(damage);
            EXPECT_LE(imagej_labels(sound.counts, texts, false).size(), 4U);
        }
    }
    for (std::size_t i = 0; i < sound.counts.size(); ++i) {
        for (const std::uint32_t count : {0U, 3U, 11U, 0x7fffffffU, 0xffffffffU}) {
            std::vector<std::uint32_t> counts = sound.counts;
            counts[i] = count;
            EXPECT_LE(imagej_labels(counts, sound.texts, false).size(), 2U);
        }
    }
    EXPECT_TRUE(imagej_labels(tags_of({{kInfo, {u"about"}}}, false).counts, sound.texts, false).empty());
}

TEST(ImagejLabels, ChannelsAreNamedByWhatAllTheirImagesShare) {
    EXPECT_EQ(channel_names_of({"a", "b", "a", "b"}, 2), (Texts{"a", "b"}));
    EXPECT_EQ(channel_names_of({"a", "b"}, 2), (Texts{"a", "b"}));
    EXPECT_EQ(channel_names_of({"a", "b", "a", "c"}, 2), (Texts{"", ""}));
    EXPECT_EQ(channel_names_of({"a", "a"}, 2), (Texts{"", ""})) << "not different";
    EXPECT_EQ(channel_names_of({"a", ""}, 2), (Texts{"", ""}));
    EXPECT_EQ(channel_names_of({"a", "b", "a"}, 2), (Texts{"", ""}));
    EXPECT_EQ(channel_names_of({"a"}, 2), (Texts{"", ""}));
    EXPECT_EQ(channel_names_of({"a"}, 1), (Texts{""}));
    EXPECT_EQ(channel_names_of({}, 3), (Texts{"", "", ""}));
}

}  // namespace
}  // namespace isoatlas
