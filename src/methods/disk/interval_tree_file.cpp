// A node of the tree cuts the range of values at keys into slabs: slab i has the values v with key[i - 1] < v <= key[i]. A cell whose
// interval lies in one slab belongs to a child; any other to the node, in lists that lie one after the other in blocks of entries:
//   left[p]      of the slab of its lowest sample, ascending by it: active in slab p as far as it begins below tau
//   right[q]     of the slab of its highest sample, descending by it: active in slab q as far as it reaches tau
//   multi[p, q]  of the first and last slab between both: active there, all of it
// At most one block of entries makes a leaf. A query walks down one path. Where the paper keeps short multi lists in a corner structure,
// they are read here list by list; those of one first slab lie one after the other.
#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "field/volume_view.h"
#include "isoatlas/disk_search.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "methods/disk/block_file.h"
#include "methods/search/cell_grid.h"

namespace isoatlas {
namespace {

constexpr std::string_view kMagic = "isoatlas BITREE\n";
constexpr std::int64_t kNoBlock = -1;

/// Numbers of the header.
constexpr std::size_t kType = 0, kCells = 1, kSlabs = 2, kLevels = 3, kRoot = 4, kEntries = 5;

/// Entries first .. first + count - 1 of the file.
struct EntryRange {
    std::int64_t first = 0;
    std::uint32_t count = 0;
};

template <class T>
inline constexpr std::int64_t kEntryBytes = 2 * sizeof(T) + sizeof(CellId::Number);

/// Where multi[p, q] is, 1 <= p <= q <= slabs - 2: those of one p one after the other.
std::size_t place_of(int p, int q, int slabs) {
    std::size_t place = 0;
    for (int before = 1; before < p; ++before) place += static_cast<std::size_t>(slabs - 1 - before);
    return place + static_cast<std::size_t>(q - p);
}

std::int64_t node_bytes(std::int64_t slabs) { return 16 + 8 * (slabs - 1) + 8 * slabs + 12 * (2 * slabs + (slabs - 1) * (slabs - 2) / 2); }

/// As many as the square root of the entries of a block, and as a node has room for.
template <class T>
int slabs_of(std::int64_t payload) {
    const std::int64_t entries = payload / kEntryBytes<T>;
    auto slabs = static_cast<std::int64_t>(std::sqrt(static_cast<double>(entries)));
    while (slabs > 2 && node_bytes(slabs) > payload) --slabs;
    return static_cast<int>(std::max<std::int64_t>(2, slabs));
}

struct Node {
    std::vector<double> keys;            ///< slabs - 1 at most, ascending
    std::vector<std::int64_t> children;  ///< blocks
    std::vector<EntryRange> left, right, multi;
};

int slab_of(const std::vector<double>& keys, double value) {
    return static_cast<int>(std::ranges::lower_bound(keys, value) - keys.begin());
}

template <class T>
class Writer {
public:
    Writer(const std::string& path, std::int64_t block_bytes)
        : file_(path, kMagic, block_bytes), slabs_(slabs_of<T>(file_.payload_bytes())), in_block_(file_.payload_bytes() / kEntryBytes<T>) {}

    void write(const VolumeInfo& info, std::vector<CellInterval<T>> cells, const Context& context) {
        const auto count = std::ssize(cells);
        struct Open {
            std::vector<CellInterval<T>> cells;
            std::size_t parent;
            int slab, level;
        };
        std::vector<Open> open;
        open.push_back({std::move(cells), 0, -1, 1});
        int levels = 0;
        while (!open.empty()) {
            stop_if_cancelled(context);
            Open part = std::move(open.back());
            open.pop_back();
            const std::size_t number = nodes_.size();
            levels = std::max(levels, part.level);
            if (part.slab >= 0) nodes_[part.parent].children[static_cast<std::size_t>(part.slab)] = static_cast<std::int64_t>(number);
            nodes_.emplace_back();
            if (std::ssize(part.cells) <= in_block_) {
                nodes_.back().left.push_back(put(part.cells));
                continue;
            }
            std::vector<std::vector<CellInterval<T>>> inside = divide(part.cells, nodes_.back());
            part.cells = {};
            for (std::size_t slab = 0; slab < inside.size(); ++slab) {
                if (!inside[slab].empty()) open.push_back({std::move(inside[slab]), number, static_cast<int>(slab), part.level + 1});
            }
        }
        flush();
        const std::int64_t first_node = add_nodes();
        file_.commit({static_cast<std::int64_t>(info.type), count, slabs_, levels, first_node, entries_, 0, 0});
    }

private:
    /// Fills a node and returns the cells of each slab.
    std::vector<std::vector<CellInterval<T>>> divide(std::vector<CellInterval<T>>& cells, Node& node) {
        node.keys = keys_of(cells);
        const auto slabs = node.keys.size() + 1;
        std::vector<std::vector<CellInterval<T>>> inside(slabs), left(slabs), right(slabs), multi((slabs - 1) * (slabs - 2) / 2);
        for (const CellInterval<T>& c : cells) {
            const int p = slab_of(node.keys, static_cast<double>(c.low)), q = slab_of(node.keys, static_cast<double>(c.high));
            if (p == q) {
                inside[static_cast<std::size_t>(p)].push_back(c);
                continue;
            }
            left[static_cast<std::size_t>(p)].push_back(c);
            right[static_cast<std::size_t>(q)].push_back(c);
            if (q - p > 1) multi[place_of(p + 1, q - 1, static_cast<int>(slabs))].push_back(c);
        }
        for (auto& list : left) std::ranges::sort(list, ByLow<T>()), node.left.push_back(put(list));
        for (auto& list : right)
            std::ranges::sort(list, [](const auto& a, const auto& b) { return ByHigh<T>()(b, a); }), node.right.push_back(put(list));
        for (auto& list : multi) node.multi.push_back(put(list));
        node.children.assign(slabs, kNoBlock);
        return inside;
    }

