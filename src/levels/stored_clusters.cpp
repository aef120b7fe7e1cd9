#include "levels/stored_clusters.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "isoatlas/error.h"
#include "level_of_detail/cluster_order.h"

namespace isoatlas {
namespace {

template <class T>
PackedArray owned(std::string name, std::string type, std::vector<T> numbers) {
    const auto held = std::make_shared<std::vector<T>>(std::move(numbers));
    return keeping(packed_chunks<T>(std::move(name), std::move(type), *held), held);
}

/// The numbers of an array of small arrays, in a row.
template <class T, std::size_t kCount>
std::span<const T> flat(const Array<std::array<T, kCount>>& rows) {
    return {rows.empty() ? nullptr : rows.front().data(), kCount * rows.size()};
}

template <class Line, class Number>
std::vector<Number> column(const std::vector<Line>& lines, Number Line::* member) {
    std::vector<Number> numbers;
    for (const Line& line : lines) numbers.push_back(line.*member);
    return numbers;
}

void add_groups(const std::vector<ClusterGroup>& groups, const std::string& prefix, std::vector<PackedArray>& arrays) {
    std::vector<std::int64_t> parts, made_of;
    std::vector<double> balls;
    for (const ClusterGroup& group : groups) {
        balls.insert(balls.end(), {group.centre[0], group.centre[1], group.centre[2], group.radius});
        parts.push_back(static_cast<std::int64_t>(group.made_of.size()));
        made_of.insert(made_of.end(), group.made_of.begin(), group.made_of.end());
    }
    arrays.push_back(owned(prefix + "groups/distance", "float64", column(groups, &ClusterGroup::distance)));
    arrays.push_back(owned(prefix + "groups/ball", "float64", std::move(balls)));
    arrays.push_back(owned(prefix + "groups/parts", "int64", std::move(parts)));
    arrays.push_back(owned(prefix + "groups/made_of", "int64", std::move(made_of)));
}

}  // namespace

std::string surface_prefix(std::size_t number) { return "surface_" + std::to_string(number) + "/"; }

std::vector<PackedArray> arrays_of(const ClusterHierarchy& hierarchy, const std::string& prefix) {
    std::vector<PackedArray> arrays;
    const std::vector<Cluster>& clusters = hierarchy.clusters;
    arrays.push_back(owned(prefix + "clusters/triangles", "int64", column(clusters, &Cluster::triangles)));
    arrays.push_back(owned(prefix + "clusters/points", "int64", points_of_clusters(hierarchy)));
    arrays.push_back(owned(prefix + "clusters/made_by", "int64", column(clusters, &Cluster::made_by)));
    arrays.push_back(owned(prefix + "clusters/replaced_by", "int64", column(clusters, &Cluster::replaced_by)));
    add_groups(hierarchy.groups, prefix, arrays);
    const Surface& surface = hierarchy.surface;
    arrays.push_back(packed_chunks<std::int64_t>(prefix + "triangles", "int64", flat(surface.triangles)));
    arrays.push_back(packed_chunks<double>(prefix + "points", "float64", flat(surface.points)));
    arrays.push_back(packed_chunks<float>(prefix + "normals", "float32", flat(surface.normals)));
    arrays.push_back(packed_chunks<std::int64_t>(prefix + "object", "int64", std::span<const std::int64_t>(surface.object)));
    arrays.push_back(packed_chunks<std::int64_t>(prefix + "contour", "int64", std::span<const std::int64_t>(surface.contour)));
    return arrays;
}

StoredClusters::StoredClusters(const Container& file, std::string prefix, Surface like) : file_(file), prefix_(std::move(prefix)) {
    const auto read = [&]<class T>(const char* name, const char* type, T) { return file.all<T>(prefix_ + name, type); };
    const auto triangles = read("clusters/triangles", "int64", std::int64_t{}), made_by = read("clusters/made_by", "int64", std::int64_t{}),
               replaced_by = read("clusters/replaced_by", "int64", std::int64_t{}), parts = read("groups/parts", "int64", std::int64_t{}),
               made_of = read("groups/made_of", "int64", std::int64_t{});
    const auto distance = read("groups/distance", "float64", double{}), ball = read("groups/ball", "float64", double{});
    points_ = read("clusters/points", "int64", std::int64_t{});
    tables_.surface = std::move(like);
    const std::size_t clusters = triangles.size(), groups = distance.size();
    if (made_by.size() != clusters || replaced_by.size() != clusters || points_.size() != clusters || parts.size() != groups ||
        ball.size() != 4 * groups)
        damaged("the lengths of its tables do not agree");
    std::int64_t first = 0;
    const std::int64_t all = file.contents().array(prefix_ + "triangles", "int64").count() / 3;
    for (std::size_t i = 0; i < clusters; ++i) {
        if (triangles[i] < 0 || triangles[i] > all - first) damaged("its clusters have more triangles than it has");
        tables_.clusters.push_back({first, triangles[i], made_by[i], replaced_by[i]});
        first += triangles[i];
    }
    std::size_t part = 0;
    for (std::size_t i = 0; i < groups; ++i) {
        if (parts[i] < 0 || static_cast<std::size_t>(parts[i]) > made_of.size() - part) damaged("its groups have more parts than it has");
        ClusterGroup group{distance[i], {ball[4 * i], ball[4 * i + 1], ball[4 * i + 2]}, ball[4 * i + 3], {}};
        group.made_of.assign(made_of.begin() + static_cast<std::ptrdiff_t>(part),
                             made_of.begin() + static_cast<std::ptrdiff_t>(part) + parts[i]);
        part += static_cast<std::size_t>(parts[i]);
        tables_.groups.push_back(std::move(group));
    }
    check_tables();
}

void StoredClusters::check_tables() const {
    const auto groups = static_cast<std::int64_t>(tables_.groups.size());
    const auto is_group = [&](std::int64_t group) { return group >= -1 && group < groups; };
    const std::int64_t points = file_.contents().array(prefix_ + "points", "float64").count() / 3;
    std::int64_t used = 0;
    for (std::size_t i = 0; i < tables_.clusters.size(); ++i) {
        const Cluster& cluster = tables_.clusters[i];
        if (!is_group(cluster.made_by) || !is_group(cluster.replaced_by)) damaged("a cluster has a group that there is not");
        if (points_[i] < 0 || points_[i] > points - used) damaged("its clusters have more points than it has");
        used += points_[i];
    }
    for (std::int64_t i = 0; i < groups; ++i) {
        const ClusterGroup& group = tables_.groups[static_cast<std::size_t>(i)];
        if (!(group.distance >= 0) || !std::isfinite(group.distance)) damaged("a distance is not a number from 0 on");
        for (const std::int64_t made_of : group.made_of) {
            if (made_of < 0 || made_of >= i) damaged("a group is made of a later one");
        }
    }
    for (const char* name : {"normals", "object", "contour"}) {
        const StoredArray& array = file_.contents().array(prefix_ + name, std::string_view(name) == "normals" ? "float32" : "int64");
        const std::int64_t wanted = std::string_view(name) == "normals" ? 3 * points : points;
        if (array.count() != 0 && array.count() != wanted) damaged("its points have numbers for other points");
    }
}

void StoredClusters::damaged(const char* what) const {
    throw Error(ErrorKind::input, {.file = file_.path(),
                                   .where = prefix_.substr(0, prefix_.size() - 1),
                                   .what = what,
                                   .next = "the levels of detail are damaged: delete the file and make them again"});
}

template <class Row>
void StoredClusters::read_rows(const char* name, const char* type, std::span<const std::int64_t> rows, Array<Row>& out) const {
    constexpr std::int64_t kFewest = 1024;
    const StoredArray& array = file_.contents().array(prefix_ + name, type);
    if (array.count() == 0) return;
    constexpr auto kBytes = static_cast<std::int64_t>(sizeof(Row));
    const std::int64_t chunk = std::max(kFewest, array.block / kBytes);  // rows that are read together anyway
    std::vector<FileRange> runs;
    for (const std::int64_t row : rows) {
        if (runs.empty() || (row - chunk) * kBytes > runs.back().end) runs.push_back({row * kBytes, 0});
        runs.back().end = (row + 1) * kBytes;
    }
    file_.fetch(array, runs);
    out.resize(rows.size());
    std::vector<Row> run;
    std::size_t next = 0;
    for (const FileRange& range : runs) {
        const std::int64_t first = range.begin / kBytes;
        run.resize(static_cast<std::size_t>((range.end - range.begin) / kBytes));
        file_.read(array, range.begin, std::as_writable_bytes(std::span(run)));
        for (; next < rows.size() && rows[next] < range.end / kBytes; ++next) out[next] = run[static_cast<std::size_t>(rows[next] - first)];
    }
}

Surface StoredClusters::read(std::span<const std::int64_t> clusters) const {
    std::vector<std::int64_t> rows;
    for (const std::int64_t i : clusters) {
        const Cluster& cluster = tables_.clusters[static_cast<std::size_t>(i)];
        for (std::int64_t t = 0; t < cluster.triangles; ++t) rows.push_back(cluster.first_triangle + t);
    }
    Surface surface = tables_.surface;
    read_rows("triangles", "int64", rows, surface.triangles);
    const std::int64_t count = file_.contents().array(prefix_ + "points", "float64").count() / 3;
    std::vector<std::int64_t> used;
    used.reserve(3 * surface.triangles.size());
    for (const auto& triangle : surface.triangles) used.insert(used.end(), triangle.begin(), triangle.end());
    std::ranges::sort(used);
    const auto doubled = std::ranges::unique(used);
    used.erase(doubled.begin(), doubled.end());
    if (!used.empty() && (used.front() < 0 || used.back() >= count)) damaged("a triangle has a point that there is not");
    read_rows("points", "float64", used, surface.points);
    read_rows("normals", "float32", used, surface.normals);
    read_rows("object", "int64", used, surface.object);
    read_rows("contour", "int64", used, surface.contour);
    for (auto& triangle : surface.triangles) {
        for (std::int64_t& point : triangle) point = std::ranges::lower_bound(used, point) - used.begin();
    }
    return surface;
}

ClusterHierarchy StoredClusters::read(double distance) const {
    ClusterHierarchy found = tables_;
    const ClusterParts parts = parts_beyond(tables_, points_, distance);
    const auto fill = [&](const char* name, const char* type, auto& rows, std::int64_t count, std::size_t bytes) {
        const StoredArray& array = file_.contents().array(prefix_ + name, type);
        if (array.count() == 0) return;
        rows.resize(static_cast<std::size_t>(count));
        file_.read(array, 0, std::as_writable_bytes(std::span(rows)).first(static_cast<std::size_t>(count) * bytes));
    };
    fill("triangles", "int64", found.surface.triangles, parts.triangles, 3 * sizeof(std::int64_t));
    fill("points", "float64", found.surface.points, parts.points, 3 * sizeof(double));
    fill("normals", "float32", found.surface.normals, parts.points, 3 * sizeof(float));
    fill("object", "int64", found.surface.object, parts.points, sizeof(std::int64_t));
    fill("contour", "int64", found.surface.contour, parts.points, sizeof(std::int64_t));
    for (const auto& triangle : found.surface.triangles) {
        for (const std::int64_t point : triangle) {
            if (point < 0 || point >= parts.points) damaged("a triangle has a point that there is not");
        }
    }
    return found;
}

}  // namespace isoatlas
