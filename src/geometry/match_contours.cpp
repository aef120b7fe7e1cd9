#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "base/cancel.h"
#include "base/parallel.h"
#include "geometry/contours.h"

namespace isoatlas {
namespace {

/// The contours that the points of one contour lie on, and nearest to.
struct Votes {
    std::map<std::int64_t, std::int64_t> on, nearest;

    [[nodiscard]] std::int64_t winner() const {
        const std::map<std::int64_t, std::int64_t>& votes = on.empty() ? nearest : on;
        const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
        return most == votes.end() ? -1 : most->first;
    }
};

/// For each contour of a mesh, that of the other mesh which its points choose.
std::vector<std::int64_t> chosen_contours(const MeshView& mesh, const MeshContours& contours, const MeshView& other,
                                          const MeshContours& of_other, const Context& context) {
    std::vector<Votes> votes(contours.list.size());
    const TriangleTree tree(other.points, other.triangles, context.threads);
    BigVector<NearTriangle> near(mesh.points.size());
    constexpr std::size_t kPointsOfABlock = 4096;
    const CallerLooks stop(context);
    for_each_block(context.threads, static_cast<std::int64_t>((near.size() + kPointsOfABlock - 1) / kPointsOfABlock),
                   [&](std::int64_t block) {
                       stop();
                       std::int64_t guess = -1;
                       const std::size_t begin = static_cast<std::size_t>(block) * kPointsOfABlock;
                       for (std::size_t i = begin; i < std::min(begin + kPointsOfABlock, near.size()); ++i) {
                           if (contours.contour_of[i] < 0) continue;
                           const Vec3& p = mesh.points[i];
                           near[i] = guess < 0 ? tree.nearest(p) : tree.nearest(p, tree.near(p, guess));
                           guess = near[i].triangle;
                       }
                   });
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (contours.contour_of[i] < 0 || near[i].triangle < 0) continue;
        const std::int64_t corner = other.triangles[static_cast<std::size_t>(near[i].triangle)][0];
        Votes& of_contour = votes[static_cast<std::size_t>(contours.contour_of[i])];
        ++(near[i].nearest.squared_distance == 0 ? of_contour.on
                                                 : of_contour.nearest)[of_other.contour_of[static_cast<std::size_t>(corner)]];
    }
    std::vector<std::int64_t> chosen(votes.size());
    std::transform(votes.begin(), votes.end(), chosen.begin(), [](const Votes& of_contour) { return of_contour.winner(); });
    return chosen;
}

std::string digits(double value) {
    std::array<char, 32> buffer{};
    constexpr int kDigits = 7;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, kDigits).ptr};
}

std::string text(const MeshContour& contour, const MeshView& mesh) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(contour.first_point)];
    return "contour at (" + digits(p[0]) + ", " + digits(p[1]) + ", " + digits(p[2]) + ") of " + std::to_string(contour.triangles) +
           " triangles";
}

std::string genus_text(const MeshContour& contour) {
    const std::string rims = contour.rims == 0 ? "" : " and " + std::to_string(contour.rims) + " rims";
    return (contour.chi + contour.rims) % 2 == 0 ? "genus " + std::to_string(contour.genus()) + rims
                                                 : "Euler number " + std::to_string(contour.chi) + rims;
}

void find_partners(ContourMatch& match, const MeshView& surface, const MeshView& mesh, const Context& context) {
    match.partner = chosen_contours(surface, match.surface, mesh, match.mesh, context);
    const std::vector<std::int64_t> back = chosen_contours(mesh, match.mesh, surface, match.surface, context);
    std::vector<bool> has_partner(back.size());
    for (std::size_t i = 0; i < match.partner.size(); ++i) {
        std::int64_t& partner = match.partner[i];
        if (partner >= 0 && back[static_cast<std::size_t>(partner)] == static_cast<std::int64_t>(i)) {
            has_partner[static_cast<std::size_t>(partner)] = true;
            continue;
        }
        partner = -1;
        if (match.unmatched.empty()) match.unmatched = "the mesh has none for the " + text(match.surface.list[i], surface);
    }
    for (std::size_t i = 0; i < has_partner.size() && match.unmatched.empty(); ++i)
        if (!has_partner[i]) match.unmatched = "the exact surface has none for the mesh's " + text(match.mesh.list[i], mesh);
}

void compare_genus(ContourMatch& match, const MeshView& surface) {
    for (std::size_t i = 0; i < match.partner.size(); ++i) {
        const MeshContour &exact = match.surface.list[i], &found = match.mesh.list[static_cast<std::size_t>(match.partner[i])];
        if (exact.chi == found.chi && exact.rims == found.rims) continue;
        match.other_genus = text(exact, surface) + " has " + genus_text(exact) + ", in the mesh " + genus_text(found);
        return;
    }
}

void compare_nesting(ContourMatch& match, const MeshView& surface, const MeshView& mesh, const Context& context) {
    const auto exact = find_enclosing(surface, match.surface, context), found = find_enclosing(mesh, match.mesh, context);
    for (std::size_t i = 0; i < exact.size(); ++i) {
        std::vector<std::int64_t> expected;
        for (const std::int64_t contour : exact[i]) expected.push_back(match.partner[static_cast<std::size_t>(contour)]);
        std::sort(expected.begin(), expected.end());
        const std::vector<std::int64_t>& is = found[static_cast<std::size_t>(match.partner[i])];
        if (expected == is) continue;
        match.other_nesting = text(match.surface.list[i], surface) + " lies inside " + std::to_string(expected.size()) +
                              " of the others, in the mesh inside " + std::to_string(is.size());
        if (expected.size() == is.size()) match.other_nesting += " that are not the same";
        return;
    }
}

}  // namespace

ContourMatch match_contours(const MeshView& surface, const MeshView& mesh, const Context& context) {
    ContourMatch match{find_contours(surface, context), find_contours(mesh, context)};
    find_partners(match, surface, mesh, context);
    if (!match.unmatched.empty()) return match;
    compare_genus(match, surface);
    if (match.surface.all_closed() && match.mesh.all_closed()) compare_nesting(match, surface, mesh, context);
    return match;
}

}  // namespace isoatlas
