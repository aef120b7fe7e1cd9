// A slice of a volume as a picture: grey values between samples, contours of the slice drawn over them.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "isoatlas/environment.h"
#include "render/colours.h"
#include "render/pen.h"
#include "render/vectors.h"

namespace isoatlas {
namespace {

/// Which axes run across and down, and whether down is against the axis.
struct Plane {
    int across, down;
    bool flipped;
};

Plane plane_of(int axis) {
    if (axis == 2) return {0, 1, false};
    return {axis == 1 ? 0 : 1, 2, true};
}

double place(const Geometry& geometry, int axis, std::int64_t i) {
    const auto& given = geometry.coordinates[axis];
    return given.empty() ? geometry.spacing[axis] * static_cast<double>(i) : given[i];
}

/// Sample positions of n pixels that span an axis evenly in space.
std::vector<double> positions(const Geometry& geometry, int axis, std::int64_t size, std::int64_t pixels, bool flipped) {
    std::vector<double> found(pixels);
    const double first = place(geometry, axis, 0), last = place(geometry, axis, size - 1);
    std::int64_t i = 0;
    for (std::int64_t p = 0; p < pixels; ++p) {
        const double x = first + (last - first) * (static_cast<double>(p) + 0.5) / static_cast<double>(pixels);
        while (i + 2 < size && place(geometry, axis, i + 1) < x) ++i;
        const double step = size > 1 ? place(geometry, axis, i + 1) - place(geometry, axis, i) : 1;
        found[flipped ? pixels - 1 - p : p] = size > 1 ? static_cast<double>(i) + (x - place(geometry, axis, i)) / step : 0;
    }
    return found;
}

/// Samples of the slice as a 2D volume in its own samples' coordinates, calibrated as the volume is.
Volume slice_of(const Volume& volume, int axis, std::int64_t index) {
    const Plane plane = plane_of(axis);
    const Extent& extent = volume.info.extent;
    const Extent flat{.rank = 2, .size = {extent.size[plane.across], extent.size[plane.down], 1}};
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        std::vector<T> values(flat.voxels());
        Index3 at{};
        at[axis] = index;
        for (std::int64_t v = 0; v < flat.size[1]; ++v) {
            for (std::int64_t u = 0; u < flat.size[0]; ++u) {
                at[plane.across] = u, at[plane.down] = v;
                values[flat.index(u, v, 0)] = samples[extent.index(at)];
            }
        }
        return make_volume<T>(flat, values);
    });
}

double between(const Volume& flat, double x, double y) {
    const Extent& extent = flat.info.extent;
    const auto x0 = static_cast<std::int64_t>(x), y0 = static_cast<std::int64_t>(y);
    const std::int64_t x1 = std::min(x0 + 1, extent.size[0] - 1), y1 = std::min(y0 + 1, extent.size[1] - 1);
    const double u = x - static_cast<double>(x0), v = y - static_cast<double>(y0);
    const auto at = [&](std::int64_t a, std::int64_t b) { return flat.value(extent.index(a, b, 0)); };
    return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x1, y0)) + v * ((1 - u) * at(x0, y1) + u * at(x1, y1));
}

struct ValueWindow {
    double black, white;
};

ValueWindow value_window(const Volume& volume, const SliceOptions& options) {
    if (options.black != options.white) return {options.black, options.white};
    return visit_samples(volume, [](auto samples) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        return ValueWindow{static_cast<double>(*low), static_cast<double>(*high)};
    });
}

/// Of a negated volume the grey is that of the file.
ValueWindow as_in_file(const VolumeInfo& info, const ValueWindow& window) {
    return polarity_of(info) == Polarity::low ? ValueWindow{window.white, window.black} : window;
}

/// Where a sample position appears, in pixels.
double pixel_of(const std::vector<double>& positions, double x) {
    const auto n = static_cast<double>(positions.size());
    const bool flipped = positions.front() > positions.back();
    const auto less = [&](double a, double b) { return flipped ? a > b : a < b; };
    const auto next = std::lower_bound(positions.begin(), positions.end(), x, less);
    const std::size_t i = std::clamp<std::ptrdiff_t>(next - positions.begin(), 1, static_cast<std::ptrdiff_t>(positions.size()) - 1);
    const double step = positions[i] - positions[i - 1];
    return std::clamp(static_cast<double>(i) - 0.5 + (step == 0 ? 0 : (x - positions[i - 1]) / step), 0.0, n);
}

