// Responses to the requests of a viewer, from a store. Any request but PUT is safe; errors are responses too. Objects:
// server/object_words.h.
//
//   /api/events                             state of the server, progress of the requests of this client: an endless stream
//   /api/atlas                              the data of the page, without pictures: docs/schema/page.schema.json
//   /api/preview?tau=T[&object=ID]          size and cost of the surface at T, before extraction; object ID at T
//   /api/objects?tau=T[&top=N]              the objects at T, the largest first
//   /api/measures?tau=T&object=ID,...       sizes of these objects, in physical units
//   /api/branches?top=N[&persistence=H...]  all objects by rank, or those of a selection (server/branch_answers.h)
//   /api/card?entry=I|branch=R[&frames=N]   a picture of one (server/cards.h)
//   /api/surface?tau=T[&object=ID,...|&contour=ID,...][&max=N]    a mesh (preview/wire_mesh.h)
//   /api/surface?tau=T[...]&points=N                              the points of Dividing Cubes, as squares of two triangles
//   /api/surface?tau=T[...]&format=stl                            the file that `isoatlas extract` writes
//   /api/label?tau=T[&object=ID,...]&format=nrrd                  the file that `isoatlas label` writes
//   /api/slice?axis=A&index=I[&max=N]       the samples of one slice (server/wire_samples.h)
//   /api/volume[?max=N]                     the volume in one byte a value (server/wire_samples.h)
//   /api/at?voxel=X,Y,Z[&object=ID@T,...][&contour=ID@T,...]   a sample, and the objects that contain it
//   /api/transfer                           the transfer function that the tree proposes
//   /api/surfaces?object=REF,...[&contour=REF,...][&format=glb]        several objects, each at its isovalue (server/several_objects.h)
//   /api/segmentation?object=REF,...[&contour=REF,...][&format=...]    their labels
//   /api/scene                              where a page begins that is opened without a link to a view (server/shared_scene.h)
//   PUT /api/scene[?after=VERSION]          sets it, and shows it in all frames: the body
//   /api/names                              names of objects (server/naming.h)
//   PUT /api/name?object=REF&name=N         gives one
//
// polarity=low: any of them of the objects of low values, where the store is open for both polarities; references to several objects may
// say it one by one: low2. The entries of /api/atlas are of both.
// tau: in units of the file, as `isoatlas extract --tau`. Everything but the page needs the token; authorisation: server/access_control.h,
// which answers /open and /enter; server/http.cpp answers /frame, /api/address and /api/volumes, and hands /volume/N/... to the service of
// the volume (server/volume_services.h).
#pragma once

#include <atomic>
#include <string>

#include "isoatlas/atlas.h"
#include "isoatlas/context.h"
#include "isoatlas/octree_front.h"
#include "isoatlas/server.h"
#include "preview/sample_surface.h"
#include "preview/wire_mesh.h"
#include "server/cards.h"
#include "server/event_stream.h"
#include "server/job_queues.h"
#include "server/naming.h"
#include "server/query_parameters.h"
#include "server/request.h"
#include "server/shared_once.h"
#include "server/shared_scene.h"
#include "server/store_catalogue.h"
#include "server/store_levels.h"
#include "server/store_state.h"
#include "server/version_counter.h"

namespace isoatlas {

struct ServiceOptions {
    std::int64_t memory = 0;    ///< bytes for responses in progress; 0: a quarter of the available memory
    bool is_read_only = false;  ///< names cannot be changed
    SceneFile scene{};          ///< where pages begin; empty: nowhere
};

inline constexpr std::int64_t kMaxShownTriangles = 100'000'000;  ///< of a response

class Service {
public:
    Service(std::string token, const Context& context, const ServiceOptions& options = {});

