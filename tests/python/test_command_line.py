"""What Python returns and writes is what the command line prints and writes, byte for byte."""
import json

import numpy as np
import pytest

import isoatlas
from conftest import smooth

VOLUMES = {
    "demo": lambda: isoatlas.phantom("demo", 48),
    "noise": lambda: np.float32(smooth((20, 21, 22), seed=3, passes=1)),
    "image": lambda: np.uint8(255 * smooth((40, 50), seed=4)),
}
SPACING = {"demo": (0.5, 0.5, 0.5), "noise": (2, 1, 0.25), "image": (3, 2)}


@pytest.fixture(params=VOLUMES)
def both(request, tmp_path):
    """An atlas of an array, the same array as a file, and a good isovalue."""
    array = VOLUMES[request.param]()
    spacing = SPACING[request.param]
    isoatlas.write(tmp_path / "v.nrrd", array, spacing=spacing, unit="mm")
    return isoatlas.open(array, spacing=spacing, unit="mm"), float(np.median(array[array > array.min()]))


def same_files(folder, one, other):
    return (folder / one).read_bytes() == (folder / other).read_bytes()


@pytest.mark.parametrize("extension", ["ply", "stl", "obj", "vtp"])
def test_surfaces(both, cli, tmp_path, extension):
    atlas, level = both
    if atlas.ndim == 2 and extension in ("stl", "obj"):
        pytest.skip("curves are written as .ply and .vtp")
    cli("extract", "v.nrrd", "--tau", level, "-o", f"cli.{extension}")
    atlas.surface(level).save(tmp_path / f"python.{extension}")
    assert same_files(tmp_path, f"cli.{extension}", f"python.{extension}")


@pytest.mark.parametrize("options", [{"boundary": "open"}, {"style": "full"}, {"shell": "inner"}, {"shell": "outer"}])
def test_options_of_surfaces(cli, tmp_path, options):
    array = VOLUMES["demo"]()
    isoatlas.write(tmp_path / "v.nrrd", array)
    level = 120.0
    cli("extract", "v.nrrd", "--tau", level, *(word for name, value in options.items() for word in (f"--{name}", value)), "-o", "cli.ply")
    isoatlas.open(array).surface(level, **options).save(tmp_path / "python.ply")
    assert same_files(tmp_path, "cli.ply", "python.ply")


def test_the_table(both, cli):
    atlas, _ = both
    lines = json.loads(cli("objects", "v.nrrd", "--json"))
    assert len(lines["objects"]) == len(atlas.objects) > 0 and lines["branches"] == atlas.objects.total
    for line, one in zip(lines["objects"], atlas.objects):
        assert (line["id"], line["best_tau"], line["voxels"], line["tunnels"], line["cavities"], line["reason"]) == \
            (one.id, one.best_tau, one.voxels, one.tunnels, one.cavities, one.reason)
        assert line["measure"] == one.measure and line["hypervolume"] == one.hypervolume and line["number"] == one.number
        assert (line["merges"] is None and np.isinf(one.merges)) or line["merges"] == one.merges
        assert [isovalue["tau"] for isovalue in line["isovalues"]] == [isovalue.tau for isovalue in one.isovalues]
        assert line["position_physical"] == list(one.position)


def test_cavities(cli, tmp_path):
    array = VOLUMES["demo"]()
    isoatlas.write(tmp_path / "v.nrrd", array)
    lines, atlas = json.loads(cli("objects", "v.nrrd", "--cavities", "--json"))["objects"], isoatlas.open(array)
    assert [(line["id"], line["best_tau"], line["voxels"]) for line in lines] == \
        [(one.id, one.best_tau, one.voxels) for one in atlas.cavities] != []
    cli("extract", "v.nrrd", "--object", "c1", "-o", "cli.ply")
    atlas.object("c1").surface().save(tmp_path / "python.ply")
    assert same_files(tmp_path, "cli.ply", "python.ply")


def test_objects_at_an_isovalue(both, cli):
    atlas, level = both
    lines = json.loads(cli("objects", "v.nrrd", "--tau", level, "--json"))["objects"]
    ours = atlas.objects_at(level)
    assert [(line["id"], line["voxels"], line["b1"], line["b2"], line["box"]["low"]) for line in lines] == \
        [(one["id"], one["voxels"], one["tunnels"], one["cavities"], one["box"][0]) for one in ours]


@pytest.mark.parametrize("number", [1, 2])
def test_surfaces_of_objects(both, cli, tmp_path, number):
    atlas, _ = both
    cli("extract", "v.nrrd", "--object", number, "-o", "cli.ply")
    atlas.object(number).surface().save(tmp_path / "python.ply")
    assert same_files(tmp_path, "cli.ply", "python.ply")


