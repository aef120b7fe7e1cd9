"""extract --coarser: a .glb with coarser and coarser versions of each object, which verify proves to be the surface."""
import json
import struct

import harness
from harness import CliTest


class Glb:
    """What a .glb has: nodes, and the points and triangles of their meshes in the space of the volume."""

    def __init__(self, path):
        data = path.read_bytes()
        length, = struct.unpack_from("<I", data, 12)
        self.json = json.loads(data[20:20 + length])
        self.bytes = data[28 + length:]

    def values(self, accessor):
        accessor = self.json["accessors"][accessor]
        view = self.json["bufferViews"][accessor["bufferView"]]
        count, kind = (3 * accessor["count"], "f") if accessor["type"] == "VEC3" else (accessor["count"], "I")
        numbers = struct.unpack_from(f"<{count}{kind}", self.bytes, view["byteOffset"])
        return [numbers[i:i + 3] for i in range(0, count, 3)]

    def mesh(self, node):
        node = self.json["nodes"][node]
        mesh, = self.json["meshes"][node["mesh"]]["primitives"]
        points = [tuple(x + t for x, t in zip(p, node["translation"])) for p in self.values(mesh["attributes"]["POSITION"])]
        return points, self.values(mesh["indices"])

    def write_obj(self, nodes, path):
        lines, first = [], 1
        for node in nodes:
            points, triangles = self.mesh(node)
            lines += ["v %.9g %.9g %.9g" % p for p in points]
            lines += ["f %d %d %d" % tuple(first + i for i in t) for t in triangles]
            first += len(points)
        path.write_text("\n".join(lines) + "\n")


class Coarser(CliTest):
    phantoms = {
        "shells.nrrd": ["nested-shells", "--size", "40", "--shells", "2"],
        "chain.nrrd": ["torus-chain", "--size", "40", "--genus", "2"],
    }

    def test_every_version_is_the_surface(self):
        for volume in self.phantoms:
            found = self.run_json("extract", volume, "--tau", "0.5", "--coarser", "3", "-o", "levels.glb")
            self.assert_schema(found, "extract")
            self.assertEqual(len(found["coarser"]), 3)
            glb = Glb(self.folder / "levels.glb")
            self.assertEqual(glb.json["extensionsUsed"], ["MSFT_lod"])
            objects = [glb.json["nodes"][i] for i in glb.json["nodes"][0]["children"]]
            self.assertEqual(len(objects), found["objects"])
            for level, version in enumerate(found["coarser"]):
                nodes = [node["extensions"]["MSFT_lod"]["ids"][level] for node in objects]
                self.assertEqual(sum(len(glb.mesh(node)[1]) for node in nodes), version["triangles"])
                glb.write_obj(nodes, self.folder / "version.obj")
                self.run_ok("verify", "version.obj", "--against", volume, "--tau", "0.5", "--max-distance", str(1.001 * version["distance"]))
                self.assertTrue(all(glb.json["nodes"][node]["extras"]["distance"] <= version["distance"] for node in nodes))
            for node in objects:
                coverage = node["extras"]["MSFT_screencoverage"]
                self.assertEqual(len(coverage), 4)
                self.assertEqual(coverage, sorted(coverage, reverse=True))
                self.assertEqual(coverage[-1], 0)
            self.assertLess(3 * found["coarser"][0]["triangles"], found["triangles"] + 3)
            # What reads no versions sees the surface alone.
            self.assertEqual(self.run_json("verify", "levels.glb")["triangles"], found["triangles"])

    def test_objects_with_isovalues_of_their_own(self):
        found = self.run_json("extract", "shells.nrrd", "--top", "2", "--coarser", "2", "-o", "levels.glb")
        glb = Glb(self.folder / "levels.glb")
        objects = [glb.json["nodes"][i] for i in glb.json["nodes"][0]["children"]]
        self.assertEqual(len(objects), len(found["surfaces"]))
        for node in objects:
            versions = [glb.json["nodes"][i] for i in node["extensions"]["MSFT_lod"]["ids"]]
            self.assertTrue(all(version["extras"]["object"] == node["extras"]["object"] for version in versions))
        text = self.run_ok("extract", "shells.nrrd", "--tau", "0.5", "--coarser", "1", "-o", "levels.glb").stdout
        self.assertRegex(text, r"coarser versions of \d+ triangles within [\d.]+, with the same topology")

    def test_what_is_refused(self):
        self.run_error(2, "extract", "shells.nrrd", "--tau", "0.5", "--coarser", "2", "-o", "x.ply", says=".glb")
        self.run_error(2, "extract", "shells.nrrd", "--tau", "0.5", "--coarser", "2", "--simplify", "1", "-o", "x.glb", says="--coarser")
        self.run_error(2, "extract", "shells.nrrd", "--tau", "0.5", "--coarser", "2", "--for-print", "-o", "x.glb", says="--for-print")
        self.run_error(2, "extract", "shells.nrrd", "--tau", "0.5", "--coarser", "0", "-o", "x.glb", says="--coarser")


if __name__ == "__main__":
    harness.main()
