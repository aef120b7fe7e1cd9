// NIfTI-1 and NIfTI-2, single files. Source: nifti1.h and nifti2.h of the NIfTI working group.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "formats/common/byte_writer.h"
#include "formats/common/gzip_stream.h"
#include "formats/common/length_unit.h"
#include "formats/common/volume_file.h"
#include "formats/volume/nifti_geometry.h"

namespace isoatlas {

namespace {

constexpr std::size_t kHeader1 = 348, kHeader2 = 540, kExtension = 4;
constexpr int kScannerSpace = 1, kAlignedSpace = 2;

/// Numbers at byte offsets.
class FieldWriter {
public:
    explicit FieldWriter(std::size_t bytes) : bytes_(bytes) {}
    template <class T>
    void set(std::size_t offset, T value) {
        std::memcpy(bytes_.data() + offset, &value, sizeof(T));
    }
    void text(std::size_t offset, std::size_t size, const std::string& text) {
        std::memcpy(bytes_.data() + offset, text.data(), std::min(size, text.size()));
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

int datatype(ValueType type) {
    static constexpr int kCodes[] = {2, 256, 512, 4, 768, 8, 16, 64};
    return kCodes[static_cast<int>(type)];
}

struct LengthUnit {
    int code = 0;       ///< 1: m, 2: mm, 3: um
    double factor = 1;  ///< to that unit
};

LengthUnit length_unit(const std::string& unit) {
    const std::optional<double> metres = metres_in(unit);
    if (!metres) return {};
    if (*metres >= 1) return {1, *metres};
    if (*metres == 1e-3) return {2, 1};
    if (*metres > 1e-3) return {2, std::round(*metres * 1e7) / 1e4};  // 10 for cm, 25.4 for in
    return *metres == 1e-6 ? LengthUnit{3, 1} : LengthUnit{3, *metres * 1e6};
}

/// Members of both versions.
struct Contents {
    std::array<std::int64_t, 8> dim{};
    std::array<double, 8> pixdim{};
    int space_code = 0;  ///< of the sform
    int qform_code = 0;  ///< 0: the sform alone, for axes that no quaternion gives, or none of float32 precisely
    int unit = 0;
    Vec3 quaternion{};  ///< b, c, d; pixdim[0] is the sign of the third axis
    std::array<std::array<double, 4>, 3> rows{};
    double slope = 0, intercept = 0;
    std::string description;
};

constexpr std::size_t kDescription = 79;  ///< and a zero

/// At most `room` characters; truncated at a comma, because a truncated number would be a different one.
std::string shortened(const std::string& text, std::size_t room) {
    if (text.size() <= room) return text;
    return std::string(utf8_prefix(text, std::min(room, text.rfind(", ", room))));
}

std::string description_of(const VolumeInfo& info) {
    const std::string text = one_line(info.description);
    if (!is_rectilinear(info.geometry)) return shortened(text, kDescription);
    if (text.empty()) return "rectilinear coordinates replaced by their mean spacing";
    const std::string note = "; was rectilinear";
    return shortened(text, kDescription - note.size()) + note;
}

Contents contents_of(const VolumeInfo& info) {
    Contents contents;
    const Geometry geometry = turned_to(regular_geometry(info), "RAS");
    const LengthUnit unit = length_unit(geometry.unit);
    contents.unit = unit.code;
    contents.dim.fill(1);
    contents.dim[0] = info.extent.rank;
    contents.pixdim.fill(1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        contents.dim[axis + 1] = info.extent.size[axis];
        contents.pixdim[axis + 1] = geometry.spacing[axis] * unit.factor;
        for (std::size_t row = 0; row < 3; ++row)
            contents.rows[row][axis] = geometry.direction[row][axis] * geometry.spacing[axis] * unit.factor;
        contents.rows[axis][3] = geometry.origin[axis] * unit.factor;
    }
    // Always a form: without one programs disagree on where the grid lies (nibabel centres and mirrors it).
    contents.space_code = is_anatomical(info.geometry) ? kScannerSpace : kAlignedSpace;
    if (const std::optional<NiftiRotation> rotation = nifti_rotation(geometry.direction)) {
        contents.qform_code = contents.space_code;
        contents.quaternion = rotation->quaternion;
        contents.pixdim[0] = rotation->is_mirrored ? -1 : 1;
    }
    if (!info.calibration.is_identity()) {
        contents.slope = info.calibration.slope;
        contents.intercept = info.calibration.intercept;
    }
    contents.description = description_of(info);
    return contents;
}

template <class Float>
void set_rows(FieldWriter& fields, std::size_t offset, const Contents& contents) {
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t i = 0; i < 4; ++i) fields.set(offset + (row * 4 + i) * sizeof(Float), static_cast<Float>(contents.rows[row][i]));
    }
}

FieldWriter header_1(const Contents& contents, ValueType type) {
    FieldWriter fields(kHeader1 + kExtension);
    fields.set(0, static_cast<std::int32_t>(kHeader1));
    fields.set(38, 'r');  // "regular", as ANALYZE readers expect
    for (std::size_t i = 0; i < 8; ++i) fields.set(40 + 2 * i, static_cast<std::int16_t>(contents.dim[i]));
    fields.set(70, static_cast<std::int16_t>(datatype(type)));
    fields.set(72, static_cast<std::int16_t>(8 * size_of(type)));
    for (std::size_t i = 0; i < 8; ++i) fields.set(76 + 4 * i, static_cast<float>(contents.pixdim[i]));
    fields.set(108, static_cast<float>(kHeader1 + kExtension));
    fields.set(112, static_cast<float>(contents.slope));
    fields.set(116, static_cast<float>(contents.intercept));
    fields.set(123, static_cast<char>(contents.unit));
    fields.text(148, kDescription, contents.description);
    fields.set(252, static_cast<std::int16_t>(contents.qform_code));
    fields.set(254, static_cast<std::int16_t>(contents.space_code));
    for (std::size_t i = 0; i < 3; ++i) {
        fields.set(256 + 4 * i, static_cast<float>(contents.quaternion[i]));
        fields.set(268 + 4 * i, static_cast<float>(contents.rows[i][3]));
    }
    set_rows<float>(fields, 280, contents);
    fields.text(344, 4, "n+1");
    return fields;
}

FieldWriter header_2(const Contents& contents, ValueType type) {
    FieldWriter fields(kHeader2 + kExtension);
    fields.set(0, static_cast<std::int32_t>(kHeader2));
    fields.text(4, 8, std::string("n+2\0\r\n\032\n", 8));
    fields.set(12, static_cast<std::int16_t>(datatype(type)));
    fields.set(14, static_cast<std::int16_t>(8 * size_of(type)));
    for (std::size_t i = 0; i < 8; ++i) fields.set(16 + 8 * i, contents.dim[i]);
    for (std::size_t i = 0; i < 8; ++i) fields.set(104 + 8 * i, contents.pixdim[i]);
    fields.set(168, static_cast<std::int64_t>(kHeader2 + kExtension));
    fields.set(176, contents.slope);
    fields.set(184, contents.intercept);
    fields.text(240, kDescription, contents.description);
    fields.set(344, static_cast<std::int32_t>(contents.qform_code));
    fields.set(348, static_cast<std::int32_t>(contents.space_code));
    for (std::size_t i = 0; i < 3; ++i) {
        fields.set(352 + 8 * i, contents.quaternion[i]);
        fields.set(376 + 8 * i, contents.rows[i][3]);
    }
    set_rows<double>(fields, 400, contents);
    fields.set(500, static_cast<std::int32_t>(contents.unit));
    return fields;
}

/// Whether float32 places every sample within a ten-thousandth of a voxel.
bool float_is_enough(const Contents& contents) {
    const double smallest = *std::min_element(contents.pixdim.begin() + 1, contents.pixdim.begin() + 4);
    for (const auto& row : contents.rows) {
        double error = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double farthest = i < 3 ? static_cast<double>(contents.dim[i + 1]) : 1;
            error += std::abs(static_cast<double>(static_cast<float>(row[i])) - row[i]) * farthest;
        }
        if (!(error <= 1e-4 * smallest)) return false;
    }
    return true;
}

/// Whether a quaternion of float32 places every sample within a two-thousandth of a voxel.
bool float_quaternion_is_enough(const Contents& contents) {
    Vec3 quaternion = contents.quaternion;
    for (double& part : quaternion) part = static_cast<double>(static_cast<float>(part));
    const std::optional<std::array<Vec3, 3>> columns = rotation_of_qform(quaternion, contents.pixdim[0] < 0);
    if (!columns) return false;
    const double smallest = *std::min_element(contents.pixdim.begin() + 1, contents.pixdim.begin() + 4);
    for (std::size_t row = 0; row < 3; ++row) {
        double error = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double step = (*columns)[axis][row] * contents.pixdim[axis + 1];
            error += std::abs(step - contents.rows[row][axis]) * static_cast<double>(contents.dim[axis + 1]);
        }
        if (!(error <= 5e-4 * smallest)) return false;
    }
    return true;
}