    /// Distinct ends of intervals, equally far from each other in their order; all below the highest, so that no slab has all cells.
    [[nodiscard]] std::vector<double> keys_of(const std::vector<CellInterval<T>>& cells) const {
        std::vector<double> ends;
        for (const CellInterval<T>& c : cells) ends.push_back(static_cast<double>(c.low)), ends.push_back(static_cast<double>(c.high));
        std::ranges::sort(ends);
        std::vector<double> keys;
        for (int i = 1; i < slabs_; ++i) {
            const double key = ends[ends.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(slabs_)];
            if (key < ends.back() && (keys.empty() || key > keys.back())) keys.push_back(key);
        }
        if (keys.empty()) keys.push_back(ends.front());
        return keys;
    }

    EntryRange put(const std::vector<CellInterval<T>>& cells) {
        const EntryRange range{entries_, static_cast<std::uint32_t>(cells.size())};
        for (const CellInterval<T>& c : cells) {
            block_.put(c.low), block_.put(c.high), block_.put(c.cell.number());
            if (++entries_ % in_block_ == 0) flush();
        }
        return range;
    }
    void flush() {
        if (!block_.bytes().empty()) (void)file_.add(block_.bytes());
        block_.clear();
    }

    /// Behind the entries, in the order of their numbers. Returns the block of the first one, the root.
    std::int64_t add_nodes() {
        const std::int64_t first = 1 + (entries_ + in_block_ - 1) / in_block_;
        for (const Node& node : nodes_) {
            PayloadWriter payload;
            payload.put(static_cast<std::int64_t>(node.keys.size())), payload.put(static_cast<std::int64_t>(node.left.size()));
            for (const double key : node.keys) payload.put(key);
            for (const std::int64_t child : node.children) payload.put(child == kNoBlock ? kNoBlock : first + child);
            for (const auto* lists : {&node.left, &node.right, &node.multi}) {
                for (const EntryRange& list : *lists) payload.put(list.first), payload.put(list.count);
            }
            (void)file_.add(payload.bytes());
        }
        return first;
    }

    BlockWriter file_;
    int slabs_;
    std::int64_t in_block_;  ///< entries
    std::vector<Node> nodes_;
    PayloadWriter block_;
    std::int64_t entries_ = 0;
};

/// One query.
template <class T>
class Query {
public:
    Query(const BlockReader& file, double tau, CellSearchCost& cost)
        : file_(file), tau_(tau), cost_(cost), in_block_(file.payload_bytes() / kEntryBytes<T>), entries_(file.numbers()[kEntries]) {}

    std::vector<CellId> run() {
        std::int64_t at = file_.numbers()[kRoot], levels = file_.numbers()[kLevels];
        for (; at != kNoBlock; --levels) {
            if (levels == 0) file_.fail("the tree has more levels than its header says");
            at = visit(at);
        }
        return std::move(found_);
    }

private:
    /// Reports the active cells of a node. Returns its child on the path.
    std::int64_t visit(std::int64_t block) {
        const Node node = read_node(block);
        if (node.keys.empty()) {
            if (!node.left.empty()) scan(node.left[0], [this](const CellInterval<T>& c) { return Take{c.is_active(tau_), true}; });
            return kNoBlock;
        }
        const int slabs = static_cast<int>(node.keys.size()) + 1, slab = slab_of(node.keys, tau_);
        const auto at = static_cast<std::size_t>(slab);
        scan(node.left[at], [this](const CellInterval<T>& c) { return Take{c.begins_below(tau_), c.begins_below(tau_)}; });
        scan(node.right[at], [this](const CellInterval<T>& c) { return Take{c.reaches(tau_), c.reaches(tau_)}; });
        for (int p = 1; p <= slab; ++p) {
            for (int q = std::max(p, slab); q <= slabs - 2; ++q)
                scan(node.multi[place_of(p, q, slabs)], [](const CellInterval<T>&) { return Take{true, true}; });
        }
        return node.children[at];
    }

