"""What notebooks show, and conversions to other packages."""
import html
import html.parser
import importlib.metadata
import importlib.util
import json
import urllib.error
import urllib.request

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
    assert atlas.objects._repr_html_().count("<th>voxels</th>") == 1
    assert "<th>mm\u00b3</th>" in isoatlas.open(demo, unit="mm").objects._repr_html_()
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
    assert "closed" in repr(view) and "closed" in view._repr_html_()
    for use in (lambda: view.request("/api/objects?tau=120"), lambda: view.scene, lambda: view.tau, lambda: view.selected,
                lambda: setattr(view, "tau", 1.0)):
        with pytest.raises(isoatlas.InputError, match="closed"):
            use()


@pytest.fixture(scope="module")
def shown(demo):
    """An atlas of the demo, as a store, and its view."""
    atlas = isoatlas.open(demo)
    with atlas.view() as view:
        yield atlas, view


def attribute(text, name):
    """The first value of an attribute in HTML."""
    return html.unescape(text.split(f'{name}="', 1)[1].split('"', 1)[0])


def answer(url, **headers):
    """Status, headers and text."""
    try:
        with urllib.request.urlopen(urllib.request.Request(url, headers=headers)) as told:
            return told.status, dict(told.headers), told.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, dict(error.headers), error.read().decode()


def in_frame(page, url, **headers):
    """What a page in a frame is answered."""
    return answer(url, **{"X-Frame-Key": page.split('name="isoatlas-frame" content="', 1)[1].split('"', 1)[0], **headers})


def test_a_cell_has_the_navigator_in_a_frame(shown, monkeypatch):
    monkeypatch.delenv("JUPYTERHUB_SERVICE_PREFIX", raising=False)
    atlas, view = shown
    text = view._repr_html_()
    assert "height: 600px" in text and "Open in a tab" in text and attribute(text, "href").startswith("http://127.0.0.1:")
    frame = attribute(text, "src")
    status, headers, page = answer(frame)
    if status == 500 and "built_without_web" in page:
        pytest.skip("isoatlas was built without pages")
    assert status == 200 and "frame-ancestors" not in headers["Content-Security-Policy"] and "Set-Cookie" not in headers
    origin = frame.split("/frame")[0]
    elsewhere = {"Host": "hub.example", "Origin": "https://hub.example"}
    status, headers, told = in_frame(page, origin + "/api/objects?tau=120", **elsewhere)
    assert status == 200 and "frame-ancestors 'none'" in headers["Content-Security-Policy"]
    assert json.loads(told) == view.request("/api/objects?tau=120")
    assert in_frame(page, origin + "/api/address")[0] == 403 and in_frame(page, origin + "/")[0] == 403
    assert answer(frame)[0] == 403 and answer(origin + "/api/objects?tau=120", **elsewhere)[0] == 421


def test_the_page_is_part_of_the_module(shown):
    status, _, page = answer(attribute(shown[1]._repr_html_(), "src"))
    if status != 200:
        pytest.skip("isoatlas was built without pages")
    assert '<main id="viewer">' in page and "<script" in page


def test_a_hub_needs_a_proxy_and_uses_it(shown, monkeypatch):
    _, view = shown
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/a/")
    versions = {}

    def version(name):
        if name not in versions:
            raise importlib.metadata.PackageNotFoundError(name)
        return versions[name]

    monkeypatch.setattr(importlib.metadata, "version", version)
    for installed in ({}, {"jupyter-server-proxy": "4.1.2"}):
        versions.update(installed)
        text = view._repr_html_()
        assert "jupyter-server-proxy 4.3" in text and "iframe" not in text
    versions["jupyter-server-proxy"] = "4.4.0"
    text = view._repr_html_()
    port = view.address.split(":")[2].split("/")[0]
    for name in ("src", "href"):
        assert attribute(text, name).startswith(f"/user/a/proxy/{port}/frame?once=")


def test_a_view_begins_with_the_first_object(demo):
    atlas = isoatlas.open(demo)
    with atlas.view(height=300) as view:
        assert "height: 300px" in view._repr_html_()
        first = view.scene
        assert view.request("/api/scene")["scene"] is None
        assert len(first["shown"]) == 1 and view.selected == [1] and view.tau == atlas.object(1).best_tau
        view.scene = first
        assert view.request("/api/scene")["scene"] == first == view.scene


def test_isovalues_and_objects_are_set_and_read(shown):
    atlas, view = shown
    view.selected = [3, "2", atlas.object(1)]
    assert view.selected == [3, 2, 1] and view.tau == atlas.object(3).best_tau
    view.tau = 120.5
    assert view.tau == 120.5
    taus = [one["tau"] for one in view.request("/api/scene")["scene"]["shown"]]
    assert taus == [120.5, atlas.object(2).best_tau, atlas.object(1).best_tau]
    view.selected = [2, 3]
    assert view.selected == [2, 3] and [one["tau"] for one in view.scene["shown"]] == [atlas.object(2).best_tau, 120.5]
    view.selected = atlas.cavities[:1] if len(atlas.cavities) else 1
    assert view.selected == (["c1"] if len(atlas.cavities) else [1])
    view.selected = []
    assert view.selected == [] and view.tau is None
    view.tau = 100
    assert view.tau == 100 and view.selected == [] and view.scene["shown"][0]["entry"] == -1


def test_scenes_are_checked(shown):
    _, view = shown
    before = view.scene
    for wrong in ({}, {**before, "volume": {"name": "x", "size": [1, 2, 3]}}, {**before, "selected": "x"}):
        with pytest.raises(isoatlas.InputError):
            view.scene = wrong
    for tau, kind in ((float("nan"), isoatlas.InputError), (1e9, isoatlas.NotFoundError)):
        with pytest.raises(kind):
            view.tau = tau
    for reference, kind in (("x", isoatlas.InputError), (10**6, isoatlas.NotFoundError), ("c1000000", isoatlas.NotFoundError)):
        with pytest.raises(kind):
            view.selected = [reference]
    assert view.scene == before


def test_a_page_tells_its_scene(shown):
    """As pages do: with the version that they know, and a body."""
    atlas, view = shown
    view.selected = [1]
    version = view.request("/api/scene")["version"]
    address, token = view._viewer.address, view._viewer.token

    def put(after, text, **headers):
        query = urllib.request.Request(f"{address}/api/scene?after={after}", text.encode(), {"X-Client": "page/a", **headers}, method="PUT")
        query.add_header("Authorization", f"Bearer {token}")
        try:
            with urllib.request.urlopen(query) as told:
                return told.status
        except urllib.error.HTTPError as error:
            return error.code

    scene = view.scene
    scene["shown"][0]["tau"] = 77.25
    scene["shown"] += [{**scene["shown"][0], "entry": -1, "id": None, "name": "x" * 100} for _ in range(2000)]  # some hundred kilobytes
    assert put(version, json.dumps(scene)) == 200
    assert view.tau == 77.25 and view.request("/api/scene")["client"] == "page"
    assert put(version, json.dumps(scene)) == 409
    assert put(version + 1, "x" * 1000) == 400
    assert put(version + 1, "{}", **{"Content-length": str(5 << 20)}) == 413
    view.selected = [1]


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
