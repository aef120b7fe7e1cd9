// write_measures: a line for each object.
#include <algorithm>
#include <cmath>

#include "base/atomic_file.h"
#include "formats/common/byte_writer.h"
#include "formats/common/file_extension.h"
#include "isoatlas/measures.h"
#include "isoatlas/polarity.h"

namespace isoatlas {
namespace {

constexpr const char* kColumns =
    "line,id,tau,voxels,voxel_volume,volume,area,equivalent_diameter,sphericity,mean,min,max,sum,deviation,centroid_x,centroid_y,"
    "centroid_z,axis_1,axis_2,axis_3,axis_1_x,axis_1_y,axis_1_z,axis_2_x,axis_2_y,axis_2_z,axis_3_x,axis_3_y,axis_3_z,box_1,box_2,box_3,"
    "box_x,box_y,box_z,low_x,low_y,low_z,high_x,high_y,high_z,feret_max,feret_min,feret_mean,feret_max_x,feret_max_y,feret_max_z,feret_min_"
    "x,feret_min_y,feret_min_z,euler,"
    "tunnels,cavities,touches_border,thickness_min,thickness_median,unit,value_unit";

/// A text of a header in quotes.
std::string quoted(const std::string& given) {
    std::string text = "\"";
    for (const char c : one_line(given)) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

class Line {
public:
    explicit Line(ByteWriter& out) : out_(out) {}
    Line& count(std::int64_t value) {
        separate();
        out_.number(value);
        return *this;
    }
    Line& real(double value) {
        separate();
        if (std::isfinite(value)) out_.number(value);
        return *this;
    }
    Line& vector(const Vec3& v) { return real(v[0]).real(v[1]).real(v[2]); }

private:
    void separate() {
        if (!first_) out_.text(",");
        first_ = false;
    }
    ByteWriter& out_;
    bool first_ = true;
};

void put(ByteWriter& out, const VolumeInfo& info, std::int64_t number, const ObjectMeasures& object) {
    Line line(out);
    line.count(number).count(object.id).real(info.calibration.reported(object.tau));
    line.count(object.voxels).real(object.voxel_volume).real(object.volume).real(object.area);
    line.real(object.equivalent_diameter).real(object.sphericity);
    const ValueStatistics& values = object.values;
    line.real(values.mean).real(values.min).real(values.max).real(values.sum).real(values.deviation);
    line.vector(object.centroid).vector(object.axes.length);
    for (const Vec3& direction : object.axes.direction) line.vector(direction);
    line.vector(object.box.size).vector(object.box.centre).vector(object.bounds[0]).vector(object.bounds[1]);
    line.real(object.feret.max).real(object.feret.min).real(object.feret.mean);
    line.vector(object.feret.max_direction).vector(object.feret.min_direction);
    line.count(object.euler).count(object.tunnels).count(object.cavities).count(object.touches_border ? 1 : 0);
    line.real(object.thickness.min).real(object.thickness.median);
}

std::string checked_extension(const std::string& path) {
    return known_extension(path, {".csv"}, {"the format of the measures", "format of measures", ".csv"});
}

}  // namespace

void write_measures(Sink& sink, const VolumeInfo& info, std::span<const ObjectMeasures> objects, std::span<const Polarity> polarities) {
    (void)checked_extension(sink.name());
    ByteWriter out(sink);
    const Polarity own = polarity_of(info);
    const VolumeInfo other = negated(info);
    const bool has_low = polarities.empty() ? own == Polarity::low : std::ranges::find(polarities, Polarity::low) != polarities.end();
    out.text(std::string(kColumns) + (has_low ? ",polarity\n" : "\n"));
    const std::string units = "," + quoted(info.geometry.unit) + "," + quoted(info.value_unit);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Polarity polarity = polarities.empty() ? own : polarities[i];
        put(out, polarity == own ? info : other, static_cast<std::int64_t>(i) + 1, objects[i]);
        out.text(units);
        if (has_low) out.text(polarity == Polarity::low ? ",low" : ",high");
        out.text("\n");
    }
    out.finish();
}

void write_measures(const std::string& path, const VolumeInfo& info, std::span<const ObjectMeasures> objects,
                    std::span<const Polarity> polarities) {
    (void)checked_extension(path);
    AtomicFile file(path);
    write_measures(file, info, objects, polarities);
    file.commit();
}

}  // namespace isoatlas
