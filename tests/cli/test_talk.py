"""Standard output holds results only; talk, progress and interrupts behave; a result that cannot be written is an error."""
import json
import os
import re
import signal
import subprocess
import time

from harness import CLI, CliTest, main, writes_in


class Talk(CliTest):
    phantoms = {"v.nrrd": ["figure-plateau"], "big.nrrd": ["noise", "--size", "160"]}

    def test_quiet_silences_talk_but_not_results_or_errors(self):
        for arguments in (["info", "v.nrrd"], ["objects", "v.nrrd"], ["tree", "v.nrrd"], ["extract", "v.nrrd", "--tau", "45", "-o", "x.stl"]):
            loud, quiet = self.run_ok(*arguments), self.run_ok(*arguments, "--quiet")
            self.assertEqual(loud.stdout, quiet.stdout)
            self.assertNotIn("next:", quiet.stderr)
            self.assertNotEqual(loud.stdout, "")
        self.assertIn("none.nrrd", self.start(["info", "none.nrrd", "--quiet"]).stderr)

    def test_verbose_tells_time_and_memory(self):
        self.assertRegex(self.run_ok("tree", "v.nrrd", "-v").stderr, r"took \d+\.\d+ s, peak memory \d")

    def test_standard_output_of_json_is_one_document(self):
        for arguments in (["info", "v.nrrd"], ["objects", "v.nrrd"], ["objects", "v.nrrd", "--tau", "45"], ["tree", "v.nrrd"],
                          ["extract", "v.nrrd", "--tau", "45", "-o", "x.ply"], ["label", "v.nrrd", "--zones", "-o", "z.nrrd"],
                          ["phantom", "--list"], ["phantom", "gyroid", "--size", "8", "-o", "g.nrrd"], ["verify", "v.nrrd"]):
            document = self.run_json(*arguments)
            self.assertRegex(document["schema"], r"^isoatlas/[a-z-]+/[12]$")

    def test_full_disk_as_standard_output(self):
        for arguments in (["info", "v.nrrd"], ["objects", "v.nrrd"], ["tree", "v.nrrd", "--json"], ["objects", "v.nrrd", "--tau", "45", "--json"],
                          ["phantom", "--list"], ["--help"], ["verify", "v.nrrd"]):
            with open("/dev/full", "w") as full:
                done = self.start(arguments, stdout=full)
            self.assertEqual(done.returncode, 5, arguments)
            self.assertIn("standard output: cannot be written", done.stderr)

    def test_closed_pipe_as_standard_output(self):
        read_end, write_end = os.pipe()
        os.close(read_end)
        done = self.start(["tree", "v.nrrd", "--json"], stdout=write_end)
        os.close(write_end)
        self.assertEqual(done.returncode, 5)
        self.assertIn("pipe", done.stderr.lower())

    def test_an_interrupt_stops_the_work_and_leaves_nothing(self):
        for signal_number, verb in ((signal.SIGINT, ["tree", "big.nrrd", "-o", "big.json"]), (signal.SIGTERM, ["tree", "big.nrrd", "-o", "big.csv"])):
            process = subprocess.Popen([CLI, *verb, "--threads", "1"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertIn(b"160 x 160 x 160", process.stderr.readline())   # loaded: the analysis begins
            time.sleep(0.05)
            self.assertIsNone(process.poll(), "the volume is too small for this test")
            process.send_signal(signal_number)
            started = time.monotonic()
            output, talk = process.communicate(timeout=60)
            self.assertEqual((process.returncode, output), (130, b""), talk)
            self.assertIn(b"stopped", talk)
            self.assertLess(time.monotonic() - started, 20)
            self.assertFalse((self.folder / verb[-1]).exists())
            self.assert_no_partial()

    def test_an_interrupt_while_writing_removes_the_unfinished_file(self):
        process = subprocess.Popen([CLI, "tree", "big.nrrd", "-o", "slow.json"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not writes_in(process, self.folder):
            self.assertIsNone(process.poll(), "the file was never seen half-written")
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        _, talk = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, talk)
        self.assertFalse((self.folder / "slow.json").exists())
        self.assert_no_partial()

    def test_progress_on_a_terminal(self):
        shown = self.on_a_terminal(["tree", "big.nrrd", "--threads", "1"])
        self.assertRegex(shown, r"\[\d/\d\] [a-z ]+[#.]+ +\d+ %")
        self.assertRegex(shown, r"\r\x1b\[K[^\r]*$|\r\x1b\[K")
        self.assertNotIn("\r", self.on_a_terminal(["tree", "big.nrrd", "--threads", "1", "--quiet"]).replace("\r\n", "\n"))

    def test_progress_of_what_cannot_tell_how_far_it_is(self):
        self.run_ok("phantom", "noise", "--size", "36", "-o", "noise.nrrd")
        shown = self.on_a_terminal(["compare", "noise.nrrd", "--tau", "0.5001", "--methods", "connected-contours"])
        self.assertRegex(shown, r"\[\d/\d\] Connected contours of slices +\d:\d\d")
        self.assertNotIn("%", shown)

    def test_colours_only_when_wanted(self):
        self.assertIn("\033[1m", self.on_a_terminal(["objects", "v.nrrd"]))
        self.assertNotIn("\033[1m", self.on_a_terminal(["objects", "v.nrrd", "--no-color"]))
        self.assertNotIn("\033[1m", self.on_a_terminal(["objects", "v.nrrd"], NO_COLOR="1"))
        self.assertNotIn("\033[1m", self.run_ok("objects", "v.nrrd").stdout)


class Units(CliTest):
    """Lengths in the file's units, values calibrated."""

    def write_nifti(self, name, slope, intercept, values, dims, spacing):
        import struct
        header = bytearray(348)
        struct.pack_into("<i", header, 0, 348)
        struct.pack_into("<8h", header, 40, 3, *dims, 1, 1, 1, 1)
        struct.pack_into("<hh", header, 70, 4, 16)
        struct.pack_into("<8f", header, 76, 1, *spacing, 0, 0, 0, 0)
        struct.pack_into("<fff", header, 108, 352, slope, intercept)
        header[123] = 2   # mm
        header[344:348] = b"n+1\0"
        (self.folder / name).write_bytes(bytes(header) + bytes(4) + struct.pack(f"<{len(values)}h", *values))

    def ball(self, inside, outside):
        return [inside if (x - 2) ** 2 + (y - 2) ** 2 + (z - 2) ** 2 <= 2 else outside for z in range(5) for y in range(5) for x in range(5)]

    def test_isovalues_are_calibrated_ones(self):
        self.write_nifti("hu.nii", 0.5, -100, self.ball(1000, 0), (5, 5, 5), (2, 2, 3))
        info = self.run_json("info", "hu.nii")
        self.assertEqual((info["values"]["low"], info["values"]["high"]), (-100, 400))
        self.assertIn("-100 .. 400", self.run_ok("info", "hu.nii").stdout)
        at = self.run_json("objects", "hu.nii", "--tau", "400")
        self.assertEqual([o["voxels"] for o in at["objects"]], [19])
        self.assertEqual(at["units"]["measure"], "mm³")
        self.assertAlmostEqual(at["objects"][0]["measure"], 19 * 12)
        self.assertEqual(self.run_json("objects", "hu.nii", "--tau", "400", "--voxel")["objects"][0]["measure"], 19)
        self.run_error(6, "objects", "hu.nii", "--tau", "500", says="above")
        self.assertEqual(self.run_json("extract", "hu.nii", "--tau", "150", "-o", "ball.ply")["tau"], 150)
        self.assertIn("volume [mm³]", self.run_ok("objects", "hu.nii", "--all").stdout)
        best = self.run_json("objects", "hu.nii", "--all")["objects"][0]
        self.assertTrue(-100 < best["best_tau"] <= 400)

    def test_a_negative_slope_turns_the_order(self):
        self.write_nifti("negative.nii", -1, 0, self.ball(-7, 3), (5, 5, 5), (1, 1, 1))
        self.assertEqual(self.run_json("info", "negative.nii")["values"]["high"], 7)
        self.assertEqual([o["voxels"] for o in self.run_json("objects", "negative.nii", "--tau", "7")["objects"]], [19])

    def test_a_printed_value_means_the_sample_again(self):
        """0.7 is no float: the sample is a little less, and --tau 0.7 must still include it."""
        import struct
        (self.folder / "f_3x3x3_float32.raw").write_bytes(struct.pack("<27f", *([0.1] * 13 + [0.7] + [0.1] * 13)))
        self.assertEqual([o["id"] for o in self.run_json("objects", "f_3x3x3_float32.raw", "--tau", "0.7")["objects"]], [13])
        self.assertIn("0.1 .. 0.7", self.run_ok("info", "f_3x3x3_float32.raw").stdout)


if __name__ == "__main__":
    main()
