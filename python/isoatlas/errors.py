"""Exceptions of isoatlas: what happened, where, what was expected, what to do next.

Each is also an exception that Python has, so that code which knows nothing of isoatlas catches it.
"""
from __future__ import annotations

__all__ = ["Error", "InputError", "InternalError", "NotFoundError", "ResourceError", "UnsupportedError", "VerificationError"]


class Error(Exception):
    """Base of all exceptions of isoatlas.

    Attributes
    ----------
    file, where, what, expected, next : str
        The parts of the message; empty where there is nothing to say.
    reason : str
        A name for programs, such as ``"missing_samples"``; ``"none"``: only the text says it.
    """

    file: str = ""
    where: str = ""
    what: str = ""
    expected: str = ""
    next: str = ""
    reason: str = "none"

    def __reduce__(self) -> tuple[object, ...]:
        return from_parts, (type(self).__name__, self.file, self.where, self.what, self.expected, self.next, self.reason, "")


class InputError(Error, ValueError):
    """An argument that means nothing, or a file that is missing, truncated or damaged."""


class NotFoundError(Error, LookupError):
    """No such object or contour, or an isovalue outside the range of the samples."""


class ResourceError(Error, MemoryError):
    """Not enough memory, a full disk, or an output that cannot be written."""


class UnsupportedError(Error, NotImplementedError):
    """A valid file or array of a format or type that isoatlas does not read."""


class VerificationError(Error, RuntimeError):
    """A guarantee does not hold. ``checks`` has all that were checked."""

    checks: tuple[object, ...] = ()


class InternalError(Error, RuntimeError):
    """A check of isoatlas itself failed: a bug."""


_NEXT = {
    "raw_layout_unknown": "give dims=(z, y, x) and type=, or name the file like name_64x64x64_uint8.raw",
    "raw_type_differs": "the size fits these dims with type='{value}'",
    "raw_sizes_differ": "the size fits dims {value} (x, y, z) with this type",
    "raw_has_more": "if the file begins with a header, add skip={value}; if something follows the samples, skip_rest=True",
    "raw_size_differs": "check dims, type and skip",
    "wrong_dimension": "give dims=(y, x) or (z, y, x)",
    "zero_spacing": "correct spacing, or leave it out",
    "skip_exceeds_file": "correct skip",
    "contradicts_sidecar": "leave it out, or correct the sidecar",
    "contradicts_header": "leave it out; it is for RAW files",
    "unknown_format": "convert the file, or give dims and type if it is RAW",
    "bytes_after_samples": "the header or the file is damaged, or it holds more than a volume: then skip_rest=True",
    "file_outside_folder": "copy the file into the folder, or follow_links=True if you trust where this volume comes from",
    "time_step_needed": "choose one with time_step=N, N from 0 to {value}",
    "no_such_time_step": "choose another time_step",
    "no_time_steps": "leave time_step out",
    "channel_needed": "choose one with channel=NAME or its number",
    "no_such_channel": "choose another channel",
    "no_channels": "leave channel out",
    "series_needed": "choose one with series=",
    "no_such_series": "choose another series",
    "no_series": "leave series out",
    "dataset_needed": "name one behind the file: 'FILE:/NAME'",
    "no_such_dataset": "name another one behind the file: 'FILE:/NAME'",
    "no_datasets": "leave out what follows the name of the file",
    "no_such_level": "choose another level",
    "no_ranges": "download the file and open the copy, or put it on a server that answers range requests",
    "redirected_elsewhere": "if you trust {value}, give the address that it redirects to",
    "address_token_needed": "if the server takes a bearer token, put it into the environment: ISOATLAS_BEARER_TOKEN",
    "address_token_refused": "check ISOATLAS_BEARER_TOKEN: the token may have expired",
    "address_with_password": "leave them out; a bearer token is taken from the environment: ISOATLAS_BEARER_TOKEN",
    "missing_samples": "missing='below' makes such samples background, missing=VALUE puts a value in their place",
    "only_missing_samples": "check the samples and no_data",
    "replacement_not_stored": "give another value, or missing='below'",
    "no_value_below": "give a value instead: missing={value}",
    "unequal_spacing": "resample it to equal spacing first",
    "not_a_store": "isoatlas.build(VOLUME, 'FILE.atlas') builds one",
    "polarity_not_stored": "isoatlas.build(VOLUME, FILE, polarity='both') builds one that does",
    "memory_budget_too_small": "give more memory=, or fewer threads=",
    "no_scratch_space": "free some space, choose another folder with store=, or allow more memory=",
    "threads_refused": "allow this process more memory and threads, or use fewer threads=",
    "output_refused": "choose another name",
    "output_read_only": "choose another name, or make the file writable",
    "build_folder_taken": "rename or remove it, or build to another file",
    "store_being_built": "wait until it is done, or build to another file",
    "built_without_web": "install Node.js and npm, and build isoatlas again: its page is bundled with them",
    "bug": "please report it with what you called and, if you may share it, the volume",
}


def from_parts(kind: str, file: str, where: str, what: str, expected: str, next: str, reason: str, value: str) -> BaseException:
    """The exception of that class: called by the modules of C++, and when one is unpickled."""
    if reason in _NEXT:
        next = _NEXT[reason].format(value=value)
    message = ": ".join(part for part in (file, where, what) if part)
    if expected:
        message += f" (expected {expected})"
    if next:
        message += f". Next: {next}"
    if kind == "Cancelled":
        return KeyboardInterrupt(message)
    classes: dict[str, type[Error]] = {
        one.__name__: one for one in (InputError, NotFoundError, ResourceError, UnsupportedError, VerificationError, InternalError)}
    error = classes.get(kind, InternalError)(message)
    error.file, error.where, error.what, error.expected, error.next, error.reason = file, where, what, expected, next, reason
    return error


def raised(kind: type[Error], what: str, *, expected: str = "", next: str = "", where: str = "", file: str = "") -> BaseException:
    """An exception of this package with these parts, to be raised."""
    return from_parts(kind.__name__, file, where, what, expected, next, "none", "")
