// A cut of the engine against a snapshot of the oracle.
#include <algorithm>

#include "oracle/compare.h"
#include "oracle/difference.h"

namespace oracle {
namespace {

/// Objects and low components form a tree with the outside as root; the contour of each towards the root.
struct Outward {
    std::vector<Index> of_object, of_low;
};

Outward outward_contours(const Snapshot& s) {
    Outward outward;
    outward.of_object.assign(s.objects.size(), -1);
    outward.of_low.assign(s.lows.size(), -1);
    std::vector<Index> lows{0};
    for (std::size_t next = 0; next < lows.size(); ++next) {
        for (Index c = 0; c < static_cast<Index>(s.contours.size()); ++c) {
            const Contour& contour = s.contours[c];
            if (contour.low != lows[next] || c == outward.of_low[contour.low]) continue;
            outward.of_object[contour.object] = c;
            for (const Index inner : s.objects[contour.object].contours) {
                if (inner == c) continue;
                outward.of_low[s.contours[inner].low] = inner;
                lows.push_back(s.contours[inner].low);
            }
        }
    }
    return outward;
}

struct Box {
    std::array<Index, 3> low, high{-1, -1, -1};
};

Box box_of(const Grid& grid, const Snapshot& s, Index object) {
    Box box{grid.size};
    for (Index v = 0; v < grid.voxels(); ++v) {
        if (s.object_of[v] != object) continue;
        const std::array<Index, 3> p = grid.voxel(v);
        for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis], p[axis]);
            box.high[axis] = std::max(box.high[axis], p[axis]);
        }
    }
    return box;
}

/// The outer contour first, then the cavities by their lowest voxel.
std::vector<Index> contours_in_order(const Snapshot& s, const Object& object, Index outer) {
    std::vector<Index> order = object.contours;
    const auto name = [&](Index c) { return c == outer ? -1 : s.lows[s.contours[c].low].lowest; };
    std::sort(order.begin(), order.end(), [&](Index p, Index q) { return name(p) < name(q); });
    return order;
}

void compare_contour(Difference& d, const Snapshot& s, Index contour, Index outer, Index object_name, const isoatlas::CutContour& actual) {
    const Contour& e = s.contours[contour];
    const bool is_outer = contour == outer;
    d.check("contour id", is_outer ? object_name : s.lows[e.low].lowest, actual.id).check("contour's object", object_name, actual.object);
    d.check("contour is outer", is_outer, actual.shell == isoatlas::Shell::outer);
    d.check("contour genus", e.genus, actual.genus).check("contour hits", e.hits, actual.hits);
}

std::vector<Index> objects_in_order(const Snapshot& s) {
    std::vector<Index> order;
    for (Index i = 0; i < static_cast<Index>(s.objects.size()); ++i) order.push_back(i);
    std::sort(order.begin(), order.end(), [&s](Index p, Index q) {
        const Object &a = s.objects[p], &b = s.objects[q];
        return a.voxels != b.voxels ? a.voxels > b.voxels : a.highest < b.highest;
    });
    return order;
}

}  // namespace

std::string compare_cut(const Elements& elements, double tau, const isoatlas::Cut& actual) {
    const Snapshot s = snapshot(elements, elements.cut_at(tau));
    const Outward outward = outward_contours(s);
    const std::vector<Index> order = objects_in_order(s);
    std::ostringstream where;
    where.precision(17);
    where << "cut at " << tau;
    Difference d(where.str());
    d.check("objects", s.objects.size(), actual.objects.size()).check("contours", s.contours.size(), actual.contours.size());
    d.check("active cells", s.active_cells, actual.active_cells).check("tau", tau, actual.tau);
    for (std::size_t i = 0; i < order.size() && d.text().empty(); ++i) {
        const Object& e = s.objects[order[i]];
        const isoatlas::CutObject& a = actual.objects[i];
        d.check("object", e.highest, a.id).check("chi", e.chi, a.chi).check("b1", e.b1, a.b1).check("b2", e.b2, a.b2);
        d.check("voxels", e.voxels, a.voxels).check("measure", static_cast<double>(e.voxels), a.measure);
        const Box box = box_of(elements.grid, s, order[i]);
        d.check("box", join(box.low) + join(box.high), join(a.box_low) + join(a.box_high));
        d.check("contours of the object", static_cast<Index>(e.contours.size()), a.contour_count);
        if (!d.text().empty()) break;
        const std::vector<Index> contours = contours_in_order(s, e, outward.of_object[order[i]]);
        for (std::size_t k = 0; k < contours.size(); ++k) {
            compare_contour(d, s, contours[k], outward.of_object[order[i]], e.highest,
                            actual.contours[static_cast<std::size_t>(a.first_contour) + k]);
        }
        for (std::size_t v = 0; v < actual.label.size(); ++v) {
            const Index label = s.object_of[v] == order[i] ? static_cast<Index>(i) : -1;
            if (label >= 0 || actual.label[v] == static_cast<Index>(i)) d.check("label", label, Index{actual.label[v]});
        }
    }
    return d.text();
}

}  // namespace oracle
