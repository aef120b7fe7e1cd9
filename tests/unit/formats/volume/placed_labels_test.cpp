// NIfTI files lie where the volume lies: by the formulas of nifti1.h, by nibabel and by VTK; of every space, and of real volumes.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "isoatlas/output.h"
#include "unit/formats/common/external.h"
#include "unit/formats/common/placed_volumes.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;
using placed_volumes::Affine;
using placed_volumes::Placed;

const std::string kData = ISOATLAS_SOURCE_DIR "/../shared/data/";

/// NIfTI has m, mm and um.
double to_nifti(const std::string& unit) { return unit == "cm" ? 10 : unit == "nm" ? 1e-3 : 1; }

Affine expected_affine(const Geometry& geometry) {
    Affine rows = placed_volumes::affine_in(geometry, "RAS");
    for (auto& row : rows) {
        for (double& x : row) x *= to_nifti(geometry.unit);
    }
    return rows;
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// What nifti1.h says of a header: both codes and both matrices.
struct Forms {
    int qform_code, sform_code;
    Affine qform, sform;
};

template <class Float, class Code>
Forms forms_at(const std::string& bytes, std::size_t codes, std::size_t quaternion, std::size_t rows, std::size_t pixdim) {
    const auto number = [&](std::size_t offset, std::size_t i) {
        return static_cast<double>(at<Float>(bytes, offset + i * sizeof(Float)));
    };
    Forms forms{at<Code>(bytes, codes), at<Code>(bytes, codes + sizeof(Code)), {}, {}};
    for (std::size_t i = 0; i < 12; ++i) forms.sform[i / 4][i % 4] = number(rows, i);
    const double b = number(quaternion, 0), c = number(quaternion, 1), d = number(quaternion, 2);
    const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
    const double r[3][3] = {{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
                            {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)},
                            {2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c}};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            forms.qform[row][axis] = r[row][axis] * number(pixdim, axis + 1) * (axis == 2 && number(pixdim, 0) < 0 ? -1 : 1);
        forms.qform[row][3] = number(quaternion, 3 + row);
    }
    return forms;
}

Forms forms_of(const std::string& path) {
    const std::string bytes = bytes_of(path);
    return at<std::int32_t>(bytes, 0) == 348 ? forms_at<float, std::int16_t>(bytes, 252, 256, 280, 76)
                                             : forms_at<double, std::int32_t>(bytes, 344, 352, 400, 104);
}

/// The largest difference of two affines at the corners of a grid, in voxels.
double difference(const Affine& a, const Affine& b, const Index3& size) {
    double smallest = 1e300, largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) smallest = std::min(smallest, std::hypot(a[0][axis], a[1][axis], a[2][axis]));
    for (std::size_t row = 0; row < 3; ++row) {
        double sum = std::abs(a[row][3] - b[row][3]);
        for (std::size_t axis = 0; axis < 3; ++axis) sum += std::abs(a[row][axis] - b[row][axis]) * static_cast<double>(size[axis] - 1);
        largest = std::max(largest, sum);
    }
    return largest / smallest;
}

TEST(PlacedLabels, NiftiHasBothFormsInEveryCase) {
    const TestFolder folder;
    for (const Placed& placed : placed_volumes::placed_geometries()) {
        const Volume volume = placed_volumes::ball(placed.geometry);
        const std::vector<std::uint32_t> labels(static_cast<std::size_t>(volume.info.extent.voxels()), 1);
        write_labels(folder / "labels.nii", volume.info, labels);
        write_volume(folder / "volume.nii", volume);
        for (const std::string name : {"labels.nii", "volume.nii"}) {
            SCOPED_TRACE(std::string(placed.name) + " " + name);
            const Forms forms = forms_of(folder / name);
            const bool is_sheared = std::string(placed.name) == "lps sheared";
            const int code = placed.geometry.space == "unknown" ? 2 : 1;
            EXPECT_EQ(forms.sform_code, code);
            EXPECT_EQ(forms.qform_code, is_sheared ? 0 : code);
            const Affine expected = expected_affine(placed.geometry);
            EXPECT_LT(difference(expected, forms.sform, volume.info.extent.size), 1e-3);
            if (!is_sheared) {
                EXPECT_LT(difference(expected, forms.qform, volume.info.extent.size), 1e-3);
            }
            const VolumeInfo back = load_volume(folder / name).info;
            EXPECT_LT(difference(expected, placed_volumes::affine_of(back.geometry), volume.info.extent.size), 1e-3);
            EXPECT_EQ(back.geometry.space, "RAS");
            EXPECT_EQ(bytes_of(folder / name).substr(0, 4) == std::string("\x1c\x02\0\0", 4), std::string(placed.name) == "far away");
            for (const std::string& note : back.notes) EXPECT_EQ(note.find("differ"), std::string::npos) << note;
        }
    }
}

