// ObjectDirectory: the objects and cavities of a volume by number, voxel or name.
//
// A number is the line in the table of significant objects (docs/glossary.md#objects), the same in every verb, on the page and in the
// viewer. What --all or a selection lists beside these has no number, only its voxel.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "data/source.h"
#include "options/object_reference.h"

namespace isoatlas::cli {

/// An object at an isovalue, or a contour: the wall of a cavity, mostly.
struct ChosenObject {
    std::int64_t number = 0;  ///< in its table, from 1; 0: in none
    bool is_contour = false;  ///< number: among the cavities
    std::int64_t voxel = 0;   ///< SurfaceOptions::objects or contours
    double tau = 0;           ///< stored
    std::string tau_text{};   ///< calibrated, as short as it can be
    bool is_best = false;     ///< tau is that of its line
    std::string name{};       ///< that a user gave it; empty: none
    Polarity polarity = Polarity::high;
};

/// "skull", "object 2", "cavity 3", "v218663"; of low values "object low2", ...
[[nodiscard]] std::string title_of(const ChosenObject& object);
/// "2", "c3", "v218663", "low2"; with_tau: "2@150" where it is not at its best isovalue.
[[nodiscard]] std::string reference_of(const ChosenObject& object, bool with_tau = false);
/// The colour that page and viewer give it; in no table: that of the place in a list.
[[nodiscard]] Colour colour_of(const ChosenObject& object, std::int64_t place);

/// The file of names of arguments.file: beside the store, or beside the one that `isoatlas view VOLUME` keeps in the current folder. Each
/// polarity has its own.
[[nodiscard]] std::string names_file(const Arguments& arguments, Polarity polarity);

/// A damaged file is a warning, and no names.
[[nodiscard]] std::vector<ObjectName> names_in(const std::string& file, const Extent& extent, Terminal& terminal);

/// Those of one polarity, that of the source: references of the other one are not looked for here (data/sides.h).
class ObjectDirectory {
public:
    ObjectDirectory(const Arguments& arguments, Source& source, Terminal& terminal);

    /// typed: the (calibrated) isovalue of references without one; none: their best ones. Throws Error: not_found (no such number, name or
    /// voxel), usage (a voxel of several lines).
    [[nodiscard]] std::vector<ChosenObject> find(std::span<const ObjectReference> references, const std::optional<double>& typed = {});
    /// References to contours: cavities of the table, or voxels with an isovalue.
    [[nodiscard]] std::vector<ChosenObject> find_contours(std::span<const ObjectReference> references,
                                                          const std::optional<double>& typed = {});
    /// The first lines that show more than background, if there are any.
    [[nodiscard]] std::vector<ChosenObject> first(std::int64_t count);

    /// Of the table.
    [[nodiscard]] std::int64_t object_count();
    /// Of a line of another table; 0: it has none.
    [[nodiscard]] std::int64_t number_of(const ObjectEntry& entry);
    [[nodiscard]] std::int64_t number_of(const CavityEntry& entry);
    /// Empty: none.
    [[nodiscard]] std::string name_of(const ObjectEntry& entry);
    [[nodiscard]] std::string name_of(const CavityEntry& entry);
    [[nodiscard]] const std::vector<ObjectName>& names();

    /// Tables that a verb has anyway: of all significant objects and cavities, from the first line on.
    void know(const ObjectTable& table) { objects_ = table; }
    void know(const CavityTable& table) { cavities_ = table; }

private:
    [[nodiscard]] const ObjectTable& objects();
    [[nodiscard]] const CavityTable& cavities();
    void load_both();
    [[nodiscard]] ChosenObject chosen(const ObjectEntry& entry, std::int64_t number);
    [[nodiscard]] ChosenObject chosen(const CavityEntry& entry, std::int64_t number);
    [[nodiscard]] ChosenObject at(ChosenObject object, double typed);
    [[nodiscard]] ChosenObject numbered(const ObjectReference& reference, const std::optional<double>& typed);
    [[nodiscard]] ChosenObject cavity(const ObjectReference& reference, const std::optional<double>& typed);
    [[nodiscard]] ChosenObject voxel(const ObjectReference& reference, const std::optional<double>& typed);
    [[nodiscard]] ChosenObject voxel_of_lines(const ObjectReference& reference);
    [[nodiscard]] ChosenObject named(const ObjectReference& reference, const std::optional<double>& typed);
    void check_voxel(std::int64_t voxel) const;
    [[nodiscard]] Polarity polarity() const { return polarity_of(source_.info()); }
    [[noreturn]] void no_number(std::int64_t number, bool is_cavity, std::int64_t count) const;

    const Arguments& arguments_;
    Source& source_;
    Terminal& terminal_;
    std::optional<ObjectTable> objects_;
    std::optional<CavityTable> cavities_;
    std::optional<std::vector<ObjectName>> names_;
};

}  // namespace isoatlas::cli
