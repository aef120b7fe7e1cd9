// The engine's answers against the oracle's. Every function returns "" or one line that says what differs first.
#pragma once

#include <string>

#include "isoatlas/analysis.h"
#include "isoatlas/cut.h"
#include "oracle/oracle.h"

namespace oracle {

/// The samples as a volume of a type; the values must be representable.
isoatlas::Volume to_volume(const Grid& grid, isoatlas::ValueType type = isoatlas::ValueType::f64);
Grid to_grid(const isoatlas::Volume& volume);

std::string compare_elements(const Result& expected, const isoatlas::Analysis& actual);
std::string compare_arcs(const Result& expected, const isoatlas::Analysis& actual);
std::string compare_levels(const Result& expected, const isoatlas::Analysis& actual);
std::string compare_events(const Result& expected, const isoatlas::Analysis& actual);  ///< all fields, parents, children, contours
std::string compare_zones(const Result& expected, const isoatlas::Analysis& actual);   ///< of every voxel
/// All of the above.
std::string compare(const Result& expected, const isoatlas::Analysis& actual);

/// Objects, contours, active cells and labels of one cut.
std::string compare_cut(const Elements& elements, double tau, const isoatlas::Cut& actual);

/// What does not depend on numbering or axes: levels as (value, in, out) and the event tree without coordinates, as one sorted text.
std::string canonical_text(const isoatlas::Analysis& analysis);
std::string canonical_text(const Result& result);

/// Every accessor of an analysis, spelled out (equal texts: equal analyses).
std::string full_text(const isoatlas::Analysis& analysis);

}  // namespace oracle
