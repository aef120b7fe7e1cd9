// What there is to answer from: a store; or none yet, while somebody builds it; or none, and why.
#pragma once

#include <mutex>
#include <optional>

#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "server/version_counter.h"

namespace isoatlas {

class StoreState {
public:
    /// changes: is told of every change; it must live as long.
    explicit StoreState(VersionCounter& changes) : changes_(changes) {}

    /// The last word. The atlas must live as long as this.
    void open(const Atlas& atlas);
    void report_progress(const BuildState& state);
    void fail(const Error& error);

    /// Throws Error: resource while there is none yet, or why there will be none.
    [[nodiscard]] const Atlas& atlas() const;

    struct State {
        bool is_open = false;
        BuildState build{};              ///< while it is not
        std::optional<Error> failure{};  ///< why it will not be
    };
    [[nodiscard]] State state() const;

private:
    template <class Change>
    void change(const Change& apply);

    VersionCounter& changes_;
    mutable std::mutex mutex_;
    const Atlas* atlas_ = nullptr;
    BuildState build_;
    std::optional<Error> failure_;
};

}  // namespace isoatlas
