// isoatlas phantom: generated volumes with known answers.
#include <fmt/format.h>

#include "data/session.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

void list(const Arguments& arguments, Terminal& terminal) {
    const std::vector<PhantomDescription>& known = phantoms();
    if (arguments.json) {
        Json json = document("phantoms");
        json["phantoms"] = Json::array();
        for (const PhantomDescription& phantom : known) {
            json["phantoms"].push_back({{"name", phantom.name}, {"summary", phantom.summary}, {"default_size", phantom.default_size}});
        }
        print(terminal, json);
        return;
    }
    Table table({{"name", true}, {"size"}, {"description", true}});
    for (const PhantomDescription& phantom : known) table.add({phantom.name, fmt::format("{}", phantom.default_size), phantom.summary});
    table.print(terminal);
    terminal.next(fmt::format("isoatlas phantom {0} -o {0}.nrrd", known.at(0).name));
}

void check_phantom_arguments(const Arguments& arguments) {
    if (arguments.file.empty()) throw Error(ErrorKind::usage, {.what = "which phantom?", .next = "isoatlas phantom --list"});
    if (arguments.output.empty()) {
        throw Error(ErrorKind::usage, {.what = "no output file", .expected = "-o FILE", .next = "add -o " + arguments.file + ".nrrd"});
    }
    Arguments generated = arguments;
    generated.file.clear();  // a name, not an input file that -o could overwrite
    check_output(generated, {".nrrd", ".npy", ".raw", ".mha", ".nii"});
}

}  // namespace

int run_phantom(const Arguments& arguments, Terminal& terminal) {
    if (arguments.list) {
        list(arguments, terminal);
        return 0;
    }
    check_phantom_arguments(arguments);
    const Volume volume = make_phantom(arguments.file, arguments.phantom);
    {
        const WritingGuard guard;
        write_volume(arguments.output, volume);
    }
    const ValueRange range = range_of(volume);
    if (arguments.json) {
        Json json = document("phantom", volume.info);
        json["phantom"] = arguments.file;
        json["output"] = arguments.output;
        json["values"] = {{"low", range.low}, {"high", range.high}};
        print(terminal, json);
        return 0;
    }
    const Scale scale(volume.info);
    terminal.out() << shown_name(arguments.output) << ": " << arguments.file << ", " << extent_text(volume.info.extent) << ' '
                   << name_of(volume.info.type) << ", values " << scale.text(range.low) << " .. " << scale.text(range.high) << '\n';
    terminal.next("isoatlas objects " + shell_word(arguments.output));
    return 0;
}

}  // namespace isoatlas::cli
