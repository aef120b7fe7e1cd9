"""isoatlas dump: every part of a store is printed as it lies in the file."""
import math
import struct

import harness


class Dump(harness.CliTest):
    phantoms = {"noise.npy": ["noise", "--size", "20"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        done = cls.start(["build", "noise.npy", "-o", "noise.atlas"])
        assert done.returncode == 0, done.stderr

    def dump(self, *part):
        document = self.run_json("dump", "noise.atlas", *part)
        self.assert_schema(document, "dump")
        return document

    def test_all_parts_are_listed_and_each_is_printed_as_it_lies_in_the_file(self):
        whole = (self.folder / "noise.atlas").read_bytes()
        codes = {"uint8": "B", "uint16": "H", "uint32": "I", "int32": "i", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}
        parts = self.dump()["parts"]
        self.assertLess(15, len(parts))
        for part in parts:
            raw = whole[part["offset"]:part["offset"] + part["bytes"]]
            if part["type"] == "json":
                self.assertIn("text", self.dump(part["name"]))
                continue
            if part.get("compressed"):
                self.assertEqual(len(self.dump(part["name"])["numbers"]), part["shape"][0])
                continue
            expected = list(struct.unpack(f"<{len(raw) // struct.calcsize(codes[part['type']])}{codes[part['type']]}", raw))
            shown = [None if number in (math.inf, -math.inf) else number for number in expected]
            self.assertEqual(self.dump(part["name"])["numbers"], shown, part["name"])
            self.assertEqual(len(self.run_ok("dump", "noise.atlas", part["name"]).stdout.splitlines()), len(expected))
        text = self.run_ok("dump", "noise.atlas").stdout
        for part in parts:
            self.assertIn(part["name"] + " ", text)

    def test_ranges(self):
        all_values = self.dump("elements/voxels")["numbers"]
        self.assertEqual(self.dump("elements/voxels[3:7]")["numbers"], all_values[3:7])
        self.assertEqual(self.dump("elements/voxels[5]"), {**self.dump("elements/voxels[5:6]")})
        self.assertEqual(self.dump("elements/voxels[5]")["first"], 5)
        self.assertEqual(self.dump("elements/voxels[4:4]")["numbers"], [])
        self.assertEqual(self.run_ok("dump", "noise.atlas", "elements/voxels[2:4]").stdout.split()[0], "2")

    def test_bricks(self):
        samples = struct.unpack("<8000f", (self.folder / "noise.npy").read_bytes()[-32000:])
        for words, low, size in ((["brick", "0"], (0, 0, 0), (16, 8, 8)), (["brick 17"], (16, 16, 16), (4, 4, 4)),
                                 (["voxel", "19,3,4"], (16, 0, 0), (4, 8, 8))):
            document = self.dump(*words)
            self.assertEqual((document["part"]["first_voxel"], document["part"]["shape"]), (list(low), list(size[::-1])))
            expected = [samples[x + 20 * (y + 20 * z)] for z in range(low[2], low[2] + size[2])
                        for y in range(low[1], low[1] + size[1]) for x in range(low[0], low[0] + size[0])]
            self.assertEqual(document["numbers"], expected)
        lines = self.run_ok("dump", "noise.atlas", "brick", "17").stdout.splitlines()
        self.assertEqual(len(lines), 1 + 4 * 5)

    def test_errors_say_what_there_is(self):
        error = self.run_error(6, "dump", "noise.atlas", "elements/voxel")
        for name in ("header", "contents", "elements/voxels", "elements/towards_outside", "brick N"):
            self.assertIn(name, error["expected"])
        for part, says in (("brick 18", "0 to 17"), ("brick x", "brick 17"), ("voxel 20,0,0", "20,20,20"), ("elements/voxels[1:", "[FIRST:END]"),
                           ("elements/voxels[9:3]", "numbers"), ("elements/voxels[-1]", "numbers"), ("header[1]", "header"),
                           ("elements/voxels[99999999999999999999]", "[FIRST:END]")):
            self.assertIn(says, self.run_error(6, "dump", "noise.atlas", part)["expected"], part)
        self.run_error(3, "dump", "noise.npy", next_says="isoatlas build")
        self.run_error(2, "dump")

    def test_compressed_arrays_say_where_their_chunks_lie(self):
        compressed = [part for part in self.dump()["parts"] if part.get("compressed")]
        self.assertIn("elements/voxels", [part["name"] for part in compressed])
        size = (self.folder / "noise.atlas").stat().st_size
        for part in compressed:
            chunks = self.dump("checksums/" + part["name"])
            self.assertEqual(chunks["part"]["shape"][1], 3)
            for offset, length in zip(chunks["numbers"][0::3], chunks["numbers"][1::3]):
                self.assertLessEqual(offset + length, size)
        places = self.dump("elements/place")["numbers"]
        self.assertEqual(places, sorted(places))  # of noise

    def test_a_damaged_part_is_not_printed_but_the_others_are(self):
        whole = bytearray((self.folder / "noise.atlas").read_bytes())
        whole[self.dump("checksums/elements/place[0]")["numbers"][0] + 10] ^= 1
        (self.folder / "bad.atlas").write_bytes(whole)
        self.assertIn("elements/place", self.run_error(3, "dump", "bad.atlas", "elements/place")["where"])
        self.run_ok("dump", "bad.atlas", "elements/voxels")


if __name__ == "__main__":
    harness.main()
