#include "oracle/case_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace oracle {
namespace {

class Reader {
public:
    explicit Reader(std::string file) : file_(std::move(file)) {}

    void read(std::vector<NamedCase>& cases) {
        std::ifstream in(file_);
        std::string text;
        while (std::getline(in, text)) {
            ++line_;
            std::istringstream words(text.substr(0, text.find('#')));
            std::string word;
            if (!(words >> word)) continue;
            if (word == "case") {
                if (!cases.empty()) finish(cases.back());
                cases.emplace_back();
                cases.back().file = std::filesystem::path(file_).filename().string();
                cases.back().line = line_;
                dims_.clear(), border_.clear();
                if (!(words >> cases.back().name)) fail("a case needs a name");
            } else {
                if (cases.empty()) fail("'" + word + "' before the first case");
                directive(cases.back(), word, words);
            }
            if (words.clear(), words >> word) fail("'" + word + "' is too much");
        }
        if (!cases.empty()) finish(cases.back());
    }

private:
    std::string file_;
    int line_ = 0;
    std::vector<Index> dims_;
    std::vector<double> border_;

    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(file_ + ":" + std::to_string(line_) + ": " + what); }

    template <class T>
    std::vector<T> numbers(std::istringstream& words) const {
        std::vector<T> list;
        for (T x{}; words >> x;) list.push_back(x);
        words.clear();
        return list;
    }
    template <class T>
    T number(std::istringstream& words) const {
        T x{};
        if (!(words >> x)) fail("a number is missing");
        return x;
    }
    void expect_word(std::istringstream& words, const std::string& expected) const {
        std::string word;
        words >> word;
        if (word != expected) fail("'" + expected + "' expected, not '" + word + "'");
    }

    void directive(NamedCase& c, std::string word, std::istringstream& words) {
        const std::set<std::string> counts{"elements", "levels", "events", "maxima"};
        Expectation e;
        if (word == "faces" || word == "trilinear") {
            e.interpolant = word == "faces" ? isoatlas::Interpolant::faces : isoatlas::Interpolant::trilinear;
            words >> word;
        }
        e.what = word;
        e.line = line_;
        if (word == "dims") {
            dims_ = numbers<Index>(words);
            if (dims_.size() < 2 || dims_.size() > 3) fail("two or three dims expected");
            c.grid.rank = static_cast<int>(dims_.size());
            std::copy(dims_.begin(), dims_.end(), c.grid.size.begin());
            return;
        }
        if (word == "values") {
            const std::vector<double> more = numbers<double>(words);
            c.grid.value.insert(c.grid.value.end(), more.begin(), more.end());
            return;
        }
        if (word == "border") {
            border_ = numbers<double>(words);
            return;
        }
        if (counts.count(word) != 0) {
            e.value = number<double>(words);
        } else if (word == "level") {
            e.value = number<double>(words);
            expect_word(words, "in");
            e.first = numbers<Index>(words);
            expect_word(words, "out");
            e.second = numbers<Index>(words);
        } else if (word == "event") {
            e.value = number<double>(words);
            words >> e.kind;
            e.first = {number<Index>(words)};
        } else if (word == "at") {
            e.value = number<double>(words);
            expect_word(words, "objects");
            e.first.push_back(number<Index>(words));
            expect_word(words, "chi");
            e.first.push_back(number<Index>(words));
            expect_word(words, "genera");
            e.second = numbers<Index>(words);
        } else {
            fail("'" + word + "' is no directive");
        }
        c.expectations.push_back(e);
    }

    void finish(NamedCase& c) {
        if (dims_.empty()) return;  // finished before
        dims_.clear();
        if (static_cast<Index>(c.grid.value.size()) != c.grid.voxels())
            fail("case " + c.name + ": the number of values does not match dims");
        if (c.expectations.empty()) fail("case " + c.name + " expects nothing");
        if (border_.empty()) return;
        Grid wide{c.grid.rank, c.grid.size, {}};
        for (int axis = 0; axis < c.grid.rank; ++axis) wide.size[axis] += 2;
        wide.value.assign(static_cast<std::size_t>(wide.voxels()), border_.front());
        for (Index v = 0; v < c.grid.voxels(); ++v) {
            const std::array<Index, 3> p = c.grid.voxel(v);
            wide.value[wide.index(p[0] + 1, p[1] + 1, c.grid.rank == 3 ? p[2] + 1 : 0)] = c.grid.value[v];
        }
        c.grid = wide;
        border_.clear();
    }
};

}  // namespace

std::vector<NamedCase> read_cases(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".txt") files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    std::vector<NamedCase> cases;
    for (const std::string& file : files) Reader(file).read(cases);
    return cases;
}

}  // namespace oracle
