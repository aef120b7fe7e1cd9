// A disk in memory that forgets in a power failure what was not synced.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/file_system.h"

namespace isoatlas::test {

class MemoryFiles final : public FileSystem {
public:
    /// What a power failure takes. Names: renames and removals; they may reach the disk before or after the content of the files.
    enum class Loss { contents_and_names, contents, names, every_second_write };

    /// Are there files without names?
    explicit MemoryFiles(bool has_unnamed = true) : has_unnamed_(has_unnamed) {}

    /// A file that is safely on the disk.
    void put(const std::string& path, std::string content) {
        names_[path] = kept_names_[path] = std::make_shared<Node>(Node{content, std::move(content), {}, 0644, false});
    }
    [[nodiscard]] bool has(const std::string& path) const { return names_.contains(path); }
    [[nodiscard]] const std::string& content(const std::string& path) const { return names_.at(path)->now; }
    /// To change it in place.
    [[nodiscard]] std::string& content(const std::string& path) { return names_.at(path)->now; }
    [[nodiscard]] std::size_t count() const { return names_.size(); }
    /// Is there a file whose name ends like that?
    [[nodiscard]] bool has_like(const std::string& end) const {
        return std::any_of(names_.begin(), names_.end(), [&](const auto& named) { return named.first.ends_with(end); });
    }

    /// Everything that was open is gone: no File of before may be used any more.
    void fail_power(Loss loss) {
        if (loss == Loss::contents_and_names || loss == Loss::names) names_ = kept_names_;
        for (const auto& [name, node] : names_) {
            node->locked = false;
            if (loss == Loss::names) continue;
            node->now = node->kept;
            for (std::size_t i = 1; i < node->lost.size() && loss == Loss::every_second_write; i += 2) node->lost[i].apply(node->now);
            node->kept = node->now;
            node->lost.clear();
        }
        kept_names_ = names_;
    }

    FileStatus status(const std::string& path) override {
        if (path == "." || path.ends_with("/..") || folders_.contains(path)) return {.kind = FileStatus::Kind::folder, .mode = 0755};
        if (!has(path)) return {.error = -ENOENT};
        const unsigned mode = names_.at(path)->mode;
        return {.kind = FileStatus::Kind::regular, .mode = mode, .writable = (mode & 0200U) != 0};
    }
    OpenedFile open(const std::string& path) override {
        if (!has(path)) return {nullptr, -ENOENT};
        return {std::make_unique<Opened>(*this, names_.at(path), false), 0};
    }
    OpenedFile create(const std::string& path, unsigned) override {
        if (has(path)) return {nullptr, -EEXIST};
        return {std::make_unique<Opened>(*this, names_[path] = std::make_shared<Node>(), true), 0};
    }
    OpenedFile create_unnamed(const std::string&, unsigned) override {
        if (!has_unnamed_) return {nullptr, -EOPNOTSUPP};
        return {std::make_unique<Opened>(*this, std::make_shared<Node>(), true), 0};
    }
    OpenedFile lock(const std::string& path) override {
        std::shared_ptr<Node>& node = names_[path];
        if (!node) node = std::make_shared<Node>();
        if (node->locked) return {nullptr, -EWOULDBLOCK};
        return {std::make_unique<Opened>(*this, node, true), 0};
    }
    void remove_abandoned(const std::string& path) override {
        if (has(path) && !names_.at(path)->locked) names_.erase(path);
    }
    int rename(const std::string& from, const std::string& to) override {
        if (!has(from)) return -ENOENT;
        names_[to] = names_[from];
        names_.erase(from);
        return 0;
    }
    int remove(const std::string& path) override { return names_.erase(path) == 1 ? 0 : -ENOENT; }
    int make_folder(const std::string& path) override { return folders_.insert(path).second ? 0 : -EEXIST; }
    int remove_folder(const std::string& path) override {
        if (!entries(path, 1).empty()) return -ENOTEMPTY;
        return folders_.erase(path) == 1 ? 0 : -ENOENT;
    }
    std::vector<std::string> entries(const std::string& path, std::size_t max) override {
        std::vector<std::string> found;
        for (const auto& [name, node] : names_) {
            if (folder_of(name) == path && found.size() < max) found.push_back(name.substr(name.rfind('/') + 1));
        }
        return found;
    }
    int sync_folder(const std::string& path) override {
        const auto lies_there = [&](const auto& named) { return folder_of(named.first) == path; };
        std::erase_if(kept_names_, lies_there);
        std::copy_if(names_.begin(), names_.end(), std::inserter(kept_names_, kept_names_.end()), lies_there);
        return 0;
    }

private:
    static std::string folder_of(const std::string& path) {
        const std::size_t slash = path.rfind('/');
        return slash == std::string::npos ? "." : path.substr(0, slash);
    }

    struct Change {  ///< a write, or a new size
        std::size_t offset;
        std::string bytes;
        bool is_size;
        void apply(std::string& content) const {
            if (is_size || content.size() < offset + bytes.size()) content.resize(offset + bytes.size(), '\0');
            std::memcpy(content.data() + offset, bytes.data(), bytes.size());
        }
    };
    struct Node {
        std::string now, kept;     ///< kept: what would survive
        std::vector<Change> lost;  ///< what would not
        unsigned mode = 0644;
        bool locked = false;
        void change(Change what) {
            what.apply(now);
            lost.push_back(std::move(what));
        }
    };

    class Opened final : public File {
    public:
        Opened(MemoryFiles& disk, std::shared_ptr<Node> node, bool owns) : disk_(disk), node_(std::move(node)), owns_(owns) {
            if (owns_) node_->locked = true;
        }
        Opened(const Opened&) = delete;
        Opened& operator=(const Opened&) = delete;
        ~Opened() override {
            if (owns_) node_->locked = false;
        }
        std::int64_t size() const override { return static_cast<std::int64_t>(node_->now.size()); }
        std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
            if (offset >= size()) return 0;
            const std::size_t count = std::min(out.size(), node_->now.size() - static_cast<std::size_t>(offset));
            std::memcpy(out.data(), node_->now.data() + offset, count);
            return static_cast<std::ptrdiff_t>(count);
        }
        std::ptrdiff_t write_at(std::int64_t offset, std::span<const std::byte> bytes) override {
            node_->change({static_cast<std::size_t>(offset), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, false});
            return static_cast<std::ptrdiff_t>(bytes.size());
        }
        int resize(std::int64_t size) override {
            node_->change({static_cast<std::size_t>(size), {}, true});
            return 0;
        }
        int reserve(std::int64_t) override { return 0; }
        int set_mode(unsigned mode) override {
            node_->mode = mode;
            return 0;
        }
        int take_name(const std::string& path) override {
            if (disk_.has(path)) return -EEXIST;
            disk_.names_[path] = node_;
            return 0;
        }
        int sync() override {
            node_->kept = node_->now;
            node_->lost.clear();
            return 0;
        }

    private:
        MemoryFiles& disk_;
        std::shared_ptr<Node> node_;
        bool owns_;
    };

    bool has_unnamed_;
    std::map<std::string, std::shared_ptr<Node>> names_, kept_names_;
    std::set<std::string> folders_;  ///< they survive
};

}  // namespace isoatlas::test
