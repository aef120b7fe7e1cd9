"""Bad input: one exception of the right class, with a sentence and the next step."""
import copy
import pickle

import numpy as np
import pytest

import isoatlas
from conftest import smooth

GOOD = smooth((5, 6, 7))
NAN = GOOD.copy()
NAN[1, 2, 3] = np.nan
INFINITE = GOOD.copy()
INFINITE[1, 2, 3] = -np.inf

CALLS = {
    "objects": (isoatlas.UnsupportedError, lambda: isoatlas.open(np.full((3, 3, 3), None))),
    "complex": (isoatlas.UnsupportedError, lambda: isoatlas.open(GOOD.astype(complex))),
    "text": (isoatlas.UnsupportedError, lambda: isoatlas.open(np.full((3, 3, 3), "a"))),
    "masked": (isoatlas.UnsupportedError, lambda: isoatlas.open(np.ma.masked_less(GOOD, 0.5))),
    "nan": (isoatlas.InputError, lambda: isoatlas.open(NAN)),
    "infinite": (isoatlas.InputError, lambda: isoatlas.open(INFINITE)),
    "empty": (isoatlas.InputError, lambda: isoatlas.open(np.zeros((0, 3, 3)))),
    "no axis": (isoatlas.InputError, lambda: isoatlas.open(np.float64(1))),
    "1d": (isoatlas.InputError, lambda: isoatlas.open(np.zeros(9))),
    "4d": (isoatlas.InputError, lambda: isoatlas.open(np.zeros((2, 3, 3, 3)))),
    "5d": (isoatlas.InputError, lambda: isoatlas.open(np.zeros((2, 2, 3, 3, 3)))),
    "spacing is not finite": (isoatlas.InputError, lambda: isoatlas.open(GOOD, spacing=(1, np.nan, 1))),
    "spacing is 0": (isoatlas.InputError, lambda: isoatlas.open(GOOD, spacing=(1, 0, 1))),
    "spacing is negative": (isoatlas.InputError, lambda: isoatlas.open(GOOD, spacing=-1)),
    "spacing of two axes": (isoatlas.InputError, lambda: isoatlas.open(GOOD, spacing=(1, 1))),
    "spacing is text": (isoatlas.InputError, lambda: isoatlas.open(GOOD, spacing="1 1 1")),
    "origin of four axes": (isoatlas.InputError, lambda: isoatlas.open(GOOD, origin=(1, 1, 1, 1))),
    "direction of four axes": (isoatlas.InputError, lambda: isoatlas.open(GOOD, direction=np.eye(4))),
    "box": (isoatlas.InputError, lambda: isoatlas.open(GOOD, box=np.s_[0:2, 0:2])),
    "box is empty": (isoatlas.InputError, lambda: isoatlas.open(GOOD, box=np.s_[2:2, 0:2, 0:2])),
    "polarity": (isoatlas.InputError, lambda: isoatlas.open(GOOD, polarity="dark")),
    "interpolant": (isoatlas.InputError, lambda: isoatlas.open(GOOD, interpolant="cubic")),
    "memory": (isoatlas.InputError, lambda: isoatlas.open(GOOD, memory="1M")),
    "memory is text": (isoatlas.InputError, lambda: isoatlas.open(GOOD, memory="much")),
    "dims of an array": (isoatlas.InputError, lambda: isoatlas.open(GOOD, dims=(1, 2, 3))),
    "missing": (isoatlas.InputError, lambda: isoatlas.open(NAN, missing="zero")),
    "no file": (isoatlas.InputError, lambda: isoatlas.open("/nowhere/scan.nrrd")),
    "level above": (isoatlas.NotFoundError, lambda: isoatlas.open(GOOD).surface(2.0)),
    "level below": (isoatlas.NotFoundError, lambda: isoatlas.open(GOOD).labels(-2.0)),
    "level is not finite": (isoatlas.InputError, lambda: isoatlas.open(GOOD).surface(np.nan)),
    "level of betti": (isoatlas.InputError, lambda: isoatlas.betti(GOOD, np.inf)),
    "no such object": (isoatlas.NotFoundError, lambda: isoatlas.open(GOOD).object(10**6)),
    "no such reference": (isoatlas.InputError, lambda: isoatlas.open(GOOD).object("tooth?")),
    "no object at a voxel": (isoatlas.NotFoundError,
                             lambda: isoatlas.open(GOOD).surface(float(np.median(GOOD)), objects=[int(GOOD.argmin())])),
    "boundary": (isoatlas.InputError, lambda: isoatlas.open(GOOD).surface(0.5, boundary="half")),
    "extension": (isoatlas.InputError, lambda: isoatlas.open(GOOD).surface(float(np.median(GOOD))).save("surface.xyz")),
    "no folder": (isoatlas.ResourceError, lambda: isoatlas.open(GOOD).surface(float(np.median(GOOD))).save("/nowhere/surface.ply")),
    "dimension": (isoatlas.InputError, lambda: isoatlas.open(GOOD).persistence(3)),
    "phantom": (isoatlas.InputError, lambda: isoatlas.phantom("nothing")),
    "mask": (isoatlas.UnsupportedError, lambda: isoatlas.marching_cubes(GOOD, mask=GOOD > 0)),
    "step": (isoatlas.InputError, lambda: isoatlas.marching_cubes(GOOD, step_size=0)),
    "gradient": (isoatlas.InputError, lambda: isoatlas.marching_cubes(GOOD, gradient_direction="up")),
    "2D": (isoatlas.InputError, lambda: isoatlas.marching_cubes(GOOD[0])),
    "triangles": (isoatlas.InputError, lambda: isoatlas.Mesh.from_arrays(np.zeros((2, 3)), [[0, 1, 2]])),
    "points": (isoatlas.InputError, lambda: isoatlas.Mesh.from_arrays(np.zeros((2, 2)), [[0, 1, 1]])),
}


