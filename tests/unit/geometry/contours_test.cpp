// Contours of meshes made of boxes with integer corners, so that rays run through corners and along edges and faces of others.
#include "geometry/contours.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "unit/geometry/meshes.h"

namespace isoatlas {
namespace {

using Cell = std::array<int, 3>;

/// The closed surface of some unit cells, of which no two touch in an edge or a corner alone. Seen from outside counter-clockwise.
void add_cells(TestMesh& mesh, const std::set<Cell>& cells) {
    std::map<Cell, std::int64_t> points;
    const auto point = [&](const Cell& at) {
        const auto [found, is_new] = points.try_emplace(at, static_cast<std::int64_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back({double(at[0]), double(at[1]), double(at[2])});
        return found->second;
    };
    for (const Cell& cell : cells)
        for (int side = 0; side < 6; ++side) {
            const int axis = side % 3, up = side / 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
            Cell neighbour = cell;
            neighbour[axis] += 2 * up - 1;
            if (cells.count(neighbour) > 0) continue;
            std::array<std::int64_t, 4> corner{};
            for (int i = 0; i < 4; ++i) {
                Cell at = cell;
                at[axis] += up, at[u] += i == 1 || i == 2 ? 1 : 0, at[v] += i >= 2 ? 1 : 0;
                corner[i] = point(at);
            }
            if (up == 0) std::swap(corner[1], corner[3]);
            mesh.triangles.push_back({corner[0], corner[1], corner[2]});
            mesh.triangles.push_back({corner[0], corner[2], corner[3]});
        }
}

std::set<Cell> box(const Cell& low, const Cell& high) {
    std::set<Cell> cells;
    for (int x = low[0]; x < high[0]; ++x)
        for (int y = low[1]; y < high[1]; ++y)
            for (int z = low[2]; z < high[2]; ++z) cells.insert({x, y, z});
    return cells;
}

void add_box(TestMesh& mesh, const Cell& low, const Cell& high) { add_cells(mesh, box(low, high)); }

/// A frame around a hole.
void add_ring(TestMesh& mesh, const Cell& at) {
    std::set<Cell> cells = box(at, {at[0] + 3, at[1] + 3, at[2] + 1});
    cells.erase({at[0] + 1, at[1] + 1, at[2]});
    add_cells(mesh, cells);
}

/// Every triangle in four: other points and triangles, the same surface.
TestMesh quartered(const TestMesh& mesh) {
    TestMesh result{mesh.points, {}};
    std::map<std::array<std::int64_t, 2>, std::int64_t> middles;
    const auto middle = [&](std::int64_t a, std::int64_t b) {
        const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::int64_t>(result.points.size()));
        const Vec3 p = mesh.points[a], q = mesh.points[b];
        if (is_new) result.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
        return found->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::int64_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const TriangleCorners& t : {TriangleCorners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) result.triangles.push_back(t);
    }
    return result;
}

/// The same contours in the reverse order of points and triangles, moved.
TestMesh reversed(const TestMesh& mesh, double shift) {
    TestMesh result;
    const auto last = static_cast<std::int64_t>(mesh.points.size()) - 1;
    for (auto p = mesh.points.rbegin(); p != mesh.points.rend(); ++p) result.points.push_back({(*p)[0] + shift, (*p)[1], (*p)[2] - shift});
    for (auto t = mesh.triangles.rbegin(); t != mesh.triangles.rend(); ++t)
        result.triangles.push_back({last - (*t)[0], last - (*t)[1], last - (*t)[2]});
    return result;
}

TEST(Contours, HaveTheirGenusAndRims) {
    TestMesh mesh;
    mesh.points.push_back({9, 9, 9});  // no triangle uses it
    add_box(mesh, {0, 0, 0}, {2, 3, 4});
    add_ring(mesh, {10, 0, 0});
    const TestMesh sheet_points = sheet(3, [](double, double) { return -5.0; });
    const auto first = static_cast<std::int64_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), sheet_points.points.begin(), sheet_points.points.end());
    for (const TriangleCorners& t : sheet_points.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const MeshContours contours = find_contours(mesh.view());
    ASSERT_EQ(contours.list.size(), 3);
    EXPECT_EQ(contours.contour_of[0], -1);
    EXPECT_EQ(contours.list[0].first_point, 1);
    EXPECT_EQ(contours.list[0].triangles, 2 * 2 * (2 * 3 + 3 * 4 + 4 * 2));
    EXPECT_EQ(contours.list[0].genus(), 0);
    EXPECT_EQ(contours.list[1].genus(), 1);
    EXPECT_EQ(contours.list[2].genus(), 0);
    EXPECT_EQ(contours.list[2].rims, 1);
    EXPECT_FALSE(contours.all_closed());
    EXPECT_EQ(contours.genus(), 1);
}

TEST(Contours, AreEnclosedAsBoxesAre) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> size(1, 6), place(0, 20);
    int nested = 0;
    for (int round = 0; round < 60; ++round) {
        TestMesh mesh;
        std::vector<std::array<Cell, 2>> boxes;
        const auto apart_or_inside = [&](const std::array<Cell, 2>& a, const std::array<Cell, 2>& b) {
            bool apart = false, a_in_b = true, b_in_a = true;
            for (int i = 0; i < 3; ++i) {
                apart = apart || a[1][i] < b[0][i] || b[1][i] < a[0][i];
                a_in_b = a_in_b && b[0][i] < a[0][i] && a[1][i] < b[1][i];
                b_in_a = b_in_a && a[0][i] < b[0][i] && b[1][i] < a[1][i];
            }
            return apart || a_in_b || b_in_a;
        };
        for (int attempt = 0; attempt < 60; ++attempt) {
            const Cell low{place(random), place(random), place(random)};
            const int edge = attempt < 20 ? 3 * size(random) : size(random);
            const std::array<Cell, 2> box{low, {low[0] + edge, low[1] + edge, low[2] + edge}};
            if (!std::ranges::all_of(boxes, [&](const auto& other) { return apart_or_inside(box, other); })) continue;
            boxes.push_back(box);
            add_box(mesh, box[0], box[1]);
        }
        const auto enclosing = find_enclosing(mesh.view(), find_contours(mesh.view()), {.threads = 1 + round % 3});
        ASSERT_EQ(enclosing.size(), boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            std::vector<std::int64_t> expected;
            for (std::size_t j = 0; j < boxes.size(); ++j)
                if (boxes[j][0][0] < boxes[i][0][0] && boxes[i][0][0] < boxes[j][1][0] && boxes[j][0][1] < boxes[i][0][1] &&
                    boxes[i][0][1] < boxes[j][1][1] && boxes[j][0][2] < boxes[i][0][2] && boxes[i][0][2] < boxes[j][1][2])
                    expected.push_back(static_cast<std::int64_t>(j));
            ASSERT_EQ(enclosing[i], expected);
            nested += expected.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(nested, 100);
}

/// Two nested boxes, one beside them, a ring.
TestMesh scene() {
    TestMesh mesh;
    add_box(mesh, {0, 0, 0}, {8, 8, 8});
    add_box(mesh, {2, 2, 2}, {4, 4, 4});
    add_box(mesh, {10, 0, 0}, {12, 2, 2});
    add_ring(mesh, {20, 0, 0});
    return mesh;
}

TEST(MatchedContours, AreThoseOfTheSameSurface) {
    const TestMesh mesh = scene();
    for (const TestMesh& other : {mesh, quartered(mesh), reversed(mesh, 0), reversed(mesh, 0.25), reversed(quartered(mesh), 0.25)}) {
        const ContourMatch match = match_contours(mesh.view(), other.view());
        EXPECT_TRUE(match.is_same()) << match.unmatched << match.other_genus << match.other_nesting;
        EXPECT_TRUE(match_contours(other.view(), mesh.view()).is_same());
        std::set<std::int64_t> partners(match.partner.begin(), match.partner.end());
        EXPECT_EQ(partners, (std::set<std::int64_t>{0, 1, 2, 3}));
    }
}

TEST(MatchedContours, LackOneThatIsGone) {
    TestMesh mesh;
    add_box(mesh, {0, 0, 0}, {8, 8, 8});
    add_box(mesh, {10, 0, 0}, {12, 2, 2});
    add_ring(mesh, {20, 0, 0});
    const TestMesh whole = scene();
    const ContourMatch gone = match_contours(whole.view(), mesh.view());
    EXPECT_EQ(gone.unmatched, "the mesh has none for the contour at (2, 2, 2) of 48 triangles");
    EXPECT_EQ(gone.partner[1], -1);
    const ContourMatch more = match_contours(mesh.view(), whole.view());
    EXPECT_EQ(more.unmatched, "the exact surface has none for the mesh's contour at (2, 2, 2) of 48 triangles");
}

TEST(MatchedContours, AreOfTheSameGenus) {
    TestMesh filled;
    add_box(filled, {20, 0, 0}, {23, 3, 1});
    TestMesh ring;
    add_ring(ring, {20, 0, 0});
    const ContourMatch match = match_contours(ring.view(), filled.view());
    EXPECT_TRUE(match.unmatched.empty());
    EXPECT_EQ(match.other_genus, "contour at (20, 0, 0) of 64 triangles has genus 1, in the mesh genus 0");
}

TEST(MatchedContours, AreNestedAlike) {
    TestMesh inside, outside;  // in the other, the outer one has a dent, open to a side, in which the inner one lies
    add_box(inside, {0, 0, 0}, {8, 8, 8});
    add_box(inside, {2, 2, 2}, {4, 4, 4});
    std::set<Cell> dented = box({0, 0, 0}, {8, 8, 8});
    for (const Cell& cell : box({1, 1, 1}, {8, 5, 5})) dented.erase(cell);
    add_cells(outside, dented);
    add_box(outside, {2, 2, 2}, {4, 4, 4});
    const ContourMatch match = match_contours(inside.view(), outside.view());
    EXPECT_TRUE(match.unmatched.empty());
    EXPECT_EQ(match.other_nesting, "contour at (2, 2, 2) of 48 triangles lies inside 1 of the others, in the mesh inside 0");
}

TEST(MatchedContours, OfNothingAreNone) {
    EXPECT_TRUE(match_contours(MeshView{}, MeshView{}).is_same());
    const TestMesh mesh = scene();
    EXPECT_FALSE(match_contours(mesh.view(), MeshView{}).is_same());
    EXPECT_FALSE(match_contours(MeshView{}, mesh.view()).is_same());
}

}  // namespace
}  // namespace isoatlas
