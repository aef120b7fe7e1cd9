// State of the store: open; being built; or failed, with the reason.
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
    /// changes: notified of every change; it must live as long.
    explicit StoreState(VersionCounter& changes) : changes_(changes) {}

    /// Final state. The atlas must live as long as this.
    void open(const Atlas& atlas);
    void report_progress(const BuildState& state);
    void fail(const Error& error);

    /// Throws Error: resource while the store is being built, or the error of its build.
    [[nodiscard]] const Atlas& atlas() const;

    struct State {
        bool is_open = false;
        BuildState build{};              ///< progress of the build
        std::optional<Error> failure{};  ///< error of the build
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
