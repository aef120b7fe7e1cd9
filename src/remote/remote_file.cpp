#include "remote/remote_file.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <optional>
#include <utility>

#include "isoatlas/error.h"
#include "remote/range_plan.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kFirstBytes = 64 << 10;                   ///< fetched when a file is opened
constexpr std::int64_t kMostWhole = std::int64_t{32} << 20;      ///< of a server without ranges
constexpr std::int64_t kLeastBytes = 32 << 10;                   ///< of a read that was not announced
constexpr std::int64_t kMostAnnounced = std::int64_t{32} << 20;  ///< fetched ahead at once
constexpr std::int64_t kMostAhead = std::int64_t{4} << 20;       ///< of reads that go on where the last one ended
constexpr int kMostRedirects = 5;

[[noreturn]] void fail(const Address& address, const std::string& what, const std::string& next, Reason reason = Reason::none,
                       const std::string& value = "") {
    throw Error(ErrorKind::input, {.file = shown(address), .what = what, .next = next, .reason = reason, .value = value});
}

[[noreturn]] void no_answer(const Address& address, const HttpAnswer& answer) {
    if (answer.is_certificate) {
        fail(address, "it is not certain that this is " + address.host + ": " + answer.problem,
             "check the address and the clock of this machine; SSL_CERT_FILE names a file of other trusted authorities");
    }
    if (answer.status == 0) fail(address, "no answer: " + answer.problem, "check the address and the connection, and try again");
    fail(address, "an answer that is not what was asked for: " + answer.problem,
         "try again; if it persists, the server or something before it alters files");
}

[[noreturn]] void refused(const Address& address, int status, bool has_token) {
    if (status == 401 || status == 403) {
        fail(address, "the server does not give this file (" + std::to_string(status) + ")",
             has_token ? "check the token: it may have expired" : "if the server takes a bearer token, give it one",
             has_token ? Reason::address_token_refused : Reason::address_token_needed);
    }
    fail(address, "the server answers " + std::to_string(status), status >= 500 ? "try again later" : "check the address");
}

[[noreturn]] void no_ranges(const Address& address, std::int64_t total) {
    const std::string size = total < 0 ? "" : " of " + std::to_string(total) + " bytes";
    fail(address, "the server sends whole files only, and this one" + size + " is too large for that",
         "download it and open the copy, or put it on a server that answers range requests, such as nginx", Reason::no_ranges);
}

/// What tells versions of a file apart.
struct Version {
    std::string etag, last_modified;
    std::int64_t size = 0;
    [[nodiscard]] bool is_certain() const { return (!etag.empty() && !etag.starts_with("W/")) || !last_modified.empty(); }
};

bool is_same(const Version& version, const HttpAnswer& answer) {
    const auto agree = [](const std::string& a, const std::string& b) { return a.empty() || b.empty() || a == b; };
    return (answer.total < 0 || answer.total == version.size) && agree(version.etag, answer.etag) &&
           agree(version.last_modified, answer.last_modified);
}

/// Where a read goes: [offset, offset + size), and which of it is still to come.
class ReadTarget {
public:
    ReadTarget(std::int64_t offset, std::span<std::byte> out) : offset_(offset), out_(out), open_{{offset, offset + std::ssize(out)}} {
        if (out.empty()) open_.clear();
    }
    [[nodiscard]] const std::vector<FileRange>& open() const { return open_; }
    /// Copies what belongs there.
    void put(std::int64_t begin, std::span<const std::byte> bytes) {
        const FileRange range{std::max(begin, offset_), std::min(begin + std::ssize(bytes), offset_ + std::ssize(out_))};
        if (range.bytes() <= 0) return;
        std::memcpy(part(range).data(), bytes.data() + (range.begin - begin), static_cast<std::size_t>(range.bytes()));
        open_ = without(std::move(open_), {&range, 1});
    }
    /// Takes what is in memory of what is to come.
    void take_from(PieceCache& pieces, std::int64_t file) {
        std::vector<FileRange> taken;
        for (FileRange range : open_) {
            range.end = range.begin + static_cast<std::int64_t>(pieces.read(file, range.begin, part(range)));
            if (range.bytes() > 0) taken.push_back(range);
        }
        open_ = without(std::move(open_), taken);
    }

private:
    [[nodiscard]] std::span<std::byte> part(const FileRange& range) const {
        return out_.subspan(static_cast<std::size_t>(range.begin - offset_), static_cast<std::size_t>(range.bytes()));
    }
    std::int64_t offset_;
    std::span<std::byte> out_;
    std::vector<FileRange> open_;
};

