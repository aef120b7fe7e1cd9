#include "remote/range_plan.h"

#include <algorithm>
#include <numeric>

namespace isoatlas {
namespace {

/// Ranges whose gap is at most this become one.
std::vector<FileRange> merged(std::span<const FileRange> ranges, std::int64_t gap) {
    std::vector<FileRange> result;
    for (const FileRange& range : ranges) {
        if (!result.empty() && range.begin - result.back().end <= gap)
            result.back().end = std::max(result.back().end, range.end);
        else
            result.push_back(range);
    }
    return result;
}

/// The largest gap to be fetched so that few requests are left, or the allowed waste is used up.
std::int64_t gap_for_few(std::span<const FileRange> ranges, std::int64_t wanted) {
    std::vector<std::int64_t> gaps;
    for (std::size_t i = 1; i < ranges.size(); ++i) gaps.push_back(ranges[i].begin - ranges[i - 1].end);
    std::ranges::sort(gaps);
    std::int64_t gap = kCheapGap, waste = 0;
    for (std::size_t i = 0; i < gaps.size() && ranges.size() - i > kFewRequests; ++i) {
        waste += gaps[i];
        if (static_cast<double>(waste) > std::max(kMostWaste * static_cast<double>(wanted), static_cast<double>(kAlwaysWasted))) break;
        gap = std::max(gap, gaps[i]);
    }
    return gap;
}

}  // namespace

std::vector<FileRange> plan_requests(std::span<const FileRange> ranges) {
    const std::int64_t wanted = std::accumulate(ranges.begin(), ranges.end(), std::int64_t{0},
                                                [](std::int64_t sum, const FileRange& range) { return sum + range.bytes(); });
    std::vector<FileRange> requests;
    for (FileRange range : merged(ranges, gap_for_few(ranges, wanted))) {
        for (; range.bytes() > kLongestRequest; range.begin += kLongestRequest)
            requests.push_back({range.begin, range.begin + kLongestRequest});
        requests.push_back(range);
    }
    return requests;
}

std::vector<std::vector<FileRange>> plan_range_sets(std::span<const FileRange> ranges, int connections) {
    std::vector<std::vector<FileRange>> sets;
    const std::vector<FileRange> apart = merged(ranges, kPartGap);
    const std::size_t share = (apart.size() + static_cast<std::size_t>(connections) - 1) / static_cast<std::size_t>(connections);
    const std::size_t most = std::clamp(share, kFewRanges, kMostRanges);
    std::int64_t bytes = 0;
    for (FileRange range : apart) {
        while (range.bytes() > 0) {
            if (sets.empty() || sets.back().size() == most || bytes >= kLongestRequest) sets.emplace_back(), bytes = 0;
            sets.back().push_back({range.begin, std::min(range.end, range.begin + kLongestRequest - bytes)});
            bytes += sets.back().back().bytes();
            range.begin = sets.back().back().end;
        }
    }
    return sets;
}

std::vector<FileRange> without(std::vector<FileRange> ranges, std::span<const FileRange> others) {
    for (const FileRange& other : others) {
        std::vector<FileRange> left;
        for (const FileRange& range : ranges) {
            const FileRange before{range.begin, std::min(range.end, other.begin)}, behind{std::max(range.begin, other.end), range.end};
            if (before.bytes() > 0) left.push_back(before);
            if (behind.bytes() > 0) left.push_back(behind);
        }
        ranges = std::move(left);
    }
    return ranges;
}

}  // namespace isoatlas
