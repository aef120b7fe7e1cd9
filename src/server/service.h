// What the server knows: answers to the requests of a viewer, from a store. Any request is safe; refusals are answers.
//
//   /api/events                             where the server is, and where the requests of this client are: a stream that goes on
//   /api/atlas                              what a page shows, without pictures: docs/schema/page.schema.json
//   /api/preview?tau=T[&object=ID]          what the surface at T is and costs, before it is made; what object ID is there
//   /api/objects?tau=T[&top=N]              the objects that are there at T, the largest first
//   /api/measures?tau=T&object=ID,...       how large these objects are, in physical units
//   /api/branches?top=N[&persistence=H...]  all bright objects by rank, or those that a selection keeps (server/branch_answers.h)
//   /api/card?entry=I|branch=R[&frames=N]   a picture of one (server/cards.h)
//   /api/surface?tau=T[&object=ID,...|&contour=ID,...][&most=N]   a mesh (server/wire_mesh.h)
//   /api/surface?tau=T[...]&format=stl                            the file that `isoatlas extract` writes
//   /api/label?tau=T[&object=ID,...]&format=nrrd                  the file that `isoatlas label` writes
//   /api/slice?axis=A&index=I[&most=N]      the samples of one slice (server/wire_samples.h)
//   /api/volume[?most=N]                    the volume in one byte a value (server/wire_samples.h)
//   /api/at?voxel=X,Y,Z[&object=ID@T,...][&contour=ID@T,...]   a sample, and what holds it
//   /api/transfer                           which values the tree proposes to see as matter
//
// tau: in units of the file, as `isoatlas extract --tau`. Everything but the page needs the token; who gets as far:
// server/access_control.h, which answers /open and /enter; server/http.cpp answers /api/address.
#pragma once

#include <atomic>
#include <string>

#include "isoatlas/atlas.h"
#include "isoatlas/context.h"
#include "server/cards.h"
#include "server/event_stream.h"
#include "server/job_queues.h"
#include "server/query_parameters.h"
#include "server/request.h"
#include "server/shared_once.h"
#include "server/store_catalogue.h"
#include "server/store_state.h"
#include "server/version_counter.h"
#include "server/wire_mesh.h"

namespace isoatlas {

class Service {
public:
    /// memory: bytes for what is being made at a time; 0: a quarter of what there is.
    Service(std::string token, const Context& context, std::int64_t memory = 0);

    /// The store that answers come from, or where it stands; nothing is answered before.
    [[nodiscard]] StoreState& store_state() { return store_state_; }
    /// Finds what every page asks first, and the surface that it shows first, on this thread. Throws Error: as StoreState::atlas(), input
    /// (damaged store), cancelled.
    void prepare(const Context& context);
    /// Never throws but for want of memory. From many threads.
    [[nodiscard]] Response answer(const Request& request);
    /// Ends what is being answered.
    void end();

private:
    [[nodiscard]] Response answer_known(const Request& request);
    [[nodiscard]] Response events_answer(const Request& request);
    [[nodiscard]] Response preview_answer(const Request& request);
    [[nodiscard]] Response objects_answer(const Request& request);
    [[nodiscard]] Response measures_answer(const Request& request);
    [[nodiscard]] Response branches_answer(const Request& request);
    [[nodiscard]] Response at_answer(const Request& request);
    [[nodiscard]] Response card_answer(const Request& request);
    [[nodiscard]] Response surface_answer(const Request& request);
    [[nodiscard]] Response label_answer(const Request& request);
    /// Waits until it is found, in no line: all wait for the same.
    [[nodiscard]] const StoreCatalogue& known(const Request& request);
    [[nodiscard]] const StoreCatalogue& known(const Context& context);
    [[nodiscard]] CardSubject card_subject(QueryParameters& words, const StoreCatalogue& known) const;
    /// Waits for its turn.
    [[nodiscard]] std::unique_ptr<JobQueue::Job> acquire_job(QueueClass line, const Request& request);
    /// When it is its turn.
    [[nodiscard]] Response samples_answer(const Request& request, Response (*make)(const Atlas&, const Request&, const Context&));

    [[nodiscard]] const Atlas& atlas() const { return store_state_.atlas(); }
    /// Throws Error{unsupported} for an image.
    [[nodiscard]] const Atlas& atlas_of_volume() const;
    [[nodiscard]] std::vector<std::int64_t> voxels(QueryParameters& words, std::string_view name) const;
    /// Of a long call for who holds the turn.
    [[nodiscard]] Context context_of(JobQueue::Job& job) const;
    /// Refuses what would take more memory than one answer may.
    [[nodiscard]] Surface extract(double tau, ExtractOptions options, const Context& context) const;
    [[nodiscard]] WireMesh wire(const Surface& surface, std::int64_t max, const Context& context) const;
    /// Is it the surface that every page shows first?
    [[nodiscard]] bool is_first(double tau, const ExtractOptions& options, std::int64_t max) const;

    const std::string token_;
    Context context_;
    const std::int64_t memory_;  ///< of one answer
    VersionCounter changes_;
    StoreState store_state_;
    JobQueues queues_;
    EventStreams events_;
    Cards cards_;
    SharedOnce<StoreCatalogue> known_;
    SharedOnce<WireMesh> first_;  ///< coarse: some ten kilobytes
    std::atomic<bool> ended_ = false;
};

}  // namespace isoatlas
