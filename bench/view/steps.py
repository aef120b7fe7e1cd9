#!/usr/bin/env python3
"""What does a step along the isovalue cost a viewer? Starts `isoatlas view` on a store and walks over its surfaces, as a key held down does.

    /usr/bin/python3 bench/view/steps.py build/release/bin/isoatlas STORE [--from A --to B] [--steps 60] [--clients 1]

Prints one line of the table in docs/performance.md: triangles, milliseconds a step (surface made, packed, coded and received; median and
slowest), bytes a triangle on the wire. With several clients, each walks on its own; the slowest client and the memory of the server too.
"""
import argparse
import concurrent.futures
import json
import pathlib
import signal
import statistics
import subprocess
import time
import urllib.request


def walk(address, token, taus, client):
    taken, triangles, sizes = [], [], []
    for tau in taus:
        request = urllib.request.Request(f"{address}/api/surface?tau={tau!r}", headers={
            "Authorization": "Bearer " + token, "Accept-Encoding": "zstd", "X-Client": str(client)})
        before = time.perf_counter()
        with urllib.request.urlopen(request, timeout=120) as answer:
            size = len(answer.read())
            taken.append(time.perf_counter() - before)
            triangles.append(int(answer.headers["X-Triangles"]))
            sizes.append(size)
    return taken, triangles, sizes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("isoatlas")
    parser.add_argument("store")
    parser.add_argument("--from", dest="first", type=float)
    parser.add_argument("--to", dest="last", type=float)
    parser.add_argument("--steps", type=int, default=60)
    parser.add_argument("--clients", type=int, default=1)
    arguments = parser.parse_args()
    server = subprocess.Popen([arguments.isoatlas, "view", arguments.store, "--no-browser"], stdout=subprocess.PIPE, text=True)
    try:
        page = server.stdout.readline().strip()
        address, token = page.split("/?token=")
        ask = urllib.request.Request(address + "/api/atlas", headers={"Authorization": "Bearer " + token})
        axis = json.load(urllib.request.urlopen(ask))["axis"]
        first = axis["low"] + 0.4 * (axis["high"] - axis["low"]) if arguments.first is None else arguments.first
        last = axis["low"] + 0.7 * (axis["high"] - axis["low"]) if arguments.last is None else arguments.last
        taus = [first + (last - first) * i / max(1, arguments.steps - 1) for i in range(arguments.steps)]
        with concurrent.futures.ThreadPoolExecutor(arguments.clients) as clients:
            walks = list(clients.map(lambda client: walk(address, token, taus, client), range(arguments.clients)))
        memory = next(line for line in pathlib.Path(f"/proc/{server.pid}/status").read_text().splitlines() if line.startswith("VmHWM"))
    finally:
        server.send_signal(signal.SIGINT)
        server.wait()
    taken = [1e3 * t for walked in walks for t in walked[0]]
    triangles = walks[0][1]
    a_triangle = sum(walks[0][2]) / max(1, sum(triangles))
    print(f"| {pathlib.Path(arguments.store).stem} | {arguments.clients} | {min(triangles):,} to {max(triangles):,} | {statistics.median(taken):.0f} | "
          f"{max(taken):.0f} | {a_triangle:.2f} | {int(memory.split()[1]) // 1024} |")


if __name__ == "__main__":
    main()
