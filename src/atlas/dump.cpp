#include "isoatlas/dump.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <string_view>
#include <type_traits>

#include "codec/checksum.h"
#include "isoatlas/error.h"
#include "store/brick_reader.h"
#include "store/container.h"

namespace isoatlas {
namespace {

constexpr std::string_view kChecksums = "checksums/";

/// Calls function(T{}) with a number of a type by name.
template <class Function>
StoreNumbers visit_named_type(std::string_view type, Function&& function) {
    if (type == "uint64") return function(std::uint64_t{});
    if (type == "int64") return function(std::int64_t{});
    for (int i = 0; i < 8; ++i) {
        if (type == name_of(static_cast<ValueType>(i))) return visit_type(static_cast<ValueType>(i), function);
    }
    return function(std::uint8_t{});  // contents with another type are rejected on reading
}

template <class T>
StoreNumbers widened(const std::vector<T>& numbers) {
    if constexpr (std::is_floating_point_v<T>) return std::vector<double>(numbers.begin(), numbers.end());
    if constexpr (std::is_signed_v<T>) return std::vector<std::int64_t>(numbers.begin(), numbers.end());
    return std::vector<std::uint64_t>(numbers.begin(), numbers.end());
}

/// Numbers with `separator` between them; nullopt for any other text.
std::optional<std::vector<std::int64_t>> numbers_in(std::string_view text, char separator) {
    std::vector<std::int64_t> numbers;
    for (const char* at = text.data(); at <= text.data() + text.size(); ++at) {
        std::int64_t number = 0;
        const auto [stop, error] = std::from_chars(at, text.data() + text.size(), number);
        if (error != std::errc{} || (stop != text.data() + text.size() && *stop != separator)) return std::nullopt;
        numbers.push_back(number);
        at = stop;
    }
    return numbers;
}

struct Named {
    std::string name;
    std::optional<std::vector<std::int64_t>> range;  ///< one or two numbers
    bool is_right = true;
};

/// "name[3:5]", parsed.
Named named(const std::string& part) {
    const std::size_t bracket = part.find('[');
    if (bracket == std::string::npos) return {part, std::nullopt, true};
    Named result{part.substr(0, bracket), std::nullopt, false};
    if (!part.ends_with(']')) return result;
    result.range = numbers_in(std::string_view(part).substr(bracket + 1, part.size() - bracket - 2), ':');
    result.is_right = result.range && result.range->size() <= 2;
    return result;
}

}  // namespace

struct StoreDump::Data {
    Container store;
    explicit Data(const std::string& path) : store(path) {}

    [[noreturn]] void no_part(const std::string& part, const std::string& what, const std::string& expected) const {
        throw Error(ErrorKind::not_found, {.file = store.path(),
                                           .where = part,
                                           .what = what,
                                           .expected = expected,
                                           .next = "choose one of the parts of the store",
                                           .reason = Reason::no_such_part});
    }

    [[nodiscard]] const StoredArray* array(std::string_view name) const {
        const auto& arrays = store.contents().arrays;
        const auto found = std::ranges::find(arrays, name, &StoredArray::name);
        return found == arrays.end() ? nullptr : &*found;
    }

    static StorePart part_of(const StoredArray& array) {
        return {StorePart::Kind::array, array.name,    array.type,      array.shape, 0, array.count(),
                array.offset,           array.bytes(), array.chunk > 0, -1,          {}};
    }
    static StorePart checksums_of(const StoredArray& array) {
        std::vector<std::int64_t> shape{array.blocks()};
        if (array.chunk > 0) shape.push_back(3);
        return {StorePart::Kind::checksums,
                std::string(kChecksums) + array.name,
                "uint64",
                shape,
                0,
                array.index_bytes() / 8,
                array.checksums,
                array.index_bytes(),
                false,
                -1,
                {}};
    }
    [[nodiscard]] StorePart text_part(const std::string& name) const {
        StorePart part;
        part.name = name;
        part.type = "json";
        part.offset = name == "header" ? 0 : store.header().contents_offset;
        part.bytes = name == "header" ? kHeaderBytes : store.header().contents_bytes;
        return part;
    }

