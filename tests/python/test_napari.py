"""The plugin of napari: its manifest, its files and layers, and the dock widget in a real window system without a screen. napari itself is no
package of Debian: a stub viewer stands for it."""
import importlib
import os
import pathlib

import numpy as np
import pytest

import isoatlas
from conftest import SOURCE
from isoatlas.napari import files, layers
from isoatlas.napari.model import Cancelled, Job, Model

TURNED = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # x becomes y


class Events:
    """Signals of a list of layers."""

    def __init__(self):
        self.slots = []

    def connect(self, slot):
        self.slots.append(slot)

    def tell(self):
        for slot in self.slots:
            slot()


class Layers(list):
    def __init__(self):
        super().__init__()
        self.events = type("Group", (), {"inserted": Events(), "removed": Events()})()


class Layer:
    def __init__(self, data, **options):
        self.scale, self.translate, self.metadata, self.name = np.ones(3), np.zeros(3), {}, ""
        self.data = data
        self.__dict__.update(options)


class Image(Layer):
    rgb = False


class Viewer:
    """Keeps what it is given, as napari's viewer would."""

    def __init__(self):
        self.layers = Layers()

    def add(self, layer):
        self.layers.append(layer)
        self.layers.events.inserted.tell()
        return layer

    def add_labels(self, data, **options):
        return self.add(type("Labels", (Layer,), {})(data, **options))

    def add_surface(self, data, **options):
        return self.add(type("Surface", (Layer,), {})(data, **options))


@pytest.fixture
def turned(demo, tmp_path):
    """A volume with a place in space, in a file."""
    atlas = isoatlas.open(demo, spacing=(2.0, 0.5, 1.0), origin=(10.0, 20.0, 30.0), direction=TURNED)
    path = tmp_path / "turned.nrrd"
    atlas.save(path)
    return path


def manifest():
    yaml = pytest.importorskip("yaml", reason="python3-yaml is not installed")
    return yaml.safe_load((pathlib.Path(isoatlas.__file__).parent / "napari" / "napari.yaml").read_text())


def test_the_manifest_names_what_there_is():
    found = manifest()
    pyproject = (SOURCE / "pyproject.toml").read_text()
    assert f'{found["name"]} = "isoatlas.napari:napari.yaml"' in pyproject
    commands = {one["id"]: one["python_name"] for one in found["contributions"]["commands"]}
    for name in commands.values():
        module, _, attribute = name.partition(":")
        if module.endswith("widget"):
            pytest.importorskip("qtpy", reason="python3-qtpy is not installed")
        assert callable(getattr(importlib.import_module(module), attribute))
    for kind in ("readers", "writers", "widgets", "sample_data"):
        assert all(one["command"] in commands for one in found["contributions"][kind])
    patterns = found["contributions"]["readers"][0]["filename_patterns"]
    assert sorted(patterns) == sorted("*" + end for end in files.ENDINGS)


def test_files_of_others_are_left_to_others(tmp_path):
    (tmp_path / "a.nrrd").write_text("not a volume")
    for path in (str(tmp_path / "a.png"), str(tmp_path / "a.nrrd"), str(tmp_path / "missing.atlas"), [str(tmp_path / "a.nrrd")]):
        assert files.reader_of(path) is None


def test_an_image_lies_where_the_header_says(turned):
    (data, options, kind), = files.reader_of(str(turned))(str(turned))
    assert kind == "image" and options["name"] == "turned"
    info = options["metadata"]["isoatlas"].info
    sample = np.array([3, 4, 5])  # (z, y, x)
    there = options["affine"] @ np.append(sample, 1)
    expected = np.asarray(info["origin"]) + np.asarray(info["direction"]) @ (np.asarray(info["spacing"]) * sample[::-1])
    np.testing.assert_allclose(there[:3][::-1], expected)


def test_a_surface_lies_in_the_samples_of_its_image(turned):
    atlas = isoatlas.open(turned)
    one = atlas.objects[0]
    (points, triangles, values), options, kind = layers.surface(one, one.best_tau, atlas.info, {})
    mesh = one.surface()
    assert kind == "surface" and len(values) == len(points) and np.array_equal(triangles, mesh.triangles)
    affine = layers.place_of(atlas.info)["affine"]
    np.testing.assert_allclose((points @ affine[:3, :3].T + affine[:3, 3])[:, ::-1], mesh.points)
    assert points.min() > -1.01 and (points.max(axis=0) < np.array(atlas.shape) + 0.01).all()


@pytest.mark.parametrize("name", ["a.seg.nrrd", "a.nrrd", "a.nii.gz", "a.tif"])
def test_labels_of_our_objects_are_written_as_by_the_atlas(turned, tmp_path, name):
    atlas = isoatlas.open(turned)
    data, options, kind = layers.labels(atlas, list(atlas.objects), layers.place_of(atlas.info))
    assert kind == "labels" and files.write_labels(str(tmp_path / name), data, options) == [str(tmp_path / name)]
    atlas.save_labels(tmp_path / f"own-{name}", objects=list(atlas.objects))
    array, info = isoatlas.read(tmp_path / name)
    own, own_info = isoatlas.read(tmp_path / f"own-{name}")
    np.testing.assert_array_equal(array, own)
    for key in ("spacing", "origin", "direction"):
        np.testing.assert_allclose(info[key], own_info[key], atol=1e-6)


