// MemorySink: the bytes of a file, also where a writer goes back or leaves a hole.
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>

#include "isoatlas/sink.h"

namespace isoatlas {
namespace {

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

TEST(MemorySink, AppendsAndWritesBack) {
    MemorySink sink("a.bin");
    EXPECT_EQ(sink.name(), "a.bin");
    EXPECT_EQ(sink.size(), 0);
    sink.write("abc");
    sink.write(bytes("def"));
    sink.write_at(1, bytes("XY"));
    EXPECT_EQ(sink.bytes(), "aXYdef");
    sink.write_at(5, bytes("12"));
    EXPECT_EQ(sink.bytes(), "aXYde12");
    sink.write_at(9, bytes("z"));
    EXPECT_EQ(sink.bytes(), std::string("aXYde12\0\0z", 10));
    sink.write("!");
    EXPECT_EQ(sink.size(), 11);
    EXPECT_EQ(sink.take(), std::string("aXYde12\0\0z!", 11));
    EXPECT_EQ(sink.size(), 0);
}

TEST(MemorySink, NoBytesAreNoChange) {
    MemorySink sink("a.bin");
    sink.write("");
    sink.write_at(0, {});
    EXPECT_EQ(sink.size(), 0);
}

}  // namespace
}  // namespace isoatlas
