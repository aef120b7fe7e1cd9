"""extract -o NAME.precomputed: a folder of multi-resolution meshes for Neuroglancer. What is in the fragments, a unit test decodes."""
import json
import struct

import harness
from harness import CliTest


class Manifest:
    """The manifest of a segment, whose fragments take `size` bytes."""

    def __init__(self, data):
        self.chunk = struct.unpack_from("<3f", data)
        self.origin = struct.unpack_from("<3f", data, 12)
        levels, = struct.unpack_from("<I", data, 24)
        self.scales = struct.unpack_from(f"<{levels}f", data, 28)
        at = 28 + 16 * levels
        counts = struct.unpack_from(f"<{levels}I", data, at)
        at += 4 * levels
        self.places, self.size = [], 0
        for count in counts:
            numbers = struct.unpack_from(f"<{4 * count}I", data, at)
            self.places.append(list(zip(numbers[:count], numbers[count:2 * count], numbers[2 * count:3 * count])))
            self.size += sum(numbers[3 * count:])
            at += 16 * count
        assert at == len(data), (at, len(data))


class Precomputed(CliTest):
    phantoms = {"field.nrrd": ["random-field", "--size", "90"], "chain.nrrd": ["torus-chain", "--size", "24"]}

    def manifests(self, name):
        folder = self.folder / name
        found = []
        for index in sorted(folder.glob("*.index"), key=lambda path: int(path.stem)):
            manifest = Manifest(index.read_bytes())
            self.assertEqual(manifest.size, (folder / index.stem).stat().st_size)
            found.append(manifest)
        return found

    def test_each_object_is_a_segment_in_levels(self):
        found = self.run_json("extract", "field.nrrd", "--top", "3", "-o", "field.precomputed")
        self.assert_schema(found, "extract")
        manifests = self.manifests("field.precomputed")
        self.assertEqual(len(manifests), len(found["surfaces"]))
        self.assertEqual(found["levels"][0]["triangles"], found["triangles"])
        self.assertEqual(found["levels"][0]["distance"], 0)
        self.assertLess(3 * found["levels"][-1]["triangles"], found["triangles"])
        for one, next_one in zip(found["levels"], found["levels"][1:]):
            self.assertLess(next_one["triangles"], one["triangles"])
            self.assertGreater(next_one["distance"], one["distance"])
        for manifest in manifests:
            self.assertEqual((manifest.chunk, manifest.origin), ((64, 64, 64), (0, 0, 0)))
            self.assertEqual(list(manifest.scales), [2 ** k for k in range(len(manifest.scales))])
            for finer, coarser in zip(manifest.places, manifest.places[1:]):
                self.assertEqual(len(set(coarser)), len(coarser))
                self.assertEqual(set(coarser), {tuple(x // 2 for x in place) for place in finer})
        listed = json.loads((self.folder / "field.precomputed/segment_properties/info").read_text())["inline"]
        self.assertEqual(listed["ids"], [str(i + 1) for i in range(len(manifests))])
        label, isovalue = listed["properties"]
        self.assertEqual(len(label["values"]), len(manifests))
        self.assertEqual(isovalue["values"], [surface["tau"] for surface in found["surfaces"]])
        info = json.loads((self.folder / "field.precomputed/info").read_text())
        self.assertEqual((info["@type"], len(info["transform"])), ("neuroglancer_multilod_draco", 12))

    def test_the_same_bytes_for_any_threads_and_from_a_store(self):
        self.run_ok("build", "chain.nrrd", "-o", "chain.atlas")
        for volume, threads in (("chain.nrrd", 1), ("chain.nrrd", 2), ("chain.atlas", 1)):
            self.run_ok("extract", volume, "--tau", "0.5", "--threads", str(threads), "-o", f"{volume}-{threads}.precomputed")
        for name in ("1", "1.index", "info", "segment_properties/info"):
            first, *others = [(folder / name).read_bytes() for folder in sorted(self.folder.glob("chain*.precomputed"))]
            self.assertEqual(len(others), 2)
            self.assertTrue(all(other == first for other in others), name)

    def test_labels_are_segments(self):
        samples = " ".join(str((2 < x < 9) * (2 < y < 9) * (2 < z < 9) * (3 if x < 6 else 7))
                           for z in range(12) for y in range(12) for x in range(12))
        header = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 12 12\nencoding: ascii\n\n"
        (self.folder / "labels.nrrd").write_text(header + samples + "\n")
        found = self.run_json("extract", "labels.nrrd", "--labels", "yes", "--object", "3", "--object", "7", "-o", "labels.precomputed")
        self.assert_schema(found, "extract-labels")
        self.assertEqual(len(self.manifests("labels.precomputed")), 2)
        self.assertEqual(found["levels"][0]["triangles"], found["triangles"])

    def test_text(self):
        text = self.run_ok("extract", "chain.nrrd", "--tau", "0.5", "-o", "text.precomputed").stdout
        self.assertRegex(text, r"levels of [\d,]+ triangles, [\d,]+ within 0\.25 voxels.*, with the same topology")

    def test_what_is_refused(self):
        for option, words in {"--split": "--split", "--for-print": "--for-print", "--simplify 1": "--simplify", "--space ras": "--space",
                              "--coarser 2": ".glb"}.items():
            self.run_error(2, "extract", "chain.nrrd", "--top", "1", *option.split(), "-o", "x.precomputed", says=words)
        (self.folder / "there.precomputed").mkdir()
        self.run_error(5, "extract", "chain.nrrd", "--tau", "0.5", "-o", "there.precomputed", says="already")
        flat = "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 3 3\nencoding: ascii\n\n0 0 0 0 9 0 0 0 0\n"
        (self.folder / "flat.nrrd").write_text(flat)
        self.run_error(4, "extract", "flat.nrrd", "--tau", "5", "-o", "flat.precomputed", says="2D image")
        self.assertFalse((self.folder / "flat.precomputed").exists())
        self.assert_no_partial()


if __name__ == "__main__":
    harness.main()
