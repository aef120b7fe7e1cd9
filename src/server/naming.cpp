#include "server/naming.h"

#include "isoatlas/error.h"
#include "server/document.h"
#include "server/query_parameters.h"

namespace isoatlas {
namespace {

std::string file_of(const Atlas& atlas) { return object_names_path(atlas.info().path, polarity_of(atlas.info())); }

std::vector<ObjectName> names_of(const Atlas& atlas) { return read_object_names(file_of(atlas), atlas.info().extent); }

void put_names(JsonStream& json, const Atlas& atlas) {
    for (const ObjectName& name : names_of(atlas)) {
        json.line().begin_object().key("name").value(name.name).key("side").value(name.is_cavity ? "cavity" : "object");
        json.key("polarity").value(isoatlas::name_of(polarity_of(atlas.info())));
        json.key("id").value(name.voxel).key("tau").value(name.isovalue).end_object();
    }
}

Response answer_of(const StoreSides& sides) {
    return {200, "application/json", document("names", [&](JsonStream& json) {
                json.key("names").begin_array();
                put_names(json, sides.main);
                if (sides.has_both()) put_names(json, *sides.low);
                json.end_array();
            })};
}

/// Throws Error{usage} where an object of the other polarity has the name.
void check_is_free(const StoreSides& sides, Polarity polarity, const std::string& name) {
    if (!sides.has_both()) return;
    const Atlas& other = sides.of(polarity == Polarity::high ? Polarity::low : Polarity::high);
    if (find_object_name(names_of(other), name) == nullptr) return;
    throw Error(ErrorKind::usage,
                {.where = "name",
                 .what = std::string("an object of ") + isoatlas::name_of(polarity_of(other.info())) + " values has this name",
                 .next = "choose another name"});
}

}  // namespace

std::vector<ObjectName> Naming::usable_names(const Atlas& atlas) {
    try {
        return names_of(atlas);
    } catch (const Error&) {
        return {};  // /api/names says so
    }
}

Response Naming::names(const StoreSides& sides, const Request& request) const {
    QueryParameters(request.words).reject_unknown();
    return answer_of(sides);
}

Response Naming::change(const NumberedSides& sides, const Request& request) {
    if (!request.is_change)
        throw Error(ErrorKind::usage, {.where = "the method", .what = "this request changes something", .expected = "PUT"});
    if (is_read_only_)
        throw Error(ErrorKind::usage, {.where = "name", .what = "this viewer writes nothing", .next = "start it without that"});
    QueryParameters words(request.words);
    const std::vector<NamedPart> parts = named_parts(words, sides, 1);
    const std::optional<std::string> name = words.text("name");
    words.reject_unknown();
    if (parts.size() != 1 || !parts[0].tau || !name)
        throw Error(ErrorKind::usage,
                    {.where = "name", .what = "requires an object at an isovalue, and a name", .expected = "object=2&name=skull"});
    const Atlas& atlas = sides.atlas(parts[0].polarity);
    const ObjectName given{*name, parts[0].voxel, atlas.info().calibration.reported(*parts[0].tau), parts[0].is_contour};
    const std::lock_guard lock(mutex_);
    check_is_free(sides.stores, parts[0].polarity, *name);
    std::vector<ObjectName> names = names_of(atlas);
    if (name->empty()) {
        std::erase_if(names, [&](const ObjectName& one) {
            return one.is_cavity == given.is_cavity && one.voxel == given.voxel && one.isovalue == given.isovalue;
        });
    } else {
        set_object_name(names, given);
    }
    write_object_names(file_of(atlas), atlas.info().extent, names);
    return answer_of(sides.stores);
}

}  // namespace isoatlas
