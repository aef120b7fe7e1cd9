// State of the store: open; being built; or failed, with the reason.
#pragma once

#include <mutex>
#include <optional>

#include "catalogue/store_sides.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "server/version_counter.h"

namespace isoatlas {

class StoreState {
public:
    /// changes: notified of every change; it must live as long.
    explicit StoreState(VersionCounter& changes) : changes_(changes) {}

    /// Final state. The atlas must live as long as this. low: the same store for objects of low values, where it is open for both.
    void open(const Atlas& atlas, const Atlas* low = nullptr);
    void report_progress(const BuildState& state);
    void fail(const Error& error);

    /// Throws Error: resource while the store is being built, or the error of its build.
    [[nodiscard]] StoreSides sides() const;

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
    const Atlas *atlas_ = nullptr, *low_ = nullptr;
    BuildState build_;
    std::optional<Error> failure_;
};

}  // namespace isoatlas
