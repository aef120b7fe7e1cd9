// A store, and who answers for it.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "isoatlas/build.h"
#include "isoatlas/phantom.h"
#include "oracle/stores.h"
#include "server/service.h"

namespace isoatlas {

class ServiceTest : public oracle::Stores {
protected:
    void SetUp() override {
        build_atlas(path_, make_phantom("torus-chain", {.size = 24}));
        atlas_.emplace(path_);
        service_.emplace("secret", Context{});
        service_->store_state().open(*atlas_);
    }

    Response ask(const std::string& path, std::multimap<std::string, std::string> words = {}, const std::string& token = "secret") {
        return service_->answer({path, std::move(words), token, "test", is_disconnected_});
    }

    std::optional<Atlas> atlas_;
    std::optional<Service> service_;
    IsDisconnected is_disconnected_;
};

}  // namespace isoatlas
