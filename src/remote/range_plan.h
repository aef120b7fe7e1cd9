// Which requests fetch a list of ranges: few, and with few bytes that nobody asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

/// A gap is fetched rather than skipped when that takes less time than another request: the bytes that arrive in one round trip.
inline constexpr std::int64_t kCheapGap = 16 << 10;
/// More requests than these are merged at their smallest gaps, until the gaps are this part of what is wanted.
inline constexpr std::size_t kFewRequests = 12;
inline constexpr double kMostWaste = 0.25;
inline constexpr std::int64_t kAlwaysWasted = 512 << 10;  ///< or this much, which is a few round trips
/// Longer requests are cut, so that several connections share them and a repeated one costs little.
/// Of several ranges in one request: a gap that is shorter than the header of another part; and how many at most (8 KiB of header).
inline constexpr std::int64_t kPartGap = 1 << 10;
inline constexpr std::size_t kMostRanges = 128, kFewRanges = 8;
inline constexpr std::int64_t kLongestRequest = std::int64_t{2} << 20;

/// ranges: ascending, not overlapping, not empty. The result too; it covers them. Each request ends with a range or at kLongestRequest.
[[nodiscard]] std::vector<FileRange> plan_requests(std::span<const FileRange> ranges);

/// Of servers that answer several ranges in one request: sets of ranges with small gaps left out, of about the same number each, for
/// `connections` at a time.
[[nodiscard]] std::vector<std::vector<FileRange>> plan_range_sets(std::span<const FileRange> ranges, int connections);

/// The parts of ranges that none of the others holds; both in any order.
[[nodiscard]] std::vector<FileRange> without(std::vector<FileRange> ranges, std::span<const FileRange> others);

}  // namespace isoatlas
