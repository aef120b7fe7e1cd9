"""Files lie where the volume lies: the space of surfaces, forms of NIfTI, units."""
import gzip
import json
import struct

import harness

HEADER = """NRRD0005
type: uint8
dimension: 3
space: right-anterior-superior
sizes: 12 12 12
space directions: (0.5,0,0) (0,0,1) (0,0.5,0)
space origin: (10,20,30)
space units: "mm" "mm" "mm"
encoding: raw

"""


def points_of(ply):
    """Positions of a binary PLY of ours."""
    head, body = ply.split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    count = [int(line.split()[2]) for line in lines if line.startswith("element vertex")][0]
    sizes = {"float": 4, "double": 8, "int": 4}
    properties = [line.split()[1] for line in lines if line.startswith("property") and "list" not in line]
    row = sum(sizes[kind] for kind in properties)
    code = "<3" + {"float": "f", "double": "d"}[properties[0]]
    return [struct.unpack_from(code, body, i * row) for i in range(count)]


class Spaces(harness.CliTest):
    def setUp(self):
        super().setUp()
        ball = bytes(200 if (x - 5) ** 2 + (y - 6) ** 2 + (z - 4) ** 2 < 12 else 10 for z in range(12) for y in range(12) for x in range(12))
        (self.folder / "ras.nrrd").write_bytes(HEADER.encode() + ball)
        (self.folder / "none.nrrd").write_bytes("\n".join(line for line in HEADER.strip().splitlines() if not line.startswith("space"))
                                                .encode() + b"\n\n" + ball)

    def extract(self, volume, name, *options):
        told = self.run_json("extract", volume, "--tau", "100", "-o", name, *options)
        self.assert_schema(told, "extract")
        return told, (self.folder / name).read_bytes()

    def test_surfaces_of_medical_volumes_are_in_lps(self):
        told, lps = self.extract("ras.nrrd", "lps.ply")
        self.assertEqual(told["space"], "LPS")
        self.assertIn(b"\ncomment SPACE=LPS\n", lps)
        told, ras = self.extract("ras.nrrd", "ras.ply", "--space", "ras")
        self.assertEqual(told["space"], "RAS")
        self.assertIn(b"\ncomment SPACE=RAS\n", ras)
        self.assertEqual(points_of(lps), [(-x, -y, z) for x, y, z in points_of(ras)])
        self.assertTrue(all(10 < x < 16 and 20 < y < 26 and 30 < z < 42 for x, y, z in points_of(ras)))
        self.assertEqual(self.extract("ras.nrrd", "file.ply", "--space", "file")[1], ras)
        self.assertEqual(self.extract("ras.nrrd", "x.stl")[1].split(b" tau")[0], b"isoatlas " + lps.split(b"isoatlas ")[1].split(b"\n")[0] + b" SPACE=LPS")
        for name in ("x.stl", "x.obj", "x.vtp", "lps.ply"):
            self.extract("ras.nrrd", name)
            self.assertTrue(self.run_json("verify", name)["holds"])

    def test_other_volumes_keep_their_numbers(self):
        for space in ("lps", "ras", "file"):
            told, ply = self.extract("none.nrrd", "none.ply", "--space", space)
            self.assertEqual(told["space"], "unknown")
            self.assertNotIn(b"SPACE=", ply)
            self.assertTrue(all(0 < x < 12 for x, _, _ in points_of(ply)))

    def test_glb_is_in_metres_with_y_up(self):
        told, glb = self.extract("ras.nrrd", "x.glb", "--space", "ras")
        self.assertEqual(told["space"], "glTF")
        self.assertIn("--space does not apply to .glb, which has metres and y up", told["warnings"])
        document = json.loads(glb[20:20 + struct.unpack("<I", glb[12:16])[0]])
        self.assertEqual(document["nodes"][0]["matrix"], [-.001, 0, 0, 0, 0, 0, .001, 0, 0, .001, 0, 0, 0, 0, 0, 1])
        self.assertTrue(self.run_json("verify", "x.glb")["holds"])
        self.assertEqual(len(self.extract("none.nrrd", "y.glb")[0]["warnings"]), 1)  # no unit

    def test_nifti_has_both_forms(self):
        for volume, code, x in (("ras.nrrd", 1, 10), ("none.nrrd", 2, 0)):
            self.run_ok("label", volume, "--tau", "100", "-o", "l.nii.gz")
            self.run_ok("convert", volume, "-o", "v.nii")
            for header in (gzip.decompress((self.folder / "l.nii.gz").read_bytes()), (self.folder / "v.nii").read_bytes()):
                self.assertEqual(struct.unpack_from("<2h", header, 252), (code, code))
                self.assertEqual(struct.unpack_from("<f", header, 268)[0], x)
                self.assertEqual(struct.unpack_from("<f", header, 292)[0], x)

    def test_wrong_space(self):
        self.run_error(2, "extract", "ras.nrrd", "--tau", "100", "--space", "lsp", "-o", "x.ply", says="--space", next_says="lps")
        self.run_error(2, "label", "ras.nrrd", "--tau", "100", "--space", "lps", "-o", "x.nrrd", says="--space")


if __name__ == "__main__":
    harness.main()
