#include "server/naming.h"

#include "isoatlas/error.h"
#include "server/document.h"
#include "server/query_parameters.h"

namespace isoatlas {
namespace {

std::string file_of(const Atlas& atlas) { return object_names_path(atlas.info().path, polarity_of(atlas.info())); }

std::vector<ObjectName> names_of(const Atlas& atlas) { return read_object_names(file_of(atlas), atlas.info().extent); }

Response answer_of(const std::vector<ObjectName>& names) {
    return {200, "application/json", document("names", [&](JsonStream& json) {
                json.key("names").begin_array();
                for (const ObjectName& name : names) {
                    json.line().begin_object().key("name").value(name.name).key("side").value(name.is_cavity ? "cavity" : "object");
                    json.key("id").value(name.voxel).key("tau").value(name.isovalue).end_object();
                }
                json.end_array();
            })};
}

}  // namespace

std::vector<ObjectName> Naming::usable_names(const Atlas& atlas) {
    try {
        return names_of(atlas);
    } catch (const Error&) {
        return {};  // /api/names says so
    }
}

Response Naming::names(const Atlas& atlas, const Request& request) const {
    QueryParameters(request.words).reject_unknown();
    return answer_of(names_of(atlas));
}

Response Naming::change(const Atlas& atlas, const NumberedLines& lines, const Request& request) {
    if (!request.is_change)
        throw Error(ErrorKind::usage, {.where = "the method", .what = "this request changes something", .expected = "PUT"});
    if (is_read_only_)
        throw Error(ErrorKind::usage, {.where = "name", .what = "this viewer writes nothing", .next = "start it without that"});
    QueryParameters words(request.words);
    const std::vector<NamedPart> parts = named_parts(words, atlas, lines, 1);
    const std::optional<std::string> name = words.text("name");
    words.reject_unknown();
    if (parts.size() != 1 || !parts[0].tau || !name)
        throw Error(ErrorKind::usage,
                    {.where = "name", .what = "requires an object at an isovalue, and a name", .expected = "object=2&name=skull"});
    const ObjectName given{*name, parts[0].voxel, atlas.info().calibration.reported(*parts[0].tau), parts[0].is_contour};
    const std::lock_guard lock(mutex_);
    std::vector<ObjectName> names = names_of(atlas);
    if (name->empty()) {
        std::erase_if(names, [&](const ObjectName& one) {
            return one.is_cavity == given.is_cavity && one.voxel == given.voxel && one.isovalue == given.isovalue;
        });
    } else {
        set_object_name(names, given);
    }
    write_object_names(file_of(atlas), atlas.info().extent, names);
    return answer_of(names);
}

}  // namespace isoatlas
