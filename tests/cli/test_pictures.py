"""Pictures and animations: what is in them, how they are asked for, what goes wrong."""
import shutil
import struct
import subprocess
import zlib

from harness import CliTest, main


def png_pixels(data):
    """Width, height and rows of RGB or RGBA pixels of a PNG file, with nothing but zlib."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed, shape = 8, b"", None
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(name + content)
        if name == b"IHDR":
            shape = struct.unpack(">IIBBBBB", content)
        if name == b"IDAT":
            packed += content
        at += 12 + size
    width, height, depth, kind = shape[:4]
    channels = {2: 3, 6: 4}[kind]
    assert depth == 8
    raw, rows, above = zlib.decompress(packed), [], bytes(width * channels)
    for y in range(height):
        begin = y * (width * channels + 1)
        rule, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + width * channels])
        for i in range(len(row)):
            left, up = row[i - channels] if i >= channels else 0, above[i]
            corner = above[i - channels] if i >= channels else 0
            p = left + up - corner
            nearest = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            row[i] = (row[i] + [0, left, up, (left + up) // 2, nearest][rule]) & 255
        rows.append([tuple(row[i:i + channels]) for i in range(0, len(row), channels)])
        above = bytes(row)
    return width, height, rows


class Pictures(CliTest):
    phantoms = {"shells.nrrd": ["nested-shells", "--size", "32", "--shells", "2"], "figure.nrrd": ["figure-plateau"]}
    small = ["--size", "64x48", "--samples", "1"]

    def setUp(self):
        for path in self.folder.glob("p.*"):
            path.unlink()

    def picture(self, *arguments):
        self.run_ok("render", *arguments, *self.small, "-o", "shown.png", "--quiet")
        return png_pixels((self.folder / "shown.png").read_bytes())

    def test_a_picture_shows_something(self):
        width, height, rows = self.picture("shells.nrrd", "--tau", "0.5", "--plain")
        self.assertEqual((width, height), (64, 48))
        self.assertNotEqual(rows[24][32], rows[24][1])
        self.assertEqual(len(rows[0][0]), 3)
        _, _, rows = self.picture("shells.nrrd", "--tau", "0.5", "--plain", "--background", "transparent")
        self.assertEqual(rows[0][0][3], 0)
        self.assertEqual(rows[24][32][3], 255)

    def test_colours_and_cuts(self):
        _, _, rows = self.picture("shells.nrrd", "--tau", "0.5", "--plain", "--colour", "#FF0000", "--view", "front")
        red, green, blue = rows[24][32]
        self.assertGreater(red, 2 * max(green, blue, 1))
        whole = rows
        _, _, rows = self.picture("shells.nrrd", "--tau", "0.5", "--plain", "--colour", "#FF0000", "--view", "front", "--cut", "half")
        self.assertNotEqual(rows, whole)

    def test_points(self):
        self.run_ok("phantom", "nested-shells", "--size", "32", "--shells", "2", "-o", "hollow.nrrd", "--quiet")
        one = self.run_json("render", "hollow.nrrd", "--tau", "0.5", "--points", "1", *self.small, "-o", "p.png")["objects"][0]
        four = self.run_json("render", "hollow.nrrd", "--tau", "0.5", "--points", "4", *self.small, "-o", "p.png")["objects"][0]
        self.assertEqual([one["triangles"], four["triangles"]], [0, 0])
        self.assertGreater(four["points"], 10 * one["points"])
        surface = self.picture("hollow.nrrd", "--tau", "0.5", "--plain", "--background", "transparent")[2]
        points = self.picture("hollow.nrrd", "--tau", "0.5", "--plain", "--background", "transparent", "--points", "4")[2]
        covered = [sum(pixel[3] > 127 for row in rows for pixel in row) for rows in (surface, points)]
        self.assertLess(abs(covered[0] - covered[1]), 0.1 * covered[0])
        def objects(*words):
            return self.run_json("render", "hollow.nrrd", *words, "--points", "2", *self.small, "-o", "p.png")["objects"]
        both, one, walls = (objects(*words)[0]["points"] for words in (["--tau", "0.5"], ["--object", "1@0.5"], ["--cavities", "1@0.5"]))
        self.assertLess(one, both)   # the other shell is left out
        self.assertLess(walls, one)
        self.assertGreater(walls, 0)
        self.run_error(2, "render", "hollow.nrrd", "--tau", "0.5", "--points", "2", "--opacity", "0.5", "-o", "p.png")

    def test_points_of_a_store_read_what_the_surface_needs(self):
        self.run_ok("phantom", "demo", "-o", "demo.nrrd", "--quiet")
        self.run_ok("build", "demo.nrrd", "-o", "demo.atlas", "--quiet")
        tau = str(0.9 * self.run_json("info", "demo.nrrd")["values"]["high"])
        words = ["--tau", tau, "--points", "2", *self.small, "-o"]
        stored = self.run_json("render", "demo.atlas", *words, "stored.png")
        self.run_ok("render", "demo.nrrd", *words, "whole.png")
        self.assertEqual((self.folder / "stored.png").read_bytes(), (self.folder / "whole.png").read_bytes())
        self.assertGreater(stored["objects"][0]["points"], 0)
        self.assertLess(stored["reads"]["bricks"], 96 ** 3 / 1024)   # all

    def test_document(self):
        document = self.run_json("render", "figure.nrrd", "--tau", "60", "--tau", "30", "--slice", "z=12", "--volume", *self.small, "-o", "p.png")
        self.assert_schema(document, "render")
        self.assertEqual([thing["tau"] for thing in document["objects"]], [60, 30])
        self.assertEqual(document["objects"][0]["opacity"], 1)
        self.assertLess(document["objects"][1]["opacity"], 1)
        self.assertEqual(document["slices"], 1)
        self.assertTrue(document["transfer"])
        flat = self.run_json("render", "figure.nrrd", "--slice", "z=12", "--flat", *self.small, "-o", "p.png")
        self.assert_schema(flat, "render")
        self.assertIsNone(flat["camera"])
        self.assertEqual((flat["width"], flat["height"]), (48, 48))
        _, _, upwards = self.picture("figure.nrrd", "--slice", "y=12", "--flat")
        _, _, downwards = self.picture("figure.nrrd", "--slice", "y=12", "--flat", "--up", "-z")
        self.assertTrue(upwards != downwards)
        self.assertTrue([row[::-1] for row in upwards[::-1]] == downwards)

    def test_up(self):
        def drawn(up):
            return self.picture("figure.nrrd", "--tau", "60", "--view", "front", f"--up={up}")

        self.assertEqual(drawn("-z"), drawn("0,0,-2"))
        self.assertEqual(drawn("y"), drawn("0,1,0"))
        self.assertNotEqual(drawn("z"), drawn("0.5,0,0.866"))

    def test_materials(self):
        air, flesh = "air:0:8:#000000:0", "flesh:60:10:#FF0000:0.2"
        document = self.run_json("render", "figure.nrrd", "--material", air, "--material", flesh, "--material", "bone:90:5:#0000FF", *self.small, "-o", "m.png")
        self.assert_schema(document, "render")
        self.assertEqual([thing["name"] for thing in document["materials"]], ["air", "flesh", "bone"])
        self.assertEqual([thing["opacity"] for thing in document["materials"]], [0, 0.2, 0.1])
        self.assertEqual((document["transfer"], document["objects"]), ([], []))
        self.assertNotEqual(self.picture("figure.nrrd", "--material", air, "--material", flesh),
                            self.picture("figure.nrrd", "--material", air, "--material", "flesh:60:20:#FF0000:0.2"))
        for wrong in ("flesh", "flesh:60:0:#FF0000", "flesh:60:1:red", "flesh:60:1:#FF0000:1", ":60:1:#FF0000", "flesh:x:1:#FF0000"):
            self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--material", wrong, says="--material")

    def test_optical_models(self):
        matter = ("--transfer", "30:0:#FF8000,60:0.05,100:0.05", "--view", "30,20", "--plain")
        default = self.picture("figure.nrrd", *matter)
        self.assertEqual(default, self.picture("figure.nrrd", *matter, "--optics", "absorption-emission"))
        seen = [default]
        for model in ("absorption", "emission", "single-scattering", "multiple-scattering"):
            seen.append(self.picture("figure.nrrd", *matter, "--optics", model))
            self.assertNotIn(seen[-1], seen[:-1], model)
        for option in (["--albedo", "0.5"], ["--asymmetry", "0.6"], ["--light=-x"], ["--sky", "0.5"]):
            self.assertNotEqual(seen[-1], self.picture("figure.nrrd", *matter, "--optics", "multiple-scattering", *option), option)
        document = self.run_json("render", "figure.nrrd", *matter, "--optics", "multiple-scattering", "--light=0,0,2", "--sky", "0.5", *self.small, "-o", "o.png")
        self.assert_schema(document, "render")
        self.assertEqual(document["optics"], {"model": "multiple-scattering", "albedo": 1, "asymmetry": 0, "light": [0, 0, 1], "sky": 0.5})
        document = self.run_json("render", "figure.nrrd", "--tau", "60", *self.small, "-o", "o.png")
        self.assertIsNone(document["optics"])

    def test_errors_of_optical_models(self):
        volume, single = ("--volume",), ("--volume", "--optics", "single-scattering")
        for wrong, says in (((*volume, "--optics", "reflection"), "multiple-scattering"),
                            (("--tau", "60", "--optics", "emission"), "add --volume"),
                            ((*single, "--shadows"), "leave out --shadows"),
                            ((*volume, "--optics", "emission", "--background", "transparent"), "--background dark"),
                            ((*volume, "--albedo", "0.5"), "--optics single-scattering"),
                            ((*volume, "--optics", "absorption", "--light=x"), "does not"),
                            ((*single, "--sky", "1"), "add --optics multiple-scattering"),
                            ((*single, "--albedo", "1.5"), "--albedo"),
                            ((*single, "--asymmetry=-1"), "--asymmetry"),
                            ((*single, "--light=0,0,0"), "--light")):
            self.run_error(2, "render", "figure.nrrd", "-o", "p.png", *wrong, says=says)

    def test_opacity_curves(self):
        flesh, bone = "30:0:#FF0000,60:0.2,80:0", "80:0:#00FF00,90:0.5:#0000FF,100:0.5"
        document = self.run_json("render", "figure.nrrd", "--transfer", flesh, f"--transfer={bone}", *self.small, "-o", "c.png")
        self.assert_schema(document, "render")
        self.assertEqual((document["transfer"], document["materials"], document["objects"]), ([], [], []))
        first, second = (curve["points"] for curve in document["curves"])
        self.assertEqual([(point["value"], point["opacity"]) for point in first], [(30, 0), (60, 0.2), (80, 0)])
        self.assertEqual([point["colour"] for point in first], [[1, 0, 0]] * 3)
        self.assertEqual([point["colour"] for point in second], [[0, 1, 0], [0, 0, 1], [0, 0, 1]])
        alone = self.picture("figure.nrrd", "--transfer", flesh, "--plain")
        both = self.picture("figure.nrrd", "--transfer", flesh, "--transfer", bone, "--plain")
        self.assertNotEqual(both, alone)
        self.assertEqual(both, self.picture("figure.nrrd", "--transfer", bone, "--transfer", flesh, "--plain"))
        self.assertEqual(alone, self.picture("figure.nrrd", "--volume", "--transfer", flesh, "--plain"))
        self.assertEqual(alone, self.picture("figure.nrrd", "--transfer", "30:0:#FF0000,60:0.2:#FF0000,80:0:#FF0000", "--plain"))

    def test_opacity_curves_are_in_values_of_the_file(self):
        curve = ("--transfer", "30:0:#FF0000,60:0.2:#00FF00,80:0.05:#0000FF,100:0", "--view", "30,20", "--plain")
        _, _, high = self.picture("figure.nrrd", *curve)
        _, _, low = self.picture("figure.nrrd", *curve, "--polarity", "low")  # samples are negated: the curve is reversed
        self.assertTrue(any(pixel != high[0][0] for row in high for pixel in row))
        self.assertLessEqual(max(abs(a - b) for one, other in zip(high, low) for p, q in zip(one, other) for a, b in zip(p, q)), 2)

    def test_errors_of_opacity_curves(self):
        for wrong, says in (("30", '"30" is not a point'), ("30:0", "a colour at the first point"), ("30:0:#FF0000", "is one point"),
                            ("30:0:red,40:1", "in hexadecimal"), ("30:0:#FF0000,40:1", "from 0 to below 1"),
                            ("30:0:#FF0000,20:0.5", "below that of the point before it"), ("x:0:#FF0000,20:0.5", "a finite number"),
                            ("1:0:#FF0000,2:0.5:#FF0000:3", "is not a point")):
            self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--transfer", wrong, says=says)
            self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--transfer", wrong, says="--transfer=300:0:#F0E8D0")

    def test_a_store_gives_the_same_picture_with_any_threads(self):
        self.run_ok("build", "figure.nrrd", "-o", "figure.atlas")
        pictures = []
        for name, threads in (("figure.nrrd", 1), ("figure.nrrd", 2), ("figure.atlas", 3)):
            self.run_ok("render", name, "--top", "2", "--slice", "y=3", *self.small, "--threads", threads, "-o", "t.png")
            pictures.append((self.folder / "t.png").read_bytes())
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[0], pictures[2])

    def test_the_same_bytes_with_any_threads(self):
        for wanted in (["render", "--tau", "60", "--tau", "30", "--cut", "octant", "-o", "t.png"],
                       ["render", "--volume", "--shadows", "--tau", "90", "-o", "t.png"],
                       ["animate", "--from", "90", "--to", "10", "--steps", "3", "-o", "t.gif"]):
            made = []
            for threads in (1, 2, 5):
                self.run_ok(wanted[0], "figure.nrrd", *wanted[1:], *self.small, "--threads", threads, "--quiet")
                made.append((self.folder / wanted[-1]).read_bytes())
            self.assertEqual(made[0], made[1])
            self.assertEqual(made[0], made[2])

    def test_the_box_of_the_volume_is_left_out(self):
        side, middle = 24, 11.5
        samples = bytearray(side ** 3)
        for i in range(side ** 3):
            at = (i % side, i // side % side, i // side ** 2)
            if 0 < min(at) and max(at) < side - 1:
                samples[i] = 200 if sum((a - middle) ** 2 for a in at) < 36 else 40
        (self.folder / "box.raw").write_bytes(samples)
        box = ["box.raw", "--dims", "24x24x24", "--type", "uint8"]
        self.assertEqual(self.run_json("objects", *box)["objects"][1]["reason"], "outline")
        document = self.run_json("render", *box, "--top", "2", "--volume", *self.small, "-o", "b.png")
        self.assertEqual(len(document["objects"]), 1)
        self.assertGreater(min(bump["low"] for bump in document["transfer"]), 40)

    def test_a_store_reads_what_is_seen(self):
        self.run_ok("build", "shells.nrrd", "-o", "shells.atlas")
        for wanted in (["--volume"], ["--volume", "--shadows", "--slice", "x=3"], ["--volume", "--optics", "multiple-scattering"], ["--slice", "z=20", "--tau", "0.5"], ["--slice", "y=31", "--flat"]):
            seen = []
            for name in ("shells.nrrd", "shells.atlas"):
                document = self.run_json("render", name, *wanted, *self.small, "--view", "30,20", "-o", "s.png")
                self.assert_schema(document, "render")
                seen.append((self.folder / "s.png").read_bytes())
            self.assertEqual(*seen)
        self.assertLess(document["reads"]["cells_loaded"], 32 ** 3 / 3)

    def events_of(self, name, *selection, taus=("95", "5", "10")):
        """What the labels of an evolution say: significant counts of every frame."""
        document = self.run_json("animate", name, "--from", taus[0], "--to", taus[1], "--steps", taus[2], *selection, *self.small, "-o", "e.gif")
        self.assert_schema(document, "animate")
        return [frame["significant"] for frame in document["frames"]], document["frames"]

    def test_labels_of_a_noisy_evolution_are_those_of_the_clean_one(self):
        clean, frames = self.events_of("figure.nrrd")
        for significant, frame in zip(clean, frames):  # nothing of the clean figure is noise
            self.assertEqual(significant, {name: frame[name] for name in significant})
        self.assertEqual([(e["appeared"], e["merged"]) for e in clean], [(0, 0)] + 3 * [(1, 0)] + 3 * [(0, 1)] + 3 * [(0, 0)])
        for seed in ("1", "2"):
            self.run_ok("phantom", "figure-plateau", "--noise", "0.02", "--seed", seed, "-o", "noisy.nrrd")
            noisy, frames = self.events_of("noisy.nrrd")
            self.assertEqual(noisy, clean)
            self.assertGreater(sum(frame["tunnels"] for frame in frames), sum(e["tunnels"] for e in noisy))
            _, frames = self.events_of("noisy.nrrd", taus=("100", "0", "11"))  # in the plateaus, where noise makes hundreds
            self.assertGreater(max(frame["tunnels"] for frame in frames), 100)
            self.assertEqual([sum(frame["significant"][name] for frame in frames) for name in ("appeared", "merged")], [3, 3])
        self.run_ok("build", "noisy.nrrd", "-o", "noisy.atlas")
        self.assertEqual(self.events_of("noisy.atlas")[0], clean)

    def test_an_evolution_of_a_selection(self):
        kept, frames = self.events_of("figure.nrrd", "--keep", "2")
        self.assertEqual([e["objects"] for e in kept], [1, 1, 2, 2, 2, 2, 1, 1, 1, 1])
        self.assertEqual(max(frame["objects"] for frame in frames), 4)
        self.assertEqual([(e["appeared"], e["merged"]) for e in self.events_of("figure.nrrd", "--keep", "2", taus=("5", "95", "2"))[0]],
                         [(0, 0), (1, 1)])
        self.run_error(2, "animate", "figure.nrrd", "--keep", "2", "-o", "e.gif", says="selection", next_says="--from")

    def test_animations(self):
        for name, begin in (("a.gif", b"GIF89a"), ("a.png", b"\x89PNG"), ("a.apng", b"\x89PNG"), ("a.webp", b"RIFF")):
            document = self.run_json("animate", "figure.nrrd", "--from", "90", "--to", "10", "--steps", "4", *self.small, "-o", name)
            self.assert_schema(document, "animate")
            self.assertEqual(document["frame_count"], 4)
            self.assertTrue((self.folder / name).read_bytes().startswith(begin), name)
        frames = document["frames"]
        self.assertEqual([frame["tau"] for frame in frames][0], 90)
        for frame in frames:
            cut = self.run_json("objects", "figure.nrrd", "--tau", frame["tau"])
            self.assertEqual(frame["objects"], cut["object_count"])
            self.assertEqual(frame["tunnels"], sum(thing["b1"] for thing in cut["objects"]))
            self.assertEqual(frame["cavities"], sum(thing["b2"] for thing in cut["objects"]))
        turn = self.run_json("animate", "figure.nrrd", "--tau", "60", "--steps", "3", *self.small, "-o", "t.gif")
        self.assertEqual((turn["frame_count"], turn["frames"]), (3, []))

    def test_film(self):
        if shutil.which("ffmpeg") is None:
            self.run_error(4, "animate", "figure.nrrd", "-o", "p.mp4", says="ffmpeg")
            self.skipTest("no ffmpeg here")
        odd = ["--size", "65x49", "--samples", "1"]
        document = self.run_json("animate", "figure.nrrd", "--from", "90", "--to", "10", "--steps", "5", "--fps", "10", *odd, "-o", "p.mp4")
        self.assertEqual(document["frame_count"], 5)
        self.assertEqual((self.folder / "p.mp4").read_bytes()[4:8], b"ftyp")
        shown = subprocess.run(["ffmpeg", "-v", "error", "-i", "p.mp4", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                               cwd=self.folder, capture_output=True, check=True).stdout
        width, height = 66, 50  # sides of films are even
        self.assertEqual(len(shown), 5 * 3 * width * height)
        self.run_ok("animate", "figure.nrrd", "--from", "90", "--to", "10", "--steps", "5", *odd, "-o", "p.apng", "--quiet")
        _, _, first = png_pixels((self.folder / "p.apng").read_bytes())
        difference = [abs(shown[3 * (y * width + x) + c] - first[y][x][c]) for y in range(49) for x in range(65) for c in range(3)]
        self.assertLess(sum(difference) / len(difference), 6)
        self.assertEqual([path.name for path in self.folder.glob("p.mp4*")], ["p.mp4"])

    def test_an_eye_somewhere(self):
        """The camera that the document tells, given back, makes the same picture; a plane can be oblique."""
        words = ["--tau", "60", "--size", "64x48", "--samples", "1", "--plain"]
        for more in ([], ["--perspective"]):
            camera = self.run_json("render", "figure.nrrd", *words, *more, "--view", "30,20", "-o", "a.png")["camera"]
            far = 3.5 if more else 1e3
            eye = ",".join(repr(t + far * d) for t, d in zip(camera["target"], camera["toward"]))
            place = ["--eye=" + eye, "--target=" + ",".join(map(repr, camera["target"])), "--height", repr(camera["height"])]
            again = self.run_json("render", "figure.nrrd", *words, *more, *place, "-o", "b.png")["camera"]
            self.assertEqual(again["projection"], camera["projection"])
            self.assertAlmostEqual(again["height"], camera["height"])
            if not more:
                self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        for cut, same in (("x>20", "1x+0y>20"), ("z<20", "-z>-20"), ("0.5y>10", "y>20")):
            self.run_ok("render", "figure.nrrd", *words, "--cut", cut, "-o", "a.png", "--quiet")
            self.run_ok("render", "figure.nrrd", *words, "--cut=" + same, "-o", "b.png", "--quiet")
            self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_parts_of_objects(self):
        """A contour, and the walls of the cavities of an object, are those that extract writes."""
        def cut(tau):
            return self.run_json("objects", "shells.nrrd", "--tau", str(tau))["objects"]
        self.run_ok("phantom", "demo", "--size", "40", "-o", "shells.nrrd", "--quiet")
        tau, there = next((t, o) for t in range(20, 240, 20) for o in cut(t) if o["b2"] > 0)
        walls = [c["id"] for c in there["contours"] if c["shell"] == "inner"]
        objects = ["--object", f"v{there['id']}@{tau}", "--contour", f"v{walls[0]}@{tau}", "--cavities", f"v{there['id']}@{tau}"]
        drawn = self.run_json("render", "shells.nrrd", *objects, "--size", "48", "--samples", "1", "-o", "p.png")["objects"]
        def triangles(*words):
            return self.run_json("extract", "shells.nrrd", "--tau", str(tau), *words, "-o", "p.ply")["triangles"]
        self.assertEqual([o["triangles"] for o in drawn], [triangles("--object", f"v{there['id']}"), triangles("--contour", f"v{walls[0]}"),
                                                           triangles("--object", f"v{there['id']}", "--shell", "inner")])

    def test_what_goes_wrong(self):
        self.run_error(2, "render", "figure.nrrd", "-o", "p.bmp", says=".bmp")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--view", "above", says="--view")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--cut", "x=3", says="--cut")
        for cut in ("x>", ">3", "2>3", "x-+y>3", "1e999x>3", "0x>3", "x>nan"):
            self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--cut", cut, says="--cut")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--eye", "1,2,3", says="--target")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--eye", "1,2,3", "--target", "1,2,3", says="--eye")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--contour", "12", says="contour 12")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--colour", "red", says="--colour")
        for up in ("w", "0,0,0", "1,2", "1,2,3,4", "x,y,z"):
            self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--up", up, says="--up")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--size", "0x7", says="--size")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--object", "12@", says="--object")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--slice", "z=99", says="slice 99")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--flat", says="--flat")
        self.run_error(2, "render", "figure.nrrd", "-o", "p.png", "--opacity", "0", says="--opacity")
        self.run_error(6, "render", "figure.nrrd", "-o", "p.png", "--tau", "1000", says="above every sample")
        self.run_error(6, "render", "figure.nrrd", "-o", "p.png", "--object", "999999", says="999999")
        self.run_error(2, "animate", "figure.nrrd", "-o", "p.gif", "--from", "3", says="--to")
        (self.folder / "flat.raw").write_bytes(bytes(range(64)))
        flat = ["flat.raw", "--dims", "8x8", "--type", "uint8"]
        self.run_error(2, "render", *flat, "--tau", "9", "-o", "p.png", says="2D")
        self.run_error(2, "animate", *flat, "--from", "9", "--to", "3", "-o", "p.gif", says="2D")
        for name in ("p.png", "p.webp"):
            self.run_error(5, "render", "figure.nrrd", "--tau", "60", "-o", "nowhere/" + name, says="folder")
        for name in ("p.gif", "p.apng", "p.webp"):
            self.run_error(5, "animate", "figure.nrrd", "--steps", "2", "-o", "nowhere/" + name, says="folder")
        self.run_error(2, "animate", "figure.nrrd", "-o", "p.vtkhdf", says="which isovalues")
        for option, *value in (["--cut", "half"], ["--keep", "2"], ["--tau", "60"], ["--plain"], ["--fps", "9"]):
            self.run_error(2, "animate", "figure.nrrd", "-o", "p.vtkhdf", "--from", "90", "--to", "30", option, *value, says=option)
        self.run_error(5, "animate", "figure.nrrd", "--from", "90", "--to", "30", "-o", "nowhere/p.vtkhdf", says="folder")
        self.run_error(6, "animate", "figure.nrrd", "-o", "p.vtkhdf", "--from", "1000", "--to", "3", says="above every sample")
        self.run_error(2, "animate", "figure.nrrd", "-o", "p.gif", "--size", "1", says="--size")
        self.run_error(2, "animate", "figure.nrrd", "-o", "p.gif", "--steps", "0", says="--steps")
        self.run_error(6, "animate", "figure.nrrd", "-o", "p.gif", "--from", "1000", "--to", "3", says="above every sample")
        self.assert_nothing_drawn()

    def assert_nothing_drawn(self):
        self.assert_no_partial()
        self.assertEqual([path.name for path in self.folder.glob("p.*")], [])

    def test_a_damaged_store(self):
        self.run_ok("build", "shells.nrrd", "-o", "damaged.atlas")
        whole = (self.folder / "damaged.atlas").read_bytes()
        pictures = (["render", "--tau", "0.5", "-o", "p.png"], ["render", "--volume", "-o", "p.png"],
                    ["animate", "--from", "0.9", "--to", "0.1", "--steps", "2", "-o", "p.gif"])
        refused = 0
        for damaged in (whole[:len(whole) // 2], *(whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1:]
                                                   for at in range(len(whole) // 9, len(whole), len(whole) // 9))):
            (self.folder / "damaged.atlas").write_bytes(damaged)
            for verb, *wanted in pictures:
                result = self.start([verb, "damaged.atlas", *wanted, *self.small, "--quiet"])
                if result.returncode == 0:  # what is damaged was not read
                    (self.folder / wanted[-1]).unlink()
                    continue
                refused += 1
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertIn("damaged.atlas", result.stderr)
                self.assert_nothing_drawn()
        self.assertGreater(refused, len(pictures))

    def test_volumes_with_one_value(self):
        for size in (1, 8):
            (self.folder / "one.raw").write_bytes(bytes([7]) * size ** 3)
            volume = ["one.raw", "--dims", "x".join(3 * [str(size)]), "--type", "uint8"]
            for wanted in (["--top", "3"], ["--tau", "7"], ["--volume", "--shadows"], ["--slice", "z=0", "--flat"]):
                self.assertEqual(self.picture(*volume, *wanted)[:2], (48, 48) if "--flat" in wanted else (64, 48))
            self.run_ok("animate", *volume, "--from", "7", "--to", "7", "--steps", "2", *self.small, "-o", "a.gif", "--quiet")
            self.run_error(6, "render", *volume, "--tau", "8", "-o", "p.png", says="above every sample")
        self.assert_nothing_drawn()

    def test_isovalues_below_zero(self):
        ramp = struct.pack("<512h", *(i % 8 - 8 for i in range(512)))
        (self.folder / "below.raw").write_bytes(ramp)
        below = ["below.raw", "--dims", "8x8x8", "--type", "int16", "--endian", "little"]
        self.assertEqual(self.picture(*below, "--tau=-5"), self.picture(*below, "--tau", "-5"))
        self.run_ok("animate", *below, "--from=-2", "--to", "-6", "--steps", "2", *self.small, "-o", "a.gif", "--quiet")


if __name__ == "__main__":
    main()
