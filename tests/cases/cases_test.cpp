// Runs the named cases of tests/cases/*.txt (format: oracle/case_file.h) against the analysis, the cut and the oracle.
#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/bodies.h"
#include "oracle/case_file.h"
#include "oracle/compare.h"

namespace oracle {
namespace {

using isoatlas::Interpolant;

class Cases : public testing::TestWithParam<NamedCase> {};

struct Answers {
    Interpolant interpolant;
    Elements elements;
    isoatlas::Volume volume;
    isoatlas::Analysis analysis;
    Answers(const Grid& grid, Interpolant i)
        : interpolant(i),
          elements(elements_of(grid, i)),
          volume(to_volume(grid)),
          analysis(isoatlas::analyse(volume, {.interpolant = i})) {}
};

std::string kind_word(isoatlas::Criticality kind) {
    const std::string name = isoatlas::name_of(kind);
    return name.substr(0, name.find(' '));
}

Index count(const isoatlas::Analysis& analysis, const std::string& what) {
    if (what == "elements") return analysis.element_count();
    if (what == "levels") return analysis.level_count();
    if (what == "events") return analysis.event_count();
    Index maxima = 0;
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(analysis.event_count()))
        maxima += analysis.event(i).objects_in == 0 ? 1 : 0;
    return maxima;
}

bool has_level(const isoatlas::Analysis& analysis, const Expectation& e) {
    for (Index i = 0; i < analysis.level_count(); ++i) {
        const isoatlas::Level level = analysis.level(i);
        if (std::abs(level.value - e.value) < 1e-3 && level.in == e.first && level.out == e.second) return true;
    }
    return false;
}

bool has_event(const isoatlas::Analysis& analysis, const Expectation& e) {
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        const isoatlas::Event event = analysis.event(i);
        if (std::abs(event.value - e.value) < 1e-3 && kind_word(event.kind) == e.kind && event.delta_chi == e.first[0]) return true;
    }
    return false;
}

void check_cut(const Answers& answers, const Expectation& e) {
    const isoatlas::Cut cut = isoatlas::cut(answers.volume, e.value, {.interpolant = answers.interpolant});
    Index chi = 0;
    for (const isoatlas::CutObject& object : cut.objects) chi += object.chi;
    std::vector<Index> genera, tree_genera;
    for (const isoatlas::CutContour& contour : cut.contours) genera.push_back(contour.genus);
    for (Index i = 0; i < answers.analysis.contour_arc_count(); ++i) {
        const isoatlas::ContourArc arc = answers.analysis.contour_arc(i);
        if (arc.value_low < e.value && e.value <= arc.value_high) tree_genera.push_back(arc.genus);
    }
    std::sort(genera.begin(), genera.end());
    std::sort(tree_genera.begin(), tree_genera.end());
    EXPECT_EQ(static_cast<Index>(cut.objects.size()), e.first[0]) << "objects";
    EXPECT_EQ(chi, e.first[1]) << "chi";
    EXPECT_EQ(genera, e.second) << "genera of the cut";
    EXPECT_EQ(tree_genera, e.second) << "genera of the contour tree";
    EXPECT_EQ(compare_cut(answers.elements, e.value, cut), "");
}

void check_expectation(const Answers& answers, const Expectation& e) {
    if (e.what == "at") {
        check_cut(answers, e);
    } else if (e.what == "level") {
        EXPECT_TRUE(has_level(answers.analysis, e)) << canonical_text(answers.analysis);
    } else if (e.what == "event") {
        EXPECT_TRUE(has_event(answers.analysis, e)) << canonical_text(answers.analysis);
    } else {
        EXPECT_EQ(count(answers.analysis, e.what), static_cast<Index>(e.value)) << e.what;
    }
}

TEST_P(Cases, HaveTheirNumbers) {
    const NamedCase& c = GetParam();
    for (const Interpolant interpolant : {Interpolant::faces, Interpolant::trilinear}) {
        const Answers answers(c.grid, interpolant);
        for (const Expectation& e : c.expectations) {
            if (e.interpolant && *e.interpolant != interpolant) continue;
            SCOPED_TRACE(c.file + ":" + std::to_string(e.line) + ", " + isoatlas::name_of(interpolant));
            check_expectation(answers, e);
        }
        const Result expected = analyse(answers.elements);
        EXPECT_TRUE(expected.consistent);
        EXPECT_EQ(compare(expected, answers.analysis), "");
    }
}

std::string test_name(const testing::TestParamInfo<NamedCase>& info) {
    std::string name = info.param.name;
    std::replace_if(name.begin(), name.end(), [](unsigned char ch) { return std::isalnum(ch) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Table, Cases, testing::ValuesIn(read_cases(ISOATLAS_SOURCE_DIR "/tests/cases")), test_name);

}  // namespace
}  // namespace oracle
