"""Labels, Betti numbers, persistence and surfaces against brute force and against other packages."""
import collections

import numpy as np
import pytest

import isoatlas
from conftest import smooth

ndimage = pytest.importorskip("scipy.ndimage", reason="python3-scipy is not installed")
spatial = pytest.importorskip("scipy.spatial", reason="python3-scipy is not installed")


def levels_of(array, count=7):
    """Samples and values between them."""
    values = np.unique(array)
    chosen = values[np.linspace(1, len(values) - 1, count).astype(int)]
    return [float(level) for level in chosen] + [float(chosen[0] + chosen[1]) / 2]


def partition(labels):
    """The same for labels that are numbered otherwise."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse].reshape(labels.shape)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("shape", [(9, 10, 11), (1, 14, 15), (20, 21)])
@pytest.mark.parametrize("interpolant", ["trilinear", "faces"])
def test_labels_lie_between_those_of_six_and_of_all_neighbours(seed, shape, interpolant):
    array = np.rint(20 * smooth(shape, seed)).astype(np.uint8)
    for level in levels_of(array):
        mask = array >= level
        few, few_count = ndimage.label(mask)
        many, many_count = ndimage.label(mask, np.ones((3,) * array.ndim))
        ours, count = isoatlas.label(array, level, connectivity=interpolant)
        assert ours.dtype == np.int32 and ours.shape == shape and np.array_equal(ours > 0, mask)
        assert many_count <= count <= few_count
        assert len({*zip(few[mask], ours[mask])}) == few_count and len({*zip(ours[mask], many[mask])}) == count  # one refines the next
        sizes = np.bincount(ours.ravel())[1:]
        assert np.all(sizes[:-1] >= sizes[1:])
        if few_count == many_count:
            assert np.array_equal(partition(ours), partition(few))
        assert isoatlas.betti(array, level, interpolant=interpolant)[0] == count


@pytest.mark.parametrize("seed", range(4))
def test_euler_number_is_that_of_the_surface(seed):
    array = smooth((10, 11, 12), seed, passes=1)
    for level in levels_of(array):
        mesh = isoatlas.open(array).surface(level)
        of_mesh = len(mesh.points) - len(np.unique(np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)) + len(mesh)
        assert of_mesh == 2 * isoatlas.euler_number(array, level)


def test_simplified_surfaces_have_the_same_euler_number():
    array = smooth((24, 25, 26), 3)
    atlas = isoatlas.open(array)

    def euler_number(mesh):
        edges = np.unique(np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
        return len(mesh.points) - len(edges) + len(mesh)

    for level in levels_of(array, 3):
        exact = atlas.surface(level)
        light, fewer = atlas.surface(level, simplify=0.5), atlas.surface(level, triangles=len(exact) // 2)
        assert len(light) < len(exact) and len(exact) // 2 <= len(fewer) < len(exact)
        assert euler_number(light) == euler_number(fewer) == euler_number(exact)
        assert len(light.normals) == len(light.points)
        tree = spatial.cKDTree(exact.points)
        assert tree.query(light.points)[0].max() < 0.5 + 1  # of the triangles, not of their corners: at most an edge more
        assert set(light.contour_ids) == set(exact.contour_ids)
        coarse = atlas.surface(level, octree=8)
        assert len(coarse) <= len(exact) and euler_number(coarse) == euler_number(exact)
        assert set(coarse.contour_ids) == set(exact.contour_ids)
        near, far = (atlas.surface(level, octree=8, eye=(12, 12, z)) for z in (-30, -3000))
        assert len(coarse) <= len(far) <= len(near) <= len(exact)
        assert len(atlas.surface(level, octree=8, eye=(12, 12, -30), pixels=4)) <= len(near)
        assert euler_number(near) == euler_number(far) == euler_number(exact)
        bounded = atlas.surface(level, octree=8, octree_error=0.1)
        assert len(coarse) <= len(bounded) and euler_number(bounded) == euler_number(exact)
    for wrong in ({"octree": 3}, {"octree": 64}, {"octree": 4, "simplify": 0.5}, {"octree_error": 0.1}, {"eye": (0, 0, 0)},
                  {"octree": 4, "eye": (0, 0)}, {"octree": 4, "eye": (0, 0, 0), "octree_error": 1}, {"octree": 4, "octree_error": 0},
                  {"octree": 4, "eye": (0, 0, 0), "pixels": 0}, {"octree": 4, "pixels": 2}, {"pixels": 2}):
        with pytest.raises(isoatlas.InputError):
            atlas.surface(level, **wrong)


def test_levels_of_detail_lie_beside_the_store(tmp_path):
    array = smooth((24, 25, 26), 3)
    with pytest.raises(isoatlas.InputError, match="store"):
        isoatlas.open(array).save_levels()
    isoatlas.build(array, tmp_path / "field.atlas")
    with isoatlas.open(tmp_path / "field.atlas") as atlas:
        first, second = atlas.find_objects(2)
        held, = atlas.save_levels([first])
        assert (held["id"], held["is_cavity"]) == (first.id, False) and held["tau"] == pytest.approx(first.best_tau)
        assert held["triangles"] == len(first.surface()) >= held["coarsest"]
        before = (tmp_path / "field.atlas.lod").read_bytes()
        assert atlas.save_levels([first]) == [held] and (tmp_path / "field.atlas.lod").read_bytes() == before
        assert [one["id"] for one in atlas.save_levels([second])] == [first.id, second.id]
        atlas.save_levels(top=1, path=tmp_path / "other.lod")
        assert (tmp_path / "other.lod").read_bytes() == before


def test_betti_numbers_of_known_shapes():
    z, y, x = np.mgrid[-12:13, -12:13, -12:13]
    radius = np.sqrt(x**2 + y**2 + z**2)
    shapes = {(1, 0, 0): radius < 8, (1, 0, 1): (radius < 9) & (radius > 5), (2, 0, 0): np.abs(np.abs(x) - 6) + np.hypot(y, z) < 3,
              (1, 1, 0): np.hypot(np.hypot(x, y) - 7, z) < 3, (0, 0, 0): radius < -1}
    for expected, mask in shapes.items():
        if expected[0]:
            assert isoatlas.betti(mask, 0.5) == expected
        assert isoatlas.euler_number(mask, 0.5) == expected[0] - expected[1] + expected[2]
    assert isoatlas.betti(np.pad(np.ones((3, 3)), 2) - np.pad(np.ones((1, 1)), 3), 0.5) == (1, 1, 0)


def test_betti_numbers_of_simple_masks_are_those_of_scikit_image():
    measure = pytest.importorskip("skimage.measure", reason="python3-skimage is not installed")
    compared = 0
    for seed in range(12):
        array = np.pad(smooth((7, 8, 9), seed), 2)
        mask = np.kron(array > np.median(array[2:-2, 2:-2, 2:-2]), np.ones((2, 2, 2))) > 0
        mask = ndimage.binary_opening(ndimage.binary_closing(mask, np.ones((3, 3, 3))), np.ones((3, 3, 3)))
        few, many = (measure.euler_number(mask, connectivity=c) for c in (1, 3))
        if few == many:  # then no pair of voxels touches along an edge or a corner alone
            assert isoatlas.euler_number(mask, 0.5) == few
            compared += 1
    assert compared > 3


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("polarity", ["high", "low"])
def test_persistence_counts_what_survives_from_one_isovalue_to_another(seed, polarity):
    array = np.rint(12 * smooth((6, 7, 8), seed, passes=1))
    atlas = isoatlas.open(array, polarity=polarity)
    sign = 1 if polarity == "high" else -1
    pairs = sign * atlas.persistence(0)
    assert np.all(pairs[:, 0] > pairs[:, 1]) and np.count_nonzero(np.isinf(pairs[:, 1])) == 1
    levels = np.unique(sign * array)
    labels = {level: isoatlas.label(atlas, sign * level)[0] for level in levels}
    for low in levels:
        for high in levels[levels >= low]:
            survivors = len(np.unique(labels[low][labels[high] > 0]))
            assert np.count_nonzero((pairs[:, 0] >= high) & (pairs[:, 1] < low)) == survivors


def test_tunnels_are_as_many_as_b1_at_every_isovalue():
    array = np.rint(30 * smooth((8, 9, 10), 7, passes=1))
    atlas = isoatlas.open(array)
    pairs = atlas.persistence(1)
    assert len(pairs) > 3
    for level in np.unique(array):
        assert np.count_nonzero((pairs[:, 1] < level) & (level <= pairs[:, 0])) == atlas.betti(level)[1]
    kept = atlas.persistence(1, min_persistence=3)
    assert len(kept) == np.count_nonzero(pairs[:, 0] - pairs[:, 1] >= 3)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("shape", [(7, 8, 9), (12, 13)])
def test_cavities_are_as_many_as_the_last_betti_number_at_every_isovalue(seed, shape):
    array = np.rint(30 * smooth(shape, seed, passes=1))
    atlas = isoatlas.open(array)
    pairs = atlas.persistence(atlas.ndim - 1)
    assert len(pairs) > 0 and np.all(pairs[:, 0] > pairs[:, 1])
    for level in np.unique(array):
        assert np.count_nonzero((pairs[:, 1] < level) & (level <= pairs[:, 0])) == atlas.betti(level)[atlas.ndim - 1]
    assert len(atlas.persistence(2)) == (len(pairs) if atlas.ndim == 3 else 0)
    with pytest.raises(isoatlas.InputError, match="dimension 3"):
        atlas.persistence(3)


def test_a_simplified_tree_parts_the_volume():
    atlas = isoatlas.open(smooth((12, 13, 14), 5, passes=1))
    simplified = atlas.tree.simplify(keep=5)
    assert simplified.kept == 5 and simplified.kept + simplified.hidden == atlas.find_objects(all=True).total
    assert simplified.zone_voxels.sum() == atlas.volume.size and len(simplified.node_of_event) == len(atlas.tree)
    counts = np.bincount(simplified.zones().ravel(), minlength=len(simplified) + 1)
    assert counts[0] == 0 and np.array_equal(counts[1:], simplified.zone_voxels)
    assert np.count_nonzero(simplified.is_maximum) == 5 and list(np.flatnonzero(simplified.parent < 0)) == [len(simplified) - 1]


def test_the_tree_is_a_graph():
    networkx = pytest.importorskip("networkx", reason="python3-networkx is not installed")
    atlas = isoatlas.open(smooth((9, 10, 11), 2))
    tree, graph = atlas.tree, atlas.tree.to_networkx()
    assert networkx.is_arborescence(graph.reverse()) and len(graph) == len(tree)
    assert all(graph.nodes[a]["value"] >= graph.nodes[b]["value"] for a, b in graph.edges)
    assert graph.nodes[len(tree) - 1]["object_voxels"] == atlas.volume.size
    assert {node["kind"] for _, node in graph.nodes(data=True)} <= set(tree.kinds)


# Surfaces.

def signed_volume(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def is_closed(triangles):
    """Every edge has two triangles, which run along it in opposite directions."""
    edges = collections.Counter(map(tuple, triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()))
    return all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items())


@pytest.mark.parametrize("direction", ["descent", "ascent"])
@pytest.mark.parametrize("spacing", [(1.0, 1.0, 1.0), (2.0, 0.5, 0.5)])
def test_marching_cubes_is_that_of_scikit_image_away_from_samples(direction, spacing):
    measure = pytest.importorskip("skimage.measure", reason="python3-skimage is not installed")
    z, y, x = np.mgrid[-10:11, -10:11, -10:11]
    ball = 8.3 - np.sqrt((x - 0.3) ** 2 + (y + 0.2) ** 2 + 1.3 * z**2)
    theirs = measure.marching_cubes(ball, 0.123, spacing=spacing, gradient_direction=direction)
    ours = isoatlas.marching_cubes(ball, 0.123, spacing=spacing, gradient_direction=direction)
    assert [one.shape[1:] for one in ours] == [one.shape[1:] for one in theirs]
    assert len(ours[0]) == len(theirs[0]) and len(ours[1]) == len(theirs[1])
    _, nearest = spatial.cKDTree(theirs[0]).query(ours[0])
    assert np.abs(theirs[0][nearest] - ours[0]).max() < 1e-5
    a, b = signed_volume(*ours[:2]), signed_volume(*theirs[:2])
    assert np.sign(a) == np.sign(b) and abs(a - b) < 1e-4 * abs(b)
    if spacing == (1, 1, 1):  # normals of scikit-image are those of the samples without their spacing
        assert np.einsum("ij,ij->i", theirs[2][nearest], ours[2]).min() > 0.99
    a, b, c = (ours[0][ours[1][:, i]] for i in range(3))
    faces = np.cross(b - a, c - a) * (-1 if direction == "descent" else 1)
    assert np.einsum("ij,ij->i", faces, ours[2][ours[1][:, 0]]).min() > 0  # they follow the triangles
    assert is_closed(ours[1]) and not isoatlas.Mesh.from_arrays(ours[0], ours[1]).inspect()["zero_area_triangles"]
    assert np.all(ours[3] >= 0.123) and ours[3].max() <= ball.max() + 1e-5


def test_the_default_level_and_steps_are_those_of_scikit_image():
    measure = pytest.importorskip("skimage.measure", reason="python3-skimage is not installed")
    array = np.pad(smooth((12, 13, 14), 3), 3)
    for options in {}, {"step_size": 2}, {"method": "lorensen"}, {"allow_degenerate": False}:
        a = signed_volume(*isoatlas.marching_cubes(array, **options)[:2])
        b = signed_volume(*measure.marching_cubes(array, **options)[:2])
        assert abs(a - b) < 1e-4 * abs(b)


def test_open_surfaces_end_at_the_border_as_those_of_scikit_image():
    array = smooth((9, 10, 11), 4)
    level = float(np.median(array)) + 1e-7
    points, triangles, _, _ = isoatlas.marching_cubes(array, level, boundary="open")
    assert not is_closed(triangles)
    assert np.all(points >= 0) and np.all(points <= np.array(array.shape) - 1)
    assert is_closed(isoatlas.marching_cubes(array, level)[1])


def test_scikit_image_8109_no_triangle_twice():
    array = np.array([[[13, -1], [-1, -7]], [[-1, 1], [7, -7]], [[15, -9], [-3, -1]]])
    points, triangles, _, _ = isoatlas.marching_cubes(array, 0, boundary="open")
    assert len({tuple(sorted(triangle)) for triangle in triangles.tolist()}) == len(triangles)
    closed = isoatlas.marching_cubes(array, 0)
    assert is_closed(closed[1])
    isoatlas.Mesh.from_arrays(closed[0], closed[1]).verify()


@pytest.mark.parametrize("seed", range(40))
def test_scikit_image_8116_no_hole_where_the_level_is_a_sample(seed):
    random = np.random.default_rng(seed)
    array = np.pad(random.integers(-2, 3, (3, 3, 3)).astype(float), 1, constant_values=-1.0)
    array[2, 2, 2] = 0
    array[1, 1, 1] = 2
    points, triangles, _, _ = isoatlas.marching_cubes(array, 0.0)
    assert is_closed(triangles)
    isoatlas.Mesh.from_arrays(points, triangles).verify()


def test_scikit_image_has_such_holes():
    """Else the test above would show nothing."""
    measure = pytest.importorskip("skimage.measure", reason="python3-skimage is not installed")
    open_ones = 0
    for seed in range(40):
        array = np.pad(np.random.default_rng(seed).integers(-2, 3, (3, 3, 3)).astype(float), 1, constant_values=-1.0)
        array[2, 2, 2], array[1, 1, 1] = 0, 2
        open_ones += not is_closed(measure.marching_cubes(array, 0.0, allow_degenerate=False)[1])
    assert open_ones > 0


def test_an_isovalue_at_every_sample_gives_a_closed_surface():
    array = np.rint(6 * smooth((8, 8, 8), 9, passes=1))
    atlas = isoatlas.open(array)
    for level in np.unique(array):
        mesh = atlas.surface(level)
        assert is_closed(mesh.triangles) and mesh.closed
        mesh.verify()
    whole = atlas.verify(levels=2)
    assert whole and all(check.holds for check in whole)


def test_objects_have_their_surface_mask_and_label(demo):
    atlas = isoatlas.open(demo)
    assert len(atlas.objects) >= 3
    for one in atlas.objects:
        mask = one.mask()
        assert mask.dtype == bool and np.count_nonzero(mask) == one.voxels and mask[one.index]
        mesh = one.surface()
        assert set(mesh.object_ids) == {one.id} and is_closed(mesh.triangles)
        assert isoatlas.betti(mask, 0.5)[0] == 1
        lower = one.surface((one.best_tau + max(one.merges, atlas.range[0])) / 2)
        assert signed_volume(lower.points, lower.triangles) > signed_volume(mesh.points, mesh.triangles)