void draw_contour(const Volume& flat, const SliceContour& contour, const std::vector<double>& columns, const std::vector<double>& rows,
                  Image& image, const Context& context) {
    const Surface curves =
        extract(flat, contour.tau, {.surface = {.objects = {}, .contours = {}, .normals = false, .ids = false}}, context);
    std::vector<Line> lines;
    for (const auto& [a, b] : curves.segments) {
        const Vec3 &p = curves.points[a], &q = curves.points[b];
        lines.push_back({{pixel_of(columns, p[0]), pixel_of(rows, p[1])}, {pixel_of(columns, q[0]), pixel_of(rows, q[1])}});
    }
    const double width = std::max(1.2, static_cast<double>(std::max(image.width, image.height)) / 350);
    draw_lines(image, lines, width, contour.colour);
}

void check_slice(const Volume& volume, const SliceOptions& options) {
    const auto refuse = [&](const std::string& what, const std::string& expected) {
        throw Error(ErrorKind::usage, {.file = volume.info.path, .what = what, .expected = expected});
    };
    if (options.axis < 0 || options.axis > 2) refuse("a slice needs an axis", "0, 1 or 2");
    const std::int64_t size = volume.info.extent.size[options.axis];
    if (options.index < 0 || options.index >= size)
        refuse("there is no slice " + std::to_string(options.index), "0 to " + std::to_string(size - 1));
    if (options.side < 16 || options.side > 16384) refuse("a picture of " + std::to_string(options.side) + " pixels", "16 to 16384");
}

}  // namespace

SceneSlice slice_picture(const Volume& volume, const SliceOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    check_slice(volume, options);
    const Plane plane = plane_of(options.axis);
    const Extent& extent = volume.info.extent;
    const Geometry& geometry = volume.info.geometry;
    const auto length = [&](int axis) { return std::max(place(geometry, axis, extent.size[axis] - 1) - place(geometry, axis, 0), 1e-300); };
    const double across = length(plane.across), down = length(plane.down), longer = std::max(across, down);
    const auto pixels = [&](double size) {
        return std::max<std::int64_t>(1, std::llround(static_cast<double>(options.side) * size / longer));
    };
    SceneSlice slice{.picture = Image(pixels(across), pixels(down))};
    const std::vector<double> columns = positions(geometry, plane.across, extent.size[plane.across], slice.picture.width, false);
    const std::vector<double> rows = positions(geometry, plane.down, extent.size[plane.down], slice.picture.height, plane.flipped);
    const Volume flat = slice_of(volume, options.axis, options.index);
    const ValueWindow window = as_in_file(volume.info, value_window(volume, options));
    const double range = window.white == window.black ? 1 : window.white - window.black;
    for_each_block(context.threads, slice.picture.height, [&](std::int64_t y) {
        for (std::int64_t x = 0; x < slice.picture.width; ++x) {
            const std::uint8_t grey = byte_of((between(flat, columns[x], rows[y]) - window.black) / range);
            std::uint8_t* pixel = slice.picture.at(x, y);
            pixel[0] = pixel[1] = pixel[2] = grey, pixel[3] = 255;
        }
    });
    if (extent.size[plane.across] > 1 && extent.size[plane.down] > 1) {
        for (const SliceContour& contour : options.contours) draw_contour(flat, contour, columns, rows, slice.picture, context);
    }
    Vec3 at{};
    at[options.axis] = static_cast<double>(options.index);
    const auto corner = [&](bool right, bool low) {
        Vec3 p = at;
        p[plane.across] = right ? static_cast<double>(extent.size[plane.across] - 1) : 0;
        p[plane.down] = low != plane.flipped ? static_cast<double>(extent.size[plane.down] - 1) : 0;
        return to_physical(geometry, p);
    };
    slice.corner = corner(false, false);
    slice.across = minus(corner(true, false), slice.corner);
    slice.down = minus(corner(false, true), slice.corner);
    return slice;
}

}  // namespace isoatlas
