// A comparison as JSON and as CSV.
#include <fmt/format.h>

#include "compare/output.h"

namespace isoatlas::cli {
namespace {

Json json_of(const ComparedMethod& method) {
    return {{"name", method.name}, {"title", method.title}, {"section", method.section}, {"source", method.source}, {"cost", method.cost}};
}

Json json_of(const SurfaceDistance& distance) {
    if (distance.samples == 0) return nullptr;
    return {{"mean", distance.mean}, {"rms", distance.rms}, {"max", distance.max}, {"samples", distance.samples}};
}

Json json_of(const ExtractedSurface& one) {
    Json json = json_of(one.method);
    json["seconds"] = one.seconds;
    json["makes_points"] = one.is_points;
    json["points"] = one.points;
    json["triangles"] = one.triangles;
    json["bytes"] = one.bytes;
    json["cells"] = one.cost.cells;
    json["working_bytes"] = one.cost.bytes;
    const auto of_surface = [&](std::int64_t count) { return one.is_points ? Json(nullptr) : Json(count); };
    json["components"] = of_surface(one.components);
    json["wrong_components"] = of_surface(one.wrong_components);
    json["euler"] = of_surface(one.euler);
    json["genus"] = one.genus ? Json(*one.genus) : Json(nullptr);
    json["hole_edges"] = of_surface(one.hole_edges);
    json["non_manifold_edges"] = of_surface(one.non_manifold_edges);
    json["zero_area_triangles"] = of_surface(one.zero_area_triangles);
    json["to_trilinear"] = json_of(one.to_trilinear);
    json["from_trilinear"] = json_of(one.from_trilinear);
    return json;
}

void add_query(Json& json, const SearchQuery& query) {
    json["seconds"] = query.seconds;
    json["cells"] = query.cost.cells;
    json["nodes"] = query.cost.nodes;
    json["blocks"] = query.cost.blocks;
    json["bytes_read"] = query.cost.bytes_read;
}

void add_run(Json& json, const SearchRun& one) {
    json["missing_memory"] = one.missing_memory > 0 ? Json(one.missing_memory) : Json(nullptr);
    json["refusal"] = one.refusal.empty() ? Json(nullptr) : Json(one.refusal);
    json["build_seconds"] = one.build_seconds;
    json["cold_seconds"] = one.cold_seconds ? Json(*one.cold_seconds) : Json(nullptr);
    add_query(json, one.query);
    json["bytes"] = one.bytes;
    json["file_bytes"] = one.file_bytes;
}

Json isovalues_of(const Comparison& found) {
    Json all = Json::array();
    for (std::size_t i = 0; i < found.isovalues.size(); ++i) {
        Json queries = Json::array();
        for (const SearchRun& one : found.searches) {
            if (!one.has_run()) continue;
            Json query{{"name", one.method.name}};
            add_query(query, one.at_isovalue[i]);
            queries.push_back(std::move(query));
        }
        all.push_back({{"tau", number(found.info.calibration.reported(found.isovalues[i]))},
                       {"active_cells", found.active_at[i]},
                       {"searches", std::move(queries)}});
    }
    return all;
}

Json sizes_of(const Comparison& found) {
    Json all = Json::array();
    for (const SizeRun& size : found.sizes) {
        Json searches = Json::array();
        for (const SearchRun& one : size.searches) {
            Json search{{"name", one.method.name}};
            add_run(search, one);
            searches.push_back(std::move(search));
        }
        Json dims = Json::array();
        for (int axis = 0; axis < size.extent.rank; ++axis) dims.push_back(size.extent.size[axis]);
        all.push_back({{"step", size.step},
                       {"dims", std::move(dims)},
                       {"cells", size.cells},
                       {"active_cells", size.active},
                       {"searches", std::move(searches)}});
    }
    return all;
}

/// Of a study; the names of methods have no commas.
std::string csv_line(const char* table, const SearchRun& one, double tau, std::int64_t cells, std::int64_t active,
                     const SearchQuery& query) {
    constexpr std::size_t kOfQuery = 9, kOfSurface = 13;  // columns behind the first five
    std::string line = fmt::format("{},{},{},{},{}", table, one.method.name, tau, cells, active);
    if (!one.has_run()) return line + std::string(kOfQuery + kOfSurface, ',') + '\n';
    const bool is_cold_too = one.cold_seconds && &query == &one.query;
    line += fmt::format(",{},{},{},{},{},{},{},{},{}", one.build_seconds, query.seconds,
                        is_cold_too ? fmt::format("{}", *one.cold_seconds) : "", query.cost.cells, query.cost.nodes, query.cost.blocks,
                        query.cost.bytes_read, one.bytes, one.file_bytes);
    return line + std::string(kOfSurface, ',') + '\n';
}

}  // namespace

Json json_of(const Comparison& found, const VolumePictures& volume) {
    Json json = document("compare", found.info);
    json["tau"] = number(found.info.calibration.reported(found.tau));
    json["cells"] = found.cells;
    json["active_cells"] = found.searches.empty() ? Json(nullptr) : Json(found.active);
    json["surface_part"] = nullptr;
    for (std::size_t axis = 0; found.surface_part && axis < 3; ++axis)
        json["surface_part"].push_back({found.surface_part->begin[axis], found.surface_part->end[axis]});
    json["surfaces"] = Json::array();
    for (const ExtractedSurface& one : found.surfaces) json["surfaces"].push_back(json_of(one));
    json["searches"] = Json::array();
    for (const SearchRun& one : found.searches) {
        Json search = json_of(one.method);
        add_run(search, one);
        json["searches"].push_back(std::move(search));
    }
    json["isovalues"] = isovalues_of(found);
    json["sizes"] = sizes_of(found);
    json["optical_models"] = Json::array();
    for (const ModelPicture& one : volume.models)
        json["optical_models"].push_back({{"name", one.name}, {"title", one.title}, {"seconds", one.seconds}});
    json["projections"] = Json::array();
    for (const ProjectionPicture& one : volume.projections)
        json["projections"].push_back({{"name", one.name},
                                       {"title", one.title},
                                       {"source", one.source},
                                       {"seconds", one.seconds},
                                       {"samples", one.samples},
                                       {"rms_error", one.error.root_mean_square},
                                       {"largest_error", one.error.largest}});
    return json;
}

std::string csv_of(const Comparison& found) {
    std::string csv =
        "table,method,tau,cells,active_cells,build_seconds,seconds,cold_seconds,cells_looked_at,nodes,blocks,bytes_read,bytes,file_bytes,"
        "points,"
        "triangles,"
        "components,wrong_components,euler,genus,hole_edges,non_manifold_edges,zero_area_triangles,"
        "to_trilinear_mean,to_trilinear_max,from_trilinear_mean,from_trilinear_max\n";
    const auto reported = [&](double tau) { return found.info.calibration.reported(tau); };
    for (const ExtractedSurface& one : found.surfaces) {
        csv += fmt::format("surface,{},{},{},{},,{},,{},,,,{},,{},", one.method.name, reported(found.tau), found.cells, one.cost.active,
                           one.seconds, one.cost.cells, one.bytes, one.points);
        csv += one.is_points ? ",,,,,,,"
                             : fmt::format("{},{},{},{},{},{},{},{}", one.triangles, one.components, one.wrong_components, one.euler,
                                           one.genus ? fmt::format("{}", *one.genus) : "", one.hole_edges, one.non_manifold_edges,
                                           one.zero_area_triangles);
        for (const SurfaceDistance* distance : {&one.to_trilinear, &one.from_trilinear})
            csv += distance->samples == 0 ? std::string(",,") : fmt::format(",{},{}", distance->mean, distance->max);
        csv += '\n';
    }
    for (const SearchRun& one : found.searches) csv += csv_line("search", one, reported(found.tau), found.cells, found.active, one.query);
    for (const SearchRun& one : found.searches) {
        for (std::size_t i = 0; i < one.at_isovalue.size(); ++i)
            csv += csv_line("isovalue", one, reported(found.isovalues[i]), found.cells, found.active_at[i], one.at_isovalue[i]);
    }
    for (const SizeRun& size : found.sizes) {
        for (const SearchRun& one : size.searches) csv += csv_line("size", one, reported(found.tau), size.cells, size.active, one.query);
    }
    return csv;
}

}  // namespace isoatlas::cli
