// A cluster hierarchy as arrays of a container. What coarse surfaces need is at the beginning of every array.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "isoatlas/cluster_hierarchy.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {

/// The names of the arrays of surface `number` begin with this.
[[nodiscard]] std::string surface_prefix(std::size_t number);

/// hierarchy: as make_clusters() orders it; lives until they are written.
[[nodiscard]] std::vector<PackedArray> arrays_of(const ClusterHierarchy& hierarchy, const std::string& prefix);

/// The clusters and groups of a stored hierarchy, and where its points and triangles are.
class StoredClusters {
public:
    /// like: the surface without points and triangles. The container must live as long as this. Throws Error{input} for damage: what is
    /// read later lies inside of what it refers to.
    StoredClusters(const Container& file, std::string prefix, Surface like);

    [[nodiscard]] const ClusterHierarchy& tables() const { return tables_; }  ///< without points and triangles
    /// With the points and triangles of the surfaces that choose every group of at most this distance. Throws Error{input} for damage.
    [[nodiscard]] ClusterHierarchy read(double distance) const;
    /// The surface of a choice, by its clusters, ascending. Throws Error{input} for damage. Cost: reads the chunks in which they lie.
    [[nodiscard]] Surface read(std::span<const std::int64_t> clusters) const;

private:
    /// rows: ascending.
    template <class Row>
    void read_rows(const char* name, const char* type, std::span<const std::int64_t> rows, Array<Row>& out) const;
    void check_tables() const;
    [[noreturn]] void damaged(const char* what) const;

    const Container& file_;
    std::string prefix_;
    ClusterHierarchy tables_;
    std::vector<std::int64_t> points_;  ///< of each cluster, that those before it do not use
};

}  // namespace isoatlas
