#include "formats/volume/nifti_header.h"

#include <string_view>

#include "formats/common/field_reader.h"

namespace isoatlas {

namespace {

std::string_view characters(std::span<const std::byte> bytes, std::size_t offset, std::size_t size) {
    if (bytes.size() < offset + size) return {};
    return {reinterpret_cast<const char*>(bytes.data()) + offset, size};
}

std::int32_t size_field(std::span<const std::byte> bytes, bool big_endian) {
    return bytes.size() < 4 ? 0 : FieldReader(bytes, big_endian).at<std::int32_t>(0);
}

template <class Float>
void take_geometry(const FieldReader& fields, std::size_t quaternion, std::size_t rows, NiftiHeader& header) {
    fields.take<Float>(quaternion, header.quaternion);
    fields.take<Float>(quaternion + 3 * sizeof(Float), header.offset);
    for (std::size_t row = 0; row < 3; ++row) fields.take<Float>(rows + row * 4 * sizeof(Float), header.rows[row]);
}

NiftiHeader decode_1(const FieldReader& fields) {
    NiftiHeader header;
    fields.take<std::int16_t>(40, header.dim);
    header.datatype = fields.at<std::int16_t>(70);
    header.bits = fields.at<std::int16_t>(72);
    fields.take<float>(76, header.pixdim);
    header.vox_offset = static_cast<double>(fields.at<float>(108));
    header.slope = static_cast<double>(fields.at<float>(112));
    header.intercept = static_cast<double>(fields.at<float>(116));
    header.units = fields.at<std::uint8_t>(123);
    header.description = fields.text(148, 80);
    header.qform_code = fields.at<std::int16_t>(252);
    header.sform_code = fields.at<std::int16_t>(254);
    take_geometry<float>(fields, 256, 280, header);
    return header;
}

NiftiHeader decode_2(const FieldReader& fields) {
    NiftiHeader header;
    header.version = 2;
    header.datatype = fields.at<std::int16_t>(12);
    header.bits = fields.at<std::int16_t>(14);
    fields.take<std::int64_t>(16, header.dim);
    fields.take<double>(104, header.pixdim);
    header.vox_offset = static_cast<double>(fields.at<std::int64_t>(168));
    header.slope = fields.at<double>(176);
    header.intercept = fields.at<double>(184);
    header.description = fields.text(240, 80);
    header.qform_code = fields.at<std::int32_t>(344);
    header.sform_code = fields.at<std::int32_t>(348);
    take_geometry<double>(fields, 352, 400, header);
    header.units = fields.at<std::int32_t>(500);
    return header;
}

}  // namespace

NiftiKind nifti_kind(std::span<const std::byte> bytes) {
    const std::int32_t little = size_field(bytes, false), big = size_field(bytes, true);
    if (little == kNifti2HeaderBytes || big == kNifti2HeaderBytes) {
        const std::string_view magic = characters(bytes, 4, 4);
        return magic == std::string_view("n+2\0", 4) || magic == std::string_view("ni2\0", 4) ? NiftiKind::nifti2 : NiftiKind::no;
    }
    if (little != kNifti1HeaderBytes && big != kNifti1HeaderBytes) return NiftiKind::no;
    const std::string_view magic = characters(bytes, 344, 4);
    return magic == std::string_view("n+1\0", 4) || magic == std::string_view("ni1\0", 4) ? NiftiKind::nifti1 : NiftiKind::analyze;
}

NiftiHeader decode_nifti(std::span<const std::byte> bytes, NiftiKind kind) {
    const bool two = kind == NiftiKind::nifti2;
    const std::int64_t size = two ? kNifti2HeaderBytes : kNifti1HeaderBytes;
    const bool big_endian = size_field(bytes, true) == size;
    const FieldReader fields(bytes, big_endian);
    NiftiHeader header = two ? decode_2(fields) : decode_1(fields);
    header.big_endian = big_endian;
    header.pair = characters(bytes, two ? 4 : 344, 2) == "ni";
    if (kind == NiftiKind::analyze) {  // the same places up to the scale factor; what follows means something else
        header.is_analyze = header.pair = true;
        header.analyze_unit = fields.text(56, 4);
        header.qform_code = header.sform_code = header.units = 0;
        header.intercept = 0;
        header.dim[0] = header.dim[0] == 4 && header.dim[4] == 1 ? 3 : header.dim[0];
    }
    return header;
}

}  // namespace isoatlas
