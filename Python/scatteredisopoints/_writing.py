# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of isosurfaces: see writer_for() and file_to_write()."""

from __future__ import annotations

import contextlib
import csv
import errno
import importlib.util
import math
import os
import re
import secrets
import shutil
import stat
import warnings
import zipfile
from pathlib import Path
from typing import Any, Callable, Iterator, Optional, Union

import numpy as np

from ._isosurface import Isosurface
from ._reading import END_OF_NAME, PLY_TYPES, without_unit

Writer = Callable[[str, Isosurface], Any]
_OF_PYVISTA = (".vtk", ".vtp", ".vtu")


def writer_for(path: str, are_triangles: bool) -> Writer:
    """What writes points or triangles to a file with this ending. Raises ValueError if no installed package does."""
    suffix = Path(path).suffix.lower()
    if suffix == ".stl" and not are_triangles:
        raise ValueError("STL files hold triangles alone: choose another format for points, such as .ply")
    if suffix in _WRITERS:
        return _WRITERS[suffix]
    if suffix in _OF_PYVISTA and importlib.util.find_spec("pyvista"):
        return _by_pyvista
    if importlib.util.find_spec("meshio"):
        import meshio

        if suffix in meshio.extension_to_filetypes:
            return _by_meshio
    raise ValueError(f'the format of {path} is unknown: there are {", ".join(_WRITERS)}, with PyVista'
                     f' {", ".join(_OF_PYVISTA)}, and those of meshio (pip install pyvista meshio)')


@contextlib.contextmanager
def file_to_write(path: str) -> Iterator[str]:
    """The name of a file that takes the place of another one, and its owner and permissions, unless what writes it
    fails. A symbolic link stays, and the file that it names is replaced; devices and pipes are written in place. Raises
    OSError, with the path, at once if the file cannot be written."""
    name, real, private = os.path.basename(path), os.path.realpath(path), ""
    folder = os.path.dirname(real)
    try:
        mode = _mode_of(path)
        if mode is not None and not stat.S_ISREG(mode):
            yield path
            return
        if os.name == "nt" and mode is not None and not mode & stat.S_IWRITE:  # which Windows does not replace
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        if not os.path.isdir(folder):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        # Nobody can guess the name of this folder and put a link there.
        private = os.path.join(folder, f".{secrets.token_hex(8)}")
        # tempfile.mkdtemp() makes folders whose files, on Windows, stay those of one user when they are moved.
        os.mkdir(private, 0o777 if os.name == "nt" else 0o700)
        yield os.path.join(private, name)
        if not os.path.exists(os.path.join(private, name)):
            raise OSError(f"{path} cannot be written: is the disk full?")
        # Some formats of meshio are several files: the one that names the others comes last.
        for each in sorted(os.listdir(private), key=lambda each: each == name):
            _replace(os.path.join(private, each),
                     real if each == name else os.path.realpath(os.path.join(folder, each)))
    except OSError as error:
        is_of_path = error.filename is None or private and str(error.filename).startswith(private)
        if error.errno is not None and is_of_path:
            raise OSError(error.errno, error.strerror, path) from error
        raise
    finally:
        if private:
            shutil.rmtree(private, ignore_errors=True)


def _mode_of(path: str) -> Optional[int]:
    """The type and permissions of a file; None if there is none. Raises OSError for links in a loop."""
    try:
        return os.stat(path).st_mode
    except FileNotFoundError:
        return None


def _replace(made: str, path: str) -> None:
    """Moves a file of this process to the place of another one, with its owner, group and permissions. Nobody gets more
    permissions if the system keeps a group to itself; programs do not stay privileged."""
    if hasattr(os, "chown") and os.path.exists(path):
        old = os.stat(path)
        mode = old.st_mode & 0o777  # without those to run as the owner
        try:
            os.chown(made, -1, old.st_gid)
        except OSError:
            of_both = mode & mode >> 3 & 0o007
            mode = mode & 0o700 | of_both << 3 | of_both
        with contextlib.suppress(OSError):
            os.chown(made, old.st_uid, -1)
        os.chmod(made, mode)
    os.replace(made, path)


def _columns(surface: Isosurface) -> Iterator[tuple[str, np.ndarray]]:
    """Coordinates and the components of all arrays, as NAME:0."""
    yield from zip("xyz", surface.points.T)
    for name, array in surface.arrays.items():
        flat = array.reshape(len(array), math.prod(array.shape[1:])).T
        yield from zip([name] if len(flat) == 1 else [f"{name}:{i}" for i in range(len(flat))], flat)