    Node read_node(std::int64_t block) {
        ++cost_.nodes;
        const std::vector<std::byte> bytes = read(block);
        PayloadReader payload(bytes, file_);
        const auto keys = payload.get<std::int64_t>(), lists = payload.get<std::int64_t>();
        if (keys < 0 || keys >= file_.numbers()[kSlabs] || lists != (keys == 0 ? 1 : keys + 1)) file_.fail("a node has no such lists");
        Node node;
        for (std::int64_t i = 0; i < keys; ++i) node.keys.push_back(payload.get<double>());
        for (std::int64_t i = 0; i < (keys == 0 ? 0 : keys + 1); ++i) node.children.push_back(payload.get<std::int64_t>());
        const auto take = [&](std::vector<EntryRange>& into, std::int64_t count) {
            for (std::int64_t i = 0; i < count; ++i) {
                EntryRange range;
                range.first = payload.get<std::int64_t>(), range.count = payload.get<std::uint32_t>();
                if (range.first < 0 || range.first > entries_ || range.count > entries_ - range.first)
                    file_.fail("a list lies outside of the file");
                into.push_back(range);
            }
        };
        take(node.left, lists);
        take(node.right, keys == 0 ? 0 : lists);
        take(node.multi, keys * (keys - 1) / 2);
        return node;
    }

    std::vector<std::byte> read(std::int64_t block) {
        ++cost_.blocks;
        cost_.bytes_read += file_.block_bytes();
        return file_.read(block);
    }

    struct Take {
        bool is_active, goes_on;
    };
    /// Takes the active entries of a list until one says that none follows.
    template <class Look>
    void scan(const EntryRange& list, const Look& look) {
        for (std::int64_t i = list.first; i < list.first + list.count; ++i) {
            ++cost_.cells;
            const CellInterval<T> cell = entry(i);
            const Take take = look(cell);
            if (take.is_active) found_.push_back(cell.cell);
            if (!take.goes_on) return;
        }
    }
    /// The block of the last entry stays in memory.
    CellInterval<T> entry(std::int64_t i) {
        if (const std::int64_t block = 1 + i / in_block_; block != block_) {
            bytes_ = read(block);
            block_ = block;
        }
        PayloadReader payload(std::span<const std::byte>(bytes_).subspan(static_cast<std::size_t>(i % in_block_ * kEntryBytes<T>)), file_);
        const T low = payload.get<T>(), high = payload.get<T>();
        return {low, high, CellId(payload.get<CellId::Number>())};
    }

    const BlockReader& file_;
    double tau_;
    CellSearchCost& cost_;
    std::int64_t in_block_, entries_, block_ = kNoBlock;
    std::vector<std::byte> bytes_;
    std::vector<CellId> found_;
};

}  // namespace

void write_interval_tree(const std::string& path, const Volume& volume, const IntervalTreeFileOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    visit_samples(VolumeView(volume), [&]<class T>(std::span<const T> samples) {
        const CellGrid<T> grid(volume.info.extent, samples);
        require_countable(grid.count(), volume.info.path);
        Writer<T>(path, options.block_bytes).write(volume.info, cell_intervals(grid), context);
    });
}

struct IntervalTreeFile::Data {
    BlockReader file;
};

IntervalTreeFile::IntervalTreeFile(const std::string& path) : data_(std::make_unique<Data>(BlockReader(path, kMagic))) {
    const HeaderNumbers& numbers = data_->file.numbers();
    if (numbers[kType] < 0 || numbers[kType] > static_cast<std::int64_t>(ValueType::f64))
        data_->file.fail("the type of the samples is unknown");
}
IntervalTreeFile::~IntervalTreeFile() = default;

std::vector<CellId> IntervalTreeFile::active(double tau, CellSearchCost& cost) {
    require_isovalue(tau);
    cost = {};
    std::vector<CellId> found = visit_type(static_cast<ValueType>(data_->file.numbers()[kType]),
                                           [&]<class T>(T) { return Query<T>(data_->file, tau, cost).run(); });
    cost.active = std::ssize(found);
    return found;
}

std::int64_t IntervalTreeFile::bytes() const { return 2 * block_bytes(); }
std::int64_t IntervalTreeFile::file_bytes() const { return data_->file.blocks() * data_->file.block_bytes(); }
std::int64_t IntervalTreeFile::block_bytes() const { return data_->file.block_bytes(); }
std::int64_t IntervalTreeFile::cells() const { return data_->file.numbers()[kCells]; }
int IntervalTreeFile::slabs() const { return static_cast<int>(data_->file.numbers()[kSlabs]); }
int IntervalTreeFile::levels() const { return static_cast<int>(data_->file.numbers()[kLevels]); }

}  // namespace isoatlas