    /// The store of the responses, or its state; nothing is answered before.
    [[nodiscard]] StoreState& store_state() { return store_state_; }
    /// The text of the scene that pages in frames show; empty: none.
    [[nodiscard]] std::string scene() const { return scene_.text(); }
    /// Throws Error: usage, as SharedScene::set(); as StoreState::sides() while there is no store.
    void set_scene(const std::string& text);
    /// Computes the data that every page requests first, and its first surface, on this thread. Throws Error: as StoreState::atlas(), input
    /// (damaged store), cancelled.
    void prepare(const Context& context);
    /// Throws std::bad_alloc only. From many threads.
    [[nodiscard]] Response answer(const Request& request);
    /// Cancels all running requests.
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
    [[nodiscard]] Response several_answer(const Request& request);
    /// Blocks until it is computed, without a queue: all wait for the same.
    [[nodiscard]] const StoreCatalogue& known(const Request& request);
    [[nodiscard]] const StoreCatalogue& known(const Context& context);
    [[nodiscard]] CardSubject card_subject(QueryParameters& words, const StoreCatalogue& known, const Atlas& atlas) const;
    /// Blocks until the job may run.
    [[nodiscard]] std::unique_ptr<JobQueue::Job> acquire_job(QueueClass line, const Request& request);
    /// When its job runs.
    [[nodiscard]] Response samples_answer(const Request& request, Response (*make)(const Atlas&, const Request&, const Context&));

    /// Of the polarity of a request. Throws Error{usage} where the store is not open for it.
    [[nodiscard]] const Atlas& atlas(const Request& request) const;
    [[nodiscard]] const SideCatalogue& side_of(const Request& request);
    [[nodiscard]] NumberedSides numbered_sides(const Request& request);
    /// Throws Error{resource} where labels would exceed the memory of a response.
    void check_labels_fit() const;
    /// Throws Error{unsupported} for an image.
    [[nodiscard]] const Atlas& atlas_of_volume(const Request& request) const;
    /// Of objects or contours of a request with one isovalue.
    [[nodiscard]] std::vector<std::int64_t> voxels(QueryParameters& words, std::string_view name, const Request& request);
    /// Context of a long call of a job.
    [[nodiscard]] Context context_of(JobQueue::Job& job) const;
    /// Throws where a response would exceed its memory budget.
    [[nodiscard]] Surface extract(const Atlas& atlas, double tau, SurfaceOptions options, const Context& context) const;
    [[nodiscard]] std::int64_t max_triangles() const;
    [[nodiscard]] WireMesh wire(const Surface& surface, const Context& context, bool strips = true) const;
    /// In place of a surface with another topology.
    [[nodiscard]] WireMesh wire_sample(const SurfaceSample& sample, const Context& context) const;
    /// Of positions, physical.
    [[nodiscard]] double step() const;
    [[nodiscard]] WireMesh wire_front(const FrontSurface& front, const Context& context) const;
    /// The exact surface, if it has no more triangles than wanted; else one with its topology by blocks of an octree; if that has more,
    /// too, points of it. The object is searched once.
    [[nodiscard]] WireMesh unprepared(const Atlas& atlas, double tau, const SurfaceOptions& options, std::int64_t triangles,
                                      const Context& context) const;
    /// A surface of at most so many triangles, with the topology of the exact one: a level of detail where the store has it; points of it
    /// where there is no such surface.
    [[nodiscard]] WireMesh mesh_of(const Atlas& atlas, double tau, const SurfaceOptions& options, const MeshWanted& wanted,
                                   const Context& context);
    /// The surface of the entry that every page shows first, on this thread.
    void prepare_first(const NamedEntry& first, const Context& context);
    /// Is it the first surface of every page?
    [[nodiscard]] bool is_first(const Atlas& atlas, double tau, const SurfaceOptions& options, const MeshWanted& wanted) const;

    const std::string token_;
    Context context_;
    const std::int64_t memory_;  ///< of one response
    VersionCounter changes_;
    StoreState store_state_;
    JobQueues queues_;
    SharedScene scene_;
    EventStreams events_;
    Cards cards_;
    Naming naming_;
    SharedOnce<StoreCatalogue> known_;
    StoreLevels levels_;
    SharedOnce<NamedEntry> first_entry_;  ///< that of first_
    SharedOnce<WireMesh> first_;          ///< coarse: some ten kilobytes
    std::atomic<bool> ended_ = false;
};

}  // namespace isoatlas
