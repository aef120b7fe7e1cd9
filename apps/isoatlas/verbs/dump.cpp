// isoatlas dump: any part of a store as stored in the file.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "options/suggest.h"
#include "text/document.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// The numbers of a part, read in pieces.
class Numbers {
    static constexpr std::int64_t kStretch = 1 << 16;

    template <class Function>
    auto visit(std::int64_t i, const Function& function) {
        if (i < first_ || i >= end_) {
            first_ = i, end_ = std::min(i + kStretch, part_.end);
            numbers_ = store_.read(part_, first_, end_);
        }
        return std::visit([&](const auto& numbers) { return function(numbers[static_cast<std::size_t>(i - first_)]); }, numbers_);
    }

public:
    Numbers(const StoreDump& store, const StorePart& part) : store_(store), part_(part) {}
    /// Reads all of them first, so that nothing of a damaged part is printed.
    void check() {
        for (std::int64_t i = part_.first; i < part_.end; i += kStretch) (void)json(i);
    }
    [[nodiscard]] Json json(std::int64_t i) {
        return visit(i, [](auto number) -> Json { return number; });
    }
    [[nodiscard]] std::string text(std::int64_t i) {
        return visit(i, [this](auto number) -> std::string {
            return part_.type == "float32" ? fmt::format("{}", static_cast<float>(number)) : fmt::format("{}", number);
        });
    }

private:
    const StoreDump& store_;
    const StorePart& part_;
    StoreNumbers numbers_;
    std::int64_t first_ = 0, end_ = 0;
};

Json json_of(const StorePart& part) {
    Json json{{"name", part.name}, {"type", part.type}, {"shape", part.shape}, {"offset", part.offset}, {"bytes", part.bytes}};
    if (part.compressed) json["compressed"] = true;
    if (part.kind == StorePart::Kind::brick) json["first_voxel"] = part.first_voxel;
    return json;
}

Json head(const Arguments& arguments) {
    Json json = document("dump");
    json["file"] = arguments.file;
    return json;
}

void list_parts(const Arguments& arguments, const StoreDump& store, Terminal& terminal) {
    const std::vector<StorePart> parts = store.parts();
    if (arguments.json) {
        print(terminal, head(arguments), "parts", static_cast<std::int64_t>(parts.size()),
              [&](std::int64_t i) { return json_of(parts[static_cast<std::size_t>(i)]); });
        return;
    }
    Table table({{"part", true}, {"type", true}, {"shape"}, {"offset"}, {"bytes"}});
    for (const StorePart& part : parts) {
        table.add({part.name, part.type + (part.compressed ? ", compressed" : ""), fmt::format("{}", fmt::join(part.shape, " x ")),
                   count_text(part.offset), count_text(part.bytes)});
    }
    table.print(terminal);
    terminal.next("isoatlas dump " + shell_word(arguments.file) + " contents; the bricks of the volume are: brick N, voxel X,Y,Z");
}

void print_array(const StorePart& part, Numbers& numbers, Terminal& terminal) {
    const auto width = static_cast<int>(std::to_string(part.end).size());
    for (std::int64_t i = part.first; i < part.end; ++i) terminal.out() << fmt::format("{:>{}}  {}\n", i, width, numbers.text(i));
}

/// One line of samples a row, one paragraph a slice.
void print_brick(const StorePart& part, Numbers& numbers, Terminal& terminal) {
    const auto& [x, y, z] = part.first_voxel;
    terminal.out() << fmt::format("{}: {}, voxels from {},{},{}, {} bytes at {}\n", part.name, part.type, x, y, z, part.bytes, part.offset);
    const std::int64_t row = part.shape[2], slice = part.shape[1] * row;
    for (std::int64_t i = 0; i < part.end; ++i) {
        if (i % slice == 0) terminal.out() << fmt::format("z = {}\n", z + i / slice);
        terminal.out() << numbers.text(i) << (i % row == row - 1 ? '\n' : ' ');
    }
}

}  // namespace

int run_dump(const Arguments& arguments, Terminal& terminal) {
    const StoreDump store(arguments.file);
    if (arguments.part.empty()) {
        list_parts(arguments, store, terminal);
        return 0;
    }
    const StorePart part = store.find(fmt::format("{}", fmt::join(arguments.part, " ")));
    const bool is_text = part.kind == StorePart::Kind::text;
    Numbers numbers(store, part);
    if (!is_text) numbers.check();
    if (arguments.json) {
        Json json = head(arguments);
        json["part"] = json_of(part);
        if (is_text) {
            json["text"] = Json::parse(store.text(part));
            print(terminal, json);
        } else {
            json["first"] = part.first;
            print(terminal, json, "numbers", part.end - part.first, [&](std::int64_t i) { return numbers.json(part.first + i); });
        }
    } else if (is_text) {
        terminal.out() << store.text(part) << '\n';
    } else if (part.kind == StorePart::Kind::brick) {
        print_brick(part, numbers, terminal);
    } else {
        print_array(part, numbers, terminal);
    }
    return 0;
}

}  // namespace isoatlas::cli
