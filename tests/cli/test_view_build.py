"""`isoatlas view` of a volume without a store: the page is there at once and hears how far the build is; nothing is lost when it ends."""
import os
import signal
import subprocess
import unittest

import harness
import served


class Watching(harness.CliTest):
    phantoms = {"small.nrrd": ["random-field", "--size", "24", "--noise", "0.02"], "noise.nrrd": ["noise", "--size", "112"]}

    def tearDown(self):
        for name in ("small.atlas", "noise.atlas"):
            (self.folder / name).unlink(missing_ok=True)

    def begin_build(self):
        """Returns once it holds the lock."""
        builder = subprocess.Popen([harness.CLI, "build", "noise.nrrd", "-o", "noise.atlas", "--quiet"], cwd=self.folder, stdout=subprocess.DEVNULL)
        lock = self.folder / "noise.atlas.build" / "lock"
        while builder.poll() is None and not (lock.exists() and lock.read_bytes()):
            pass
        return builder

    def test_says_how_far_it_is_and_opens(self):
        viewer = served.Viewer(self.folder, "noise.nrrd")
        self.assertEqual(viewer.ask("/api/preview?tau=0.5")[0], 503)
        states = viewer.until("open")
        for state in states:
            self.assert_schema(state, "server-events")
        fractions = [state["build"]["fraction"] for state in states[:-1]]
        self.assertEqual(fractions, sorted(fractions))
        self.assertGreater(len({state["build"]["phase"] for state in states[:-1]}), 1)
        self.assertEqual(viewer.ask("/api/preview?tau=0.5")[0], 200)
        self.assertEqual(viewer.stop()[0], 0)

    def test_ends_while_it_builds_and_goes_on_from_there(self):
        viewer = served.Viewer(self.folder, "noise.nrrd")
        for state in viewer.states():
            if state["state"] != "building" or state["build"]["phase"] in ("objects", "pack"):
                break
        code, said = viewer.stop()
        self.assertIn(code, (0, 130), said)
        if code == 130:
            self.assertIn("finished phases are kept", said)
            self.assertFalse((self.folder / "noise.atlas").exists())
        viewer = served.Viewer(self.folder, "noise.nrrd")
        viewer.until("open")
        code, said = viewer.stop()
        self.assertEqual(code, 0)
        self.assertIn("was finished by an earlier build" if (self.folder / "noise.atlas.build").exists() else "noise.atlas", said + "noise.atlas")
        self.assertFalse((self.folder / "noise.atlas.build").exists())

    def test_waits_for_a_store_that_another_process_builds(self):
        builder = self.begin_build()
        for arguments in (["noise.nrrd", "--read-only"], ["noise.atlas", "--read-only"]):
            if builder.poll() is not None:
                break
            viewer = served.Viewer(self.folder, *arguments)
            states = viewer.until("open")
            self.assertEqual(states[-1]["state"], "open")
            self.assertEqual(viewer.stop()[0], 0)
        self.assertEqual(builder.wait(), 0)

    def test_says_when_that_process_has_left_no_store(self):
        builder = self.begin_build()
        viewer = served.Viewer(self.folder, "noise.nrrd", "--read-only")
        builder.send_signal(signal.SIGKILL)
        builder.wait()
        state = viewer.until("failed")[-1]
        self.assert_schema(state, "server-events")
        self.assertIn("isoatlas build noise.nrrd -o noise.atlas", state["error"]["next"])
        self.assertEqual(viewer.stop()[0], 5)
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas", "--quiet")

    def test_a_build_that_fails_is_told_with_its_next_step(self):
        viewer = served.Viewer(self.folder, "small.nrrd", "--tunnel-height", "0", "--gaussian", "1e9")
        state = viewer.until("failed")[-1]
        self.assert_schema(state, "server-events")
        self.assertNotEqual(state["error"]["next"], "")
        document = viewer.read_document()
        self.assertEqual(document["error"]["exit_code"], state["error"]["code"])
        self.assertEqual(document["error"]["message"], state["error"]["message"])
        code, said = viewer.stop()
        self.assertEqual(code, state["error"]["code"])
        self.assertIn(state["error"]["message"], said)
        self.assertIn(f"Ctrl-C ends the viewer with exit code {code}", said)

    def test_an_image_is_refused_with_what_to_do_instead(self):
        (self.folder / "image.nrrd").write_bytes(b"NRRD0004\ntype: uint8\ndimension: 2\nsizes: 4 4\nencoding: raw\n\n" + bytes(range(16)))
        self.run_ok("build", "image.nrrd", "-o", "image2.atlas", "--quiet")
        for file in ("image.nrrd", "image2.atlas"):
            done = self.start(["view", file, "--no-browser"])
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"Next: isoatlas {file} makes a page of it", done.stderr)
            self.run_ok(file, "--quiet")

    def test_read_only_writes_nothing(self):
        before = sorted(os.listdir(self.folder))
        done = self.start(["view", "small.nrrd", "--no-browser", "--read-only"])
        self.assertEqual(done.returncode, 5)
        self.assertIn("isoatlas build small.nrrd -o small.atlas", done.stderr)
        self.run_ok("build", "small.nrrd", "-o", "small.atlas", "--quiet")
        viewer = served.Viewer(self.folder, "small.nrrd", "--read-only")
        for path in ("surface?tau=0&format=stl", "label?tau=0&format=nii.gz", "label?tau=0&format=tif", "atlas", "surface?tau=0"):
            self.assertEqual(viewer.ask("/api/" + path)[0], 200, path)
        self.assertEqual(viewer.stop()[0], 0)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted([*before, "small.atlas"]))


class Leaving(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "128"]}

    def setUp(self):
        if not (self.folder / "noise.atlas").exists():
            self.run_ok("build", "noise.nrrd", "-o", "noise.atlas", "--quiet")
        self.viewer = served.Viewer(self.folder, "noise.atlas", "--threads", "1")

    def tearDown(self):
        self.assertEqual(self.viewer.stop()[0], 0)

    def begin_and_see(self, lane):
        """A request whose answer is being made, and the states that go on to come."""
        states = self.viewer.states("me")
        connection = self.viewer.begin("/api/surface?tau=0.5", "me/" + lane)
        for state in states:
            if any(request["client"] == "me/" + lane and request["place"] == 0 for request in state["requests"]):
                return connection, states
        self.fail("the request was never seen")

    def gone_before_done(self, states):
        """The furthest that the extraction has come when it was ended."""
        furthest = 0
        for state in states:
            if not state["requests"]:
                return furthest
            furthest = max(furthest, state["requests"][0]["fraction"])
        self.fail("the stream ended")

    def test_a_closed_connection_ends_its_request(self):
        connection, states = self.begin_and_see("surface")
        connection.close()
        self.assertLess(self.gone_before_done(states), 0.9)

    def test_the_end_of_the_events_ends_all_requests_of_a_client(self):
        connection, states = self.begin_and_see("surface")
        states.close()
        answer = connection.recv(65536)
        connection.close()
        self.assertIn(b" 409 ", answer.split(b"\r\n")[0])


if __name__ == "__main__":
    harness.main()
