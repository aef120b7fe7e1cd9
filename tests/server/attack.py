#!/usr/bin/env python3
"""What a neighbour without the token can do to `isoatlas view`: while each attack is held, its owner is answered, and the memory stays.

Bounded in requests, bytes and time, on 127.0.0.1. Prints a line for each attack: what the owner waited for at most, and how much the memory has
grown at its peak. The verdict on the owner is that he is answered while the attack is held, not how soon: machines are busy.
"""
import contextlib
import http.client
import json
import pathlib
import resource
import socket
import threading
import time
import unittest

import harness
import served

MIB = 1 << 20
MOST_GROWTH = 24 * MIB        # 256 strangers of 16 KiB are 4; the rest is the owner's answers and threads
MOST_SENT = 32 * MIB          # what the system keeps between two programs is not ours
OWNER_ASKS = 8


class Attacked(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "32"]}
    limits = {}   # of the server: resource.RLIMIT_... -> bytes

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        assert cls.start(["build", "demo.nrrd", "-o", "demo.atlas", "--quiet"]).returncode == 0

    def setUp(self):
        self.begin()
        self.owner_is_answered()

    def begin(self):
        def limit():
            for which, size in self.limits.items():
                resource.setrlimit(which, (size, size))
        self.viewer = served.Viewer(self.folder, "demo.atlas", "--memory", "200M", preexec_fn=limit)
        self.viewer.until("open")
        self.port, self.token, self.process = self.viewer.port, self.viewer.token, self.viewer.process

    @contextlib.contextmanager
    def without_memory(self):
        limits = resource.prlimit(self.process.pid, resource.RLIMIT_AS)
        resource.prlimit(self.process.pid, resource.RLIMIT_AS, (self.resident("VmSize"), limits[1]))
        yield
        resource.prlimit(self.process.pid, resource.RLIMIT_AS, limits)

    def tearDown(self):
        self.assertIsNone(self.process.poll(), "the server has ended")
        code, said = self.viewer.stop()
        self.assertEqual(code, 0, said)
        self.assertFalse(served.token_file(self.port).exists())

    # --- the owner, and the memory

    def owner_is_answered(self):
        """The longest wait of some requests, each on a connection of its own, none repeated."""
        longest = 0
        for i in range(OWNER_ASKS):
            begun = time.monotonic()
            status, _, body = self.viewer.ask(f"/api/preview?tau={100 + i}")
            longest = max(longest, time.monotonic() - begun)
            self.assertEqual(status, 200, body)
        return longest

    def resident(self, name):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return 1024 * int(next(line for line in status.splitlines() if line.startswith(name)).split()[1])

    @contextlib.contextmanager
    def attack(self, name):
        """Inside, the attack is made and held; then the owner asks, and it is let go."""
        before = self.resident("VmRSS")
        with contextlib.suppress(OSError):
            pathlib.Path(f"/proc/{self.process.pid}/clear_refs").write_text("5")   # the peak begins anew
        with contextlib.ExitStack() as held:
            yield held
            longest = self.owner_is_answered()
        growth = self.resident("VmHWM") - before
        print(f"{type(self).__name__:8} {name:34} owner {1000 * longest:6.1f} ms   peak {growth / MIB:+6.1f} MiB of {before / MIB:.0f}", flush=True)
        if not harness.SANITIZED:
            self.assertLess(growth, MOST_GROWTH, name)

    # --- a stranger

    def connect(self, held):
        connection = held.enter_context(socket.create_connection(("127.0.0.1", self.port), timeout=10))
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection

    def host(self):
        return f"Host: 127.0.0.1:{self.port}\r\n"

    def owners(self, path):
        return f"GET {path} HTTP/1.1\r\n{self.host()}Authorization: Bearer {self.token}\r\n"

    @staticmethod
    def rest(connection):
        """What comes until the other end closes; what was not read there may have made it a reset."""
        answer = b""
        with contextlib.suppress(ConnectionError):
            while piece := connection.recv(65536):
                answer += piece
        return answer

    def asked(self, text):
        with contextlib.ExitStack() as held:
            connection = self.connect(held)
            with contextlib.suppress(ConnectionError):
                connection.sendall(text.encode())
            return self.rest(connection)

    def status(self, text):
        answer = self.asked(text)
        return int(answer.split()[1]) if answer else None

    def pour(self, connection, head, piece):
        """Sends without an end until the server has had enough; the bytes that went."""
        sent = 0
        with contextlib.suppress(ConnectionError):
            connection.sendall(head)
            while sent < 2 * MOST_SENT:
                connection.sendall(piece)
                sent += len(piece)
        return sent

    # --- the attacks

    def test_endless_requests(self):
        for name, head, piece in (("endless header line", f"GET / HTTP/1.1\r\n{self.host()}X: ", "a" * 65536),
                                  ("endless headers", f"GET / HTTP/1.1\r\n{self.host()}", "X: y\r\n" * 10000),
                                  ("endless request line", "GET /", "a" * 65536),
                                  ("endless empty lines", "", "\r\n" * 30000),
                                  ("endless body", f"GET / HTTP/1.1\r\n{self.host()}Content-Length: 99999999999\r\n\r\n", "a" * 65536),
                                  ("endless scene", f"PUT /api/scene HTTP/1.1\r\n{self.host()}Content-Length: 4000000\r\n\r\n", "a" * 65536),
                                  ("endless chunks", f"GET / HTTP/1.1\r\n{self.host()}Transfer-Encoding: chunked\r\n\r\n", "5\r\nabcde\r\n" * 6000)):
            with self.attack(name) as held:
                for _ in range(4):
                    self.assertLess(self.pour(self.connect(held), head.encode(), piece.encode()), MOST_SENT, name)

    def test_slow_requests(self):
        """Each byte comes in time, the request does not: every one of 200 is cut off, whatever it sends."""
        with self.attack("200 slow requests") as held:
            connections = [self.connect(held) for _ in range(200)]
            for connection in connections:
                connection.sendall(f"GET / HTTP/1.1\r\n{self.host()}X: ".encode())
            ended = threading.Event()

            def drip(left):
                while left and not ended.wait(0.25):
                    for connection in list(left):
                        try:
                            connection.sendall(b"a")
                        except OSError:
                            left.remove(connection)
            dripping = threading.Thread(target=drip, args=(list(connections),))
            dripping.start()
            held.callback(dripping.join)
            held.callback(ended.set)
            self.owner_is_answered()
            dripping.join(60)
            self.assertFalse(dripping.is_alive(), "some are still held")

    def test_held_connections(self):
        for name, text in (("500 silent connections", ""), ("500 half requests", f"GET / HTTP/1.1\r\n{self.host()}X: " + "a" * 16000)):
            with self.attack(name) as held:
                for _ in range(500):
                    with contextlib.suppress(ConnectionError):
                        self.connect(held).sendall(text.encode())

    def test_a_flood_of_connections(self):
        ended = threading.Event()

        def flood():
            for _ in range(3000):
                if ended.is_set():
                    return
                with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", self.port), timeout=10) as connection:
                    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
        with self.attack("flood of connections") as held:
            threads = [threading.Thread(target=flood) for _ in range(4)]
            for thread in threads:
                thread.start()
                held.callback(thread.join)
            held.callback(ended.set)

    def test_ranges_are_not_answered_as_ranges(self):
        page = self.asked(self.owners("/") + "Connection: close\r\n\r\n")
        for name, ranges in (("giant range", "1" * 4000), ("many ranges", ",".join(["0-0"] * 1000)), ("range of the end", "-99999999999999")):
            field = f"Range: bytes={ranges}\r\n\r\n"
            with self.attack("160 x " + name) as held:
                connections = [self.connect(held) for _ in range(160)]
                for connection in connections:
                    connection.sendall(f"GET / HTTP/1.1\r\n{self.host()}{field}".encode())
                self.assertEqual({self.rest(connection).split()[1] for connection in connections}, {b"403"})
            self.assertEqual(self.asked(self.owners("/") + "Connection: close\r\n" + field), page)

    def test_half_closed_connections(self):
        with self.attack("100 half-closed connections") as held:
            for text, answers in (("GET / HTTP", {None}), (f"GET / HTTP/1.1\r\n{self.host()}\r\n", {b"403"}),
                                  (self.owners("/api/preview?tau=100") + "\r\n", {b"200", b"409"})):
                connections = [self.connect(held) for _ in range(33)]
                for connection in connections:
                    connection.sendall(text.encode())
                    connection.shutdown(socket.SHUT_WR)
                got = {(answer.split() + [None, None])[1] if (answer := self.rest(connection)) else None for connection in connections}
                self.assertLessEqual(got, answers)

    def test_requests_one_after_the_other(self):
        with self.attack("requests sent at once") as held:
            stranger = self.connect(held)
            with contextlib.suppress(ConnectionError):
                stranger.sendall(f"GET / HTTP/1.1\r\n{self.host()}\r\n".encode() * 1000)
            self.assertEqual(self.rest(stranger).count(b"HTTP/1.1 403 "), 1)
            owner = self.connect(held)
            paths = [f"/api/objects?tau={10 * i}" for i in range(20)]
            owner.sendall("".join(self.owners(path) + "\r\n" for path in paths).encode() + (self.owners("/none") + "Connection: close\r\n\r\n").encode())
            answer = self.rest(owner)
            self.assertEqual(answer.count(b"HTTP/1.1 200 "), 20)
            self.assertEqual([float(piece.split(b",")[0]) for piece in answer.split(b'"tau":')[1:]], [10.0 * i for i in range(20)])
            self.assertEqual(answer.count(b"HTTP/1.1 404 "), 1)

    def test_who_is_refused(self):
        good = f"GET /api/atlas HTTP/1.1\r\n{self.host()}"
        bearer = f"Authorization: Bearer {self.token}\r\n"
        with self.attack("300 wrong tokens"):
            for i in range(300):
                self.assertEqual(self.status(good + f"Authorization: Bearer {i:032x}\r\n\r\n"), 403)
        for text, status in ((f"GET /api/atlas HTTP/1.1\r\nHost: evil.example\r\n{bearer}\r\n", 421),
                             (f"GET /api/atlas HTTP/1.1\r\nHost: evil.example:{self.port}\r\n{bearer}\r\n", 421),
                             (f"GET /api/atlas HTTP/1.1\r\nHost: localhost:{self.port}\r\n{bearer}Connection: close\r\n\r\n", 200),
                             (f"GET /api/atlas HTTP/1.1\r\n{bearer}\r\n", 421), (good + self.host() + bearer + "\r\n", 400),
                             (good + bearer + "Origin: http://evil.example\r\n\r\n", 403), (good + bearer + "Origin: null\r\n\r\n", 403),
                             (good + bearer + f"Authorization: Bearer {'0' * 32}\r\n\r\n", 400),
                             (f"POST /api/atlas HTTP/1.1\r\n{self.host()}{bearer}Content-Length: 99999999999\r\n\r\n", 405),
                             (good + bearer + "Content-Length: 99999999999\r\n\r\n", 413), (good + bearer + "Content-Length: 5\r\n\r\nabcde", 413),
                             (good + bearer + "Transfer-Encoding: chunked\r\n\r\n5\r\nabcde\r\n0\r\n\r\n", 413),
                             (f"PUT /api/scene HTTP/1.1\r\n{self.host()}{bearer}Content-Length: 4194305\r\n\r\n", 413),
                             (f"PUT /api/scene HTTP/1.1\r\n{self.host()}{bearer}Transfer-Encoding: chunked\r\n\r\n2\r\n{{}}\r\n0\r\n\r\n", 413),
                             (f"PUT /api/scene HTTP/1.1\r\n{self.host()}Content-Length: 2\r\n\r\n{{}}", 403),
                             (f"PUT /api/scene HTTP/1.1\r\n{self.host()}{bearer}Content-Length: 2\r\nConnection: close\r\n\r\n{{}}", 400),
                             (good + bearer + "Expect: 100-continue\r\nContent-Length: 5\r\n\r\n", 413),
                             (good + bearer + "Content-Length: x\r\n\r\n", 400), (good + bearer + "Content-Length: 0\r\nConnection: close\r\n\r\n", 200),
                             (good + bearer + "X: y\r\n" * 200 + "\r\n", 431), (good + bearer + "X: " + "y" * 17000 + "\r\n\r\n", 431),
                             (f"GET /api/atlas HTTP/9.9\r\n{self.host()}{bearer}\r\n", 505), ("\0\1\2\r\n\r\n", 400), ("GET\r\n\r\n", 400),
                             (f"GET /api/atlas HTTP/1.0\r\n{self.host()}{bearer}\r\n", 200)):
            self.assertEqual(self.status(text), status, text[:200])

    def test_too_many_listeners(self):
        """64 listen; those who come later are told, and others are answered all the same."""
        with self.attack("100 listeners") as held:
            def listen(client, until):
                connection = self.connect(until)
                connection.sendall((self.owners("/api/events") + f"X-Client: {client}\r\n\r\n").encode())
                answer = connection.recv(65536)
                return answer.split()[1], answer
            for i in range(63):
                self.assertEqual(listen(i, held)[0], b"200")
            status = b"503"
            while status == b"503":   # until the end of the listener of setUp() is noticed
                with contextlib.ExitStack() as attempt:
                    status, _ = listen(63, attempt)
                    if status == b"200":
                        held.push(attempt.pop_all())
            self.assertEqual(status, b"200")
            answers = [listen(i, held) for i in range(64, 100)]
            self.assertEqual([status for status, _ in answers], [b"503"] * 36)
            self.assertIn("too many event streams", json.loads(answers[-1][1].split(b"\r\n\r\n", 1)[1])["error"]["what"])

    def test_many_idle_connections_of_the_owner(self):
        with self.attack("300 idle connections of the owner") as held:
            for _ in range(300):
                connection = self.connect(held)
                connection.sendall((self.owners("/api/preview?tau=100") + "\r\n").encode())
                self.assertIn(b" 200 ", connection.recv(65536)[:20])


    @unittest.skipIf(harness.SANITIZED, "allocators of sanitizers end the program")
    def test_no_memory_is_left(self):
        """While nothing can be allocated some are refused or cut off; afterwards all is as before."""
        with self.attack("500 half requests without memory") as held:
            with self.without_memory():
                for _ in range(500):
                    with contextlib.suppress(OSError):
                        self.connect(held).sendall(f"GET / HTTP/1.1\r\n{self.host()}X: ".encode() + b"a" * 16000)
                self.ask_without_memory()

    def ask_without_memory(self):
        for path in ["/api/atlas", "/"] * 20:
            with contextlib.suppress(OSError, http.client.HTTPException):
                self.assertIn(self.viewer.ask(path, **{"Accept-Encoding": "zstd"})[0], (200, 500, 503))

    @unittest.skipIf(harness.SANITIZED, "allocators of sanitizers end the program")
    def test_no_memory_is_left_at_the_begin(self):
        """The same while the first answers are prepared, of ten viewers: nobody knows how far one has come."""
        for _ in range(10):
            self.viewer.stop()
            self.begin()
            with self.without_memory():
                self.ask_without_memory()
            self.owner_is_answered()


@unittest.skipIf(harness.SANITIZED, "sanitizers need more address space")
class Limited(Attacked):
    """The same with little stack and address space."""
    limits = {resource.RLIMIT_STACK: 1 << 20, resource.RLIMIT_AS: 3_000_000 * 1024}


if __name__ == "__main__":
    unittest.main()
