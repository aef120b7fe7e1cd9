// Sink: where a writer puts the bytes of one file: a file on disk, memory, or what a program derives from it.
//
//   MemorySink sink("surface.ply");
//   write_surface(sink, surface);
//   send(sink.bytes());
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace isoatlas {

/// Writers call it from one thread. What was written when a writer throws is not a file.
class Sink {
public:
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;
    virtual ~Sink();

    /// The next bytes, behind all written so far.
    virtual void write(std::span<const std::byte> bytes) = 0;
    void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
    /// Writes anywhere: over what is there, e.g. a link to a later page, or behind it; a hole reads as zeros. Only TIFF and VTKHDF need it.
    virtual void write_at(std::int64_t offset, std::span<const std::byte> bytes) = 0;
    /// End of the bytes written so far: the offset of the next write().
    [[nodiscard]] virtual std::int64_t size() const = 0;
    /// Of the file: its extension is the format, and messages name it.
    [[nodiscard]] const std::string& name() const { return name_; }

protected:
    explicit Sink(std::string name) : name_(std::move(name)) {}

private:
    std::string name_;
};

/// Keeps the file in memory. Cost: memory for the file, twice while it grows.
class MemorySink : public Sink {
public:
    explicit MemorySink(std::string name) : Sink(std::move(name)) {}
    using Sink::write;
    void write(std::span<const std::byte> bytes) override;
    void write_at(std::int64_t offset, std::span<const std::byte> bytes) override;
    [[nodiscard]] std::int64_t size() const override { return static_cast<std::int64_t>(bytes_.size()); }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }
    /// The sink is empty afterwards.
    [[nodiscard]] std::string take() { return std::exchange(bytes_, {}); }

private:
    std::string bytes_;
};

}  // namespace isoatlas
