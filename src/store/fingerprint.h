// The fingerprint of a build: everything that the bytes of a store follow from. Two builds with the same fingerprint write the same store;
// so a finished phase, or a store that lies beside a volume, is used for a build exactly when their fingerprints are the same.
//
// It is a list of names and texts, such as "spacing", "0.5 x 0.5 x 2": kept in phases and stores as it is, compared member by member, and
// what differs is said in these words. Numbers are written with as many digits as it takes to tell them from all others.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

/// What a change of the code makes of the same samples and options. To be counted up whenever any array of a store would get other numbers,
/// be it in the last place: finished phases and tables of before are then not used, nor compared, any more.
inline constexpr int kAlgorithmVersion = 3;  // 1 and 2: those of the stores of versions 1 and 2, which do not tell it

struct Fingerprint {
    struct Member {
        std::string name, text;
        friend bool operator==(const Member&, const Member&) = default;
    };
    std::vector<Member> members;  ///< in the order in which they are said; no two of one name

    void add(std::string_view name, std::string text) { members.push_back({std::string(name), std::move(text)}); }
    /// The text of a member; null: there is none.
    [[nodiscard]] const std::string* find(std::string_view name) const;
    void remove(std::string_view name);
    /// Of all names and texts.
    [[nodiscard]] std::uint64_t hash() const;
    friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
};

/// What differs, in words: "spacing 1 x 1 x 1 there, 2 x 2 x 2 here". Nothing: they are the same.
[[nodiscard]] std::vector<std::string> differences(const Fingerprint& there, const Fingerprint& here);
/// The same as one phrase; the first few of many.
[[nodiscard]] std::string joined(const std::vector<std::string>& differences);

/// Numbers as texts that are the same exactly when their bits are.
[[nodiscard]] std::string exact_text(double number);
[[nodiscard]] std::string exact_text(const std::array<double, 3>& numbers, std::string_view between);
[[nodiscard]] std::string checksum_text(std::uint64_t checksum);

}  // namespace isoatlas