@pytest.mark.parametrize("extension", ["nrrd", "nii", "tif"])
def test_labels_at_an_isovalue(both, cli, tmp_path, extension):
    atlas, level = both
    cli("label", "v.nrrd", "--tau", level, "-o", f"cli.{extension}")
    atlas.save_labels(tmp_path / f"python.{extension}", level)
    assert same_files(tmp_path, f"cli.{extension}", f"python.{extension}")


def test_labels_of_the_table(cli, tmp_path):
    array = VOLUMES["demo"]()
    isoatlas.write(tmp_path / "v.nrrd", array, spacing=0.5)
    cli("label", "v.nrrd", "--top", 24, "-o", "cli.seg.nrrd")
    atlas = isoatlas.open(array, spacing=0.5)
    atlas.save_labels(tmp_path / "python.seg.nrrd", keep=24)
    assert same_files(tmp_path, "cli.seg.nrrd", "python.seg.nrrd")
    labels = atlas.labels(keep=24)
    assert set(np.unique(labels)) <= {0, *(one.number for one in atlas.objects)}


@pytest.mark.parametrize("detail", ["events", "levels", "elements", "contours"])
def test_trees(both, cli, tmp_path, detail):
    atlas, _ = both
    cli("tree", "v.nrrd", "--detail", detail, "-o", "cli.csv")
    atlas.tree.save(tmp_path / "python.csv", detail=detail)
    assert same_files(tmp_path, "cli.csv", "python.csv")


def test_spectrum_and_zones(both, cli, tmp_path):
    atlas, level = both
    cli("spectrum", "v.nrrd", "-o", "cli.csv")
    atlas.spectrum().save(tmp_path / "python.csv")
    assert same_files(tmp_path, "cli.csv", "python.csv")
    b0, b1, b2 = atlas.betti(level)
    counts = atlas.spectrum(0).counts_at(level)
    assert (counts["objects"], counts["tunnels"], counts["cavities"]) == (b0, b1, b2)
    cli("label", "v.nrrd", "--zones", "-o", "cli.nrrd")
    zones, _ = isoatlas.read(tmp_path / "cli.nrrd")
    assert np.array_equal(zones, atlas.zones())
    sizes = np.bincount(atlas.zones().ravel(), minlength=len(atlas.tree) + 1)[1:]
    assert np.array_equal(sizes, atlas.tree.zone_voxels)


def test_tunnels(cli, tmp_path):
    array = np.float32(smooth((14, 15, 16), seed=5, passes=1))
    isoatlas.write(tmp_path / "v.nrrd", array)
    atlas = isoatlas.open(array)
    for words, exact in (["--exact"], True), ([], False):
        lines = json.loads(cli("handles", "v.nrrd", *words, "--top", 100000, "--json"))["handles"]
        ours = atlas.handles(exact=exact)
        assert [[line["opens"], line["closes"]] for line in lines] == ours.pairs.tolist() != []


def test_stores_are_the_same_bytes(both, cli, tmp_path):
    atlas, level = both
    cli("build", "v.nrrd", "-o", "cli.atlas")
    isoatlas.build(tmp_path / "v.nrrd", tmp_path / "python.atlas")
    assert same_files(tmp_path, "cli.atlas", "python.atlas")
    stored = isoatlas.open(tmp_path / "cli.atlas")
    assert stored.is_store and not atlas.is_store and np.array_equal(stored.volume, atlas.volume)
    for name in ("points", "triangles", "segments", "normals", "object_ids"):
        assert np.array_equal(getattr(stored.surface(level), name), getattr(atlas.surface(level), name))
    assert [one.to_dict() for one in stored.objects] == [one.to_dict() for one in atlas.objects]
    assert np.array_equal(stored.labels(level), atlas.labels(level))


def test_pictures_and_measures(cli, tmp_path):
    array = VOLUMES["demo"]()
    isoatlas.write(tmp_path / "v.nrrd", array, spacing=0.5, unit="mm")
    atlas = isoatlas.open(array, spacing=0.5, unit="mm")
    lines = json.loads(cli("measure", "v.nrrd", "--object", 1, "--json"))["objects"]
    ours = atlas.object(1).measures()
    assert lines[0]["volume"] == ours["volume"] and lines[0]["area"] == ours["area"]
    picture = isoatlas.render(atlas.object(1).surface(), size=(80, 60))
    assert picture.shape == (60, 80, 4) and picture.dtype == np.uint8 and len(np.unique(picture)) > 10


