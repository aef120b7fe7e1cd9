// Parts of an array that are read, or written, in order, all of them alternately.
//
// Where the array lies in the scratch file (memory_limit.h) every part has a buffer, which is copied from and to the file: of mapped memory
// a touch brings 64 KB, and hundreds of parts as much each. Elsewhere the parts are read and written in place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/memory_limit.h"

namespace isoatlas {

/// Items of a buffer when there are so many: all together a small share of the limit.
template <class T>
[[nodiscard]] std::size_t buffered_items(std::size_t parts) {
    constexpr std::size_t kShare = 64, kMin = 512, kMax = std::size_t{1} << 16;
    const std::size_t bytes = static_cast<std::size_t>(memory_limit()) / kShare / std::max<std::size_t>(parts, 1);
    return std::max<std::size_t>(std::clamp(bytes, kMin, kMax) / sizeof(T), 1);
}

/// A part of an array to be read once: in place, or a copy in the buffer.
template <class T>
[[nodiscard]] std::span<const T> part_in_memory(std::span<const T> part, std::vector<T>& buffer) {
    if (!is_scratch(part.data())) return part;
    buffer.resize(part.size());
    read_scratch(part.data(), std::as_writable_bytes(std::span(buffer)));
    return buffer;
}

/// Items to a part of an array of the same size.
template <class T>
void write_part(std::span<T> part, std::span<const T> items) {
    if (is_scratch(part.data())) {
        write_scratch(part.data(), std::as_bytes(items));
    } else {
        std::copy(items.begin(), items.end(), part.begin());
    }
}

/// One field of every item, to a part of an array of the same size.
template <class T, class Item, class Field>
void write_fields(std::span<T> part, std::span<const Item> items, const Field& field) {
    if (is_scratch(part.data())) {
        std::vector<T> fields(items.size());
        std::transform(items.begin(), items.end(), fields.begin(), field);
        write_part<T>(part, fields);
    } else {
        std::transform(items.begin(), items.end(), part.begin(), field);
    }
}

/// Calls change(items) for a part of an array, in place or as a copy that is written back.
template <class T, class Change>
void change_part(std::span<T> part, const Change& change) {
    if (!is_scratch(part.data())) return change(part);
    std::vector<T> items;
    (void)part_in_memory<T>(part, items);
    change(std::span<T>(items));
    write_part<T>(part, items);
}

template <class T>
class PartReaders {
public:
    /// first: item of each part, and of the end.
    PartReaders(std::span<const T> all, std::span<const std::size_t> first) : items_(buffered_items<T>(first.size() - 1)) {
        parts_.reserve(first.size() - 1);
        for (std::size_t p = 0; p + 1 < first.size(); ++p) add(all.subspan(first[p], first[p + 1] - first[p]));
    }
    /// parts: of any arrays.
    explicit PartReaders(std::span<const std::span<const T>> parts) : items_(buffered_items<T>(parts.size())) {
        parts_.reserve(parts.size());
        for (const std::span<const T> part : parts) add(part);
    }
    [[nodiscard]] std::size_t parts() const { return parts_.size(); }
    [[nodiscard]] bool has_next(std::size_t p) const { return !parts_[p].ready.empty() || !parts_[p].rest.empty(); }
    /// The next item of a part that has one.
    [[nodiscard]] const T& next(std::size_t p) {
        Part& part = parts_[p];
        if (part.ready.empty()) fill(part);
        const T& item = part.ready.front();
        part.ready = part.ready.subspan(1);
        return item;
    }

private:
    struct Part {
        std::span<const T> ready, rest;
        std::vector<T> buffer;
    };

    void add(std::span<const T> part) {
        if (is_scratch(part.data())) {
            parts_.push_back({{}, part, {}});
        } else {
            parts_.push_back({part, {}, {}});
        }
    }
    void fill(Part& part) {
        part.buffer.resize(std::min(items_, part.rest.size()));
        read_scratch(part.rest.data(), std::as_writable_bytes(std::span(part.buffer)));
        part.ready = part.buffer;
        part.rest = part.rest.subspan(part.buffer.size());
    }

    std::size_t items_;
    std::vector<Part> parts_;
};

template <class T>
class PartWriters {
public:
    /// first: where each part begins.
    PartWriters(std::span<T> all, std::span<const std::size_t> first) : buffered_(is_scratch(all.data())) {
        items_ = buffered_items<T>(first.size());
        place_.reserve(first.size());
        for (const std::size_t item : first) place_.push_back(all.data() + item);
        if (buffered_) buffer_.resize(first.size());
    }
    void put(std::size_t p, const T& item) {
        if (!buffered_) {
            *place_[p]++ = item;
            return;
        }
        std::vector<T>& buffer = buffer_[p];
        if (buffer.size() == items_) flush(p);
        if (buffer.empty()) buffer.reserve(items_);
        buffer.push_back(item);
    }
    /// After the last item: nothing is in the array before.
    void finish() {
        for (std::size_t p = 0; p < buffer_.size(); ++p) flush(p);
    }

private:
    void flush(std::size_t p) {
        if (buffer_[p].empty()) return;
        write_scratch(place_[p], std::as_bytes(std::span(buffer_[p])));
        place_[p] += buffer_[p].size();
        buffer_[p].clear();
    }

    bool buffered_;
    std::size_t items_ = 0;
    // Of each part: where the next item goes, or the first one of its buffer. Few bytes, as they are accessed at random.
    std::vector<T*> place_;
    std::vector<std::vector<T>> buffer_;
};

}  // namespace isoatlas
