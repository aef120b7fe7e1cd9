#!/usr/bin/env python3
"""What does a step along the isovalue cost a viewer? Starts `isoatlas view` on a store and walks over its surfaces, as a key held down does.

    /usr/bin/python3 bench/view/steps.py build/release/bin/isoatlas STORE [--triangles 200000] [--steps 60] [--clients 1] [--seconds S]
    /usr/bin/python3 bench/view/steps.py build/release/bin/isoatlas STORE --drag v670662 0.8 1.6 [--most 20000]

Prints lines of the table in docs/performance.md: clients, steps, triangles, milliseconds of a step (surface made, packed, coded and
received; median, 95 % are faster, slowest, and the median of the slowest client), bytes a triangle on the wire, failures, and the memory of
the server after a tenth of the steps and at the end, MB. Steps go up and down near the isovalue with about that many triangles, or over the
whole axis without --triangles. --drag: of an object, between two isovalues, with at most --most triangles, as pages request them while an
isovalue is dragged; 0 triangles are points. Each of several clients walks on its own, from another place; for SECONDS, instead of STEPS, if
given.
"""
import argparse
import http.client
import json
import os
import pathlib
import secrets
import signal
import statistics
import subprocess
import threading
import time
import urllib.parse

AROUND = 0.02  # of the axis, on both sides


class Server:
    def __init__(self, isoatlas, store, arguments):
        self.token = secrets.token_hex(16)
        self.process = subprocess.Popen([isoatlas, "view", store, "--no-browser", *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True, env=dict(os.environ, ISOATLAS_TOKEN=self.token))
        self.port = urllib.parse.urlsplit(self.process.stdout.readline()).port

    def ask(self, connection, path, client):
        """Status, headers, bytes."""
        connection.request("GET", path, headers={"Authorization": "Bearer " + self.token, "Accept-Encoding": "zstd", "X-Client": client})
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)

    def json(self, path):
        connection = self.connect()
        connection.request("GET", path, headers={"Authorization": "Bearer " + self.token})
        return json.load(connection.getresponse())

    def memory(self):
        """Resident, MB."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1]) // 1000

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait()


class Walk(threading.Thread):
    """A client that asks again as soon as it is answered."""

    def __init__(self, server, paths, steps, until, name):
        super().__init__()
        self.server, self.paths, self.steps, self.until, self.client = server, paths, steps, until, name
        self.seconds, self.triangles, self.bytes, self.failures = [], [], 0, 0

    def run(self):
        connection = self.server.connect()
        while len(self.seconds) < self.steps and time.monotonic() < self.until:
            path = self.paths[len(self.seconds) % len(self.paths)]
            before = time.perf_counter()
            try:
                status, headers, body = self.server.ask(connection, path, self.client)
            except OSError:
                status, connection = 0, self.server.connect()
            self.seconds.append(time.perf_counter() - before)
            if status != 200:
                self.failures += 1
                continue
            self.triangles.append(int(headers["X-Triangles"]))
            self.bytes += len(body)


def axis_around(server, triangles):
    """The isovalues between which the steps go."""
    axis = server.json("/api/atlas")["axis"]
    low, high = axis["low"], axis["high"]
    if triangles is None:
        return low, high
    taus = [low + (high - low) * i / 200 for i in range(1, 200)]
    middle = min(taus, key=lambda tau: abs(sum(server.json(f"/api/preview?tau={tau!r}")["triangles"]) / 2 - triangles))
    return middle - AROUND * (high - low), middle + AROUND * (high - low)


def up_and_down(low, high, count, start):
    """Fractions of a way there and back again, so that no step is far."""
    there = [low + (high - low) * i / max(1, count - 1) for i in range(count)]
    way = there + there[-2:0:-1]
    first = int(start * len(way))
    return way[first:] + way[:first]


def measure(server, arguments, low, high):
    until = time.monotonic() + arguments.seconds if arguments.seconds else float("inf")
    steps = 10**9 if arguments.seconds else arguments.steps
    words = f"&object={arguments.drag[0]}&max={arguments.most}" if arguments.drag else ""
    ways = [up_and_down(low, high, 60, i / arguments.clients) for i in range(arguments.clients)]
    walks = [Walk(server, [f"/api/surface?tau={tau!r}{words}" for tau in way], steps, until, f"client {i}") for i, way in enumerate(ways)]
    begin = time.monotonic()
    for walk in walks:
        walk.start()
    early = None
    while any(walk.is_alive() for walk in walks):
        time.sleep(0.05)
        done = (time.monotonic() - begin) / arguments.seconds if arguments.seconds else len(walks[0].seconds) / steps
        if early is None and done >= 0.1:
            early = server.memory()
    return walks, early


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("isoatlas")
    parser.add_argument("store")
    parser.add_argument("--triangles", type=int)
    parser.add_argument("--steps", type=int, default=60)
    parser.add_argument("--clients", type=int, default=1)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--drag", nargs=3, metavar=("OBJECT", "LOW", "HIGH"))
    parser.add_argument("--most", type=int, default=20_000)
    parser.add_argument("--memory", help="budget of the server")
    arguments = parser.parse_args()
    server = Server(arguments.isoatlas, arguments.store, ["--memory", arguments.memory] if arguments.memory else [])
    try:
        low, high = map(float, arguments.drag[1:]) if arguments.drag else axis_around(server, arguments.triangles)
        walks, early = measure(server, arguments, low, high)
        late = server.memory()
    finally:
        server.stop()
    taken = sorted(1e3 * t for walk in walks for t in walk.seconds)
    triangles = [n for walk in walks for n in walk.triangles]
    of_triangle = f"{sum(walk.bytes for walk in walks) / sum(triangles):.2f}" if sum(triangles) else "-"
    slowest = max(statistics.median(walk.seconds) for walk in walks)
    print(f"| {pathlib.Path(arguments.store).stem} | {arguments.clients} | {len(taken):,} | {min(triangles):,} to {max(triangles):,} | "
          f"{statistics.median(taken):.0f} | {taken[int(0.95 * len(taken))]:.0f} | {taken[-1]:.0f} | {1e3 * slowest:.0f} | "
          f"{of_triangle} | {sum(walk.failures for walk in walks)} | {early} to {late} |")


if __name__ == "__main__":
    main()