/// Releases a lock while it exists.
class Unlocked {
public:
    explicit Unlocked(std::unique_lock<std::mutex>& lock) : lock_(lock) { lock_.unlock(); }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;
    ~Unlocked() { lock_.lock(); }

private:
    std::unique_lock<std::mutex>& lock_;
};

/// Several threads may wait for answers at the same time; what one has asked for, the others wait for.
class RemoteFile final : public File {
public:
    RemoteFile(std::shared_ptr<RemoteShared> shared, Address address, Version version, const HttpAnswer& first)
        : shared_(std::move(shared)), address_(std::move(address)), version_(std::move(version)), id_(shared_->files.fetch_add(1)) {
        if (first.status == 200) {
            whole_ = first.body;
            return;
        }
        if (version_.is_certain()) {
            cached_ = shared_->disk.open(address_.url + "\n" + version_.etag + "\n" + version_.last_modified + "\n" +
                                         std::to_string(version_.size));
        }
        for (const AnswerPart& part : first.parts)
            shared_->pieces.add(id_, part.range.begin,
                                std::span(first.body).subspan(part.place, static_cast<std::size_t>(part.range.bytes())));
    }
    ~RemoteFile() override { shared_->pieces.forget(id_); }

    std::int64_t size() const override { return version_.size; }

    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        if (offset < 0) return -EINVAL;
        out = out.first(static_cast<std::size_t>(std::clamp<std::int64_t>(version_.size - offset, 0, std::ssize(out))));
        if (there(offset, out) == out.size()) return std::ssize(out);
        ReadTarget target(offset, out);
        std::unique_lock lock(mutex_);
        target.take_from(shared_->pieces, id_);  // another thread may have fetched it
        if (target.open().empty()) return std::ssize(out);
        const std::int64_t begin = target.open().front().begin, end = offset + std::ssize(out);
        const bool goes_on = offset <= reached_ && reached_ < end;
        ahead_ = goes_on ? std::min(2 * ahead_, kMostAhead) : kLeastBytes;
        reached_ = end;
        const FileRange wanted{begin, std::min(std::max(end, begin + ahead_), version_.size)};
        while (!target.open().empty()) {
            fetch(lock, {&wanted, 1}, target);
            target.take_from(shared_->pieces, id_);
        }
        return std::ssize(out);
    }

    std::ptrdiff_t read_nowait(std::int64_t offset, std::span<std::byte> out) override {
        out = out.first(static_cast<std::size_t>(std::clamp<std::int64_t>(version_.size - offset, 0, std::ssize(out))));
        return there(offset, out) == out.size() ? std::ssize(out) : -EAGAIN;
    }

    void prefetch(std::int64_t offset, std::int64_t bytes) override {
        const FileRange range{offset, std::min(offset + bytes, version_.size)};
        fetch_ranges({&range, 1});
    }
    void prefetch_ranges(std::span<const FileRange> ranges) override { fetch_ranges(ranges); }

    void fetch_ranges(std::span<const FileRange> ranges) override {
        if (!whole_.empty()) return;
        std::vector<FileRange> wanted;  // what stays in memory until it is read
        std::int64_t left = std::min(kMostAnnounced, shared_->options.memory / 2);
        for (const FileRange& range : ranges) {
            if (left <= 0) break;
            wanted.push_back({range.begin, std::min(range.end, range.begin + left)});
            left -= wanted.back().bytes();
        }
        std::unique_lock lock(mutex_);
        ReadTarget nowhere(0, {});
        fetch(lock, wanted, nowhere);
    }

