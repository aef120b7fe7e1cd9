#include "formats/common/xml_skeleton.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr std::size_t kMaxTags = std::size_t{16} << 20;
constexpr std::size_t kXmlBytes = std::size_t{1} << 18;

/// Sequential characters of a file, with a fast search.
class Characters {
public:
    Characters(std::unique_ptr<File> file, const std::string& path) : path_(path), file_(std::move(file)), buffer_(kXmlBytes) {}

    /// The next character, or nullopt at the end of the file.
    [[nodiscard]] std::optional<char> next() {
        if (cursor_ == filled_ && !fill()) return std::nullopt;
        return static_cast<char>(buffer_[cursor_++]);
    }
    /// Advances past the next such character; false: there is none.
    [[nodiscard]] bool skip_behind(char wanted) {
        while (cursor_ < filled_ || fill()) {
            const auto begin = buffer_.begin() + static_cast<std::ptrdiff_t>(cursor_),
                       end = buffer_.begin() + static_cast<std::ptrdiff_t>(filled_);
            const auto found = std::find(begin, end, static_cast<std::byte>(wanted));
            cursor_ = static_cast<std::size_t>(found - buffer_.begin());
            if (found == end) continue;
            ++cursor_;
            return true;
        }
        return false;
    }
    [[nodiscard]] std::int64_t offset() const { return start_ + static_cast<std::int64_t>(cursor_); }

private:
    bool fill() {
        start_ += static_cast<std::int64_t>(filled_);
        cursor_ = 0;
        filled_ = read_available(*file_, path_, start_, buffer_);
        return filled_ > 0;
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::vector<std::byte> buffer_;
    std::int64_t start_ = 0;  ///< offset of the buffer in the file
    std::size_t filled_ = 0, cursor_ = 0;
};

class Scanner {
public:
    Scanner(std::unique_ptr<File> file, const std::string& path) : path_(path), characters_(std::move(file), path) {}

    XmlSkeleton scan() {
        while (true) {
            const std::int64_t text_begin = characters_.offset();
            const bool found = characters_.skip_behind('<');
            close_pending(text_begin, found ? characters_.offset() - 1 : -1);
            if (!found) return std::move(skeleton_);
            if (!read_tag()) continue;
            if (!is_element("AppendedData")) {
                keep_tag();
                continue;
            }
            keep_appended();
            return std::move(skeleton_);
        }
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = "offset " + std::to_string(characters_.offset()),
                                       .what = what,
                                       .expected = expected,
                                       .next = "the file is damaged or truncated: get it again"});
    }

    /// Reads the tag after a '<' into tag_, without '<' and '>'. False: a comment or instruction, skipped.
    bool read_tag() {
        tag_.clear();
        char quote = 0;
        while (const std::optional<char> c = characters_.next()) {
            if (quote == 0 && *c == '>' && !is_open_comment()) return !tag_.starts_with('!') && !tag_.starts_with('?');
            if (*c == quote) {
                quote = 0;
            } else if (quote == 0 && (*c == '"' || *c == '\'') && !tag_.starts_with('!')) {
                quote = *c;
            }
            tag_ += *c;
            if (tag_.size() + skeleton_.text.size() > kMaxTags) fail("its tags are larger than 16 MiB", "a VTK XML file");
        }
        fail("the file ends inside a tag", "'>'");
    }
    [[nodiscard]] bool is_open_comment() const { return tag_.starts_with("!--") && (tag_.size() < 5 || !tag_.ends_with("--")); }
    [[nodiscard]] bool is_element(std::string_view name) const {
        if (!tag_.starts_with(name)) return false;
        return tag_.size() == name.size() || std::string_view(" \t\r\n/").find(tag_[name.size()]) != std::string_view::npos;
    }

    void keep_tag() {
        if (is_element("DataArray") && !tag_.ends_with('/')) {
            pending_ = tag_;  // the end of its content is known at the next tag
            return;
        }
        skeleton_.text += "<" + tag_ + ">";
    }
    void close_pending(std::int64_t begin, std::int64_t end) {
        if (pending_.empty()) return;
        if (end < 0) fail("the file ends inside a data array", "</DataArray>");
        const std::size_t name = std::string_view("DataArray").size();
        // Our attributes come first: one of the same name in the file is ignored.
        skeleton_.text += "<" + pending_.substr(0, name) + " " + kContentBegin + "=\"" + std::to_string(begin) + "\" " + kContentEnd +
                          "=\"" + std::to_string(end) + "\"" + pending_.substr(name) + ">";
        pending_.clear();
    }
    /// Binary data follow: closes the section and the document.
    void keep_appended() {
        const bool empty = tag_.ends_with('/');
        skeleton_.text += "<" + tag_ + (empty ? ">" : "/>") + "</VTKFile>";
        if (empty) return;
        while (const std::optional<char> c = characters_.next()) {
            if (*c == '_') {
                skeleton_.appended = characters_.offset();
                return;
            }
            if (*c != ' ' && *c != '\t' && *c != '\r' && *c != '\n') break;
        }
        fail("the appended data do not start with '_'", "'_'");
    }

    std::string path_;
    Characters characters_;
    XmlSkeleton skeleton_;
    std::string tag_, pending_;
};

}  // namespace

XmlSkeleton read_xml_skeleton(std::unique_ptr<File> file, const std::string& path) { return Scanner(std::move(file), path).scan(); }

}  // namespace isoatlas