/// Turned about all axes; degrees.
Geometry turned_by(double x, double y, double z, double mirror) {
    const double unit = std::acos(-1.0) / 180;
    const double cu = std::cos(x * unit), su = std::sin(x * unit), cv = std::cos(y * unit), sv = std::sin(y * unit),
                 cw = std::cos(z * unit), sw = std::sin(z * unit);
    Geometry geometry{.spacing = {0.5, 0.75, 2.5}, .origin = {1, 2, 3}, .space = "RAS"};
    geometry.direction = {{{cu * cv, cu * sv * sw - su * cw, mirror * (cu * sv * cw + su * sw)},
                           {su * cv, su * sv * sw + cu * cw, mirror * (su * sv * cw - cu * sw)},
                           {-sv, cv * sw, mirror * cv * cw}}};
    return geometry;
}

/// What programs take from the files is the grid. Returns the code of the qform.
int check_forms(const Geometry& geometry) {
    const TestFolder folder;
    const Volume volume = placed_volumes::ball(geometry);
    const Index3& size = volume.info.extent.size;
    write_volume(folder / "v.nii", volume);
    const Forms forms = forms_of(folder / "v.nii");
    EXPECT_EQ(forms.sform_code, 1);
    EXPECT_LT(difference(expected_affine(geometry), forms.sform, size), 1e-3);
    if (forms.qform_code != 0) {
        EXPECT_LT(difference(forms.sform, forms.qform, size), 1e-3);
    }
    EXPECT_LT(difference(expected_affine(geometry), placed_volumes::affine_of(load_volume(folder / "v.nii").info.geometry), size), 1e-3);
    return forms.qform_code;
}

RC_GTEST_PROP(PlacedLabels, AnyRotationIsAQuaternion, ()) {
    const auto angle = [] { return *rc::gen::inRange(-360, 361) * 2.0; };  // many quarter turns
    const double x = angle(), y = angle(), z = angle(), mirror = *rc::gen::element(-1.0, 1.0);
    const int code = check_forms(turned_by(x, y, z, mirror));
    RC_ASSERT(code == 0 || code == 1);
    RC_ASSERT(!testing::Test::HasFailure());
}

TEST(PlacedLabels, QuaternionsThatLoseDigitsAreLeftOut) {
    // Readers take a from 1 - b^2 - c^2 - d^2. Near a half turn float32 leaves it four digits.
    EXPECT_EQ(check_forms(turned_by(-370, -532, -438, -1)), 0);
    EXPECT_EQ(check_forms(turned_by(180, 0, 0, 1)), 1);  // exact
    EXPECT_EQ(check_forms(turned_by(10, 20, 30, 1)), 1);
}

constexpr const char* kCheckAffine = R"(
import nibabel, numpy
def check(name, affine, size):
    image = nibabel.load(name)
    for form in (image.affine, image.get_sform(coded=True)[0], image.get_qform(coded=True)[0]):
        if form is None: continue
        far = (numpy.abs(form - affine)[:3, :3] @ (numpy.array(size) - 1) + numpy.abs(form - affine)[:3, 3]).max()
        step = numpy.sqrt((numpy.array(affine, dtype=float)[:3, :3] ** 2).sum(axis=0)).min()
        assert far < 1e-3 * step, (name, form, affine)
)";

bool has_nibabel() { return external::run("/usr/bin/python3 -c 'import nibabel'").status == 0; }

