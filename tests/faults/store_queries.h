// Everything that a store can be asked, with answers as bytes that can be compared.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/atlas.h"
#include "store/contents.h"

namespace isoatlas::test {

struct Query {
    const char* name;
    std::function<std::string(const Atlas&)> ask;
};

/// Bytes of numbers, one behind the other.
class AnswerBytes {
public:
    template <class N, class Memory>
    AnswerBytes& add(const std::vector<N, Memory>& numbers) {
        return add_bytes(std::as_bytes(std::span<const N>(numbers)));
    }
    template <class... N>
    AnswerBytes& add_numbers(const N&... numbers) {
        (add_bytes(std::as_bytes(std::span<const N, 1>(&numbers, 1))), ...);
        return *this;
    }
    AnswerBytes& add_bytes(std::span<const std::byte> bytes) {
        text_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size()) += '|';
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

inline std::string bytes_of_cut(const Cut& cut) {
    AnswerBytes answer;
    answer.add_numbers(cut.tau, cut.tunnel_height, cut.active_cells).add(cut.label);
    for (const CutObject& o : cut.objects)
        answer.add_numbers(o.id, o.chi, o.b1, o.b2, o.voxels, o.measure, o.box_low, o.box_high, o.first_contour, o.contour_count);
    for (const CutContour& c : cut.contours) answer.add_numbers(c.id, c.object, c.shell, c.genus, c.hits);
    return answer.text();
}

inline std::string bytes_of_surface(const Surface& s) {
    AnswerBytes answer;
    answer.add(s.points).add(s.normals).add(s.triangles).add(s.segments).add(s.object).add(s.contour);
    answer.add_numbers(s.tau, s.reported_tau, s.closed, s.interpolant, s.tunnel_height, s.reported_tunnel_height);
    return answer.text() + s.space + s.unit;
}

inline std::string bytes_of_analysis(const Analysis& analysis) {
    AnswerBytes answer;
    answer.add_numbers(analysis.interpolant(), analysis.tunnel_height());
    for (const ElementId i : ids<ElementId>(analysis.element_count())) {
        const Element e = analysis.element(i);
        answer.add_numbers(e.value, e.position, e.h0, e.l0, e.kind);
    }
    for (std::int64_t i = 0; i < analysis.contour_arc_count(); ++i) {
        const ContourArc a = analysis.contour_arc(i);
        answer.add_numbers(a.upper, a.lower, a.value_high, a.value_low, a.genus);
    }
    for (std::int64_t i = 0; i < analysis.level_count(); ++i) {
        const Level l = analysis.level(i);
        answer.add_numbers(l.value, l.event).add(l.in).add(l.out);
    }
    for (const EventId i : ids<EventId>(analysis.event_count())) {
        const Event e = analysis.event(i);
        answer.add_numbers(e.value, e.position, e.kind, e.parent, e.objects_in, e.lows_out, e.delta_chi, e.chi, e.b1, e.b2, e.contours);
        answer.add_numbers(e.zone.tau_low, e.zone.tau_high, e.zone.voxels, e.object_voxels);
    }
    return answer.text();
}

/// The queries, for isovalue tau and the object that contains a voxel.
inline std::vector<Query> queries(double tau, std::int64_t voxel) {
    Context context;
    context.threads = 1;
    SurfaceOptions one;
    one.objects = {voxel};
    return {{"what is in it",
             [](const Atlas& atlas) {
                 Contents contents;
                 contents.volume = atlas.info();
                 return to_json(contents) + AnswerBytes().add_numbers(atlas.range(), atlas.file_bytes(), atlas.tunnel_height()).text();
             }},
            {"cut", [=](const Atlas& atlas) { return bytes_of_cut(atlas.cut(tau, {.label = true}, context)); }},
            {"surface", [=](const Atlas& atlas) { return bytes_of_surface(atlas.extract(tau, {}, context)); }},
            {"one object", [=](const Atlas& atlas) { return bytes_of_surface(atlas.extract(tau, one, context)); }},
            {"trees", [](const Atlas& atlas) { return bytes_of_analysis(atlas.analysis()); }},
            {"samples",
             [=](const Atlas& atlas) {
                 const Volume volume = atlas.volume(context);
                 return AnswerBytes().add(std::vector<std::byte>(volume.bytes.begin(), volume.bytes.end())).text();
             }},
            {"check", [=](const Atlas& atlas) {
                 atlas.check(context);
                 return std::string("sound");
             }}};
}

}  // namespace isoatlas::test