private:
    /// How many of the bytes are in memory, from the first one on; they are copied.
    std::size_t there(std::int64_t offset, std::span<std::byte> out) {
        if (whole_.empty()) return shared_->pieces.read(id_, offset, out);
        if (!out.empty()) std::memcpy(out.data(), whole_.data() + offset, out.size());
        return out.size();
    }

    std::vector<FileRange> missing(std::span<const FileRange> ranges) const {
        std::vector<FileRange> all;
        for (const FileRange& range : ranges) std::ranges::copy(shared_->pieces.missing(id_, range), std::back_inserter(all));
        return all;
    }

    /// Brings the missing parts of ranges into memory, and into the target. The caller holds the lock, which is released meanwhile.
    void fetch(std::unique_lock<std::mutex>& lock, std::span<const FileRange> ranges, ReadTarget& target) {
        const auto take = [&](std::int64_t begin, std::span<const std::byte> bytes) {
            shared_->pieces.add(id_, begin, bytes);
            target.put(begin, bytes);
        };
        for (const FileRange& range : missing(ranges)) shared_->from_disk += shared_->disk.load(cached_, range, take);
        const std::vector<FileRange> wanted = missing(ranges);
        if (std::vector<FileRange> own = without(wanted, asked_); !own.empty()) {
            const Asked asked(*this, own);
            if (own.size() > 1 && takes_several_) own = fetch_sets(lock, plan_range_sets(own, shared_->options.connections), take);
            std::vector<RangeSet> single;
            for (const FileRange& request : plan_requests(own)) single.push_back({request});
            (void)fetch_sets(lock, single, take);
        }
        answered_.wait(lock, [&] { return without(wanted, asked_) == wanted; });  // what others have asked for
    }

    /// What this thread asks for while it exists. Begins and ends with the lock held.
    class Asked {
    public:
        Asked(RemoteFile& file, std::vector<FileRange> ranges) : file_(file), ranges_(std::move(ranges)) {
            file_.asked_.insert(file_.asked_.end(), ranges_.begin(), ranges_.end());
        }
        Asked(const Asked&) = delete;
        Asked& operator=(const Asked&) = delete;
        ~Asked() {  // ranges of different threads are apart
            std::erase_if(file_.asked_, [this](const FileRange& range) { return std::ranges::find(ranges_, range) != ranges_.end(); });
            file_.answered_.notify_all();
        }

    private:
        RemoteFile& file_;
        std::vector<FileRange> ranges_;
    };

    /// Asks for each set in one request. Returns the ranges that a server which does not answer several in one request has left out.
    template <class Take>
    std::vector<FileRange> fetch_sets(std::unique_lock<std::mutex>& lock, const std::vector<RangeSet>& sets, const Take& take) {
        std::vector<FileRange> left;
        if (sets.empty()) return left;
        std::vector<HttpAnswer> answers;
        {
            const Unlocked meanwhile(lock);
            answers = shared_->client.get(address_, sets, 0);
        }
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const HttpAnswer& answer = answers[i];
            if (sets[i].size() > 1 && (answer.lacks_ranges || answer.status == 200 || answer.status == 416) && is_same(version_, answer)) {
                takes_several_ = false;
                left.insert(left.end(), sets[i].begin(), sets[i].end());
                continue;
            }
            check(answer);
            for (const AnswerPart& part : answer.parts) {
                const auto bytes = std::span(answer.body).subspan(part.place, static_cast<std::size_t>(part.range.bytes()));
                take(part.range.begin, bytes);
                shared_->disk.store(cached_, part.range.begin, bytes);
            }
        }
        return left;
    }

    void check(const HttpAnswer& answer) const {
        const bool has_version = answer.total >= 0 || !answer.etag.empty();
        const bool is_other =
            has_version && (answer.status == 206 || answer.status == 200 || answer.status == 416) && !is_same(version_, answer);
        if (is_other || answer.status == 412) fail(address_, "the file has changed on the server since it was opened", "open it again");
        if (!answer.problem.empty()) no_answer(address_, answer);
        if (answer.status == 200) no_ranges(address_, answer.total);
        if (answer.status != 206) refused(address_, answer.status, !shared_->options.token.empty());
    }

    std::shared_ptr<RemoteShared> shared_;
    Address address_;
    Version version_;
    std::int64_t id_;
    std::vector<std::byte> whole_;  ///< of a server without ranges
    std::mutex mutex_;              ///< for all that follows; not held while answers are waited for
    std::condition_variable answered_;
    std::vector<FileRange> asked_;  ///< on their way, apart
    CachedVersion cached_;
    bool takes_several_ = true;                       ///< ranges in one request, as far as is known
    std::int64_t reached_ = 0, ahead_ = kLeastBytes;  ///< the end of the last read; bytes to fetch when the next one goes on there
};

