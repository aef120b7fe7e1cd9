"""`isoatlas view`: what it answers over HTTP, to whom, and how it ends."""
import concurrent.futures
import contextlib
import errno
import gzip
import json
import os
import pathlib
import pty
import re
import socket
import struct
import unittest
import urllib.error
import urllib.request

import harness
import served


class View(harness.CliTest):
    phantoms = {"field.nrrd": ["random-field", "--size", "24", "--noise", "0.02"]}

    def setUp(self):
        self.viewer = served.Viewer(self.folder, "field.nrrd")
        self.ask, self.port, self.token = self.viewer.ask, self.viewer.port, self.viewer.token
        self.states = self.viewer.until("open")

    def tearDown(self):
        code, errors = self.viewer.stop()
        self.assertEqual(code, 0, errors)

    def json_of(self, path):
        status, _, body = self.ask(path)
        self.assertEqual(status, 200, body)
        return json.loads(body)

    def raw(self, text):
        """What comes before the connection ends; it may end while we send."""
        answer = b""
        with self.viewer.connect() as connection, contextlib.suppress(ConnectionError):
            connection.sendall(text)
            try:
                connection.shutdown(socket.SHUT_WR)
            except OSError as error:  # it has ended, and is no ConnectionError
                if error.errno != errno.ENOTCONN:
                    raise
            while piece := connection.recv(65536):
                answer += piece
        return answer

    def test_story(self):
        self.assert_schema(self.viewer.document, "view")
        for state in self.states:
            self.assert_schema(state, "server-events")
        atlas = self.json_of("/api/atlas")
        self.assert_schema(atlas, "page")
        table = self.run_json("objects", "field.atlas")
        objects = [entry for entry in atlas["entries"] if atlas["branches"][entry["branch"]]["polarity"] == "high"]
        self.assertEqual([entry["id"] for entry in objects], [entry["id"] for entry in table["objects"]])
        for entry in objects[:3]:
            tau = entry["tau"]
            extracted = self.run_json("extract", "field.atlas", "--tau", repr(tau), "--object", f"v{entry['id']}", "-o", "x.ply")
            status, headers, body = self.ask(f"/api/surface?tau={tau!r}&object=v{entry['id']}")
            self.assertEqual(status, 200, body)
            self.assertEqual(int(headers["X-Triangles"]), extracted["triangles"])
            self.assertEqual(body[:4], b"iam1")
            for format in ("ply", "stl", "obj", "vtp", "glb", "vtkhdf"):
                self.run_json("extract", "field.atlas", "--tau", repr(tau), "--object", f"v{entry['id']}", "-o", "x." + format)
                one = f"/api/surface?tau={tau!r}&object=v{entry['id']}" if format != "glb" else f"/api/surfaces?object=v{entry['id']}@{tau!r}"
                status, _, body = self.ask(f"{one}&format={format}")   # a node of .glb has a name
                self.assertEqual((status, body), (200, (self.folder / ("x." + format)).read_bytes()), format)
            preview = self.json_of(f"/api/preview?tau={tau!r}")
            self.assert_schema(preview, "server-preview")
            objects = self.json_of(f"/api/objects?tau={tau!r}")
            self.assert_schema(objects, "server-objects")
            self.assertEqual(objects["count"], preview["objects"])
            named = self.json_of(f"/api/preview?tau={tau!r}&object=v{entry['id']}")
            self.assert_schema(named, "server-preview")
            self.assertEqual(named["object"], next(one for one in objects["objects"] if one["id"] == entry["id"]))

    def test_measures(self):
        tau = self.run_json("objects", "field.atlas")["objects"][0]["best_tau"]
        listed = self.run_json("objects", "field.atlas", "--tau", repr(tau))["objects"][:5]
        measures = self.json_of(f"/api/measures?tau={tau!r}&object=" + ",".join(f"v{entry['id']}" for entry in listed))
        self.assert_schema(measures, "server-measures")
        self.assertEqual(sorted(one["id"] for one in measures["objects"]), sorted(entry["id"] for entry in listed))
        for entry in listed:
            one = next(one for one in measures["objects"] if one["id"] == entry["id"])
            extracted = self.run_json("extract", "field.atlas", "--tau", repr(tau), "--object", f"v{entry['id']}", "-o", "x.ply")
            self.assertEqual((one["triangles"], one["tunnels"], one["cavities"]), (extracted["triangles"], entry["b1"], entry["b2"]))

    def test_labels(self):
        tau = self.run_json("objects", "field.atlas")["objects"][0]["best_tau"]
        for format in ("nrrd", "nii", "nii.gz", "tif"):
            self.run_json("label", "field.atlas", "--tau", repr(tau), "-o", "x." + format)
            status, _, body = self.ask(f"/api/label?tau={tau!r}&format={format}")
            self.assertEqual((status, body), (200, (self.folder / ("x." + format)).read_bytes()), format)

    def test_a_unit_where_the_file_says_none(self):
        entry = self.run_json("objects", "field.atlas")["objects"][0]
        what = f"v{entry['id']}@{entry['best_tau']!r}"
        for format in ("ply", "stl", "obj", "vtp", "glb", "vtkhdf"):
            self.run_json("extract", "field.atlas", "--unit", "um", "--object", what, "-o", "x." + format)
            where = f"/api/surfaces?object={what}" if format == "glb" else f"/api/surface?tau={entry['best_tau']!r}&object=v{entry['id']}"
            status, _, body = self.ask(f"{where}&format={format}&unit=%C2%B5m")
            self.assertEqual((status, body), (200, (self.folder / ("x." + format)).read_bytes()), format)
        one = f"/api/surface?tau={entry['best_tau']!r}&object=v{entry['id']}&format=ply"
        self.assertIn("comment unit \u00b5m\n".encode(), self.ask(one + "&unit=um")[2])
        self.assertNotIn(b"comment unit", self.ask(one)[2])
        self.run_json("label", "field.atlas", "--unit", "um", "--tau", repr(entry["best_tau"]), "-o", "x.nrrd")
        status, _, body = self.ask(f"/api/label?tau={entry['best_tau']!r}&unit=um")
        self.assertEqual((status, body), (200, (self.folder / "x.nrrd").read_bytes()))
        self.run_json("label", "field.atlas", "--unit", "um", "--object", what, "-o", "x.seg.nrrd")
        status, _, body = self.ask(f"/api/segmentation?object={what}&unit=um")
        self.assertEqual((status, body), (200, (self.folder / "x.seg.nrrd").read_bytes()))
        for wrong in ("a%0Ab", "voxels", "m" * 40):
            self.assertEqual(self.ask(f"{one}&unit={wrong}")[0], 400, wrong)

    def test_numbers_are_those_of_the_command_line(self):
        tables = {side: self.run_json("objects", "field.atlas", "--polarity", side)["objects"] for side in ("high", "low")}
        atlas = self.json_of("/api/atlas")
        for entry in atlas["entries"]:
            same = tables[atlas["branches"][entry["branch"]]["polarity"]][entry["number"] - 1]
            self.assertEqual((entry["id"], entry["tau"], entry["reference"]), (same["id"], same["best_tau"], same["reference"]))
        first = tables["high"][0]
        tau = repr(first["best_tau"])
        self.assertEqual(self.ask(f"/api/surface?tau={tau}&object=1")[2], self.ask(f"/api/surface?tau={tau}&object=v{first['id']}")[2])

    def test_several_objects(self):
        table = self.run_json("objects", "field.atlas")["objects"]
        words = ["1", f"{len(table)}", f"v{table[0]['id']}@{table[0]['best_tau'] - 0.01!r}"]
        for format in ("glb", "ply", "stl"):
            self.run_json("extract", "field.atlas", "--object", *words, "-o", "x." + format)
            status, _, body = self.ask(f"/api/surfaces?object={','.join(words)}&format={format}")
            self.assertEqual((status, body), (200, (self.folder / ("x." + format)).read_bytes()), format)
        for format in ("seg.nrrd", "nii.gz"):
            self.run_json("label", "field.atlas", "--object", *words, "-o", "x." + format)
            status, _, body = self.ask(f"/api/segmentation?object={','.join(words)}&format={format}")
            self.assertEqual((status, body), (200, (self.folder / ("x." + format)).read_bytes()), format)

    def test_names(self):
        self.assertEqual(self.json_of("/api/names")["names"], [])
        self.assertEqual(self.ask("/api/name?object=1&name=skull")[0], 400)   # GET changes nothing
        self.assertEqual(self.viewer.change("/api/name?object=1&name=skull", token="")[0], 403)
        self.assertEqual(self.viewer.change("/api/name?object=1&name=skull", Origin="http://evil.example")[0], 403)
        self.assertEqual(self.viewer.change("/api/atlas")[0], 405)
        self.assertEqual(self.json_of("/api/names")["names"], [])
        status, told = self.viewer.change("/api/name?object=1&name=big%20skull")
        self.assertEqual(status, 200, told)
        self.assert_schema(told, "server-names")
        self.assertEqual([n["name"] for n in self.run_json("name", "field.atlas")["names"]], ["big skull"])
        for bad in ("object=2&name=big%20skull", "object=2&name=v3", "object=2", "name=x", "object=v1&name=x", "object=1,2&name=x"):
            status, told = self.viewer.change("/api/name?" + bad)
            self.assertEqual(status, 400, bad)
            self.assert_schema(told, "server-error")
        self.run_ok("name", "field.atlas", "2", "jaw")
        self.assertEqual({n["name"] for n in self.json_of("/api/names")["names"]}, {"big skull", "jaw"})
        for number in (1, 2):
            self.assertEqual(self.viewer.change(f"/api/name?object={number}&name=")[0], 200)
        self.assertFalse((self.folder / "field.atlas.names.json").exists())

    def test_choosing(self):
        everything = self.json_of("/api/branches")
        self.assert_schema(everything, "server-branches")
        for height, size in ((0.05, 3), (0.2, 1)):
            chosen = self.json_of(f"/api/branches?persistence={height}&min-voxels={size}")
            table = self.run_json("objects", "field.atlas", "--persistence", str(height), "--min-voxels", str(size))
            self.assertEqual(chosen["kept"], table["branches"] - table["hidden"])
            self.assertEqual(chosen["all"], table["branches"])
            expected = [r for r, p, n in zip(everything["rank"], everything["persistence"], everything["voxels"]) if p >= height and n >= size]
            self.assertEqual(chosen["rank"], expected or [0])
        card = self.json_of("/api/card?entry=0&frames=3")
        self.assert_schema(card, "server-card")
        self.assertEqual(card["picture"]["frames"], 3)
    def test_samples(self):
        atlas = self.json_of("/api/atlas")
        size = atlas["volume"]["size"]
        with open(self.folder / "field.nrrd", "rb") as file:
            samples = file.read().split(b"\n\n", 1)[1]
        width = len(samples) // (size[0] * size[1] * size[2])
        for axis, index in ((0, 3), (1, 23), (2, 0)):
            status, _, body = self.ask(f"/api/slice?axis={axis}&index={index}")
            self.assertEqual((status, body[:4]), (200, b"ias1"))
            columns, rows, step, _, zero = struct.unpack("<5I", body[4:24])
            across, down = [a for a in range(3) if a != axis]
            self.assertEqual((columns, rows, step, zero), (size[across], size[down], 1, 0))
            at = [0, 0, 0]
            at[axis], at[across], at[down] = index, 5, 7
            offset = width * (at[0] + size[0] * (at[1] + size[1] * at[2]))
            place = 40 + width * (5 + columns * 7)
            self.assertEqual(body[place:place + width], samples[offset:offset + width])
        status, _, body = self.ask("/api/slice?axis=2&index=1&max=100")
        self.assertEqual(struct.unpack("<3I", body[4:16]), (8, 8, 3))
        status, _, body = self.ask("/api/volume?max=2000")
        self.assertEqual((body[:4], struct.unpack("<4I", body[4:20]), len(body)), (b"iav1", (12, 12, 12, 2), 40 + 12 ** 3))

    def test_what_holds_a_voxel(self):
        atlas = self.json_of("/api/atlas")
        size = atlas["volume"]["size"]
        i, entry = next((i, e) for i, e in enumerate(atlas["entries"]) if not e["reference"].startswith("low"))
        x, y, z = entry["id"] % size[0], entry["id"] // size[0] % size[1], entry["id"] // size[0] // size[1]
        found = self.json_of(f"/api/at?voxel={x},{y},{z}&object=v{entry['id']}@{entry['tau']!r},v{entry['id']}@{atlas['volume']['high'] + 1!r}")
        self.assert_schema(found, "server-at")
        self.assertIn(i, found["entries"])
        self.assertEqual(found["objects"], [True, False])
        transfer = self.json_of("/api/transfer")
        self.assert_schema(transfer, "server-transfer")
        self.assertGreater(len(transfer["tents"]), 0)

    def test_the_command_line_asks(self):
        address = self.viewer.document["server"]
        printed = self.run_ok("ask", address, "/api/preview?tau=0.5").stdout
        self.assertEqual(json.loads(printed), self.json_of("/api/preview?tau=0.5"))
        self.run_ok("extract", "field.atlas", "--tau", "0.5", "-o", "own.stl")
        told = self.run_json("ask", address, "/api/surface?tau=0.5&format=stl", "-o", "asked.stl")
        self.assert_schema(told, "ask")
        self.assertEqual((self.folder / "asked.stl").read_bytes(), (self.folder / "own.stl").read_bytes())
        self.run_ok("extract", "field.atlas", "--tau", "0.5", "--simplify", "0.5", "-o", "own.stl")
        self.run_ok("ask", address, "/api/surface?tau=0.5&format=stl&simplify=0.5", "-o", "asked.stl")
        self.assertEqual((self.folder / "asked.stl").read_bytes(), (self.folder / "own.stl").read_bytes())
        self.run_error(2, "ask", address, "/api/preview", says="missing isovalue")
        self.run_error(6, "ask", address, "/api/nothing", says="no such path")
        self.run_error(2, "ask", address, "/api/events", says="finite response")
        self.run_error(2, "ask", address, "/api/surface?tau=0.5", says="octet-stream", next_says="-o")
        self.assertEqual(self.run_ok("ask", self.port, "/api/preview?tau=0.5").stdout, printed)
        self.run_error(2, "ask", "http://example.org", "/api/atlas", says="not an address")
        self.run_error(3, "ask", "http://127.0.0.1:1", "/api/atlas", says="no viewer of this user", next_says="isoatlas view")

    def test_no_secret_on_a_command_line(self):
        """What opens the viewer is neither in the words of its own process, nor taken from those of another."""
        address = self.viewer.document["server"]
        words = pathlib.Path(f"/proc/{self.viewer.process.pid}/cmdline").read_bytes()
        self.assertNotIn(self.token.encode(), words)
        for secret in (self.viewer.document["address"], f"{address}/?token={self.token}"):
            self.run_error(2, "ask", secret, "/api/atlas", says="every user of this machine", next_says="isoatlas ask " + address)

    def test_the_token_is_in_a_file_of_the_user_or_in_the_environment(self):
        file = served.token_file(self.port)
        self.assertEqual((file.stat().st_mode & 0o777, file.parent.stat().st_mode & 0o777), (0o600, 0o700))
        told = {"ISOATLAS_TOKEN": self.token}
        file.chmod(0o640)
        done = self.start(["ask", self.port, "/api/atlas"])
        self.assertEqual(done.returncode, 3)
        self.assertIn("ISOATLAS_TOKEN", done.stderr)
        self.assertEqual(self.start(["ask", self.port, "/api/atlas"], environment=told).returncode, 0)
        file.chmod(0o600)
        self.assertEqual(self.start(["ask", self.port, "/api/atlas"], environment={"ISOATLAS_TOKEN": "0" * 32}).returncode, 2)
        other = served.Viewer(self.folder, "field.nrrd", env=dict(os.environ, ISOATLAS_TOKEN="abcdefghijklmnop"))
        self.assertEqual(other.token, "abcdefghijklmnop")
        self.assertEqual(other.ask("/")[0], 200)
        self.assertTrue(served.token_file(other.port).exists())
        self.assertEqual(other.stop()[0], 0)
        self.assertFalse(served.token_file(other.port).exists())
        for bad in ("short", "with a space in it", "x" * 257, "abcdefghijklmno\r\n"):
            done = self.start(["view", "field.atlas", "--no-browser"], environment={"ISOATLAS_TOKEN": bad})
            self.assertEqual((done.returncode, "16 to 256 letters and digits" in done.stderr), (2, True), done.stderr)
        homeless = served.Viewer(self.folder, "field.nrrd", wanted_token="abcdefghijklmnop",
                                 env=dict(os.environ, ISOATLAS_TOKEN="abcdefghijklmnop", XDG_RUNTIME_DIR="/dev/null"))
        self.assertEqual(homeless.ask("/")[0], 200)
        code, said = homeless.stop()
        self.assertEqual(code, 0)
        self.assertIn("cannot read the token of this viewer", said)

    def test_a_token_that_was_left_behind(self):
        killed = served.Viewer(self.folder, "field.nrrd")
        killed.process.kill()
        killed.process.communicate()
        self.assertTrue(served.token_file(killed.port).exists())
        self.run_error(3, "ask", killed.port, "/api/atlas", says="no response")
        again = served.Viewer(self.folder, "field.nrrd", "--port", str(killed.port), "--new-link")
        self.assertNotEqual(again.token, killed.token)
        self.run_ok("ask", again.port, "/api/atlas")
        self.assertEqual(again.stop()[0], 0)

    def opened(self, address, method="GET"):
        """Status, cookie and key that a browser gets."""
        request = urllib.request.Request(address, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                cookie, page = answer.headers["Set-Cookie"], answer.read().decode()
                return answer.status, cookie, re.search(r'"isoatlas","(\w+)"', page).group(1)
        except urllib.error.HTTPError as error:
            return error.code, error.headers["Set-Cookie"], None

    def test_an_address_opens_once(self):
        first = self.viewer.document["address"]
        self.assertEqual(self.opened(first, "HEAD")[0], 403)   # who only looks does not use it up
        status, cookie, key = self.opened(first)
        self.assertEqual(status, 200)
        self.assertRegex(cookie, rf"^isoatlas-{self.port}=[0-9a-f]{{32}}; Path=/; HttpOnly; SameSite=Strict; Max-Age=2592000$")
        self.assertNotIn(self.token, cookie + key)
        self.assertEqual(self.opened(first), (403, None, None))
        self.assertEqual(self.opened(first[:-1] + "x")[0], 403)
        document = self.json_of("/api/address")
        self.assert_schema(document, "server-address")
        self.assertEqual(self.opened(document["address"]), (200, cookie, key))
        self.assertEqual(self.ask("/api/address?x=1")[0], 400)
        many = [self.json_of("/api/address")["address"] for _ in range(17)]
        self.assertEqual([self.opened(address)[0] for address in many], [403] + 16 * [200])

    def test_a_store_is_the_one_volume(self):
        document = self.json_of("/api/volumes")
        self.assert_schema(document, "server-volumes")
        self.assertEqual((document["volume"], document["channels"], document["time_steps"]), (0, [""], 1))
        self.assertEqual(self.json_of("/volume/0/api/atlas"), self.json_of("/api/atlas"))
        self.assertEqual(self.ask("/volume/1/api/atlas")[0], 404)
        self.assertEqual(self.ask("/api/volumes?x=1")[0], 400)

    def test_the_desktop_opens_an_address_for_one_use(self):
        """Every user of the machine sees the words of xdg-open and of the browser."""
        folder = self.folder / "desktop"
        folder.mkdir()
        (folder / "xdg-open").write_text('#!/bin/sh\necho "$1" > asked && mv asked opened\n')
        (folder / "xdg-open").chmod(0o755)
        environment = dict(os.environ, DISPLAY=":0", PATH=f"{folder}:{os.environ['PATH']}")
        viewer = served.Viewer(folder, "../field.atlas", browser="", env=environment)
        while not (folder / "opened").exists():
            self.assertIsNone(viewer.process.poll())
        address = (folder / "opened").read_text().strip()
        self.assertRegex(address, rf"^http://127.0.0.1:{viewer.port}/open\?once=[0-9a-f]{{32}}$")
        self.assertNotIn(viewer.token, address)
        self.assertNotEqual(address, viewer.document["address"])
        self.assertEqual([self.opened(address)[0] for _ in range(2)], [200, 403])
        self.assertEqual(viewer.stop()[0], 0)

    def test_enter_gives_another_address(self):
        try:
            process, terminal = pty.fork()
        except OSError as error:   # a container without /dev/pts
            self.skipTest(f"no pseudo terminal here: {error}")
        if process == 0:
            os.chdir(self.folder)
            os.execv(harness.CLI, [harness.CLI, "view", "field.atlas", "--no-browser"])
        shown = ""

        def addresses(count):
            nonlocal shown
            while len(found := re.findall(r"(http\S+/open\?once=[0-9a-f]{32})\r", shown)) < count:
                shown += os.read(terminal, 4096).decode()
            return found
        addresses(1)
        os.write(terminal, b"\n")
        first, second = addresses(2)
        self.assertNotEqual(first, second)
        self.assertIn("Enter prints another one", shown)
        for address in (second, first):
            self.assertEqual(self.opened(address)[0], 200)
        os.write(terminal, b"\x03")   # Ctrl-C
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), 0)
        os.close(terminal)

    def test_a_browser_needs_its_cookie_and_its_key(self):
        _, cookie, key = self.opened(self.viewer.document["address"])
        cookie = cookie.split(";")[0]
        site = "Sec-Fetch-Site"
        for path, token, headers, status in (
                ("/api/atlas", key, {"Cookie": cookie}, 200), ("/api/atlas", key, {"Cookie": f"a=b; {cookie}; c=d", site: "same-origin"}, 200),
                ("/api/atlas", key, {}, 403), ("/api/atlas", "", {"Cookie": cookie}, 403), ("/api/atlas", key, {"Cookie": cookie[:-1]}, 403),
                ("/api/atlas", key, {"Cookie": cookie.replace("-", "_")}, 403), ("/api/atlas", key, {"Cookie": cookie, site: "same-site"}, 403),
                ("/api/atlas", key, {"Cookie": cookie, site: "cross-site"}, 403), ("/api/atlas", key, {"Cookie": cookie, "Origin": "http://127.0.0.1:1"}, 403),
                ("/", "", {"Cookie": cookie}, 200), ("/?x=1", "", {"Cookie": cookie, site: "none"}, 200), ("/", "", {}, 403), ("/", key, {}, 403)):
            self.assertEqual(self.ask(path, token, **headers)[0], status, (path, headers))

    def test_a_link_on_another_site_goes_on_from_a_page_of_ours(self):
        """A browser keeps a cookie of SameSite=Strict back there."""
        for site, status in (("cross-site", b"303"), ("same-site", b"303"), ("same-origin", b"403"), ("none", b"403")):
            answer = self.raw(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\nSec-Fetch-Site: {site}\r\n\r\n".encode())
            self.assertEqual((answer.split()[1], b"Location: /enter\r\n" in answer), (status, status == b"303"))
        status, _, page = self.ask("/enter", token="")
        self.assertEqual(status, 200)
        self.assertIn(b'location.replace("./"+location.hash)', page)

    def test_who_may_ask(self):
        for path in ("/api/atlas", "/api/events", "/api/label?tau=0"):
            self.assertEqual(self.ask(path, token="")[0], 403)
        self.assertEqual(self.ask("/api/atlas", token=self.token[:-1] + "x")[0], 403)
        self.assertEqual(self.ask("/", token="")[0], 403)
        self.assertEqual(self.ask("/", Host="evil.example")[0], 421)
        status, headers, _ = self.ask("/api/atlas", Origin="http://evil.example")
        self.assertNotIn("Access-Control-Allow-Origin", headers)
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])

    def test_refusals(self):
        for path, status in (("/api/surface?tau=nan", 400), ("/api/surface", 400), ("/api/preview?tau=1&x=2", 400), ("/api/none", 404),
                             ("/api/measures?tau=0", 400), ("/api/label?tau=0&format=exe", 400), ("/api/events?x=1", 400),
                             ("/api/slice", 400), ("/api/slice?axis=3&index=0", 400), ("/api/slice?axis=0&index=24", 400), ("/api/volume?max=0", 400),
                             ("/api/at?voxel=1,2", 400), ("/api/at?voxel=1,2,24", 400), ("/api/at?voxel=1,2,3&object=v5", 400), ("/api/transfer?x=1", 400), ("/api/atlas?x=1", 400),
                             ("/../../etc/passwd", 404), ("/%2e%2e/%2e%2e/etc/passwd", 404), ("/api/surface?tau=0&object=v99999999999", 400), ("/api/surface?tau=0&object=99999999999", 404),
                             ("/api/surface?tau=0&object=" + ",".join(["1"] * 257), 400)):
            got, _, body = self.ask(path)
            self.assertEqual(got, status, path[:60])
            self.assert_schema(json.loads(body), "server-error")

    def test_hostile_bytes(self):
        for text in (b"", b"\r\n\r\n", b"GET\r\n\r\n", b"\x00" * 1000 + b"\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",
                     b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 10000 + b"\r\n",
                     b"GET / HTTP/1.1\r\nHost: 127.0.0.1:" + str(self.port).encode() + b"\r\nRange: bytes=-99999999999999\r\n\r\n"):
            self.raw(text)
        self.json_of("/api/atlas")

    def test_coding(self):
        status, headers, body = self.ask("/api/atlas", **{"Accept-Encoding": "gzip"})
        self.assertEqual(headers["Content-Encoding"], "gzip")
        self.assertEqual(json.loads(gzip.decompress(body)), self.json_of("/api/atlas"))

    def test_many_clients(self):
        atlas = self.json_of("/api/atlas")
        taus = [atlas["volume"]["low"] + (atlas["volume"]["high"] - atlas["volume"]["low"]) * i / 13 for i in range(1, 13)]
        expected = {tau: self.ask(f"/api/surface?tau={tau!r}")[2] for tau in taus}

        def step(client):
            return all(self.ask(f"/api/surface?tau={tau!r}", **{"X-Client": str(client)})[2] == expected[tau] for tau in taus)

        with concurrent.futures.ThreadPoolExecutor(50) as clients:
            self.assertTrue(all(clients.map(step, range(50))))

    def test_a_port_that_is_taken(self):
        done = self.start(["view", "field.atlas", "--no-browser", "--port", str(self.port)])
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("--port", done.stderr)


