// Voxels whose component spans several tiles, as records (value, representative, count) that are read back in descending order.
//
// They are kept in buckets of descending ranges of values: tiles write to the end of every bucket, and one bucket at a time is read and
// sorted, in memory or, when few values have many voxels, in pieces that are merged.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/external_sort.h"
#include "base/part_streams.h"

namespace isoatlas {

template <class T, class Id>
struct OpenVoxels {
    T value;
    Id representative, count;
};

template <class T, class Id>
class OpenVoxelBuckets {
public:
    using Record = OpenVoxels<T, Id>;

    /// bounds: strictly descending; the bucket behind bound b holds values of at most bounds[b].
    explicit OpenVoxelBuckets(std::vector<double> bounds) : bounds_(std::move(bounds)), buckets_(bounds_.size() + 1) {}

    [[nodiscard]] std::size_t count() const { return buckets_.size(); }

    /// records: in descending order. Thread safe.
    void add(std::span<const Record> records) {
        std::size_t bucket = 0;
        for (std::size_t first = 0, i = 0; first < records.size(); first = i) {
            while (bucket < bounds_.size() && static_cast<double>(records[first].value) <= bounds_[bucket]) ++bucket;
            for (i = first; i < records.size(); ++i) {
                if (bucket < bounds_.size() && static_cast<double>(records[i].value) <= bounds_[bucket]) break;
            }
            append(buckets_[bucket], records.subspan(first, i - first));
        }
    }

    /// Calls visit(record) for the records of a bucket in descending order; they are gone from here. threads: that may work on it.
    template <class Visit>
    void take(std::size_t bucket, int threads, const Visit& visit) {
        std::vector<Chunk>& chunks = buckets_[bucket].chunks;
        std::size_t count = 0;
        for (const Chunk& chunk : chunks) count += chunk.count;
        if (count <= std::max(kChunk, sortable_items<Record>(1))) {
            for (const Record& record : sorted(chunks, count)) visit(record);
        } else {
            std::vector<std::span<const Record>> runs;
            for (Chunk& chunk : chunks) {
                for (const auto run : sort_runs(threads, chunk.items(), sortable_items<Record>(threads), key, before)) runs.push_back(run);
            }
            merge_runs<Record>(runs, before, visit);
        }
        chunks.clear();
    }

private:
    static constexpr std::size_t kChunk = std::size_t{1} << 17;
    struct Chunk {
        BigVector<Record> records;
        std::size_t count = 0;  ///< how many there are by now
        [[nodiscard]] std::span<Record> items() { return std::span(records).first(count); }
    };
    struct Bucket {
        std::vector<Chunk> chunks;
        std::mutex mutex;
    };

    static double key(const Record& record) { return -static_cast<double>(record.value); }
    static bool before(const Record& p, const Record& q) { return p.value > q.value; }

    /// All records of the chunks, which are given up.
    [[nodiscard]] static std::vector<Record> sorted(std::vector<Chunk>& chunks, std::size_t count) {
        std::vector<Record> records, buffer;
        records.reserve(count);
        for (Chunk& chunk : chunks) {
            const std::span<const Record> part = part_in_memory<Record>(chunk.items(), buffer);
            records.insert(records.end(), part.begin(), part.end());
            release(chunk.records);
        }
        sort_by_steps(std::span(records), key, before);
        return records;
    }

    static void append(Bucket& bucket, std::span<const Record> records) {
        const std::lock_guard lock(bucket.mutex);
        while (!records.empty()) {
            if (bucket.chunks.empty() || bucket.chunks.back().count == kChunk) {
                bucket.chunks.emplace_back();
                bucket.chunks.back().records.resize(kChunk);
            }
            Chunk& chunk = bucket.chunks.back();
            const std::size_t count = std::min(records.size(), kChunk - chunk.count);
            write_part<Record>(std::span(chunk.records).subspan(chunk.count, count), records.first(count));
            chunk.count += count;
            records = records.subspan(count);
        }
    }

    std::vector<double> bounds_;
    std::vector<Bucket> buckets_;
};

}  // namespace isoatlas
