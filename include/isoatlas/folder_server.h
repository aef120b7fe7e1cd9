// FolderServer: the files of a folder for programs that read parts of them by HTTP, such as isoatlas with an address (remote.h).
#pragma once

#include <memory>
#include <string>

namespace isoatlas {

/// Answers GET and HEAD for regular files below a folder, whole, a range, or several in one response (multipart/byteranges). Listens on
/// 127.0.0.1 alone: other machines reach it through a tunnel, or a web server serves the folder. Links that lead outside are not followed;
/// names that begin with "." are not served, but for the keys of Zarr. Each file has an ETag of its time of change and size.
class FolderServer {
public:
    /// port 0: any that is free. token: what requests must carry as "Authorization: Bearer TOKEN"; empty: nothing. reader: the site whose
    /// pages may read the files in a browser (CORS), such as "https://example.org"; "*": those of every site; empty: none.
    /// Throws Error: usage (reader is not the origin of a site), input (not a folder), resource (the port is taken).
    FolderServer(const std::string& folder, int port, const std::string& token = "", const std::string& reader = "");
    ~FolderServer();
    FolderServer(const FolderServer&) = delete;
    FolderServer& operator=(const FolderServer&) = delete;

    /// "http://127.0.0.1:PORT"
    [[nodiscard]] std::string address() const;
    [[nodiscard]] int port() const;
    /// Runs until stop() is called, from any thread.
    void run();
    void stop();

private:
    class Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
