// What the server knows: answers to the questions of a viewer, from a store. Any question is safe; refusals are answers.
//
//   /api/events                             where the server is, and where the questions of this client are: a stream that goes on
//   /api/atlas                              what a page shows, without pictures: docs/schema/page.schema.json
//   /api/preview?tau=T[&object=ID]          what the surface at T is and costs, before it is made; what object ID is there
//   /api/objects?tau=T[&top=N]              the objects that are there at T, the largest first
//   /api/measures?tau=T&object=ID,...       how large these objects are, in physical units
//   /api/branches?top=N[&persistence=H...]  all bright objects by rank, or those that a selection keeps (server/branches.h)
//   /api/card?entry=I|branch=R[&frames=N]   a picture of one (server/cards.h)
//   /api/surface?tau=T[&object=ID,...|&contour=ID,...][&most=N]   a mesh (server/wire_mesh.h)
//   /api/surface?tau=T[...]&format=stl                            the file that `isoatlas extract` writes
//   /api/label?tau=T[&object=ID,...]&format=nrrd                  the file that `isoatlas label` writes
//   /api/slice?axis=A&index=I[&most=N]      the samples of one slice (server/wire_samples.h)
//   /api/volume[?most=N]                    the volume in one byte a value (server/wire_samples.h)
//   /api/at?voxel=X,Y,Z[&object=ID@T,...][&contour=ID@T,...]   a sample, and what holds it
//   /api/transfer                           which values the tree proposes to see as matter
//
// tau: in units of the file, as `isoatlas extract --tau`. Everything but the page needs the token; who gets as far: server/door.h, which
// answers /open and /enter; server/http.cpp answers /api/address.
#pragma once

#include <atomic>
#include <string>

#include "isoatlas/atlas.h"
#include "isoatlas/context.h"
#include "server/cards.h"
#include "server/changes.h"
#include "server/event_stream.h"
#include "server/known.h"
#include "server/lines.h"
#include "server/opening.h"
#include "server/question.h"
#include "server/shared.h"
#include "server/wire_mesh.h"
#include "server/words.h"

namespace isoatlas {

class Service {
public:
    /// memory: bytes for what is being made at a time; 0: a quarter of what there is.
    Service(std::string token, const Context& context, std::int64_t memory = 0);

    /// The store that answers come from, or where it stands; nothing is answered before.
    [[nodiscard]] Opening& opening() { return opening_; }
    /// Finds what every page asks first, and the surface that it shows first, on this thread. Throws Error: as Opening::atlas(), input
    /// (damaged store), cancelled.
    void prepare(const Context& context);
    /// Never throws but for want of memory. From many threads.
    [[nodiscard]] Answer answer(const Question& question);
    /// Ends what is being answered.
    void end();

private:
    [[nodiscard]] Answer answer_known(const Question& question);
    [[nodiscard]] Answer events_answer(const Question& question);
    [[nodiscard]] Answer preview_answer(const Question& question);
    [[nodiscard]] Answer objects_answer(const Question& question);
    [[nodiscard]] Answer measures_answer(const Question& question);
    [[nodiscard]] Answer branches_answer(const Question& question);
    [[nodiscard]] Answer at_answer(const Question& question);
    [[nodiscard]] Answer card_answer(const Question& question);
    [[nodiscard]] Answer surface_answer(const Question& question);
    [[nodiscard]] Answer label_answer(const Question& question);
    /// Waits until it is found, in no line: all wait for the same.
    [[nodiscard]] const Known& known(const Question& question);
    [[nodiscard]] const Known& known(const Context& context);
    [[nodiscard]] CardSubject card_subject(Words& words, const Known& known) const;
    /// Waits for its turn.
    [[nodiscard]] std::unique_ptr<Turns::Turn> turn_in(Line line, const Question& question);
    /// When it is its turn.
    [[nodiscard]] Answer samples_answer(const Question& question, Answer (*make)(const Atlas&, const Question&, const Context&));

    [[nodiscard]] const Atlas& atlas() const { return opening_.atlas(); }
    /// Throws Error{unsupported} for an image.
    [[nodiscard]] const Atlas& atlas_of_volume() const;
    [[nodiscard]] std::vector<std::int64_t> voxels(Words& words, std::string_view name) const;
    /// Of a long call for who holds the turn.
    [[nodiscard]] Context context_of(Turns::Turn& turn) const;
    /// Refuses what would take more memory than one answer may.
    [[nodiscard]] Surface extract(double tau, ExtractOptions options, const Context& context) const;
    [[nodiscard]] WireMesh wire(const Surface& surface, std::int64_t most, const Context& context) const;
    /// Is it the surface that every page shows first?
    [[nodiscard]] bool is_first(double tau, const ExtractOptions& options, std::int64_t most) const;

    const std::string token_;
    Context context_;
    const std::int64_t memory_;  ///< of one answer
    Changes changes_;
    Opening opening_;
    Lines lines_;
    EventStreams events_;
    Cards cards_;
    Shared<Known> known_;
    Shared<WireMesh> first_;  ///< coarse: some ten kilobytes
    std::atomic<bool> ended_ = false;
};

}  // namespace isoatlas