TEST(PlacedLabels, NibabelSeesTheVolumesAffine) {
    if (!has_nibabel()) GTEST_SKIP() << "python3-nibabel is not installed";
    const TestFolder folder;
    std::string program = kCheckAffine;
    int number = 0;
    for (const Placed& placed : placed_volumes::placed_geometries()) {
        const Volume volume = placed_volumes::ball(placed.geometry);
        const std::vector<std::uint32_t> labels(static_cast<std::size_t>(volume.info.extent.voxels()), 1);
        for (const std::string end : {".nii", ".nii.gz"}) {
            const std::string name = folder / (std::to_string(number++) + end);
            write_labels(name, volume.info, labels);
            program +=
                "check('" + name + "', numpy.array(" + placed_volumes::python_text(expected_affine(placed.geometry)) + "), [9, 8, 7])\n";
        }
    }
    const external::Result result = external::python(program + "print('good')");
    EXPECT_EQ(result.text, "good\n");
}

/// Labels of real volumes, each converted by us: nibabel's affine is that of the file they come from.
TEST(PlacedLabels, NibabelSeesTheAffineOfRealVolumes) {
    if (!has_nibabel()) GTEST_SKIP() << "python3-nibabel is not installed";
    if (!std::filesystem::exists(kData + "nifti_orientations")) GTEST_SKIP() << "no shared data";
    const TestFolder folder;
    std::string program = kCheckAffine;
    int number = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kData + "nifti_orientations")) {
        const std::string path = entry.path().string();
        if (!path.ends_with(".nii") && !path.ends_with(".nii.gz")) continue;
        const VolumeInfo info = open_volume(path)->info();
        if (info.geometry.space == "unknown") continue;  // nibabel invents an affine for the source
        const std::string name = folder / ("l" + std::to_string(number++) + ".nii.gz");
        write_labels(name, info, std::vector<std::uint32_t>(static_cast<std::size_t>(info.extent.voxels()), 1));
        program += "check('" + name + "', nibabel.load('" + path + "').affine, nibabel.load('" + path + "').shape[:3])\n";
    }
    EXPECT_GT(number, 0);
    const external::Result result = external::python(program + "print('good')");
    EXPECT_EQ(result.text, "good\n");
}

TEST(PlacedLabels, VtkSeesImageDataWhereItIs) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const TestFolder folder;
    std::string program =
        "import vtk, numpy\n"
        "def check(name, affine):\n  r = vtk.vtkXMLImageDataReader()\n  r.SetFileName(name)\n  r.Update()\n  g = r.GetOutput()\n"
        "  m = g.GetIndexToPhysicalMatrix()\n  m = [[m.GetElement(i, j) for j in range(4)] for i in range(4)]\n"
        "  assert numpy.allclose(m, affine, rtol=1e-12), (name, m)\n  s = g.GetPointData().GetScalars()\n"
        "  return g.GetDimensions(), s.GetDataTypeAsString(), s.GetValue(0), s.GetValue(9 * 8 * 7 - 1)\n";
    int number = 0;
    for (const Placed& placed : placed_volumes::placed_geometries()) {
        const Volume volume = placed_volumes::ball(placed.geometry);
        const std::string name = folder / (std::to_string(number++) + ".vti");
        write_volume(name, volume);
        program += "print(*check('" + name + "', " + placed_volumes::python_text(placed_volumes::affine_of(placed.geometry)) + "))\n";
        const Volume back = load_volume(name);
        EXPECT_EQ(back.bytes, volume.bytes);
        EXPECT_LT(difference(placed_volumes::affine_of(placed.geometry), placed_volumes::affine_of(back.info.geometry), {9, 8, 7}), 1e-9);
    }
    const external::Result result = external::python(program);
    EXPECT_EQ(result.status, 0) << result.text;
    EXPECT_EQ(static_cast<int>(std::count(result.text.begin(), result.text.end(), '\n')), number) << result.text;
    EXPECT_EQ(result.text.rfind("(9, 8, 7) float ", 0), 0U) << result.text;
}

TEST(PlacedLabels, EveryTypeOfSampleIsKeptByVti) {
    const TestFolder folder;
    for (const ValueType type :
         {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::i16, ValueType::u32, ValueType::i32, ValueType::f32, ValueType::f64}) {
        Volume volume = make_volume({.rank = 3, .size = {3, 4, 5}}, type);
        for (std::size_t i = 0; i < volume.bytes.size(); ++i) volume.bytes[i] = static_cast<std::byte>((i * 37) % 64);
        write_volume(folder / "v.vti", volume);
        const Volume back = load_volume(folder / "v.vti");
        EXPECT_EQ(back.info.type, type);
        EXPECT_EQ(back.bytes, volume.bytes);
    }
}

}  // namespace
}  // namespace isoatlas
