#include "store/fingerprint.h"

#include <algorithm>
#include <charconv>
#include <span>

#include "codec/checksum.h"

namespace isoatlas {
namespace {

constexpr std::size_t kLongestText = 60;  ///< characters of a text in a message
constexpr std::size_t kSaid = 3;

std::string shortened(const std::string* text) {
    if (text == nullptr || text->empty()) return "none";
    if (text->size() <= kLongestText) return *text;
    std::size_t end = kLongestText;
    while (end > 0 && (static_cast<unsigned char>((*text)[end]) & 0xc0) == 0x80) --end;  // not inside a UTF-8 character
    return text->substr(0, end) + "...";
}

std::string difference(const std::string& name, const std::string* there, const std::string* here) {
    std::string of_there = shortened(there), of_here = shortened(here);
    if (of_there == of_here) of_there = "another", of_here = "this";  // they differ after the first characters
    return name + " " + of_there + " there, " + of_here + " here";
}

}  // namespace

const std::string* Fingerprint::find(std::string_view name) const {
    const auto found = std::ranges::find(members, name, &Member::name);
    return found == members.end() ? nullptr : &found->text;
}

void Fingerprint::remove(std::string_view name) {
    std::erase_if(members, [name](const Member& member) { return member.name == name; });
}

std::uint64_t Fingerprint::hash() const {
    std::string all;
    for (const Member& member : members) {  // lengths separate neighbours
        for (const std::string* text : {&member.name, &member.text}) all += std::to_string(text->size()) + ":" + *text;
    }
    return checksum(std::as_bytes(std::span<const char>(all)));
}

std::vector<std::string> differences(const Fingerprint& there, const Fingerprint& here) {
    std::vector<std::string> found;
    for (const Fingerprint::Member& member : here.members) {
        const std::string* other = there.find(member.name);
        if (other == nullptr || *other != member.text) found.push_back(difference(member.name, other, &member.text));
    }
    for (const Fingerprint::Member& member : there.members) {
        if (here.find(member.name) == nullptr) found.push_back(difference(member.name, &member.text, nullptr));
    }
    return found;
}

std::string joined(const std::vector<std::string>& differences) {
    std::string text;
    for (std::size_t i = 0; i < std::min(kSaid, differences.size()); ++i) text += (i == 0 ? "" : "; ") + differences[i];
    if (differences.size() > kSaid) text += "; and " + std::to_string(differences.size() - kSaid) + " more";
    return text;
}

std::string exact_text(double number) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

std::string exact_text(const std::array<double, 3>& numbers, std::string_view between) {
    return exact_text(numbers[0]) + std::string(between) + exact_text(numbers[1]) + std::string(between) + exact_text(numbers[2]);
}

std::string checksum_text(std::uint64_t checksum) {
    char digits[17] = "0000000000000000";
    char number[16];
    const auto end = std::to_chars(number, number + sizeof number, checksum, 16).ptr;
    std::copy_backward(number, end, digits + 16);
    return {digits, 16};
}

}  // namespace isoatlas
