// One request of libcurl and what has come of its answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <curl/curl.h>

#include "base/file_system.h"
#include "isoatlas/remote.h"
#include "remote/address.h"
#include "remote/http_client.h"

namespace isoatlas {

class HttpTransfer {
public:
    HttpTransfer(const Address& address, RangeSet ranges, std::int64_t max_whole, const RemoteOptions& options);
    ~HttpTransfer();
    HttpTransfer(const HttpTransfer&) = delete;
    HttpTransfer& operator=(const HttpTransfer&) = delete;

    [[nodiscard]] CURL* handle() const { return handle_; }
    /// After libcurl is done with it: judges the answer.
    void finish(CURLcode code);
    [[nodiscard]] HttpAnswer& answer() { return answer_; }
    /// May the same request be answered better?
    [[nodiscard]] bool is_worth_repeating() const;
    /// Seconds that the server asks to wait; 0: it does not.
    [[nodiscard]] double retry_after() const { return retry_after_; }
    [[nodiscard]] std::int64_t received() const { return received_; }

private:
    static std::size_t on_header(char* text, std::size_t size, std::size_t count, void* self);
    static std::size_t on_body(char* bytes, std::size_t size, std::size_t count, void* self);
    void take_header(std::string line);
    [[nodiscard]] bool take_body(const char* bytes, std::size_t count);
    [[nodiscard]] std::int64_t most_bytes(long status) const;
    void judge_ranges();

    CURL* handle_;
    curl_slist* headers_ = nullptr;
    RangeSet ranges_;
    FileRange content_range_;  ///< of a single part
    std::string content_type_;
    std::int64_t max_whole_;
    HttpAnswer answer_;
    std::int64_t received_ = 0, content_length_ = -1;
    double retry_after_ = 0;
    bool is_refused_ = false;  ///< we ended it: more came than was asked for, or nothing that is wanted
    CURLcode code_ = CURLE_OK;
    char message_[CURL_ERROR_SIZE] = {};
};

}  // namespace isoatlas