class Uneven(harness.CliTest):
    """A grid with a coordinate for each sample."""

    AXES = [[0, 1, 2.5, 7, 8], [-1, 0, 5, 6, 6.5], [2, 4, 5, 5.5, 9]]

    def setUp(self):
        extent = "0 4 0 4 0 4"
        array = '<DataArray type="{}" Name="{}" format="ascii">{}</DataArray>'
        values = [100 if abs(x - 2) + abs(y - 2) + abs(z - 2) < 2 else 0 for z in range(5) for y in range(5) for x in range(5)]
        lists = [array.format("Float64", name, " ".join(map(str, axis))) for name, axis in zip("xyz", self.AXES)]
        (self.folder / "u.vtr").write_text(
            f'<VTKFile type="RectilinearGrid"><RectilinearGrid WholeExtent="{extent}"><Piece Extent="{extent}"><Coordinates>'
            + "".join(lists) + "</Coordinates><PointData>" + array.format("UInt8", "v", " ".join(map(str, values)))
            + "</PointData></Piece></RectilinearGrid></VTKFile>")
        self.viewer = served.Viewer(self.folder, "u.vtr")
        self.viewer.until("open")

    def tearDown(self):
        code, errors = self.viewer.stop()
        self.assertEqual(code, 0, errors)

    def test_coordinates(self):
        page = json.loads(self.viewer.ask("/api/atlas")[2])
        self.assert_schema(page, "page")
        volume = page["volume"]
        self.assertIsNone(volume["spacing"])
        self.assertEqual(volume["origin"], [axis[0] for axis in self.AXES])
        self.assertEqual(volume["coordinates"], [[place - axis[0] for place in axis] for axis in self.AXES])
        at = json.loads(self.viewer.ask("/api/at?voxel=3,2,4")[2])
        self.assertEqual(at["position"], [7, 5, 9])


if __name__ == "__main__":
    harness.main()
