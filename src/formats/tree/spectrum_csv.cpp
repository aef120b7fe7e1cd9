// The spectrum as CSV: rows of kind "interval", then "size", then "advice"; missing values are empty.
#include <cmath>

#include "formats/common/byte_writer.h"
#include "formats/tree/spectrum_formats.h"

namespace isoatlas {
namespace {

void put_real(ByteWriter& out, double value) {
    out.text(",");
    if (std::isfinite(value)) out.number(value);
}

void put_counts(ByteWriter& out, const LevelCounts& counts) {
    for (const std::int64_t count : {counts.objects, counts.contours, counts.tunnels, counts.cavities}) out.text(","), out.number(count);
}

/// Columns of all rows of one isovalue.
void put_isovalue(ByteWriter& out, const char* kind, const VolumeInfo& info, const Spectrum& spectrum, double tau) {
    out.text(kind);
    for (int end = 0; end < 2; ++end) put_real(out, info.calibration.reported(tau));
    const SpectrumInterval counts = counts_at(spectrum, tau);
    put_counts(out, counts.all);
    put_counts(out, counts.significant);
}

void put_advice(ByteWriter& out, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumAdvice& advice) {
    put_isovalue(out, "advice", info, spectrum, advice.tau);
    out.text(",,,,,,,"), out.number(advice.object);
    out.text(","), out.text(advice.reason ? name_of(*advice.reason) : "");
    out.text(",");
    if (advice.cavity >= 0) out.number(advice.cavity);
    out.text("\n");
}

}  // namespace

void write_spectrum_csv(Sink& sink, const VolumeInfo& info, const Spectrum& spectrum) {
    ByteWriter out(sink);
    out.text(
        "kind,tau_low,tau_high,objects,contours,tunnels,cavities,significant_objects,significant_contours,significant_tunnels,"
        "significant_cavities,min_voxels,max_voxels,cells,facets,area,measure,object,reason,cavity\n");
    for (const SpectrumInterval& interval : spectrum.intervals) {
        out.text("interval");
        for (const double end : info.calibration.reported_interval(interval.low, interval.high)) put_real(out, end);
        put_counts(out, interval.all);
        put_counts(out, interval.significant);
        out.text(",,,,,,,,,\n");
    }
    for (const SpectrumSize& size : spectrum.sizes) {
        put_isovalue(out, "size", info, spectrum, size.tau);
        for (const std::int64_t count : {size.voxels.min, size.voxels.max, size.cells, size.facets}) out.text(","), out.number(count);
        put_real(out, size.area);
        put_real(out, size.measure);
        out.text(",,,\n");
    }
    for (const SpectrumAdvice& advice : spectrum.advice) put_advice(out, info, spectrum, advice);
    out.finish();
}

}  // namespace isoatlas
