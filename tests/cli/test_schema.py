"""Every document about a store is what its schema says, and has no member that the schema does not describe."""
import harness


def undescribed(value, schema, where="$"):
    if isinstance(value, dict) and "properties" in schema:
        found = [f"{where}.{name}" for name in value if name not in schema["properties"]]
        for name in value.keys() & schema["properties"].keys():
            found += undescribed(value[name], schema["properties"][name], f"{where}.{name}")
        return found
    if isinstance(value, list) and "items" in schema:
        return [one for item in value for one in undescribed(item, schema["items"], where + "[]")]
    return []


class Schemas(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "12", "--quantise", "16"]}

    def check(self, name, *arguments):
        document = self.run_json(*arguments)
        self.assert_schema(document, name)
        self.assertEqual(undescribed(document, self.schema(name)), [], name)
        if "reads" in document:
            self.assert_schema(document["reads"], "reads")
            self.assertEqual(document["reads"] is None, arguments[1].endswith(".nrrd"))

    def test_documents_are_as_described(self):
        self.check("build-estimate", "build", "noise.nrrd", "-o", "noise.atlas", "--dry-run")
        self.check("build", "build", "noise.nrrd", "-o", "noise.atlas")
        self.check("build", "build", "noise.nrrd", "-o", "faces.atlas", "--interpolant", "faces", "--gaussian", "1")
        for file in ("noise.atlas", "faces.atlas", "noise.nrrd"):
            self.check("info", "info", file)
            self.check("objects", "objects", file)
            self.check("objects", "objects", file, "--both", "--all")
            self.check("cavities", "objects", file, "--cavities")
            self.check("objects", "objects", file, "--keep", "3")
            self.check("simplified-tree", "tree", file, "--top", "50%")
            self.check("objects-at", "objects", file, "--tau", "7")
            self.check("measure", "measure", file)
            self.check("measure", "measure", file, "--tau", "7", "--no-percolation")
            self.check("extract", "extract", file, "--tau", "7", "-o", "x.ply")
            self.check("extract", "extract", file, "--best", "--style", "full", "--boundary", "open", "-o", "x.stl")
            self.check("animate-surfaces", "animate", file, "--from", "9", "--to", "7", "--steps", "3", "-o", "x.vtkhdf")
            self.check("label", "label", file, "--tau", "7", "-o", "x.nrrd")
            self.check("label", "label", file, "--tau", "7", "--cavities", "-o", "x.nrrd")
            self.check("label", "label", file, "--zones", "-o", "x.nrrd")
            self.check("label", "label", file, "--object", "1@5", "--top", "2", "-o", "chosen.nrrd")
            self.check("extract", "extract", file, "--object", "1", "1@5", "-o", "x.glb")
            self.check("name", "name", file, "1", "first")
            self.check("convert", "convert", file, "-o", "x.npy")
            self.check("verify", "verify", file, "--levels", "1")
            self.check("tree-file", "tree", file, "-o", "x.csv")
            self.check("handles", "handles", file)
            self.check("spectrum", "spectrum", file)
            self.check("table131", "table131", file)
            self.check("compare", "compare", file, "--tau", "7")
            for detail in ("events", "levels", "elements", "contours"):
                self.assert_schema(self.run_json("tree", file, "--detail", detail), "tree-" + detail)
        self.check("verify", "verify", "x.ply")
        self.check("info", "info", "noise.atlas", "--tau", "7")
        for part in ([], ["header"], ["contents"], ["elements/place"], ["brick", "0"]):
            self.check("dump", "dump", "noise.atlas", *part)


if __name__ == "__main__":
    harness.main()
