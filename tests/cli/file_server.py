"""A server of static files with range requests, and with the faults of real ones. For tests.

    with FileServer(folder, faults=...) as server: server.address + "/name"
"""
import http.server
import re
import socket
import ssl
import threading
import time
from pathlib import Path


class FileServer:
    """faults: a function of (server, handler, path, number of the request) that may answer itself and then returns True.
    certificate: path of a file with certificate and key; then it is https."""

    def __init__(self, folder, faults=None, ranges=True, several=True, etags=True, round_trip=0.0, bytes_a_second=0.0, token=None,
                 certificate=None):
        self.folder, self.faults, self.ranges, self.etags, self.token = Path(folder), faults, ranges, etags, token
        self.several = several
        self.round_trip, self.bytes_a_second = round_trip, bytes_a_second
        self.lock, self.requests, self.bytes, self.seen = threading.Lock(), 0, 0, []
        self.line = threading.Lock()  # the one line to the client, which all connections share
        owner = self

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"
            disable_nagle_algorithm = True  # else head and body of an answer wait for each other

            def do_GET(self):
                owner.answer(self)

            def log_message(self, *_):
                pass

        class Quiet(http.server.ThreadingHTTPServer):
            request_queue_size = 64

            def handle_error(self, request, client_address):  # a client that leaves is no news
                pass

        self.server = Quiet(("127.0.0.1", 0), Handler)
        self.server.daemon_threads = True
        if certificate is not None:
            secure = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            secure.load_cert_chain(certificate)
            self.server.socket = secure.wrap_socket(self.server.socket, server_side=True, do_handshake_on_connect=False)
        self.address = f"http{'' if certificate is None else 's'}://127.0.0.1:{self.server.server_address[1]}"
        self.thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02})

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        if self.thread.is_alive():
            self.server.shutdown()
            self.thread.join()
            self.server.server_close()

    def answer(self, handler):
        with self.lock:
            self.requests += 1
            number = self.requests
            self.seen.append((handler.path, dict(handler.headers)))
        if self.round_trip:
            time.sleep(self.round_trip)
        if self.faults is not None and self.faults(self, handler, handler.path, number):
            return
        if self.token is not None and handler.headers.get("Authorization") != f"Bearer {self.token}":
            self.send(handler, 401, b"who are you?")
            return
        self.send_file(handler)

    def path_of(self, handler):
        path = (self.folder / handler.path.split("?")[0].lstrip("/")).resolve()
        return path if path.is_file() and self.folder.resolve() in path.parents else None

    def send_file(self, handler, part=None, **headers):
        """part: of the body, to be sent before the connection is closed."""
        path = self.path_of(handler)
        if path is None:
            self.send(handler, 404, b"not here")
            return
        status = path.stat()
        size = status.st_size
        if self.etags:
            headers = {"ETag": f'"{status.st_mtime_ns}-{size}"', **headers}
        parts = re.fullmatch(r"bytes=(\d+-\d+(?:,\d+-\d+)+)", handler.headers.get("Range", ""))
        if parts and self.ranges and self.several:
            self.send_parts(handler, path, [tuple(map(int, one.split("-"))) for one in parts[1].split(",")], part, headers)
            return
        found = re.fullmatch(r"bytes=(\d+)-(\d+)", handler.headers.get("Range", ""))
        if not found or not self.ranges:
            self.send(handler, 200, path.read_bytes(), part, **headers)
            return
        begin, end = int(found[1]), min(int(found[2]) + 1, size)
        if begin >= size:
            self.send(handler, 416, b"", **{"Content-Range": f"bytes */{size}"})
            return
        with open(path, "rb") as file:
            file.seek(begin)
            data = file.read(end - begin)
        self.send(handler, 206, data, part, **{"Content-Range": f"bytes {begin}-{end - 1}/{size}", **headers})

    def send_parts(self, handler, path, ranges, part, headers):
        size, boundary, body = path.stat().st_size, "a-boundary-of-parts", b""
        with open(path, "rb") as file:
            for begin, last in ranges:
                file.seek(begin)
                data = file.read(min(last + 1, size) - begin)
                body += (f"\r\n--{boundary}\r\nContent-Type: application/octet-stream\r\n"
                         f"Content-Range: bytes {begin}-{begin + len(data) - 1}/{size}\r\n\r\n").encode() + data
        body += f"\r\n--{boundary}--\r\n".encode()
        self.send(handler, 206, body, part, **{"Content-Type": f"multipart/byteranges; boundary={boundary}", **headers})

    def send(self, handler, status, body, part=None, **headers):
        handler.send_response(status)
        handler.send_header("Content-Length", str(len(body)))
        for name, value in headers.items():
            handler.send_header(name, value)
        handler.end_headers()
        sent = body if part is None else body[:part]
        try:
            for begin in range(0, len(sent), 16384):
                piece = sent[begin:begin + 16384]
                if self.bytes_a_second:
                    with self.line:
                        time.sleep(len(piece) / self.bytes_a_second)
                handler.wfile.write(piece)
                with self.lock:
                    self.bytes += len(piece)
            handler.wfile.flush()
        except OSError:
            part = 0
        if part is not None:
            handler.close_connection = True
            try:
                handler.connection.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
