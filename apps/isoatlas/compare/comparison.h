// What `isoatlas compare` measures: methods that make surfaces at one isovalue, and methods that find active cells, at that isovalue and,
// where a study is asked for, at others and in coarser volumes.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/methods.h"

namespace isoatlas::cli {

/// A surface, or points, while they are in memory.
struct SurfaceInHand {
    Extraction result;
    SurfaceDefects defects;
    ComponentDifference difference;  ///< from the reference
};

struct ExtractedSurface {
    ComparedMethod method{};
    double seconds = 0;
    bool is_points = false;
    std::int64_t points = 0, triangles = 0, bytes = 0;  ///< of the result
    ExtractionCost cost{};
    // Of points, all zero:
    std::int64_t components = 0, wrong_components = 0, euler = 0;
    std::optional<std::int64_t> genus{};  ///< of all together; none: edges have more than two triangles, or rims meet
    std::int64_t hole_edges = 0, non_manifold_edges = 0, zero_area_triangles = 0;
    SurfaceDistance to_trilinear{}, from_trilinear{};  ///< no samples: there was nothing to measure
};
/// Is shown each surface; the reference first.
using LookAtSurface = std::function<void(const ExtractedSurface&, const SurfaceInHand&)>;

struct SearchQuery {
    double seconds = 0;
    CellSearchCost cost{};
};

struct SearchRun {
    ComparedMethod method{};
    double build_seconds = 0;
    std::int64_t bytes = 0, file_bytes = 0;
    SearchQuery query{};                     ///< at the isovalue
    std::optional<double> cold_seconds{};    ///< of a file: of the same query before, when no page of the file was in memory
    std::vector<SearchQuery> at_isovalue{};  ///< then, at those of the study
    std::int64_t missing_memory = 0;         ///< not 0: it did not run, as it would have needed about so many bytes
    std::string refusal{};                   ///< not empty: it did not run, and why
    [[nodiscard]] bool has_run() const { return missing_memory == 0 && refusal.empty(); }
};

/// One volume of the study over sizes.
struct SizeRun {
    std::int64_t step = 1;  ///< every how many samples
    Extent extent{};
    std::int64_t cells = 0, active = 0;
    std::vector<SearchRun> searches{};
};

struct Comparison {
    VolumeInfo info;
    double tau = 0;
    std::int64_t cells = 0, active = 0;
    std::optional<SampleBox> surface_part{};   ///< of which surfaces were made; none: the volume
    std::vector<ExtractedSurface> surfaces{};  ///< none of an image
    std::vector<SearchRun> searches{};
    std::vector<double> isovalues{};        ///< of the study, ascending stored values; empty: no study
    std::vector<std::int64_t> active_at{};  ///< these
    std::vector<SizeRun> sizes{};           ///< ascending; the last one is the volume itself; empty: no study
};

struct CompareOptions {
    ComparedMethods methods;
    std::int64_t isovalues = 0, sizes = 0;    ///< of the studies
    std::int64_t memory = 0;                  ///< bytes for a search structure while it is built
    std::optional<SampleBox> surface_part{};  ///< surfaces of these samples alone
};

/// The reference, the last one of the list, runs first; one other surface is in memory at a time. None of an image.
[[nodiscard]] std::vector<ExtractedSurface> run_extractors(const Volume& volume, double tau, const std::vector<ComparedExtractor>& methods,
                                                           const LookAtSurface& look, const Context& context);

/// One method after the other, each alone: times are compared. A search that does not find exactly the active cells of brute force:
/// Error{internal}. context: told which method runs.
[[nodiscard]] Comparison run_comparison(const Volume& volume, double tau, const CompareOptions& options, const LookAtSurface& look,
                                        const Context& context);

/// Exponent e of the power law c x^e that fits the points best (least squares of logarithms); none: fewer than three points above zero, or
/// all at one x.
[[nodiscard]] std::optional<double> fitted_exponent(const std::vector<std::array<double, 2>>& points);

}  // namespace isoatlas::cli
