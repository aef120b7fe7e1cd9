// Addresses: which stay on a host, which may carry secrets, and what is shown of them.
#include <gtest/gtest.h>

#include "isoatlas/error.h"
#include "remote/address.h"

namespace isoatlas {
namespace {

TEST(Addresses, PartsAndWhatIsShown) {
    const Address address = parse_address("https://example.org:8443/a%20b/c.atlas?signature=x#top");
    EXPECT_EQ(address.host, "example.org");
    EXPECT_EQ(address.port, "8443");
    EXPECT_EQ(shown(address), "https://example.org:8443/a%20b/c.atlas");
    EXPECT_EQ(parse_address("http://h/x").port, "80");
    EXPECT_EQ(parse_address("http://h/a b").url, "http://h/a%20b");
    for (const char* bad : {"ftp://h/x", "/a/b", "https://", "http://h:99999/x", "http://me:word@h/x", "https://me@h/x"})
        EXPECT_THROW((void)parse_address(bad), Error) << bad;
}

TEST(Addresses, RedirectsAreResolved) {
    const Address from = parse_address("https://h/a/b?c=1");
    EXPECT_EQ(redirected(from, "/d").url, "https://h/d");
    EXPECT_EQ(redirected(from, "d").url, "https://h/a/d");
    EXPECT_EQ(redirected(from, "//other/d").host, "other");
    EXPECT_THROW((void)redirected(from, "file:///etc/passwd"), Error);
}

TEST(Addresses, HostsAndSecrets) {
    const Address plain = parse_address("http://h/a"), safe = parse_address("https://h/b");
    EXPECT_TRUE(stays_on_host(plain, safe));
    EXPECT_FALSE(stays_on_host(safe, plain));
    EXPECT_FALSE(stays_on_host(safe, parse_address("https://h.other/b")));
    EXPECT_FALSE(stays_on_host(safe, parse_address("https://h:444/b")));
    EXPECT_TRUE(keeps_secrets(safe));
    EXPECT_FALSE(keeps_secrets(plain));
    EXPECT_TRUE(keeps_secrets(parse_address("http://127.0.0.1:80/a")));
    EXPECT_FALSE(keeps_secrets(parse_address("http://127.0.0.1.example/a")));
}

}  // namespace
}  // namespace isoatlas
