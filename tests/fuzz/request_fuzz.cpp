// What comes over a connection before anybody is let in: a head of HTTP, read whole, and again in two pieces that the first byte cuts.
// Both readings let in the same, keep their bounds, and end as "more", "whole" or refused with a known status; the target is taken apart.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/check.h"
#include "server/request_head.h"
#include "server/target.h"

namespace {

using namespace isoatlas;

struct Reading {
    HeadReader reader;
    HeadReader::State state = HeadReader::State::more;
    std::string bytes;

    void read(std::string_view piece) {
        while (state == HeadReader::State::more && !piece.empty()) {  // as a connection: never more than a head
            const std::size_t count = std::min(piece.size(), kLongestHead - bytes.size());
            bytes.append(piece.substr(0, count));
            piece.remove_prefix(count);
            state = reader.read(bytes);
            ISOATLAS_CHECK(state != HeadReader::State::more || bytes.size() < kLongestHead);
        }
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::size_t cut = text.size() * data[0] / 256;
    Reading whole, pieces;
    whole.read(text);
    pieces.read(text.substr(0, cut));
    pieces.read(text.substr(cut));
    // What is wrong is refused at once, or when more has come, or by the deadline of its connection.
    if (whole.state == HeadReader::State::refused && pieces.state == HeadReader::State::more) return 0;
    ISOATLAS_CHECK(whole.state == pieces.state);
    if (whole.state == HeadReader::State::refused) {
        for (const int status : {whole.reader.status(), pieces.reader.status()})  // of several faults, whichever is found first
            ISOATLAS_CHECK(status == 400 || status == 431 || status == 505);
    }
    if (whole.state != HeadReader::State::whole) return 0;
    const RequestHead &head = whole.reader.head(), &again = pieces.reader.head();
    ISOATLAS_CHECK(head.method == again.method && head.target == again.target && head.host == again.host);
    ISOATLAS_CHECK(head.authorization == again.authorization && head.cookie == again.cookie && head.client == again.client);
    ISOATLAS_CHECK(head.keep_alive == again.keep_alive && head.has_body == again.has_body && head.is_old == again.is_old);
    ISOATLAS_CHECK(head.method.size() + head.target.size() + head.host.size() + head.cookie.size() <= kLongestHead);
    const Target target = target_of(head.target);
    ISOATLAS_CHECK(target.path.size() <= head.target.size() && target.words.size() <= head.target.size());
    return 0;
}
