// Dump: any part of a store as it lies in the file (docs/format.md), for inspection and debugging. Nothing is returned whose checksum is
// wrong (the packed bytes of volume/data have none: its bricks have); a damaged store can be read as far as it is intact.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "isoatlas/index3.h"

namespace isoatlas {

/// Description of a part, without its numbers.
struct StorePart {
    enum class Kind : std::uint8_t { text, array, checksums, brick } kind = Kind::text;
    std::string name;                    ///< "contents", "elements/value", "checksums/elements/value", "brick 17"
    std::string type;                    ///< of the numbers: "uint8" ... "float64"; "json" for texts
    std::vector<std::int64_t> shape;     ///< of the whole array; a brick: its samples, z y x
    std::int64_t first = 0, end = 0;     ///< the selected numbers of it, first index slowest
    std::int64_t offset = 0, bytes = 0;  ///< of the whole part in the file; a brick: of its packed samples
    bool compressed = false;             ///< it lies in chunks, see its checksums; offset and bytes are those it would have
    std::int64_t brick = -1;             ///< which one
    Index3 first_voxel{};                ///< of a brick
};

using StoreNumbers = std::variant<std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<double>>;

class StoreDump {
public:
    /// Reads header and contents. Throws Error: input (missing, not a store, damaged), unsupported (a later version).
    explicit StoreDump(const std::string& path);
    StoreDump(StoreDump&&) noexcept;
    StoreDump& operator=(StoreDump&&) noexcept;
    ~StoreDump();

    /// header, contents, then every array and its checksums, as they lie in the contents. Bricks are not among them.
    [[nodiscard]] std::vector<StorePart> parts() const;
    /// "header", "contents", the name of an array, "checksums/" and that name (of compressed arrays: offset, bytes and checksum of every
    /// chunk); one of them with [I] or [FIRST:END] behind it;
    /// "brick N"; "voxel X,Y,Z": the brick that holds it. Throws Error{not_found} that lists the parts.
    [[nodiscard]] StorePart find(const std::string& part) const;
    /// JSON of header or contents. Throws Error{usage} for other parts.
    [[nodiscard]] std::string text(const StorePart& part) const;
    /// Numbers [first, end) of an array, its checksums or a brick (x fastest), as int64, uint64 or float64, whatever holds its type.
    /// Throws Error: input (damaged), usage (texts; a range outside). Cost: the blocks that are touched, or the brick.
    [[nodiscard]] StoreNumbers read(const StorePart& part, std::int64_t first, std::int64_t end) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
