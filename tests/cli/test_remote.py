#!/usr/bin/env python3
"""Files on web servers: the same answers as from a file of this machine, or one message that says what is wrong. Faulty servers included."""
import concurrent.futures
import contextlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import unittest
import urllib.error
import urllib.request
from pathlib import Path

from file_server import FileServer
from harness import CLI, CliTest
from served import Viewer

ROUND_TRIP, BYTES_A_SECOND = 0.02, 10e6  # of the line for which the first picture has a bound


def small_pieces(seed):
    """One answer in a hundred is cut short, and more at the beginning."""
    chance = random.Random(seed)

    def fault(server, handler, path, number):
        if chance.random() < 0.01 or number in (2, 3):
            server.send_file(handler, part=100)
            return True
        return False
    return fault


class Remote(CliTest):
    phantoms = {"field.nrrd": ["random-field", "--size", "40"], "text.nii": ["demo", "--size", "32"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for arguments in (["build", "field.nrrd", "-o", "field.atlas"], ["extract", "field.atlas", "--tau", "1", "-o", "local.ply"]):
            done = cls.start(arguments)
            assert done.returncode == 0, done.stderr

    @classmethod
    def start(cls, arguments, **options):
        options["environment"] = {"XDG_CACHE_HOME": str(cls.folder / "cache"), **options.get("environment", {})}
        return super().start(arguments, **options)

    def setUp(self):
        shutil.rmtree(self.folder / "cache", ignore_errors=True)

    def assert_same_surface(self, server, *options):
        out = self.folder / "remote.ply"
        out.unlink(missing_ok=True)
        done = self.run_ok("extract", f"{server.address}/field.atlas", "--tau", "1", "-o", out, *options)
        self.assertEqual(out.read_bytes(), (self.folder / "local.ply").read_bytes())
        return done

    def test_volumes_and_stores_answer_as_files_do(self):
        with FileServer(self.folder) as server:
            for name in ("field.nrrd", "text.nii"):
                remote, local = (self.run_json("info", path) for path in (f"{server.address}/{name}", name))
                for document in (remote, local):
                    document["volume"]["path"] = ""
                    document["file"]["data_file"] = ""
                self.assertEqual(remote, local)
            self.assert_same_surface(server)
            self.assertIn("/field.atlas", {path for path, _ in server.seen})

    def test_an_ome_zarr_answers_as_its_folder_does(self):
        self.run_ok("convert", "text.nii", "-o", "text.ome.zarr")
        with FileServer(self.folder) as server:
            remote, local = (self.run_json("objects", path) for path in (f"{server.address}/text.ome.zarr", "text.ome.zarr"))
        for document in (remote, local):
            document["volume"]["path"] = ""
        self.assertEqual(remote, local)

    def test_servers_of_single_ranges_answer_as_well(self):
        def one_of_several(server, handler, path, number):
            several = handler.headers.get("Range", "").split(",")
            if len(several) == 1:
                return False
            handler.headers.replace_header("Range", several[0])
            server.send_file(handler)
            return True
        for options in ({"several": False}, {"faults": one_of_several}):
            with FileServer(self.folder, **options) as server:
                shutil.rmtree(self.folder / "cache", ignore_errors=True)
                self.assert_same_surface(server)

    def test_a_surface_reads_a_part_of_the_store(self):
        with FileServer(self.folder) as server:
            self.run_ok("extract", f"{server.address}/field.atlas", "--tau", "3", "-o", "small.ply", "--cache", "0")
            self.assertLess(server.bytes, (self.folder / "field.atlas").stat().st_size)

    def test_a_slow_line_shows_how_far_it_is(self):
        with FileServer(self.folder, round_trip=0.8) as server:  # short reads show nothing
            shown = self.on_a_terminal(["extract", f"{server.address}/field.atlas", "--tau", "1", "-o", "slow.ply", "--threads", "1"],
                                       XDG_CACHE_HOME=str(self.folder / "cache"))
        self.assertRegex(shown, r"\[1/1\] read +[#.]+ +\d+ %")

    def test_what_was_read_is_kept_for_the_next_process(self):
        with FileServer(self.folder) as server:
            self.assert_same_surface(server)
            first = server.bytes
            self.assert_same_surface(server)
            self.assertLess(server.bytes - first, first / 2)
            again = server.bytes
            self.assert_same_surface(server, "--cache", "0")
            self.assertGreater(server.bytes - again, first / 2)

    def test_damaged_pieces_of_the_cache_are_fetched_again(self):
        with FileServer(self.folder) as server:
            self.assert_same_surface(server)
            pieces = [path for path in (self.folder / "cache").rglob("*-*") if path.is_file()]
            self.assertNotEqual(pieces, [])
            for number, piece in enumerate(pieces):
                data = bytearray(piece.read_bytes())
                data[len(data) // 2] ^= 1
                piece.write_bytes(bytes(data[:-1]) if number % 2 else bytes(data))
            self.assert_same_surface(server)

    def test_the_cache_keeps_its_budget(self):
        with FileServer(self.folder) as server:
            self.run_ok("objects", f"{server.address}/field.nrrd", "--cache", "100k")
            held = sum(path.stat().st_size for path in (self.folder / "cache").rglob("*") if path.is_file())
            self.assertLessEqual(held, 100 * 1024)

    def test_answers_cut_short_are_asked_for_again(self):
        with FileServer(self.folder, faults=small_pieces(7)) as server:
            self.assert_same_surface(server)

    def test_a_server_that_dies_is_told(self):
        def dies(server, handler, path, number):
            if number > 4:
                handler.close_connection = True
                handler.connection.close()
                return True
            return False
        with FileServer(self.folder, faults=dies) as server:
            self.run_error(3, "extract", f"{server.address}/field.atlas", "--tau", "1", "-o", "none.ply", says="no answer",
                           next_says="try again")
            self.assertFalse((self.folder / "none.ply").exists())

    def test_a_wrong_range_is_never_taken(self):
        def shifts(server, handler, path, number):
            data = (self.folder / "field.atlas").read_bytes()
            server.send(handler, 206, data[1:65537], **{"Content-Range": f"bytes 1-65536/{len(data)}"})
            return True
        with FileServer(self.folder, faults=shifts) as server:
            self.run_error(3, "info", f"{server.address}/field.atlas", says="another range")

    def test_a_longer_answer_is_never_taken(self):
        def adds(server, handler, path, number):
            data = (self.folder / "field.atlas").read_bytes() + bytes(100000)
            server.send(handler, 206, data, **{"Content-Range": f"bytes 0-65535/{len(data)}"})
            return True
        with FileServer(self.folder, faults=adds) as server:
            self.run_error(3, "info", f"{server.address}/field.atlas", says="more bytes")

    def test_a_file_that_changes_is_told(self):
        copy = self.folder / "changing.atlas"
        shutil.copy(self.folder / "field.atlas", copy)

        def changes(server, handler, path, number):
            if number == 3:
                copy.write_bytes(copy.read_bytes() + b"1")
            return False
        with FileServer(self.folder, faults=changes) as server:
            done = self.start(["extract", f"{server.address}/changing.atlas", "--tau", "1", "-o", "none.ply"])
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("changed on the server", done.stderr)

    def test_a_server_without_ranges(self):
        with FileServer(self.folder, ranges=False) as server:
            self.assert_same_surface(server)  # small: taken as a whole
            with open(self.folder / "large.raw", "wb") as large:
                large.truncate(200 << 20)
            self.run_error(3, "info", f"{server.address}/large.raw", "--dims", "200x1024x1024", "--type", "uint8",
                           says="whole files only", next_says="isoatlas serve")
            self.assertLess(server.bytes, 100 << 20)

    def test_tokens_are_sent_and_never_shown(self):
        with FileServer(self.folder, token="s3cret") as server:
            error = self.run_error(3, "info", f"{server.address}/field.nrrd", says="401", next_says="ISOATLAS_BEARER_TOKEN")
            self.assertNotIn("s3cret", str(error))
            done = self.start(["info", f"{server.address}/field.nrrd", "-v"], environment={"ISOATLAS_BEARER_TOKEN": "s3cret"})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("s3cret", done.stdout + done.stderr)
            wrong = self.start(["info", f"{server.address}/field.nrrd"], environment={"ISOATLAS_BEARER_TOKEN": "other"})
            self.assertIn("expired", wrong.stderr)
            for path in (self.folder / "cache").rglob("*"):
                self.assertNotIn("s3cret", str(path))

    def test_redirects_stay_on_the_host(self):
        def moved(server, handler, path, number):
            if path != "/old.nrrd":
                return False
            server.send(handler, 302, b"", **{"Location": "/field.nrrd"})
            return True

        def elsewhere(server, handler, path, number):
            server.send(handler, 302, b"", **{"Location": "https://elsewhere.example/field.nrrd?signature=s3cret"})
            return True

        def circle(server, handler, path, number):
            server.send(handler, 301, b"", **{"Location": path})
            return True
        with FileServer(self.folder, faults=moved) as server:
            self.run_ok("info", f"{server.address}/old.nrrd")
        with FileServer(self.folder, faults=elsewhere) as server:
            error = self.run_error(3, "info", f"{server.address}/field.nrrd", says="another host, https://elsewhere.example")
            self.assertNotIn("s3cret", str(error))
        with FileServer(self.folder, faults=circle) as server:
            self.run_error(3, "info", f"{server.address}/field.nrrd", says="circle")

    def test_what_cannot_be_opened(self):
        with FileServer(self.folder) as server:
            gone = server.address
            self.run_error(3, "info", f"{gone}/none.nrrd", says="there is no such file on the server")
            self.run_error(3, "info", gone.replace("http:", "https:") + "/field.nrrd", says="no answer")
        self.run_error(3, "info", f"{gone}/field.nrrd", says="no answer")
        error = self.run_error(2, "info", "https://me:s3cret@localhost/field.nrrd", says="user name", next_says="ISOATLAS_BEARER_TOKEN")
        self.assertNotIn("s3cret", error["message"])

    def test_busy_servers_are_asked_again(self):
        def busy(server, handler, path, number):
            if number > 2:
                return False
            server.send(handler, 503 if number == 1 else 429, b"later", **{"Retry-After": "0"})
            return True
        with FileServer(self.folder, faults=busy) as server:
            self.run_ok("info", f"{server.address}/field.nrrd")
            self.assertGreaterEqual(server.requests, 3)

    def test_an_empty_file(self):
        Path(self.folder / "empty.nrrd").write_bytes(b"")
        with FileServer(self.folder) as server:
            self.run_error(3, "info", f"{server.address}/empty.nrrd", says="empty")

    def test_outputs_do_not_go_to_servers(self):
        with FileServer(self.folder) as server:
            done = self.start(["convert", "field.nrrd", "-o", f"{server.address}/x.nrrd"])
            self.assertEqual(done.returncode, 5, done.stderr)

    @contextlib.contextmanager
    def serving(self, *arguments):
        """Its address."""
        process = subprocess.Popen([CLI, "serve", *arguments, "--json"], cwd=self.folder, stdout=subprocess.PIPE, text=True)
        try:
            text = ""
            while not text.endswith("}\n"):
                text += process.stdout.readline()
            document = json.loads(text)
            self.assert_schema(document, "serve")
            yield document["address"]
        finally:
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(), 0)
            process.stdout.close()

    def test_the_other_side(self):
        """`isoatlas serve`: whole files, ranges, several ranges; nothing outside of the folder."""
        (self.folder / "served").mkdir(exist_ok=True)
        shutil.copy(self.folder / "field.atlas", self.folder / "served")
        (self.folder / "served" / ".secret").write_text("x")
        (self.folder / "served" / "link").symlink_to(self.folder / "field.nrrd")
        with self.serving("served") as address:
            out = self.folder / "remote.ply"
            self.run_ok("extract", f"{address}/field.atlas", "--tau", "1", "-o", out)
            self.assertEqual(out.read_bytes(), (self.folder / "local.ply").read_bytes())
            content = (self.folder / "field.atlas").read_bytes()
            with urllib.request.urlopen(f"{address}/field.atlas") as answer:
                self.assertEqual(answer.read(), content)
                etag = answer.headers["ETag"]
            asked = urllib.request.Request(f"{address}/field.atlas", headers={"Range": "bytes=5-9,-3"})
            with urllib.request.urlopen(asked) as answer:
                self.assertEqual((answer.status, answer.headers["ETag"]), (206, etag))
                body = answer.read()
            self.assertIn(b"\r\n\r\n" + content[5:10] + b"\r\n--", body)
            self.assertIn(b"\r\n\r\n" + content[-3:] + b"\r\n--", body)
            for path in ("none", ".secret", "link", "../field.nrrd", "%2e%2e/field.nrrd", "", "field.atlas/"):
                with self.assertRaises(urllib.error.HTTPError, msg=path) as refused:
                    urllib.request.urlopen(f"{address}/{path}")
                self.assertEqual(refused.exception.code, 404, path)
            strange = urllib.request.Request(f"{address}/field.atlas", headers={"Host": "evil.example"})
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(strange)
            self.assertEqual(refused.exception.code, 421)
        self.run_error(3, "serve", "field.nrrd", says="is not a folder")

    def test_pages_of_a_site_may_read_where_they_are_allowed_to(self):
        def headers(address, origin, method="GET", path="field.nrrd"):
            asked = urllib.request.Request(f"{address}/{path}", method=method, headers={"Origin": origin} if origin else {})
            try:
                with urllib.request.urlopen(asked) as answer:
                    return answer.status, answer.headers
            except urllib.error.HTTPError as refused:
                return refused.code, refused.headers
        allowed = "Access-Control-Allow-Origin"
        (self.folder / "read").mkdir()
        shutil.copy(self.folder / "field.nrrd", self.folder / "read")
        site, other = "https://site.example", "https://site.example.org"
        with self.serving("read", "--allow-origin", site) as address:
            status, told = headers(address, site)
            self.assertEqual((status, told[allowed], told["Vary"]), (200, site, "Origin"))
            self.assertIn("Content-Range", told["Access-Control-Expose-Headers"])
            self.assertEqual(headers(address, site, path="none")[1][allowed], site)  # so that a page learns of it
            status, told = headers(address, site, "OPTIONS")
            self.assertEqual((status, told[allowed], told["Access-Control-Allow-Headers"]), (200, site, "Authorization, Range"))
            self.assertEqual(headers(address, site, "POST")[0], 405)
            for stranger in (other, "null", None):
                status, told = headers(address, stranger)
                self.assertEqual((status, told[allowed]), (200, None))
            self.assertEqual(headers(address, other, "OPTIONS")[0], 405)
        with self.serving("read", "--allow-origin", "*") as address:
            self.assertEqual(headers(address, other)[1][allowed], "*")
        with self.serving("read") as address:
            self.assertEqual([headers(address, site)[1][allowed], headers(address, site, "OPTIONS")[0]], [None, 405])
        for wrong in ("site.example", "https://", f"{site}/page", "https://a b"):
            self.run_error(2, "serve", "read", "--allow-origin", wrong, says="not the origin of a site")


class FirstPicture(CliTest):
    """`isoatlas view` of a store on a server: what the page asks for until its first object stands in the picture."""

    phantoms = {"scan.nrrd": ["random-field", "--size", "128"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        done = cls.start(["build", "scan.nrrd", "-o", "scan.atlas"])
        assert done.returncode == 0, done.stderr
        cls.local, _ = cls.first_picture("scan.atlas")
        assert {status for status, _ in cls.local} == {200}, cls.local

    @classmethod
    def first_picture(cls, store):
        """Status and body of each answer, in the order of web/src/viewer/main.ts, and what the viewer says of its traffic."""
        environment = {**os.environ, "XDG_CACHE_HOME": str(cls.folder / "cache")}
        viewer = Viewer(cls.folder, store, "--cache", "0", "-v", env=environment)
        answers = []
        try:
            for path in ("/api/volumes", "/api/scene", "/api/atlas"):
                status, _, body = viewer.ask(path)
                answers.append((status, body.replace(str(store).encode(), b"STORE")))
            if answers[-1][0] == 200:
                page = json.loads(body)
                first = next(entry for entry in page["entries"] if not entry["background"])
                status, _, body = viewer.ask(f"/api/surface?tau={first['tau']}&object=v{first['id']}&max=20000")
                answers.append((status, body))
        finally:
            code, said = viewer.stop()
        assert code == 0, said
        return answers, said

    def test_few_round_trips_and_few_bytes(self):
        with FileServer(self.folder) as server:
            answers, said = self.first_picture(f"{server.address}/scan.atlas")
            self.assertEqual(answers, self.local)
            requests, round_trips = map(int, re.search(r"network: (\d+) requests in (\d+) round trips", said).groups())
            self.assertEqual(requests, server.requests)
            self.assertLessEqual(round_trips, requests)
            # Two more: connections are opened before the first request, and again before the first several at a time.
            self.assertLess((round_trips + 2) * ROUND_TRIP + server.bytes / BYTES_A_SECOND, 2)
            self.assertLess(round_trips, 25)
            self.assertLess(server.bytes, (self.folder / "scan.atlas").stat().st_size)

    def test_many_at_once(self):
        """What several requests need is asked for once; each gets what it gets of a local store, also where some answers are cut short."""
        def all_at_once(store):
            viewer = Viewer(self.folder, store, "--cache", "0", "-v")
            try:
                atlas = json.loads(viewer.ask("/api/atlas")[2])
                paths = [f"/api/surface?tau={entry['tau']}&max={most}" for entry in atlas["entries"][:4] for most in (20000, 30000)]
                with concurrent.futures.ThreadPoolExecutor(len(paths)) as threads:
                    return [answer[::2] for answer in threads.map(viewer.ask, paths)]
            finally:
                code, said = viewer.stop()
                assert code == 0, said

        local = all_at_once("scan.atlas")
        self.assertEqual({status for status, _ in local}, {200})
        for faults in (None, small_pieces(1)):
            with self.subTest(faults=faults is not None), FileServer(self.folder, faults=faults) as server:
                self.assertEqual(all_at_once(f"{server.address}/scan.atlas"), local)
                if faults is None:
                    self.assertLess(server.bytes, 1.5 * (self.folder / "scan.atlas").stat().st_size)

    def test_answers_cut_short(self):
        for seed in range(3):
            with self.subTest(seed=seed), FileServer(self.folder, faults=small_pieces(seed)) as server:
                self.assertEqual(self.first_picture(f"{server.address}/scan.atlas")[0], self.local)

    def test_a_server_that_dies_in_the_middle(self):
        """While the store is opened, while the data of the page are read, while the surface is."""
        told = 0
        for number in (3, 9, 13):
            def dies(server, handler, path, request, number=number):
                if request < number:
                    return False
                handler.close_connection = True
                if request == number:
                    server.send_file(handler, part=10)
                else:
                    handler.connection.close()
                return True
            with self.subTest(number=number), FileServer(self.folder, faults=dies) as server:
                try:
                    answers, _ = self.first_picture(f"{server.address}/scan.atlas")
                except RuntimeError as error:  # it did not open
                    answers = []
                    self.assertRegex(str(error), "it ended with 3: .*no answer")
                    told += 1
                for answer, right in zip(answers, self.local):
                    if answer != right:
                        self.assertGreaterEqual(answer[0], 400)
                        self.assertIn(b"no answer", answer[1])
                        told += 1
        self.assertGreaterEqual(told, 3)


@unittest.skipUnless(shutil.which("openssl"), "openssl is not installed")
class Certificates(CliTest):
    """https with an authority of our own: trusted where SSL_CERT_FILE names it, for the names in the certificate."""

    phantoms = {"field.nrrd": ["random-field", "--size", "24"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for arguments in (["build", "field.nrrd", "-o", "field.atlas"], ["convert", "field.nrrd", "-o", "field.ome.zarr"],
                          ["extract", "field.atlas", "--tau", "1", "-o", "local.ply"]):
            done = cls.start(arguments)
            assert done.returncode == 0, done.stderr
        cls.openssl("req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=Authority of a test", "-keyout", "ca.key",
                    "-out", "ca.pem")
        cls.right, cls.other = cls.certificate("right", "IP:127.0.0.1"), cls.certificate("other", "DNS:other.example")

    @classmethod
    def openssl(cls, *arguments):
        subprocess.run(["openssl", *arguments], cwd=cls.folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    @classmethod
    def certificate(cls, name, host):
        cls.openssl("req", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={name}", "-keyout", f"{name}.key", "-out", f"{name}.csr")
        (cls.folder / f"{name}.ext").write_text(f"subjectAltName={host}\n")
        cls.openssl("x509", "-req", "-days", "2", "-in", f"{name}.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-extfile",
                    f"{name}.ext", "-out", f"{name}.crt")
        path = cls.folder / f"{name}.pem"
        path.write_text((cls.folder / f"{name}.crt").read_text() + (cls.folder / f"{name}.key").read_text())
        return path

    def ask(self, *arguments, authority="", token=""):
        environment = {"XDG_CACHE_HOME": str(self.folder / "cache"), "SSL_CERT_FILE": authority, "ISOATLAS_BEARER_TOKEN": token}
        return self.start(arguments, environment=environment)

    def test_a_trusted_certificate(self):
        with FileServer(self.folder, certificate=self.right, token="s3cret") as server:
            trusted = {"authority": str(self.folder / "ca.pem"), "token": "s3cret"}
            out = self.folder / "remote.ply"
            done = self.ask("extract", f"{server.address}/field.atlas", "--tau", "1", "-o", out, **trusted)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(out.read_bytes(), (self.folder / "local.ply").read_bytes())
            done = self.ask("extract", f"{server.address}/field.ome.zarr", "--tau", "1", "-o", out, **trusted)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(out.read_bytes(), (self.folder / "local.ply").read_bytes())

    def test_certificates_that_are_not_trusted(self):
        for certificate, authority in ((self.right, ""), (self.other, str(self.folder / "ca.pem")), (self.right, str(self.other))):
            with FileServer(self.folder, certificate=certificate, token="s3cret") as server:
                for name in ("field.atlas", "field.ome.zarr"):
                    with self.subTest(certificate=certificate.name, authority=authority, name=name):
                        done = self.ask("info", f"{server.address}/{name}", authority=authority, token="s3cret")
                        self.assertEqual(done.returncode, 3, done.stderr)
                        self.assertIn("it is not certain that this is 127.0.0.1", done.stderr)
                        self.assertIn("SSL_CERT_FILE", done.stderr)
                self.assertEqual(server.seen, [])  # no request, and no token, was sent

    def test_a_file_of_authorities_that_is_not_there(self):
        with FileServer(self.folder, certificate=self.right) as server:
            done = self.ask("info", f"{server.address}/field.atlas", authority=str(self.folder / "none.pem"))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("none.pem", done.stderr)
            self.assertEqual(server.seen, [])


if __name__ == "__main__":
    unittest.main()
