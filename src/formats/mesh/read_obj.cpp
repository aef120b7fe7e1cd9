// OBJ (Wavefront): points and faces with all forms of indices; everything else of the format is skipped.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "formats/common/byte_cursor.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

constexpr std::int64_t kNoObject = std::numeric_limits<std::int64_t>::min();

/// Statements that do not change points and faces. Anything else is not an OBJ file.
constexpr std::array kSkipped{"vt",   "vn",     "vp",  "g",    "s",    "mg",        "usemtl",   "mtllib",   "usemap", "maplib",
                              "p",    "cstype", "deg", "bmat", "step", "curv",      "curv2",    "surf",     "parm",   "trim",
                              "hole", "scrv",   "sp",  "end",  "con",  "bevel",     "c_interp", "d_interp", "lod",    "shadow_obj",
                              "bsp",  "bzp",    "cdc", "cdp",  "res",  "trace_obj", "ctech",    "stech",    "call",   "csh"};

class ObjParser {
public:
    ObjParser(std::string_view bytes, const std::string& file) : in_(bytes, file) {}

    Mesh parse() {
        while (in_.left() > 0) parse_statement(next_statement());
        keep_object_ids();
        check_mesh(mesh_, in_.file());
        return std::move(mesh_);
    }

private:
    /// A line without its comment, with the lines joined that a backslash continues.
    std::string_view next_statement() {
        std::string_view line = in_.line();
        if (line.starts_with('#')) take_comment(mesh_, line.substr(1));
        if (line.empty() || line.back() != '\\') return line.substr(0, line.find('#'));
        joined_.clear();
        while (!line.empty() && line.back() == '\\') {
            joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
            line = in_.line();
        }
        joined_.append(line);
        return std::string_view(joined_).substr(0, joined_.find('#'));
    }
    void parse_statement(std::string_view line) {
        const std::string_view keyword = take_word(line);
        if (keyword.empty()) return;
        if (keyword == "v") {
            parse_point(line);
        } else if (keyword == "f" || keyword == "fo") {
            parse_cell(line, 3);
        } else if (keyword == "l") {
            parse_cell(line, 2);
        } else if (keyword == "o") {
            parse_object(take_word(line));
        } else if (std::none_of(kSkipped.begin(), kSkipped.end(), [&](const char* known) { return keyword == known; })) {
            in_.fail_at_line(in_quotes(keyword) + " is not a statement of OBJ");
        }
    }
    void parse_point(std::string_view line) {
        std::array<double, 3> point{};
        for (double& x : point) {
            const std::string_view word = take_word(line);
            if (!parse_number(word, x))
                in_.fail_at_line(word.empty() ? "a point with fewer than 3 coordinates" : in_quotes(word) + " is not a number");
        }
        mesh_.points.push_back(point);
    }
    /// Indices: 7, 7/1, 7/1/3, 7//3; negative ones count back from the last point.
    std::int64_t parse_corner(std::string_view word) {
        std::int64_t index = 0;
        if (!parse_number(word.substr(0, word.find('/')), index) || index == 0)
            in_.fail_at_line(in_quotes(word) + " is not a point number");
        const auto points = static_cast<std::int64_t>(mesh_.points.size());
        if (index < -points) in_.fail_at_line(in_quotes(word) + " counts back beyond the first point");
        return index > 0 ? index - 1 : points + index;
    }
    void parse_cell(std::string_view line, std::size_t min) {
        corners_.clear();
        for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) corners_.push_back(parse_corner(word));
        if (corners_.size() < min) in_.fail_at_line("a face or line with " + std::to_string(corners_.size()) + " points");
        if (min == 3) add_polygon(mesh_, corners_);
        for (const std::int64_t p : corners_) mark(p);
    }
    void parse_object(std::string_view name) {
        constexpr std::string_view kPrefix = "object_";
        object_ = kNoObject;
        if (name.starts_with(kPrefix) && !parse_number(name.substr(kPrefix.size()), object_)) object_ = kNoObject;
    }
    /// Records the object of a point; if a point has two objects or none, the file has no object ids.
    void mark(std::int64_t point) {
        if (!ids_are_clear_) return;
        if (object_ == kNoObject || point >= static_cast<std::int64_t>(mesh_.points.size())) {
            ids_are_clear_ = false;
            return;
        }
        if (mesh_.object.size() <= static_cast<std::size_t>(point)) mesh_.object.resize(mesh_.points.size(), kNoObject);
        std::int64_t& object = mesh_.object[static_cast<std::size_t>(point)];
        if (object != kNoObject && object != object_) ids_are_clear_ = false;
        object = object_;
    }
    void keep_object_ids() {
        mesh_.object.resize(mesh_.points.size(), kNoObject);
        const bool complete = std::find(mesh_.object.begin(), mesh_.object.end(), kNoObject) == mesh_.object.end();
        if (!ids_are_clear_ || !complete) mesh_.object.clear();
    }

    ByteCursor in_;
    Mesh mesh_;
    std::vector<std::int64_t> corners_;
    std::string joined_;
    std::int64_t object_ = kNoObject;
    bool ids_are_clear_ = true;
};

}  // namespace

Mesh parse_obj(std::string_view bytes, const std::string& file) { return ObjParser(bytes, file).parse(); }

}  // namespace isoatlas
