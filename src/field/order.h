// THE total order of elements. Every comparison in the system that decides a tie is made here.
//
// Elements: vertices (voxels), the points of ambiguous faces, and the body points of cells (docs/theory/6-interior.md#body-points).
// Key of an element = (value, second, third), compared lexicographically:
//   body B1         (s, -2, cell)
//   face point      (s, -1, face)                          when s lies above the value of its highest Low
//   vertex          (value, 2 * voxel, -)
//   face point      (s, 2 * voxel(highest Low) + 1, face)  when s equals that value: just above its Low
//   body B2         (s, +max, cell)
// An element is stored as its value and a 64-bit code from which everything else is recomputed.
// voxel = x + nx*(y + ny*z); face = 3 * voxel(corner a) + orientation.
//
// In the literature: simulation of simplicity (Edelsbrunner, Muecke 1990), here by rank instead of by perturbation.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "field/cell.h"
#include "isoatlas/volume.h"

namespace isoatlas {

enum class CodeKind : std::uint8_t { vertex = 0, face = 1, body_open = 2, body_close = 3 };

/// 64 bits: index (54) | tie corner or axis (3) | diagonal (1) | h0 (2) | l0 (2) | kind (2).
/// index: voxel, or face number. Of a face: tie corner 0: s above the highest Low; 1 + i: s equals the value of corner i of a b c d, the
/// highest Low; diagonal 1: b, d are the Highs. Of a saddle vertex: the axis of its two upper neighbours (h0 = 2), else of its two lower
/// ones.
struct ElementCode {
    std::uint64_t bits;

    static constexpr ElementCode vertex(std::int64_t voxel, int h0, int l0, int axis) {
        return {static_cast<std::uint64_t>(voxel) << 10 | static_cast<std::uint64_t>(axis << 7 | h0 << 4 | l0 << 2)};
    }
    static constexpr ElementCode face(std::int64_t number, int tie_corner, bool bd_high, int h0, int l0) {
        return {static_cast<std::uint64_t>(number) << 10 |
                static_cast<std::uint64_t>(tie_corner << 7 | int{bd_high} << 6 | h0 << 4 | l0 << 2 | 1)};
    }
    /// kind: body_open or body_close. a, b, ring: corners of the cell.
    static constexpr ElementCode body(CodeKind kind, std::int64_t cell, int a, int b, int ring) {
        const int h0 = kind == CodeKind::body_open ? 2 : 1;
        return {(static_cast<std::uint64_t>(cell) << 9 | static_cast<std::uint64_t>(a << 6 | b << 3 | ring)) << 10 |
                static_cast<std::uint64_t>(h0 << 4 | (3 - h0) << 2 | static_cast<int>(kind))};
    }
    [[nodiscard]] constexpr CodeKind kind() const { return static_cast<CodeKind>(bits & 3); }
    [[nodiscard]] constexpr int l0() const { return static_cast<int>(bits >> 2 & 3); }
    [[nodiscard]] constexpr int h0() const { return static_cast<int>(bits >> 4 & 3); }
    [[nodiscard]] constexpr bool bd_high() const { return bits >> 6 & 1; }
    [[nodiscard]] constexpr int tie_corner() const { return static_cast<int>(bits >> 7 & 7); }
    [[nodiscard]] constexpr int axis() const { return static_cast<int>(bits >> 7 & 7); }
    [[nodiscard]] constexpr bool is_body() const { return bits >> 1 & 1; }
    [[nodiscard]] constexpr std::int64_t cell() const { return index() >> 9; }
    /// Corner of a body point: 0, 1 in the regions it joins, 2 in the ring.
    [[nodiscard]] constexpr int body_corner(int i) const { return static_cast<int>(index() >> (6 - 3 * i) & 7); }
    [[nodiscard]] constexpr std::int64_t index() const { return static_cast<std::int64_t>(bits >> 10); }
};

/// Voxel steps of one grid: offset of corner i of a face of orientation o from its corner a.
struct GridSteps {
    std::array<std::int64_t, 3> axis;
    explicit constexpr GridSteps(const Extent& extent) : axis{1, extent.size[0], extent.size[0] * extent.size[1]} {}
    [[nodiscard]] constexpr std::int64_t face_corner(int orientation, int corner) const {
        const FaceAxes axes = kFaceAxes[orientation];
        return (corner == 1 || corner == 2 ? axis[axes.axis1] : 0) + (corner >= 2 ? axis[axes.axis2] : 0);
    }
    /// Voxel of corner k of the cell whose corner 0 is a voxel.
    [[nodiscard]] constexpr std::int64_t cell_corner(std::int64_t cell, int k) const {
        return cell + (k & 1) * axis[0] + (k >> 1 & 1) * axis[1] + (k >> 2) * axis[2];
    }
    /// Voxel of corner i (0..3 = a..d) of a face number.
    [[nodiscard]] constexpr std::int64_t face_voxel(std::int64_t face, int corner) const {
        return face / 3 + face_corner(static_cast<int>(face % 3), corner);
    }
};

/// Second part of the key.
constexpr std::int64_t second_key(ElementCode code, const GridSteps& steps) {
    if (code.kind() == CodeKind::vertex) return 2 * code.index();
    if (code.is_body()) return code.kind() == CodeKind::body_open ? -2 : std::numeric_limits<std::int64_t>::max();
    if (code.tie_corner() == 0) return -1;
    return 2 * steps.face_voxel(code.index(), code.tie_corner() - 1) + 1;
}

/// value as an unsigned number with the same order (-0.0 equals 0.0; no NaN).
constexpr std::uint64_t ordered_bits(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);  // -0.0 + 0.0 == 0.0
    return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

struct KeyedElement {
    double value;
    ElementCode code;
};

/// Is p above q in the total order?
struct Above {
    GridSteps steps;
    [[gnu::always_inline]] constexpr bool operator()(const KeyedElement& p, const KeyedElement& q) const {
        if (p.value != q.value) return p.value > q.value;
        const std::int64_t p2 = second_key(p.code, steps), q2 = second_key(q.code, steps);
        if (p2 != q2) return p2 > q2;
        return p.code.index() > q.code.index();
    }
};

/// Position of an element in voxel coordinates; a face point lies in the middle of its face, a body point in that of its cell.
inline std::array<double, 3> element_position(ElementCode code, const Extent& extent) {
    const bool is_face = code.kind() == CodeKind::face;
    const Index3 voxel = extent.voxel(code.is_body() ? code.cell() : is_face ? code.index() / 3 : code.index());
    std::array<double, 3> position{static_cast<double>(voxel[0]), static_cast<double>(voxel[1]), static_cast<double>(voxel[2])};
    if (code.is_body()) {
        for (double& coordinate : position) coordinate += 0.5;
    }
    if (is_face) {
        const FaceAxes axes = kFaceAxes[code.index() % 3];
        position[axes.axis1] += 0.5;
        position[axes.axis2] += 0.5;
    }
    return position;
}

}  // namespace isoatlas