    [[nodiscard]] std::vector<StorePart> parts() const {
        std::vector<StorePart> all{text_part("header"), text_part("contents")};
        for (const StoredArray& array : store.contents().arrays) {
            all.push_back(part_of(array));
            if (array.block > 0) all.push_back(checksums_of(array));
        }
        return all;
    }

    [[nodiscard]] std::string list() const {
        std::string names;
        for (const StorePart& part : parts()) names += part.kind == StorePart::Kind::checksums ? "" : part.name + ", ";
        return names + "checksums/ARRAY, brick N, voxel X,Y,Z";
    }

    [[nodiscard]] StorePart brick_part(std::int64_t brick) const {
        const BrickGrid grid(store.contents().volume.extent);
        const std::string name = "brick " + std::to_string(brick);
        if (brick < 0 || brick >= grid.count()) no_part(name, "there is no such brick", "0 to " + std::to_string(grid.count() - 1));
        const Box box = grid.box(BrickId(brick));
        StorePart part;
        part.kind = StorePart::Kind::brick;
        part.name = name;
        part.type = name_of(store.contents().volume.type);
        part.shape = {box.size(2), box.size(1), box.size(0)};
        part.end = box.count();
        part.brick = brick;
        part.first_voxel = box.begin;
        const StoredArray &data = store.contents().array("volume/data", "uint8"),
                          &offset = store.contents().array("volume/offset", "uint64"),
                          &bytes = store.contents().array("volume/bytes", "uint16");
        const auto begin = number_of<std::uint64_t>(offset, brick);
        if (begin > static_cast<std::uint64_t>(data.bytes())) {
            throw Error(ErrorKind::input, {.file = store.path(),
                                           .where = name,
                                           .what = "it lies outside the data",
                                           .next = "the store is damaged: build it again from the volume"});
        }
        part.offset = data.offset + static_cast<std::int64_t>(begin);
        part.bytes = number_of<std::uint16_t>(bytes, brick);
        return part;
    }

    [[nodiscard]] StorePart part_of_voxel(const std::string& part, const std::vector<std::int64_t>& at) const {
        const Extent& extent = store.contents().volume.extent;
        const BrickGrid grid(extent);
        Index3 place{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t voxel = axis < at.size() ? at[axis] : 0;
            if (voxel < 0 || voxel >= extent.size[axis]) {
                no_part(part, "there is no such voxel",
                        "below " + std::to_string(extent.size[0]) + "," + std::to_string(extent.size[1]) + "," +
                            std::to_string(extent.size[2]));
            }
            place[axis] = voxel / kBrickSize[axis];
        }
        return brick_part(grid.brick(place).number());
    }

    template <class T>
    [[nodiscard]] T number_of(const StoredArray& array, std::int64_t i) const {
        std::array<T, 1> number{};
        store.read(array, i * static_cast<std::int64_t>(sizeof(T)), std::as_writable_bytes(std::span(number)));
        return number[0];
    }

