#include "isoatlas/folder_server.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"
#include "server/byte_ranges.h"
#include "server/network.h"
#include "server/response.h"
#include "server/secret.h"
#include "server/target.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFilePiece = 256 << 10;
constexpr std::string_view kBoundary = "isoatlas-parts-4f0d1c6a9b";
constexpr std::string_view kBytesType = "application/octet-stream";
constexpr std::string_view kPartsType = "multipart/byteranges; boundary=isoatlas-parts-4f0d1c6a9b";

std::string not_served(int status) { return last_answer({.status = status, .type = "text/plain"}, "not served\n"); }

/// Pages of other sites reach a local port under a name of theirs.
bool is_local(std::string_view host) {
    host = host.substr(0, host.rfind(':'));
    return host == "127.0.0.1" || host == "localhost";
}

/// "https://host" or "http://host", perhaps with a port, as browsers send it; or "*".
bool is_origin(std::string_view text) {
    if (text == "*") return true;
    const std::size_t scheme = text.starts_with("https://") ? 8 : text.starts_with("http://") ? 7 : text.size();
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == ':' || c == '[' || c == ']';
    };
    return scheme < text.size() && std::ranges::all_of(text.substr(scheme), fits);
}

/// A part of a response: text, then bytes of the file.
struct BodyPart {
    std::string text;
    FileRange range;
};

struct FileResponse {
    ResponseHead head;
    std::vector<BodyPart> parts;
};

std::string content_range(const FileRange& range, std::int64_t size) {
    return "bytes " + std::to_string(range.begin) + "-" + std::to_string(range.end - 1) + "/" + std::to_string(size);
}

/// Several ranges in one body.
std::vector<BodyPart> body_of(const std::vector<FileRange>& ranges, std::int64_t size) {
    const std::string mark = "\r\n--" + std::string(kBoundary);
    std::vector<BodyPart> parts;
    for (const FileRange& range : ranges) {
        parts.push_back(
            {mark + "\r\nContent-Type: " + std::string(kBytesType) + "\r\nContent-Range: " + content_range(range, size) + "\r\n\r\n",
             range});
    }
    parts.push_back({mark + "--\r\n", {}});
    return parts;
}

FileResponse response_to(const std::string& field, std::int64_t size, const std::string& etag) {
    FileResponse response{.head = {.type = kBytesType, .has_ranges = true}, .parts = {}};
    response.head.fields.emplace_back("ETag", etag);
    const std::optional<std::vector<FileRange>> ranges = byte_ranges(field, size);
    if (!ranges) {
        response.parts = {{"", {0, size}}};
    } else if (ranges->empty()) {
        response.head.status = 416;
        response.head.fields.emplace_back("Content-Range", "bytes */" + std::to_string(size));
    } else if (ranges->size() == 1) {
        response.head.status = 206;
        response.head.fields.emplace_back("Content-Range", content_range(ranges->front(), size));
        response.parts = {{"", ranges->front()}};
    } else {
        response.head.status = 206, response.head.type = kPartsType;
        response.parts = body_of(*ranges, size);
    }
    std::size_t length = 0;
    for (const BodyPart& part : response.parts) length += part.text.size() + static_cast<std::size_t>(part.range.bytes());
    response.head.length = length;
    return response;
}

/// False: the client has left, or the file has become shorter.
bool send_part(const Peer& peer, File& file, const std::string& path, const BodyPart& part) {
    if (!part.text.empty() && !peer.send(part.text, true)) return false;
    std::vector<std::byte> piece;
    for (std::int64_t at = part.range.begin; at < part.range.end; at += std::ssize(piece)) {
        piece.resize(static_cast<std::size_t>(std::min<std::int64_t>(kFilePiece, part.range.end - at)));
        if (read_available(file, path, at, piece) < piece.size()) return false;
        if (!peer.send({reinterpret_cast<const char*>(piece.data()), piece.size()})) return false;
    }
    return true;
}

}  // namespace

class FolderServer::Data {
public:
    Data(const std::string& folder, int port, std::string token, std::string reader)
        : folder_(fs::path(file_system().resolved(folder))),
          token_(std::move(token)),
          reader_(std::move(reader)),
          network_(port, false,
                   {.at_the_door = [this](const RequestHead& head) { return at_the_door(head); },
                    .refusal = not_served,
                    .answer = [this](const RequestHead& head, const std::string&, const Peer& peer) { return answer(head, peer); }}) {}

