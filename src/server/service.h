// What the server knows: answers to the questions of a viewer, from a store. Any question is safe; refusals are answers.
//
//   /api/atlas                              what a page shows, without pictures: docs/schema/page.schema.json
//   /api/preview?tau=T                      what the surface at T is and costs, before it is made
//   /api/objects?tau=T[&top=N]              the objects that are there at T, the largest first
//   /api/surface?tau=T[&object=ID,...|&contour=ID,...][&most=N]   a mesh (server/wire_mesh.h)
//   /api/surface?tau=T[...]&format=stl                            the file that `isoatlas extract` writes
//
// tau: in units of the file, as `isoatlas extract --tau`. Everything but the page needs the token.
#pragma once

#include <string>

#include "base/lazy.h"
#include "isoatlas/atlas.h"
#include "isoatlas/context.h"
#include "server/question.h"
#include "server/turns.h"

namespace isoatlas::server {

class Service {
public:
    /// atlas must live as long as this.
    Service(const Atlas& atlas, std::string token, const Context& context);

    /// Never throws but for want of memory. From many threads.
    [[nodiscard]] Answer answer(const Question& question);
    /// Ends what is being answered.
    void end() { turns_.end(); }

private:
    [[nodiscard]] Answer answer_known(const Question& question);
    [[nodiscard]] Answer atlas_answer();
    [[nodiscard]] Answer preview_answer(const Question& question) const;
    [[nodiscard]] Answer objects_answer(const Question& question) const;
    [[nodiscard]] Answer surface_answer(const Question& question);
    /// In stored values.
    [[nodiscard]] double stored_tau(double reported) const { return atlas_.info().calibration.stored(reported); }

    const Atlas& atlas_;
    std::string token_;
    Context context_;
    Turns turns_;
    Lazy<std::string> atlas_json_;
};

}  // namespace isoatlas::server
