// The formats behind write_tree: one function each, all reading the tree through TreeView. docs/formats.md lists the columns.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/connectivity.h"
#include "formats/common/json_stream.h"
#include "isoatlas/output.h"

namespace isoatlas {

/// The tree in reported (calibrated) values.
struct TreeView {
    const Volume& volume;
    const Analysis& analysis;
    const TreeOutput& options;
    bool has_zones;  ///< false: voxel counts are unknown

    TreeView(const Volume& the_volume, const Analysis& the_analysis, const TreeOutput& the_options);
    [[nodiscard]] double reported(double stored) const { return volume.info.calibration.reported(stored); }
    /// Both ends of the zone of an event, ascending.
    [[nodiscard]] std::array<double, 2> reported(const ZoneRange& zone) const {
        return volume.info.calibration.reported_interval(zone.tau_low, zone.tau_high);
    }
    [[nodiscard]] std::array<double, 2> reported(const ContourArc& arc) const {
        return volume.info.calibration.reported_interval(arc.value_low, arc.value_high);
    }
    /// Of the values of the file.
    [[nodiscard]] Criticality kind_of(const Event& event) const { return is_low() ? mirrored(event.kind) : event.kind; }
    [[nodiscard]] bool is_low() const { return polarity_of(volume.info) == Polarity::low; }
    [[nodiscard]] Connectivity connectivity() const {
        return connectivity_of(volume.info, analysis.interpolant(), analysis.tunnel_height());
    }
    [[nodiscard]] std::int64_t item_count() const;  ///< of the chosen detail
    [[nodiscard]] bool is_outside(ElementId element) const { return element == ElementId(analysis.element_count()); }
};

using EventVisitor = std::function<void(const Event&, std::span<const GenusCount>)>;
/// Every event in id order, with the genera of the contours of its object.
void visit_events(const TreeView& tree, const EventVisitor& visit);

[[nodiscard]] const char* name_of(TreeDetail detail);

void write_json(const TreeView& tree, const JsonStream::Output& output);
// Each writes the whole file.
void write_tree_csv(Sink& sink, const TreeView& tree);
void write_tree_graphml(Sink& sink, const TreeView& tree);
void write_tree_vtu(Sink& sink, const TreeView& tree);

/// "0:2 3:1": two contours of genus 0, one of genus 3.
[[nodiscard]] std::string histogram_text(std::span<const GenusCount> genera);
/// Numbers between spaces.
[[nodiscard]] std::string list_text(std::span<const std::int64_t> numbers);
[[nodiscard]] std::string list_text(std::span<const EventId> events);

}  // namespace isoatlas