    Network& network() { return network_; }

private:
    /// May a page of another site read the answer?
    [[nodiscard]] bool may_read(const RequestHead& head) const {
        return !head.origin.empty() && (reader_ == "*" || head.origin == reader_);
    }
    /// What tells a browser so; a request with more than a range is asked for first, without a token.
    void allow_reader(const RequestHead& head, ResponseHead& response) const {
        if (reader_.empty()) return;
        response.fields.emplace_back("Vary", "Origin");
        if (!may_read(head)) return;
        response.fields.emplace_back("Access-Control-Allow-Origin", reader_);
        response.fields.emplace_back("Access-Control-Expose-Headers", "Accept-Ranges, Content-Length, Content-Range, ETag");
        if (head.method != "OPTIONS") return;
        response.fields.emplace_back("Access-Control-Allow-Methods", "GET, HEAD");
        response.fields.emplace_back("Access-Control-Allow-Headers", "Authorization, Range");
        response.fields.emplace_back("Access-Control-Allow-Private-Network", "true");
    }

    [[nodiscard]] std::optional<std::string> at_the_door(const RequestHead& head) const {
        if (head.method == "OPTIONS" && !head.has_body && is_local(head.host) && may_read(head)) return std::nullopt;
        if ((head.method != "GET" && head.method != "HEAD") || head.has_body) return not_served(405);
        if (!is_local(head.host)) return not_served(421);
        if (!token_.empty() && !is_secret(head.authorization, "Bearer " + token_)) return not_served(401);
        return std::nullopt;
    }

    /// The file of a target; empty: there is none that is served.
    [[nodiscard]] std::string path_of(const std::string& target) const {
        const fs::path relative = fs::path(target_of(target).path).relative_path();
        for (const fs::path& word : relative) {
            const std::string name = word.string();
            if (name.empty() || (name.starts_with('.') && !name.starts_with(".z"))) return {};  // .zarray, .zgroup, .zattrs
        }
        const fs::path real = file_system().resolved((folder_ / relative).string());
        const auto [own, rest] = std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end());
        return own == folder_.end() && rest != real.end() && file_exists(real.string()) ? real.string() : std::string();
    }

    bool answer(const RequestHead& head, const Peer& peer) const try {
        const std::string path = head.method == "OPTIONS" ? "" : path_of(head.target);
        if (path.empty()) {
            ResponseHead none{.status = 404, .type = "text/plain", .length = 0, .fields = {}, .keep_alive = head.keep_alive};
            if (head.method == "OPTIONS") none.status = 200, none.type = {};
            allow_reader(head, none);
            return peer.send(text_of(none)) && head.keep_alive;
        }
        const std::unique_ptr<File> file = open_file(path);
        std::error_code ignored;
        const auto time = fs::last_write_time(path, ignored).time_since_epoch().count();
        FileResponse response =
            response_to(head.range, file->size(), "\"" + std::to_string(time) + "-" + std::to_string(file->size()) + "\"");
        response.head.keep_alive = head.keep_alive;
        allow_reader(head, response.head);
        if (!peer.send(text_of(response.head), head.method != "HEAD" && *response.head.length > 0)) return false;
        if (head.method == "HEAD") return head.keep_alive;
        for (const BodyPart& part : response.parts) {
            if (!send_part(peer, *file, path, part)) return false;
        }
        return head.keep_alive;
    } catch (const Error&) {
        (void)peer.send(not_served(404));
        return false;
    }

    fs::path folder_;
    std::string token_;
    std::string reader_;  ///< origin of pages that may read; empty: none
    Network network_;
};

FolderServer::FolderServer(const std::string& folder, int port, const std::string& token, const std::string& reader) {
    if (!reader.empty() && !is_origin(reader)) {
        throw Error(ErrorKind::usage, {.what = "\"" + reader + "\" is not the origin of a site",
                                       .expected = "https://host or http://host:port, without a path; * for every site"});
    }
    if (!is_directory(folder)) {
        throw Error(ErrorKind::input, {.file = folder, .what = "is not a folder", .next = "name the folder that holds the files"});
    }
    data_ = std::make_unique<Data>(folder, port, token, reader);
}
FolderServer::~FolderServer() = default;
std::string FolderServer::address() const { return "http://127.0.0.1:" + std::to_string(port()); }
int FolderServer::port() const { return data_->network().port(); }
void FolderServer::run() { data_->network().run(); }
void FolderServer::stop() { data_->network().stop(); }

}  // namespace isoatlas
