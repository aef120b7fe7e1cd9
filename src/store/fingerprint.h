// The fingerprint of a build: everything that determines the bytes of a store. Builds with the same fingerprint write the same store; a
// finished phase, or a store beside a volume, is used for a build exactly when their fingerprints are equal.
//
// It is a list of names and texts, such as "spacing", "0.5 x 0.5 x 2": stored verbatim in phases and stores, compared member by member;
// messages quote the differing members. Numbers have as many digits as needed to be unique.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

/// Version of the algorithms. Increment whenever any array of a store would get other numbers, even in the last place: earlier finished
/// phases and tables are then neither used nor compared.
inline constexpr int kAlgorithmVersion = 4;     // 1 and 2: stores of versions 1 and 2, which do not record it
inline constexpr int kFirstExactAlgorithm = 3;  // the same but for the isovalues of the tables of objects and cavities

struct Fingerprint {
    struct Member {
        std::string name, text;
        friend bool operator==(const Member&, const Member&) = default;
    };
    std::vector<Member> members;  ///< in order of messages; names are unique

    void add(std::string_view name, std::string text) { members.push_back({std::string(name), std::move(text)}); }
    /// The text of a member; null: no such member.
    [[nodiscard]] const std::string* find(std::string_view name) const;
    void remove(std::string_view name);
    /// Hash of all names and texts.
    [[nodiscard]] std::uint64_t hash() const;
    friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
};

/// Descriptions of the differences: "spacing 1 x 1 x 1 there, 2 x 2 x 2 here". Empty: equal.
[[nodiscard]] std::vector<std::string> differences(const Fingerprint& there, const Fingerprint& here);
/// The same as one phrase; only the first few of many.
[[nodiscard]] std::string joined(const std::vector<std::string>& differences);

/// Numbers as texts that are equal exactly when their bits are.
[[nodiscard]] std::string exact_text(double number);
[[nodiscard]] std::string exact_text(const std::array<double, 3>& numbers, std::string_view between);
[[nodiscard]] std::string checksum_text(std::uint64_t checksum);

}  // namespace isoatlas