def _labeled(surface: Isosurface, kind: str, label_of: Callable[[str], str], usual: dict[str, str]
             ) -> dict[str, np.ndarray]:
    """Columns by labels that differ, also from the coordinates for our own reader. Usual labels of some names are kept
    for these."""
    given = list(_columns(surface))
    columns, reserved = dict(given[:3]), [usual[name] for name, _ in given if name in usual]
    for name, array in given[3:]:
        label = plain = usual.get(name, label_of(name))
        while label in columns or without_unit(label) in {*"xyz"} or label in reserved and name not in usual:
            label = re.sub(END_OF_NAME, "_", label, count=1)
        if label != plain:
            warnings.warn(f'"{name}" has the name "{label}" in the {kind} file, since "{plain}" names something else.',
                          RuntimeWarning, stacklevel=5)
        columns[label] = array
    return columns


def write_csv(path: Union[str, int], surface: Isosurface) -> None:
    """Writes points and arrays to a file or to its descriptor."""
    columns = _labeled(surface, "CSV", lambda name: " ".join(name.split()), {})
    with open(path, "w", encoding="utf-8", newline="", closefd=isinstance(path, str)) as file:
        writer = csv.writer(file, lineterminator="\n")
        # A semicolon without quotes would separate columns.
        csv.writer(file, lineterminator="\n", quoting=csv.QUOTE_ALL if ";" in "".join(columns) else csv.QUOTE_MINIMAL
                   ).writerow(columns)
        # str() of a float32 is the shortest text that gives it.
        writer.writerows(zip(*(map(str, array) if array.dtype == np.float32 else array.tolist()
                               for array in columns.values())))


def _write_npz(path: str, surface: Isosurface) -> None:
    # Not by np.savez(), which takes the names of arrays for its own parameters.
    arrays = {**surface.arrays, **surface.cell_arrays, "points": surface.points, "triangles": surface.triangles}
    for name in surface.arrays:
        if arrays[name] is not surface.arrays[name]:
            raise ValueError(f'The name "{name}" is that of something else in NPZ files: rename the array.')
    with zipfile.ZipFile(path, "w") as archive:
        for name in (name for name in arrays if arrays[name] is not None):
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                np.lib.format.write_array(entry, np.ascontiguousarray(arrays[name]), allow_pickle=False)


def _write_ply(path: str, surface: Isosurface) -> None:
    types = {kind: name for name, kind in PLY_TYPES.items()}
    columns = _labeled(surface, "PLY", lambda name: "_".join(name.split()).encode("ascii", "replace").decode(),
                       {f"Normals:{i}": "n" + axis for i, axis in enumerate("xyz")})
    kinds = {name: array.dtype.str[1:] if array.dtype.str[1:] in types else "f8" for name, array in columns.items()}
    vertices = np.empty(len(surface), [(name, "<" + kind) for name, kind in kinds.items()])
    for name, array in columns.items():
        vertices[name] = array
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(surface)}",
             *(f"property {types[kind]} {name}" for name, kind in kinds.items())]
    faces = np.empty(0 if surface.triangles is None else len(surface.triangles), [("n", "u1"), ("corners", "<i4", 3)])
    if surface.triangles is not None:
        faces["n"], faces["corners"] = 3, surface.triangles
        lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    header = "\n".join([*lines, "end_header\n"]).encode("ascii", "replace")
    Path(path).write_bytes(header + vertices.tobytes() + faces.tobytes())


def _write_stl(path: str, surface: Isosurface) -> None:
    corners = surface.points[surface.triangles].astype(np.float64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    facets = np.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["normal"], facets["corners"] = normals / np.where(lengths > 0, lengths, 1), corners
    Path(path).write_bytes(bytes(80) + np.array(len(facets), "<u4").tobytes() + facets.tobytes())


def _write_obj(path: str, surface: Isosurface) -> None:
    with open(path, "wb") as file:
        digits = "%.9g" if surface.points.dtype == np.float32 else "%.17g"
        np.savetxt(file, surface.points, f"v {digits} {digits} {digits}")
        if surface.triangles is not None:
            np.savetxt(file, surface.triangles + 1, "f %d %d %d")


_WRITERS: dict[str, Writer] = {
    ".ply": _write_ply, ".stl": _write_stl, ".obj": _write_obj, ".npz": _write_npz, ".csv": write_csv}


def _by_pyvista(path: str, surface: Isosurface) -> None:
    data = surface.to_pyvista()
    (data.cast_to_unstructured_grid() if path.lower().endswith(".vtu") else data).save(path)


def _by_meshio(path: str, surface: Isosurface) -> None:
    import meshio

    cells = (("vertex", np.arange(len(surface))[:, None]) if surface.triangles is None else
             ("triangle", surface.triangles))
    of_cells = {name: [array] for name, array in surface.cell_arrays.items()}
    meshio.Mesh(surface.points, [cells], surface.arrays, of_cells).write(path)