    [[nodiscard]] StoreNumbers read_brick(std::int64_t brick, std::int64_t first, std::int64_t end) const {
        return visit_type(store.contents().volume.type, [&]<class T>(T) {
            std::vector<T> samples;
            BrickReader<T>(store).read({BrickId(brick)}, {},
                                       [&](BrickId, std::span<const T> all) { samples.assign(all.begin() + first, all.begin() + end); });
            return widened(samples);
        });
    }
};

StoreDump::StoreDump(const std::string& path) : data_(std::make_unique<Data>(path)) {}
StoreDump::StoreDump(StoreDump&&) noexcept = default;
StoreDump& StoreDump::operator=(StoreDump&&) noexcept = default;
StoreDump::~StoreDump() = default;

std::vector<StorePart> StoreDump::parts() const { return data_->parts(); }

StorePart StoreDump::find(const std::string& part) const {
    if (part == "header" || part == "contents") return data_->text_part(part);
    for (const std::string_view kind : {"brick ", "voxel "}) {
        if (!part.starts_with(kind)) continue;
        const auto numbers = numbers_in(std::string_view(part).substr(kind.size()), ',');
        if (!numbers || numbers->size() > 3) data_->no_part(part, "is not the index of a brick or a voxel", "brick 17, or voxel 40,41,42");
        return kind == "brick " && numbers->size() == 1 ? data_->brick_part(numbers->front()) : data_->part_of_voxel(part, *numbers);
    }
    const Named wanted = named(part);
    const bool is_checksums = wanted.name.starts_with(kChecksums);
    const StoredArray* array = data_->array(is_checksums ? std::string_view(wanted.name).substr(kChecksums.size()) : wanted.name);
    if (array == nullptr || (is_checksums && array->block == 0)) data_->no_part(part, "there is no such part", data_->list());
    StorePart found = is_checksums ? Data::checksums_of(*array) : Data::part_of(*array);
    if (!wanted.is_right) data_->no_part(part, "the range is not valid", found.name + "[I] or " + found.name + "[FIRST:END]");
    if (!wanted.range) return found;
    const std::int64_t count = found.end;
    found.first = wanted.range->front();
    found.end = wanted.range->size() == 2 ? wanted.range->back() : found.first + 1;
    if (found.first < 0 || found.end < found.first || found.end > count || (wanted.range->size() == 1 && found.first >= count))
        data_->no_part(part, "the range exceeds the part", "at most " + std::to_string(count) + " numbers, from 0");
    return found;
}

std::string StoreDump::text(const StorePart& part) const {
    if (part.name == "contents") return data_->store.contents_text();
    if (part.name != "header") throw Error(ErrorKind::usage, {.where = part.name, .what = "is not a text", .next = "read its numbers"});
    const Header& header = data_->store.header();
    return "{\n \"file_size\": " + std::to_string(header.file_size) + ",\n \"contents_offset\": " + std::to_string(header.contents_offset) +
           ",\n \"contents_bytes\": " + std::to_string(header.contents_bytes) +
           ",\n \"contents_checksum\": " + std::to_string(header.contents_checksum) + "\n}";
}

StoreNumbers StoreDump::read(const StorePart& part, std::int64_t first, std::int64_t end) const {
    std::int64_t count = 1;
    for (const std::int64_t n : part.shape) count *= n;
    if (part.kind == StorePart::Kind::text || first < 0 || first > end || end > count) {
        throw Error(
            ErrorKind::usage,
            {.file = data_->store.path(), .where = part.name, .what = "has no such numbers", .next = "use a range inside the part"});
    }
    if (part.kind == StorePart::Kind::brick) return data_->read_brick(part.brick, first, end);
    const bool is_checksums = part.kind == StorePart::Kind::checksums;
    const StoredArray* array = data_->array(is_checksums ? std::string_view(part.name).substr(kChecksums.size()) : part.name);
    if (array == nullptr) data_->no_part(part.name, "there is no such part", data_->list());
    if (is_checksums) {
        const std::vector<std::uint64_t> index = data_->store.index_of(*array);
        return std::vector<std::uint64_t>(index.begin() + first, index.begin() + end);
    }
    return visit_named_type(array->type, [&]<class T>(T) {
        std::vector<T> numbers(static_cast<std::size_t>(end - first));
        const std::span<std::byte> bytes = std::as_writable_bytes(std::span(numbers));
        const std::int64_t at = first * static_cast<std::int64_t>(sizeof(T));
        if (array->block == 0) {
            data_->store.read_unchecked(*array, at, bytes);
        } else {
            data_->store.read(*array, at, bytes);
        }
        return widened(numbers);
    });
}

}  // namespace isoatlas
