// A server and its client in one program: what is asked is answered, what cannot be answered is refused with the error of the service.
#include <gtest/gtest.h>

#include <new>
#include <thread>

#include "isoatlas/build.h"
#include "isoatlas/client.h"
#include "isoatlas/phantom.h"
#include "isoatlas/server.h"
#include "oracle/stores.h"

namespace isoatlas {
namespace {

class HttpTest : public oracle::Stores {
protected:
    void SetUp() override {
        build_atlas(path_, make_phantom("torus-chain", {.size = 24}));
        atlas_.emplace(path_);
        server_.open(*atlas_);
        thread_ = std::thread([this] { server_.run(); });
    }
    void TearDown() override {
        server_.stop();
        thread_.join();
    }
    std::string with_token(const std::string& token) const { return server_.address() + "/?token=" + token; }

    std::optional<Atlas> atlas_;
    Server server_{{.token = "0123456789abcdef"}};
    std::thread thread_;
};

ErrorKind kind_of(const auto& call) {
    try {
        (void)call();
    } catch (const Error& error) {
        return error.kind();
    }
    return ErrorKind::internal;
}

TEST_F(HttpTest, AnswersAndRefusals) {
    const std::string address = with_token(server_.token());
    const ServerResponse answer = ask_server(address, "/api/objects?tau=0.5");
    EXPECT_EQ(answer.type, "application/json");
    EXPECT_TRUE(answer.bytes.starts_with("{\"schema\"")) << answer.bytes.substr(0, 40);
    EXPECT_EQ(ask_server(address, "/api/surface?tau=0.5").bytes.substr(0, 4), "iam1");
    EXPECT_EQ(kind_of([&] { return ask_server(address, "/api/objects"); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { return ask_server(address, "/api/none"); }), ErrorKind::not_found);
    EXPECT_EQ(kind_of([&] { return ask_server(with_token("fedcba9876543210"), "/api/atlas"); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { return ask_server(address, "/api/objects?tau=1 2"); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { return ask_server("http://127.0.0.2:1/?token=1", "/api/atlas"); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { return Server({.port = server_.port()}); }), ErrorKind::resource);
    EXPECT_EQ(kind_of([&] { return Server({.token = "too short"}); }), ErrorKind::usage);
}

TEST_F(HttpTest, MemoryThatIsMissingWhileItPreparesEndsNothing) {
    Context without;
    without.cancelled = []() -> bool { throw std::bad_alloc(); };
    EXPECT_NO_THROW(server_.prepare(without));
    EXPECT_EQ(ask_server(with_token(server_.token()), "/api/atlas").type, "application/json");
}

TEST(Http, AServerThatIsStoppedBeforeItRunsDoesNot) {
    Server server;
    server.stop();
    server.run();
    EXPECT_EQ(server.token().size(), 32U);
}

}  // namespace
}  // namespace isoatlas
