// What reading a volume gives when a file of it is damaged.
#pragma once

#include <array>
#include <sstream>
#include <string>

#include "unit/formats/volume/volume_files.h"

namespace isoatlas::test {

/// What a file says: its samples as they are stored, in host byte order, or that it is refused.
struct Answer {
    bool read = false;
    std::string samples{}, message{};
    ValueType type = ValueType::u8;
    Extent extent{};
};

inline Answer answer_of(const std::string& path, std::int64_t time_step) {
    Answer answer;
    OpenOptions options;
    if (time_step >= 0) options.time_step = time_step;
    try {
        const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
        answer.samples = read_all(*reader, reader->info().extent.size[2]);
        answer.type = reader->info().type;
        answer.extent = reader->info().extent;
        answer.read = true;
    } catch (const Error& error) {
        answer.message = error.what();
        const bool documented =
            error.kind() == ErrorKind::input || error.kind() == ErrorKind::unsupported || error.kind() == ErrorKind::usage;
        EXPECT_TRUE(documented) << error.what();
        EXPECT_FALSE(error.text().next.empty()) << error.what();
    }
    return answer;
}

/// Gives a file of a volume other contents, and says what opening the volume (`path`) gives compared with the sound one.
class Damage {
public:
    /// declared_otherwise: the samples have the same bytes, but the header, which has no checksum, gives them another type or shape.
    enum class Outcome { refused, same, declared_otherwise, other_samples };

    Damage(std::string path, std::string damaged, std::string content, std::int64_t time_step)
        : path_(std::move(path)), damaged_(std::move(damaged)), content_(std::move(content)), time_step_(time_step) {
        sound_ = answer_of(path_, time_step_);
        EXPECT_TRUE(sound_.read) << sound_.message;
    }
    [[nodiscard]] Outcome flip(std::size_t bit) const {
        std::string flipped = content_;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << bit % 8);
        return with(flipped);
    }
    [[nodiscard]] Outcome with(const std::string& content) const {
        const Outcome outcome = compare(content);
        ++counts_[static_cast<std::size_t>(outcome)];
        return outcome;
    }
    [[nodiscard]] const std::array<int, 4>& numbers() const { return counts_; }
    [[nodiscard]] std::string counts() const {
        std::ostringstream text;
        text << counts_[0] << " refused, " << counts_[1] << " the same, " << counts_[2] << " declared otherwise, " << counts_[3]
             << " other samples";
        return text.str();
    }

private:
    Outcome compare(const std::string& content) const {
        const Replaced replaced(damaged_, content);
        const Answer answer = answer_of(path_, time_step_);
        if (!answer.read) return Outcome::refused;
        const bool as_declared = answer.type == sound_.type && answer.extent == sound_.extent;
        if (answer.samples == sound_.samples) return as_declared ? Outcome::same : Outcome::declared_otherwise;
        return Outcome::other_samples;
    }

    std::string path_, damaged_, content_;
    std::int64_t time_step_;
    Answer sound_;
    mutable std::array<int, 4> counts_{};
};

}  // namespace isoatlas::test