/// NIfTI-1 holds 16-bit sizes and 32-bit floats; rounding is fine, infinity and zero are not.
bool needs_version_2(const Contents& contents) {
    const auto survives = [](double x) { return x == 0 || (std::isfinite(static_cast<float>(x)) && static_cast<float>(x) != 0); };
    if (!survives(contents.slope) || !survives(contents.intercept)) return true;
    if (!std::all_of(contents.pixdim.begin(), contents.pixdim.end(), survives) || !float_is_enough(contents)) return true;
    return *std::max_element(contents.dim.begin(), contents.dim.end()) > std::numeric_limits<std::int16_t>::max();
}

}  // namespace

void write_nifti(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, Packing packing) {
    Contents contents = contents_of(info);
    const bool is_version_2 = needs_version_2(contents);
    if (!is_version_2 && contents.qform_code != 0 && !float_quaternion_is_enough(contents)) contents.qform_code = 0;
    const FieldWriter header = is_version_2 ? header_2(contents, info.type) : header_1(contents, info.type);
    if (packing == Packing::gzip) {
        GzipStream stream(sink);
        stream.write(header.bytes());
        samples([&](std::span<const std::byte> bytes) { stream.write(bytes); });
        stream.finish();
    } else {
        sink.write(header.bytes());
        samples([&](std::span<const std::byte> bytes) { sink.write(bytes); });
    }
}

}  // namespace isoatlas
