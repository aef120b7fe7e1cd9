// Stores: as they come, and with every checksum mended, so that what lies behind the checksums is reached. A documented error or sound
// answers, never a crash.
#include <algorithm>
#include <cstring>

#include "codec/checksum.h"
#include "field/brick_grid.h"
#include "fuzz/volume_target.h"
#include "isoatlas/atlas.h"
#include "isoatlas/dump.h"
#include "isoatlas/verify.h"
#include "levels/stored_clusters.h"
#include "store/container.h"

namespace {

using isoatlas::Contents;
using isoatlas::StoredArray;
using Bytes = std::vector<std::byte>;

std::uint64_t number_at(const Bytes& bytes, std::int64_t offset) {
    std::uint64_t number;
    std::memcpy(&number, bytes.data() + offset, 8);
    return number;
}

void put_number(Bytes& bytes, std::int64_t offset, std::uint64_t number) { std::memcpy(bytes.data() + offset, &number, 8); }

const StoredArray* find(const Contents& contents, const char* name) {
    for (const StoredArray& array : contents.arrays) {
        if (array.name == name) return &array;
    }
    return nullptr;
}

std::span<const std::byte> part(const Bytes& bytes, std::int64_t offset, std::int64_t size) {
    return std::span(bytes).subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
}

void mend_bricks(Bytes& bytes, const Contents& contents) {
    const isoatlas::BrickGrid grid(contents.volume.extent);
    const StoredArray *data = find(contents, "volume/data"), *offset = find(contents, "volume/offset"),
                      *sizes = find(contents, "volume/bytes"), *sums = find(contents, "volume/checksum");
    if (!data || !offset || !sizes || !sums || data->type != "uint8" || sizes->type != "uint16") return;
    if (offset->bytes() != 8 * grid.count() || sums->bytes() != 8 * grid.count() || sizes->bytes() != 2 * grid.count()) return;
    for (std::int64_t b = 0; b < grid.count(); ++b) {
        const auto at = static_cast<std::int64_t>(number_at(bytes, offset->offset + 8 * b));
        std::uint16_t size;
        std::memcpy(&size, bytes.data() + sizes->offset + 2 * b, sizeof size);
        if (at < 0 || at > data->bytes() || size > data->bytes() - at) continue;
        put_number(bytes, sums->offset + 8 * b, isoatlas::checksum(part(bytes, data->offset + at, size)));
    }
}

/// The same file with right checksums, as far as it has places for them.
Bytes mended(Bytes bytes) {
    const auto size = static_cast<std::int64_t>(bytes.size());
    if (size < isoatlas::kHeaderBytes) return bytes;
    isoatlas::Header header{size, static_cast<std::int64_t>(number_at(bytes, 24)), static_cast<std::int64_t>(number_at(bytes, 32)), 0};
    if (header.contents_offset < 0 || header.contents_bytes < 0 || header.contents_offset > size ||
        header.contents_bytes > size - header.contents_offset)
        return bytes;
    const std::span<const std::byte> text = part(bytes, header.contents_offset, header.contents_bytes);
    try {
        const Contents contents = isoatlas::contents_of_json({reinterpret_cast<const char*>(text.data()), text.size()}, "fuzz", size);
        mend_bricks(bytes, contents);
        for (const StoredArray& array : contents.arrays) {
            for (std::int64_t block = 0; block < array.blocks(); ++block) {
                const std::int64_t first = block * array.block, count = std::min(array.block, array.bytes() - first);
                put_number(bytes, array.checksums + 8 * block, isoatlas::checksum(part(bytes, array.offset + first, count)));
            }
        }
    } catch (const isoatlas::Error&) {
    }
    header.contents_checksum = isoatlas::checksum(part(bytes, header.contents_offset, header.contents_bytes));
    const auto head = isoatlas::bytes_of_header(header);
    std::memcpy(bytes.data(), head.data(), head.size());
    return bytes;
}

template <class Ask>
void ask(const Ask& query) {
    try {
        query();
    } catch (const isoatlas::Error&) {
    }
}

void dump() {
    const isoatlas::StoreDump store("fuzz");
    std::vector<isoatlas::StorePart> parts = store.parts();
    for (const char* name : {"brick 0", "brick 1", "voxel 1,2,0"}) ask([&] { parts.push_back(store.find(name)); });
    for (const isoatlas::StorePart& part : parts) {
        ask([&] { (void)store.text(part); });
        ask([&] { (void)store.read(part, part.first, std::min(part.end, part.first + 1000)); });
    }
}

void query(std::span<const std::byte> content) {
    const fuzz::OnlyContent in_use(content);
    isoatlas::Context context;
    context.threads = 1;
    ask([&] {
        const isoatlas::Atlas atlas("fuzz");
        if (atlas.info().extent.voxels() > 1 << 18) return;
        const std::array<double, 2> range = atlas.range();
        for (const double tau : {range[0], (range[0] + range[1]) / 2, range[1]}) {
            ask([&] { (void)atlas.cut(tau, {.label = true}, context); });
            ask([&] { (void)atlas.extract(tau, {}, context); });
            isoatlas::SurfaceOptions options;
            options.objects = {0};
            ask([&] { (void)atlas.extract(tau, options, context); });
        }
        ask([&] { (void)atlas.volume(context); });
        ask([&] { atlas.check(context); });
        ask([&] {
            const isoatlas::Analysis analysis = atlas.analysis();
            for (const isoatlas::ElementId i : isoatlas::ids<isoatlas::ElementId>(analysis.element_count())) (void)analysis.element(i);
            for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) (void)analysis.event(i);
            for (std::int64_t i = 0; i < analysis.level_count(); ++i) (void)analysis.level(i);
            for (std::int64_t i = 0; i < analysis.contour_arc_count(); ++i) (void)analysis.contour_arc(i);
            analysis.visit_object_contours([](isoatlas::EventId, std::span<const isoatlas::GenusCount>) {});
        });
    });
    ask([&] {
        const isoatlas::Atlas atlas("fuzz");
        if (atlas.info().extent.voxels() <= 1 << 12) (void)isoatlas::verify_atlas(atlas, {.levels = 1}, context);
    });
    ask(dump);
    ask([&] {
        const isoatlas::Container file("fuzz");
        const isoatlas::StoredClusters clusters(file, isoatlas::surface_prefix(0), {});
        for (const double distance : {1.0, -1.0}) (void)isoatlas::surface_within(clusters.read(distance), std::max(0.0, distance));
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> content = std::as_bytes(std::span(data, size));
    query(content);
    const Bytes better = mended(Bytes(content.begin(), content.end()));
    query(better);
    return 0;
}
