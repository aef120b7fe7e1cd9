// The JSON documents of --json: one object on standard output; long lists are streamed, one entry a line.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

class Terminal;
using Json = nlohmann::ordered_json;

/// {"schema": "isoatlas/NAME/1", "version": ...}
[[nodiscard]] Json document(const std::string& name);
/// The same with "volume", "units" and, for results of an analysis, "interpolant" (and its "tunnel_height", given in stored values) and
/// "boundary".
[[nodiscard]] Json document(const std::string& name, const VolumeInfo& info);
[[nodiscard]] Json document(const std::string& name, const VolumeInfo& info, Interpolant interpolant, double tunnel_height,
                            Boundary boundary = Boundary::closed);

/// "reads": read statistics of the store for this document; null for a volume file.
void add_reads(Json& json, const std::optional<QueryCost>& reads);

void print(Terminal& terminal, const Json& json);
/// Prints `head` with one more member: name: [item(0), ..., item(count - 1)].
void print(Terminal& terminal, const Json& head, const std::string& name, std::int64_t count,
           const std::function<Json(std::int64_t)>& item);

/// Infinite becomes null.
[[nodiscard]] Json number(double value);

}  // namespace isoatlas::cli