@pytest.mark.parametrize("extension", ["json", "graphml", "csv", "vtu"])
def test_simplified_trees(both, cli, tmp_path, extension):
    atlas, _ = both
    cli("tree", "v.nrrd", "--keep", 4, "--min-voxels", 5, "-o", f"cli.{extension}")
    simplified = atlas.tree.simplify(keep=4, min_voxels=5)
    simplified.save(tmp_path / f"python.{extension}")
    if extension == "json":  # they name their volumes
        ours, theirs = (json.loads((tmp_path / f"{who}.json").read_text()) for who in ("python", "cli"))
        assert ours["nodes"] == theirs["nodes"] != []
    else:
        assert same_files(tmp_path, f"cli.{extension}", f"python.{extension}")
    cli("label", "v.nrrd", "--zones", "--keep", 4, "--min-voxels", 5, "-o", "zones.nrrd")
    np.testing.assert_array_equal(isoatlas.read(tmp_path / "zones.nrrd")[0], simplified.zones())


def test_names(cli, tmp_path):
    isoatlas.build(VOLUMES["demo"](), tmp_path / "v.atlas")
    atlas = isoatlas.open(tmp_path / "v.atlas")
    assert atlas.names == {} and atlas.objects[0].name is None
    cli("name", "v.atlas", 2, "the neck")
    assert atlas.names == {"the neck": "2"} and atlas.object("the neck").number == 2 and atlas.objects[1].name == "the neck"
    atlas.give_name("c1", "hollow")
    atlas.give_name("the neck", None)
    named = json.loads(cli("name", "v.atlas", "--json"))["names"]
    assert [(one["name"], one["reference"]) for one in named] == [("hollow", "c1")] and atlas.object("hollow").is_cavity
    assert "hollow" in atlas.cavities._repr_html_()
    with pytest.raises(isoatlas.InputError, match="c1"):
        atlas.give_name(1, "c1")  # a reference is no name
    with pytest.raises(isoatlas.InputError, match="hollow"):
        atlas.give_name(1, "hollow")  # another one has it
    with pytest.raises(isoatlas.InputError, match="liver"):
        atlas.object("liver")
    with pytest.raises(isoatlas.UnsupportedError, match="memory"):
        isoatlas.open(VOLUMES["demo"]()).give_name(1, "head")


def test_labels_that_are_given(cli, tmp_path):
    labels = isoatlas.open(VOLUMES["demo"]()).labels(keep=4).astype(np.uint8)
    isoatlas.write(tmp_path / "l.nrrd", labels, spacing=(0.5, 0.5, 0.5), unit="mm")
    lines = json.loads(cli("objects", "l.nrrd", "--labels", "yes", "--json"))["labels"]
    regions = isoatlas.label_regions(labels, spacing=(0.5, 0.5, 0.5))
    for name in ("label", "voxels", "measure", "components", "tunnels", "cavities"):
        assert regions[name].tolist() == [line[name] for line in lines] != []
    assert regions.position.tolist() == [line["position_physical"] for line in lines]
    number = int(regions.label[-1])
    cli("extract", "l.nrrd", "--labels", "yes", "--object", number, "-o", "cli.ply")
    theirs, ours = isoatlas.read_mesh(tmp_path / "cli.ply"), isoatlas.label_surface(tmp_path / "l.nrrd", number)
    np.testing.assert_array_equal(ours.points, theirs.points)
    np.testing.assert_array_equal(ours.triangles, theirs.triangles)
    assert isoatlas.label_surface(labels, number, spacing=(0.5, 0.5, 0.5)).verify()
    with pytest.raises(isoatlas.NotFoundError, match="200"):
        isoatlas.label_surface(labels, 200)
    with pytest.raises(isoatlas.InputError):
        isoatlas.label_regions(labels - 0.5)


def test_phantoms_and_conversions(cli, tmp_path):
    for name in ("torus-chain", "noise"):
        cli("phantom", name, "--size", 24, "-o", f"{name}.npy")
        assert np.array_equal(np.load(tmp_path / f"{name}.npy"), isoatlas.phantom(name, 24))
    array = VOLUMES["noise"]()
    isoatlas.write(tmp_path / "v.nrrd", array, spacing=(3, 2, 1), unit="mm")
    for extension in ("npy", "mha", "vti", "nii", "tif"):
        cli("convert", "v.nrrd", "-o", f"cli.{extension}")
        isoatlas.open(tmp_path / "v.nrrd").save(tmp_path / f"python.{extension}")
        assert same_files(tmp_path, f"cli.{extension}", f"python.{extension}")
        back, _ = isoatlas.read(tmp_path / f"cli.{extension}")
        assert np.array_equal(back, array)
    assert isoatlas.info(tmp_path / "v.nrrd")["spacing"] == [1, 2, 3]