def test_painted_labels_are_written_too(tmp_path):
    data = np.zeros((4, 5, 6), dtype=np.int64)
    data[1, 2, 3] = 7
    files.write_labels(str(tmp_path / "a.nrrd"), data, {"scale": (2.0, 1.0, 0.5), "translate": (1.0, 2.0, 3.0)})
    array, info = isoatlas.read(tmp_path / "a.nrrd")
    np.testing.assert_array_equal(array, data)
    assert info["spacing"] == [0.5, 1.0, 2.0] and info["origin"] == [3.0, 2.0, 1.0]
    with pytest.raises(isoatlas.UnsupportedError, match="rotated"):
        files.write_labels(str(tmp_path / "b.nrrd"), data, {"rotate": TURNED})


def searched(data, **options):
    viewer = Viewer()
    image = viewer.add(Image(data, **{"name": "scan", **options}))
    model = Model(viewer)
    model.take(model.seek(image).result())
    return viewer, model


def test_objects_of_an_image_of_any_reader(demo):
    viewer, model = searched(demo, scale=np.array([2.0, 1.0, 1.0]))
    atlas = isoatlas.open(demo, spacing=(2.0, 1.0, 1.0))
    assert [one.id for one in model.objects] == [one.id for one in atlas.objects]
    assert model.objects[0].measure == atlas.objects[0].measure
    surface = model.show_surface(model.objects[0])
    assert np.array_equal(surface.scale, [2.0, 1.0, 1.0])
    low, high = model.isovalues(model.objects[0])
    assert low < model.objects[0].best_tau <= high
    assert model.show_surface(model.objects[0], (low + high) / 2) is surface and len(viewer.layers) == 2
    viewer.layers.remove(surface)
    assert model.show_surface(model.objects[0]) is not surface
    labels = model.show_labels([])
    np.testing.assert_array_equal(labels.data, atlas.labels(objects=[one for one in atlas.objects if not one.background]))


def test_an_image_of_ours_brings_its_atlas(turned):
    (data, options, _), = files.read(str(turned))
    viewer, model = searched(data, **options)
    assert model.atlas is options["metadata"]["isoatlas"]


def test_colour_pictures_and_series_are_not_searched(demo):
    viewer = Viewer()
    viewer.add(Image(np.zeros((4, 4, 3)), name="rgb")).rgb = True
    viewer.add(Image(np.zeros((2, 4, 4, 4)), name="series"))
    viewer.add(Image(demo, name="scan"))
    assert [layer.name for layer in Model(viewer).images()] == ["scan"]


def test_a_job_can_be_cancelled_and_tells_its_error():
    begun = []

    def work(progress):
        begun.append(True)
        while True:
            progress("wait", 0.5)

    job = Job(work)
    job.cancel()
    with pytest.raises(Cancelled):
        job.result()
    assert job.done and begun and (job.phase, job.part) == ("wait", 0.5)
    with pytest.raises(isoatlas.InputError):
        Job(lambda progress: isoatlas.open(np.zeros((0, 0, 0)))).result()


@pytest.fixture
def widget():
    pytest.importorskip("qtpy", reason="python3-qtpy is not installed")
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from qtpy.QtWidgets import QApplication
    application = QApplication.instance() or QApplication([])
    from isoatlas.napari.widget import ObjectsWidget
    viewer = Viewer()
    made = ObjectsWidget(napari_viewer=viewer)
    yield made, viewer
    made.deleteLater()
    application.processEvents()


def test_the_widget_finds_and_shows_objects(widget, demo):
    shown, viewer = widget
    assert not shown.find.isEnabled() and not shown.surface.isEnabled()
    viewer.add(Image(demo, name="scan"))
    assert shown.find.isEnabled() and shown.images.currentText() == "scan"
    shown.find.click()
    assert shown.job is not None and not shown.find.isEnabled()
    shown.job.wait()
    shown.look()
    atlas = isoatlas.open(demo)
    assert shown.table.rowCount() == len(atlas.objects) and shown.table.item(0, 0).text() == "1"
    assert not shown.slider.isEnabled()
    shown.table.selectRow(1)
    assert shown.slider.isEnabled() and shown.isovalue.text() == f"{atlas.objects[1].best_tau:g}"
    shown.surface.click()
    assert [layer.name for layer in viewer.layers] == ["scan", "object 2"]
    shown.slider.setValue(shown.slider.value() + 1)
    assert len(viewer.layers) == 2 and viewer.layers[1].metadata["isovalue"] == pytest.approx(float(shown.isovalue.text()), rel=1e-3)
    shown.table.clearSelection()
    shown.labels.click()
    assert viewer.layers[2].name == "objects" and shown.message.text() == ""


def test_the_widget_says_errors(widget):
    shown, viewer = widget
    viewer.add(Image(np.full((4, 4, 4), np.nan), name="empty"))
    shown.find.click()
    if shown.job is not None:
        shown.job.wait()
        shown.look()
    assert shown.message.text() != "" and shown.job is None and shown.find.isEnabled()
