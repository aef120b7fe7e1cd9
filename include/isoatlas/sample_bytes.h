// SampleBytes: the bytes of the samples of a volume, its own or borrowed from somebody else.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace isoatlas {

/// A std::vector of bytes that may also lie in memory of another program part, which an owner keeps alive. Borrowed bytes are never
/// written to: access that could change them makes a copy first, which is this object's own. Copies of borrowed bytes are borrowed too.
class SampleBytes {
public:
    using value_type = std::byte;
    using iterator = std::byte*;
    using const_iterator = const std::byte*;

    SampleBytes() = default;
    /// owner: what keeps the bytes where they are; null: the caller does. Whoever else writes to them changes the volume.
    SampleBytes(std::span<const std::byte> bytes, std::shared_ptr<const void> owner) : borrowed_(bytes), owner_(std::move(owner)) {}

    [[nodiscard]] bool is_borrowed() const { return borrowed_.data() != nullptr; }
    [[nodiscard]] std::size_t size() const { return is_borrowed() ? borrowed_.size() : own_.size(); }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] const std::byte* data() const { return is_borrowed() ? borrowed_.data() : own_.data(); }
    [[nodiscard]] std::byte* data() { return own().data(); }
    [[nodiscard]] const std::byte* begin() const { return data(); }
    [[nodiscard]] const std::byte* end() const { return data() + size(); }
    [[nodiscard]] std::byte* begin() { return data(); }
    [[nodiscard]] std::byte* end() { return data() + size(); }
    [[nodiscard]] const std::byte& operator[](std::size_t i) const { return data()[i]; }
    [[nodiscard]] std::byte& operator[](std::size_t i) { return data()[i]; }

    void resize(std::size_t size) { own().resize(size); }
    void push_back(std::byte byte) { own().push_back(byte); }
    void pop_back() { own().pop_back(); }

    friend bool operator==(const SampleBytes& a, const SampleBytes& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

private:
    std::vector<std::byte>& own() {
        if (is_borrowed()) {
            own_.assign(borrowed_.begin(), borrowed_.end());
            borrowed_ = {};
            owner_.reset();
        }
        return own_;
    }

    std::vector<std::byte> own_;
    std::span<const std::byte> borrowed_;
    std::shared_ptr<const void> owner_;
};

}  // namespace isoatlas
