// The objects of high and of low values of a file in one command: each side is opened when a reference needs it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "data/object_directory.h"
#include "data/source.h"

namespace isoatlas::cli {

/// Arguments of a command about one polarity, where missing samples are in no object of it.
[[nodiscard]] Arguments of_side(const Arguments& arguments, Polarity polarity);

/// What a command without --polarity is about. Page and viewer: both sides; high values alone, with a sentence, where missing samples lie
/// below all others, as a store has its samples once. Other verbs: low where all objects that are named are of low values and nothing else
/// is asked for, so that nothing of the other side is computed; else as they are.
[[nodiscard]] Arguments with_sides(const Arguments& arguments);

class Sides {
public:
    Sides(const Arguments& arguments, Terminal& terminal) : arguments_(arguments), terminal_(terminal) {}

    /// That of references without a polarity: of --polarity; without it, of a store of low values alone low.
    [[nodiscard]] Polarity polarity();
    [[nodiscard]] Source& main() { return source(polarity()); }
    /// Opens it at the first call. Throws Error: as Source, unsupported (a store that does not hold the polarity).
    [[nodiscard]] Source& source(Polarity polarity) { return side(polarity).source; }
    [[nodiscard]] Source& source(const ChosenObject& object) { return source(object.polarity); }
    [[nodiscard]] ObjectDirectory& directory(Polarity polarity) { return side(polarity).directory; }
    [[nodiscard]] ObjectDirectory& directory() { return directory(polarity()); }
    /// Of a volume both; of a store what it was built with.
    [[nodiscard]] bool holds(Polarity polarity) const;
    [[nodiscard]] bool is_open(Polarity polarity) const { return sides_[static_cast<std::size_t>(polarity)] != nullptr; }

    /// As ObjectDirectory::find() and find_contours(), in the order of the references. A name is looked for on both sides.
    [[nodiscard]] std::vector<ChosenObject> find(std::span<const ObjectReference> references, const std::optional<double>& typed = {});
    [[nodiscard]] std::vector<ChosenObject> find_contours(std::span<const ObjectReference> references,
                                                          const std::optional<double>& typed = {});
    /// The first lines of the table, with --polarity both of the list of both, that show more than background, if there are any.
    [[nodiscard]] std::vector<ChosenObject> first(std::int64_t count);
    /// There are none, and nothing else was chosen: Error{not_found}.
    [[noreturn]] void refuse_without_objects() const;
    /// Of the sources that are open.
    void release_trees();

private:
    struct Side {
        Side(Arguments own, Terminal& terminal)
            : arguments(std::move(own)), source(arguments, terminal), directory(arguments, source, terminal) {}
        Arguments arguments;
        Source source;
        ObjectDirectory directory;
    };
    [[nodiscard]] Side& side(Polarity polarity);
    [[nodiscard]] Polarity polarity_of_reference(const ObjectReference& reference);
    [[nodiscard]] std::vector<ObjectReference> first_of_both(std::int64_t count);
    template <class Find>
    [[nodiscard]] std::vector<ChosenObject> find_on_sides(std::span<const ObjectReference> references, const Find& find);

    const Arguments& arguments_;
    Terminal& terminal_;
    std::optional<Polarity> polarity_;
    std::array<std::unique_ptr<Side>, 2> sides_;
};

}  // namespace isoatlas::cli
