#include "field/cell_loops.h"

#include <memory>

#include "base/check.h"

namespace isoatlas {
namespace {

/// Corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> outward_corners(int face) {
    const std::array<int, 4>& c = kFaceCorners[face];
    const bool plus_side = face & 1;
    const bool turns_with_normal = face / 2 != 1;  // a b c d turn around +normal for xy and yz, around -normal for xz
    if (plus_side == turns_with_normal) return c;
    return {c[0], c[3], c[2], c[1]};
}

CellLoops follow_links(int pattern, int joined) {
    std::array<int, 12> next;
    next.fill(-1);
    for (int f = 0; f < 6; ++f) {
        const FaceLinks links = face_links(pattern, joined, f);
        for (int i = 0; i < links.count; ++i) {
            ISOATLAS_CHECK(next[links.link[i][0]] == -1);
            next[links.link[i][0]] = links.link[i][1];
        }
    }
    CellLoops loops{};
    int used = 0;
    for (int first = 0; first < 12; ++first) {
        if (next[first] == -1) continue;
        for (int e = first; next[e] != -1;) {
            loops.edge[used++] = static_cast<std::uint8_t>(e);
            const int following = next[e];
            next[e] = -1;
            e = following;
        }
        loops.begin[++loops.count] = static_cast<std::uint8_t>(used);
    }
    return loops;
}

int hits_of(int pattern) {
    int hits = 0;
    for (int e = 0; e < 12; ++e) {
        const std::array<int, 2>& c = kEdgeCorners[e];
        if ((pattern >> c[0] & 1) != (pattern >> c[1] & 1)) hits |= 1 << e;
    }
    return hits;
}

std::unique_ptr<const CellCaseTables> make_tables() {
    auto tables = std::make_unique<CellCaseTables>();
    int cases = 0;
    for (int pattern = 0; pattern < 256; ++pattern) {
        int split = 0;
        for (int f = 0; f < 6; ++f) split |= int{face_is_split(pattern, f)} << f;
        tables->split_faces[pattern] = static_cast<std::uint8_t>(split);
        tables->hit_edges[pattern] = static_cast<std::uint16_t>(hits_of(pattern));
        tables->first_case[pattern] = static_cast<std::uint16_t>(cases);
        for (int joined = 0; joined < 64; ++joined) {
            if (joined != (joined & split)) {  // an earlier mask with the same split faces has the number
                tables->numbered_case[pattern * 64 + joined] = tables->numbered_case[pattern * 64 + (joined & split)];
                continue;
            }
            ISOATLAS_CHECK(cases < kCellCases);
            tables->numbered_case[pattern * 64 + joined] = static_cast<std::uint16_t>(cases);
            tables->pattern_of[cases] = static_cast<std::uint8_t>(pattern);
            tables->joined_of[cases] = static_cast<std::uint8_t>(joined);
            tables->loops[cases] = follow_links(pattern, joined);
            ++cases;
        }
    }
    ISOATLAS_CHECK(cases == kCellCases);
    return tables;
}

}  // namespace

FaceLinks face_links(int pattern, int joined, int face) {
    const std::array<int, 4> corners = outward_corners(face);
    const auto high = [&](int i) { return pattern >> corners[i & 3] & 1; };
    const auto edge_after = [&](int i) { return edge_between(corners[i & 3], corners[(i + 1) & 3]); };
    const bool lows_cut_off = face_is_split(pattern, face) && (joined >> face & 1);
    FaceLinks links;
    for (int i = 0; i < 4; ++i) {
        if (high(i) || !high(i + 1)) continue;  // edge_after(i) enters the Highs: links start there
        // ... and end where the walk leaves the Highs: after this run of Highs, or before the Low just passed.
        int leave = lows_cut_off ? i - 1 : i + 1;
        while (!(high(leave) && !high(leave + 1))) leave += lows_cut_off ? -1 : 1;
        links.link[links.count++] = {edge_after(i), edge_after(leave)};
    }
    return links;
}

const CellCaseTables& cell_cases() {
    static const std::unique_ptr<const CellCaseTables> tables = make_tables();
    return *tables;
}

}  // namespace isoatlas