@pytest.mark.parametrize("call", CALLS)
def test_bad_input_is_one_exception_with_the_next_step(call):
    expected, function = CALLS[call]
    with pytest.raises(expected) as raised:
        function()
    error = raised.value
    assert isinstance(error, isoatlas.Error) and error.what and error.what in str(error)
    assert type(error) is expected


@pytest.mark.parametrize("ours,known", [(isoatlas.InputError, ValueError), (isoatlas.NotFoundError, LookupError),
                                        (isoatlas.ResourceError, MemoryError), (isoatlas.UnsupportedError, NotImplementedError),
                                        (isoatlas.VerificationError, RuntimeError), (isoatlas.InternalError, RuntimeError)])
def test_exceptions_are_also_those_of_python(ours, known):
    assert issubclass(ours, known) and issubclass(ours, isoatlas.Error)


def test_the_next_step_is_in_words_of_python():
    with pytest.raises(isoatlas.InputError) as raised:
        isoatlas.open(NAN)
    assert raised.value.reason == "missing_samples" and "missing=" in raised.value.next
    assert raised.value.where == "voxel (3, 2, 1)"


def test_exceptions_survive_pickle():
    with pytest.raises(isoatlas.InputError) as raised:
        isoatlas.open(NAN)
    back = pickle.loads(pickle.dumps(raised.value))
    assert type(back) is isoatlas.InputError and str(back) == str(raised.value) and back.reason == raised.value.reason


def test_a_mesh_with_a_hole_fails_its_verification():
    mesh = isoatlas.open(GOOD).surface(float(np.median(GOOD)))
    assert all(check.holds for check in mesh.verify())
    broken = isoatlas.Mesh.from_arrays(mesh.points, mesh.triangles[1:])
    with pytest.raises(isoatlas.VerificationError) as raised:
        broken.verify()
    assert any(not check.holds for check in raised.value.checks)
    assert broken.verify(strict=False) == raised.value.checks


def test_a_closed_atlas_says_so():
    with isoatlas.open(GOOD) as atlas:
        mesh = atlas.surface(float(np.median(GOOD)))
    assert mesh.points.shape[1] == 3
    with pytest.raises(isoatlas.InputError, match="closed"):
        atlas.objects
    assert "closed" in repr(atlas)


def test_a_file_that_is_damaged_or_vanishes(tmp_path):
    isoatlas.write(tmp_path / "v.nrrd", GOOD)
    whole = (tmp_path / "v.nrrd").read_bytes()
    (tmp_path / "v.nrrd").write_bytes(whole[:-100])
    with pytest.raises(isoatlas.InputError, match="v.nrrd"):
        isoatlas.open(tmp_path / "v.nrrd")
    isoatlas.build(GOOD, tmp_path / "v.atlas")
    atlas = isoatlas.open(tmp_path / "v.atlas")
    pickled = pickle.dumps(atlas)
    (tmp_path / "v.atlas").unlink()
    assert copy.copy(atlas).objects is not None  # the file is open
    with pytest.raises(isoatlas.InputError):
        pickle.loads(pickled)
