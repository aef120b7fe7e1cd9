// What a page of high values leaves for that of both polarities of the same volume.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>

#include "atlas/overview.h"
#include "catalogue/draw_cards.h"
#include "isoatlas/page.h"

namespace isoatlas {

struct AtlasTrees;

/// What a picture of an object of high values depends on, beside the volume and options: its id, isovalue and number, which has a colour.
using PictureKey = std::tuple<std::int64_t, double, std::int64_t>;

struct PageDraft::Data {
    std::optional<Overview> high;
    std::shared_ptr<const AtlasTrees> trees;

    /// From any thread.
    void keep(const PictureKey& key, CardPicture card) {
        const std::lock_guard lock(mutex_);
        cards_.insert_or_assign(key, std::move(card));
    }
    /// From any thread; once each.
    [[nodiscard]] std::optional<CardPicture> take(const PictureKey& key) {
        const std::lock_guard lock(mutex_);
        auto kept = cards_.extract(key);
        return kept.empty() ? std::nullopt : std::optional(std::move(kept.mapped()));
    }

private:
    std::mutex mutex_;
    std::map<PictureKey, CardPicture> cards_;
};

}  // namespace isoatlas
