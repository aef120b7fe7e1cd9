#include "isoatlas/sink.h"

#include <algorithm>

#include "base/check.h"

namespace isoatlas {
namespace {

std::string_view text_of(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace

Sink::~Sink() = default;

void MemorySink::write(std::span<const std::byte> bytes) { bytes_ += text_of(bytes); }

void MemorySink::write_at(std::int64_t offset, std::span<const std::byte> bytes) {
    ISOATLAS_CHECK(offset >= 0);
    const auto first = static_cast<std::size_t>(offset);
    bytes_.resize(std::max(bytes_.size(), first + bytes.size()));
    bytes_.replace(first, bytes.size(), text_of(bytes));
}

}  // namespace isoatlas