/// An open file that several users share.
class SharedFile final : public File {
public:
    explicit SharedFile(std::shared_ptr<File> file) : file_(std::move(file)) {}
    std::int64_t size() const override { return file_->size(); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override { return file_->read_at(offset, out); }
    std::ptrdiff_t read_nowait(std::int64_t offset, std::span<std::byte> out) override { return file_->read_nowait(offset, out); }
    void prefetch(std::int64_t offset, std::int64_t bytes) override { file_->prefetch(offset, bytes); }
    void prefetch_ranges(std::span<const FileRange> ranges) override { file_->prefetch_ranges(ranges); }
    void fetch_ranges(std::span<const FileRange> ranges) override { file_->fetch_ranges(ranges); }

private:
    std::shared_ptr<File> file_;
};

/// The answer for the first bytes, and where redirects on the same host led to.
std::pair<Address, HttpAnswer> first_answer(RemoteShared& shared, const Address& given) {
    Address address = given;
    const RangeSet first{{0, kFirstBytes}};
    for (int redirects = 0;; ++redirects) {
        HttpAnswer answer = std::move(shared.client.get(address, {&first, 1}, kMostWhole)[0]);
        if (answer.status < 300 || answer.status > 399 || answer.location.empty()) return {address, std::move(answer)};
        const Address to = redirected(address, answer.location);
        if (!stays_on_host(given, to)) {
            fail(given, "the server redirects to another host, " + to.scheme + "://" + to.host,
                 "if you trust that host, give the address that it redirects to", Reason::redirected_elsewhere, to.host);
        }
        if (redirects == kMostRedirects) fail(given, "the server redirects in a circle", "check the address");
        address = to;
    }
}

}  // namespace

RemoteShared::RemoteShared(const RemoteOptions& given)
    : options(given), client(options), pieces(options.memory), disk(remote_cache_folder(options), options.disk_cache) {}

namespace {

std::shared_ptr<File> open_now(const std::shared_ptr<RemoteShared>& shared, const std::string& given) {
    auto [address, answer] = first_answer(*shared, parse_address(given));
    if (answer.status == 416) {  // an empty file has no first byte
        answer.status = 200, answer.total = 0, answer.problem.clear();
        answer.body.clear();
    }
    if (answer.status == 404 || answer.status == 410) return nullptr;
    if (!answer.problem.empty()) no_answer(address, answer);
    if (answer.status == 200 && answer.total != std::ssize(answer.body)) no_ranges(address, answer.total);
    if (answer.status != 200 && answer.status != 206) refused(address, answer.status, !shared->options.token.empty());
    if (answer.total < 0) fail(address, "the server does not say how long the file is", "download it and open the copy");
    Version version{answer.etag, answer.last_modified, answer.total};
    return std::make_shared<RemoteFile>(shared, std::move(address), std::move(version), answer);
}

}  // namespace

std::unique_ptr<File> open_remote_file(const std::shared_ptr<RemoteShared>& shared, const std::string& given) {
    std::shared_ptr<File> file = shared->recent.find(given);
    if (file == nullptr) {
        file = open_now(shared, given);
        if (file == nullptr) return nullptr;
        shared->recent.add(given, file);
    }
    return std::make_unique<SharedFile>(std::move(file));
}

std::shared_ptr<File> RecentFiles::find(const std::string& address) {
    const std::scoped_lock lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    std::erase_if(files_, [&](const Recent& recent) { return now - recent.opened > kRecent; });
    const auto found = std::ranges::find(files_, address, &Recent::address);
    return found == files_.end() ? nullptr : found->file;
}

void RecentFiles::forget() {
    const std::scoped_lock lock(mutex_);
    files_.clear();
}

void RecentFiles::add(const std::string& address, std::shared_ptr<File> file) {
    const std::scoped_lock lock(mutex_);
    if (files_.size() == kMostRecent) files_.pop_front();
    files_.push_back({address, std::move(file), std::chrono::steady_clock::now()});
}

bool exists_remotely(RemoteShared& shared, const std::string& given) {
    try {
        const HttpAnswer answer = first_answer(shared, parse_address(given)).second;
        return answer.status == 206 || answer.status == 200 || answer.status == 416;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) throw;
        return false;
    }
}

}  // namespace isoatlas
