"""What notebooks show, and conversions to other packages."""
import html.parser
import importlib.util

import numpy as np
import pytest

import isoatlas
from conftest import smooth


class Tags(html.parser.HTMLParser):
    """Every element that is opened is closed, and nothing is loaded from elsewhere."""

    VOID = {"img", "rect", "br"}

    def __init__(self):
        super().__init__()
        self.open, self.seen = [], []

    def handle_starttag(self, tag, attributes):
        self.seen.append(tag)
        for name, value in attributes:
            assert name not in ("src", "href") or value.startswith("data:"), value
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def tags_of(text):
    parser = Tags()
    parser.feed(text)
    assert not parser.open
    return parser.seen


def test_tables_and_atlases_have_html(demo):
    atlas = isoatlas.open(demo)
    tags = tags_of(atlas.objects._repr_html_())
    assert tags.count("tr") == len(atlas.objects) + 1 and "img" in tags
    assert "table" in tags_of(atlas._repr_html_())
    assert "img" not in tags_of(isoatlas.open(demo[30]).objects._repr_html_())  # nothing to draw of an image


def test_texts_say_what_there_is(demo):
    atlas = isoatlas.open(demo)
    assert "64 x 64 x 64" in repr(atlas) and repr(atlas.objects).count("\n") == len(atlas.objects)
    assert "triangles, closed" in repr(atlas.surface(120.0)) and "segments, closed" in repr(isoatlas.open(demo[32]).surface(20.0))


def test_columns_become_data_frames(demo):
    pandas = pytest.importorskip("pandas", reason="python3-pandas is not installed")
    atlas = isoatlas.open(demo)
    frame = atlas.objects.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.index) == [one.number for one in atlas.objects]
    assert list(frame["best_tau"]) == [one.best_tau for one in atlas.objects]
    tree = atlas.tree.to_pandas()
    assert len(tree) == len(atlas.tree) and {"value", "position_x", "position_z"} <= set(tree.columns)
    assert len(atlas.spectrum(0).to_dict()["objects"]) > 0


@pytest.mark.parametrize("package", ["trimesh", "pyvista", "meshio"])
def test_meshes_become_those_of_other_packages(package):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    mesh = isoatlas.open(smooth((8, 9, 10))).surface(0.5)
    other = getattr(mesh, f"to_{package}")()
    points = other.vertices if package == "trimesh" else other.points
    assert np.allclose(points, mesh.points)
    assert package != "trimesh" or other.is_watertight


def test_the_viewer_answers_until_it_is_closed(demo):
    with isoatlas.open(demo).view() as view:
        objects = view.request("/api/objects?tau=120")
        assert objects and view.address.startswith("http://127.0.0.1:")
        assert "<a href=" in view._repr_html_()
    assert "closed" in repr(view)
    with pytest.raises(isoatlas.InputError, match="closed"):
        view.request("/api/objects?tau=120")


def test_files_of_pictures(demo, tmp_path):
    from isoatlas._pictures import save_animation, save_image
    mesh = isoatlas.open(demo).surface(120.0)
    frames = [isoatlas.render(mesh, size=32, view=(angle, 20), samples=1) for angle in (0, 30)]
    save_image(tmp_path / "one.png", frames[0])
    save_animation(tmp_path / "two.gif", frames)
    image = pytest.importorskip("PIL.Image", reason="python3-pil is not installed")
    assert np.array_equal(np.asarray(image.open(tmp_path / "one.png").convert("RGBA")), frames[0])
    from isoatlas._html import png
    (tmp_path / "own.png").write_bytes(png(frames[0]))
    assert np.array_equal(np.asarray(image.open(tmp_path / "own.png").convert("RGBA")), frames[0])
