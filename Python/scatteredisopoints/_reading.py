# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of samples, for the command line: see read_samples()."""

from __future__ import annotations

import contextlib
import csv
import importlib.util
import io
import logging
import math
import re
import sys
import warnings
import zipfile
from itertools import chain, islice, takewhile
from pathlib import Path
from typing import Any, Iterable, Iterator, Optional, Sequence, TextIO

import numpy as np

from . import _datasets
from ._arrays import CELL, POINT, as_numpy
from ._polydata import PolyDataMaker

_TEXT = (".asc", ".csv", ".dat", ".tsv", ".txt", ".xyz")
_MISSING = ("", "n/a", "na", "none", "null")  # entries of text without a number, beside "nan"
_POSITIONS = (("x", "y", "z"), ("points",), ("positions",), *(tuple(f"points{separator}{axis}" for axis in range(3))
                                                               for separator in ":_"))  # names in lower case
PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
             "double": "f8"}  # others, such as int8, are NumPy's names
END_OF_NAME = r"(?= *[([]|$)"  # perhaps before a unit in brackets
# Numbers whose comma or point may separate thousands.
_MAYBE_THOUSANDS = re.compile(r"\s*[-+]?[1-9]\d{0,2}[.,]\d{3}\s*")


def to_number(text: str) -> float:
    """Raises ValueError unless a text is a number, also for the underscores of Python's numbers."""
    if "_" in text:
        raise ValueError
    return float(text)


def without_unit(name: str) -> str:
    """The name of a coordinate in lower case."""
    return re.split(END_OF_NAME, name.lower(), maxsplit=1)[0]


def read_samples(path: str, names: Sequence[str] = (), columns: Optional[Sequence[str]] = None, *,
                 are_places: bool = False) -> _datasets.DataSamples:
    """The samples of a file, without values, with all arrays, and with those of the given names.

    path: of a table (text, NPY, NPZ), a PLY file, or a file that PyVista or meshio reads; "-": a table from stdin.
    names: of arrays, or of parts of these: NAME:0, NAME:x or NAME:magnitude.
    columns: the arrays of a table with the coordinates, or the one with positions; None: usual names.
    are_places: columns are those of another file, which this one need not have.

    Raises OSError if the file cannot be read, ImportError without a package for it, ValueError for wrong contents.
    """
    try:
        data = _read(path)
    except Exception as error:
        if isinstance(error, (ImportError, MemoryError)) or getattr(error, "filename", None):
            raise
        raise ValueError(f"{path} cannot be read: {error}") from error
    unusable: dict[str, Any] = {}
    if isinstance(data, dict):
        positions = _positions(path, data, columns, are_places)
        unusable = {name: array for name, array in data.items() if isinstance(array, Exception)}
        data = {name: array for name, array in data.items() if np.shape(array)[:1] == positions.shape[:1]}
        known = set(data)
    else:
        known = {name for leaf in _datasets.leaves(data) for kind in (POINT, CELL) if leaf.IsA("vtkDataSet")
                 for name, _, _ in _datasets.named_arrays(leaf.GetAttributes(kind))}
    wholes = [name if name in known else name.rpartition(":")[0] for name in names]
    for name in (name for name, whole in zip(names, wholes) if whole not in known):
        there = ", ".join(sorted(known)) or "none"
        raise ValueError(f"{path}: {unusable[name]}" if name in unusable else
                         f'{path} has no array of numbers named "{name}": there are {there}')
    if isinstance(data, dict):
        samples = _datasets.DataSamples(positions, None, None, data, PolyDataMaker())
    else:
        samples = (_datasets.samples_with_arrays(data, wholes, (POINT, CELL)) if names else
                   _datasets.samples_without_values(data, with_arrays=True))
    for name, whole in zip(names, wholes):
        if name != whole:
            samples.arrays[name] = _part(whole, as_numpy(samples.arrays[whole]), name[len(whole) + 1:].lower())
    return samples


def _part(name: str, array: np.ndarray, part: str) -> np.ndarray:
    """A component of an array, or its magnitude."""
    array = array.reshape(len(array), -1)
    if part == "magnitude":
        return np.linalg.norm(array, axis=1)
    parts = {name: i for names in ("xyz", map(str, range(array.shape[1]))) for i, name in enumerate(names)}
    if parts.get(part, array.shape[1]) >= array.shape[1]:
        raise ValueError(f'"{name}" has no component "{part}": there are 0 to {array.shape[1] - 1}, and magnitude')
    return array[:, parts[part]]


def _positions(path: str, table: dict[str, Any], columns: Optional[Sequence[str]], are_places: bool) -> np.ndarray:
    """Takes the positions out of a table."""
    if are_places and columns and not {*columns} <= {*table}:
        columns = None
    remedy = (("name the coordinates x, y, z, or as in FILE" if are_places else "give the coordinates by --columns")
              + f"; there are {', '.join(table)}")
    names = list(map(without_unit, table))
    usual = next((each for each in _POSITIONS if {*names} >= {*each}), _POSITIONS[0])
    for name in (name for name in usual if names.count(name) > 1 and not columns):
        raise ValueError(f'{path} has several columns for "{name}": {remedy}')
    wanted = columns or [dict(zip(names, table)).get(name, name) for name in usual]
    for name in (name for name in wanted if name not in table):
        raise ValueError(f'{path} has no "{name}": {"" if are_places else "add it, or "}{remedy}')
    if len({*wanted}) < len(wanted):
        raise ValueError(f"the columns {', '.join(wanted)} are not different: {remedy}")
    arrays = [table.pop(name) for name in wanted]
    for error in (array for array in arrays if isinstance(array, Exception)):
        raise ValueError(f"{path}: {error}")
    shapes = [np.shape(array) for array in arrays]
    if len(arrays) == 3 and len({*shapes}) == 1 and len(shapes[0]) == 1:
        return np.column_stack(arrays)
    if len(arrays) != 1 or shapes[0][1:] != (3,):
        found = ", ".join(f'"{name}" of the shape {shape}' for name, shape in zip(wanted, shapes))
        raise ValueError(f"{path} has {found}, not three columns of coordinates: {remedy}")
    return arrays[0]


def _read(path: str) -> Any:
    """A table of arrays by name, with a ValueError in place of one without numbers; or a data set."""
    suffix = Path(path).suffix.lower()
    if path == "-" or suffix in _TEXT:
        file = sys.stdin.fileno() if path == "-" else path
        with open(file, encoding="utf-8-sig", errors="replace", newline="", closefd=path != "-") as text:
            return _read_text(text)
    if suffix == ".npy":
        with open(path, "rb") as binary:
            array = np.lib.format.read_array(binary)
        if array.dtype.names:
            return {name: _numbers(array, name) for name in array.dtype.names}
        if array.ndim != 2 or array.shape[1] < 3:
            raise ValueError(f"its shape is {array.shape}, not (n, 4): x, y, z and value")
        return dict(zip(_default_names(array.shape[1]), array.T))
    if suffix == ".npz":
        with zipfile.ZipFile(path), np.load(path) as archive:
            return {name: _numbers(archive, name) for name in archive.files}
    if suffix == ".ply":
        return _read_ply(path)
    open(path, "rb").close()
    if importlib.util.find_spec("pyvista"):
        import pyvista

        logging.disable()  # of VTK's messages by PyVista
        with pyvista.vtk_verbosity("off"):
            data = pyvista.read(path)
        if all(leaf.GetNumberOfElements(POINT) == 0 for leaf in _datasets.leaves(data)):
            raise ValueError("VTK finds no points: it is empty, damaged, or not what its name says")
        return data
    if importlib.util.find_spec("meshio"):
        import meshio

        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            try:
                mesh = meshio.read(path)
            except SystemExit:  # which it raises for damaged files
                raise ValueError(said.getvalue()) from None
        return {**mesh.point_data, "points": mesh.points}
    raise ImportError(f"{path} needs PyVista or meshio: pip install pyvista; without them there are"
                      f" {', '.join((*_TEXT, '.npy', '.npz', '.ply'))}")


def _numbers(table: Any, name: str) -> Any:
    """An array by name, or a ValueError in place of one without numbers."""
    with contextlib.suppress(ValueError):  # of Python's objects
        array = table[name]
        if isinstance(array, np.ndarray) and array.dtype.kind in "biuf" and 0 not in array.shape[1:]:
            return array
    return ValueError(f'"{name}" holds no numbers')


def _default_names(count: int) -> list[str]:
    """Of columns without names."""
    return ["x", "y", "z", *(["value"] if count == 4 else map(str, range(4, count + 1)))][:count]


def _read_text(file: TextIO) -> dict[str, Any]:
    """Columns between commas, semicolons, tabs or blanks, below a line of names, if there is one, perhaps in a
    comment. Those with an empty name, such as the index of pandas, are left out. Where commas do not separate, they may
    be decimal."""
    head: list[str] = []  # up to the first line that is no comment
    while not head or not head[-1].strip() or head[-1].startswith("#"):
        head.append(file.readline())
        if not head[-1]:
            raise ValueError("it is empty")
        if "\0" in head[-1]:
            raise ValueError("it is in UTF-16, or no text: save it as text in UTF-8")
    line = re.sub('"[^"]*"', "", head[-1])
    are_decimal = re.fullmatch(r"\s*([-+]?\d*,?\d+(e[-+]?\d+)?\s+){2,}", line.lower() + " ")
    delimiter = " " if are_decimal else next((each for each in "\t;," if each in line), " ")

    def rows_of(lines: Any) -> Any:
        tidy = ("" if line.startswith("#") else " ".join(line.split()) if delimiter == " " else line for line in lines)
        reader, begin = csv.reader(tidy, delimiter=delimiter, skipinitialspace=True), 1
        try:
            for row in reader:
                if row and row[-1].endswith("\n"):  # of the last line
                    raise csv.Error
                if "".join(row).strip():
                    yield reader.line_num, row
                begin = reader.line_num + 1
        except csv.Error:  # of an entry that is too long
            raise ValueError(f"a quote in line {begin} is not closed") from None

    def number(text: str) -> Optional[float]:
        try:
            return to_number(text if delimiter == "," else text.replace(",", "."))
        except ValueError:
            return math.nan if text.strip().lower() in _MISSING else None

    rows = rows_of(chain(head, file))
    first = next(rows, (0, []))
    if not first[1]:
        raise ValueError("it is empty")
    names = [name.strip() for name in first[1]]
    are_pandas = names == ["", *map(str, range(len(names) - 1))]  # which names columns so if the user does not
    if None not in map(number, names) and not are_pandas:
        rows = chain([first], rows)
        comment = next((row for _, row in rows_of([line.lstrip("# ") for line in head[-2:-1]])), [])
        names = [name.strip() for name in comment] if len(comment) == len(names) else _default_names(len(names))
    twice = next((name for i, name in enumerate(names) if name and name in names[:i]), None)
    if twice is not None:
        raise ValueError(f'two columns have the name "{twice}"')
    columns: dict[str, Any] = {name: [np.zeros(0)] for name in names if name}
    clear: dict[tuple[str, str], str] = {}  # a number by its comma or point, which is decimal, and its column
    unclear: dict[tuple[str, str], str] = {}  # the same for what may separate thousands
    while chunk := list(islice(rows, 50_000)):
        for line, row in chunk:
            if len(row) != len(names):
                raise ValueError(f"line {line} has {len(row)} entries instead of {len(names)}")
        for name, *texts in zip(names, *(row for _, row in chunk)):
            if not isinstance(columns.get(name), list):
                continue
            parsed = list(map(number, texts))
            if None in parsed:
                i = parsed.index(None)
                columns[name] = ValueError(f'"{texts[i]}" in line {chunk[i][0]}, column "{name}", is no number')
                continue
            columns[name].append(np.array(parsed))
            for mark in ",." if delimiter != "," else "":
                for text in (text for text in texts if mark in text and (mark, name) not in clear):
                    (unclear if _MAYBE_THOUSANDS.fullmatch(text) else clear).setdefault((mark, name), text)
    _check_thousands(columns, clear, unclear)
    return {name: np.concatenate(parts) if isinstance(parts, list) else parts for name, parts in columns.items()}


def _check_thousands(columns: dict[str, Any], clear: dict[tuple[str, str], str], unclear: dict[tuple[str, str], str]
                     ) -> None:
    """Puts a ValueError in place of columns whose commas, or points, separate thousands; warns of those that may."""
    decimal = {mark: text for (mark, name), text in clear.items() if isinstance(columns[name], list)}
    doubtful = []
    for (mark, name), text in unclear.items():
        other = "." if mark == "," else ","
        if (mark, name) in clear or not isinstance(columns[name], list):
            continue
        if other in decimal:
            columns[name] = ValueError(f'"{text}", column "{name}", and "{decimal[other]}" cannot both be decimal:'
                                       " remove separators of thousands")
        elif mark == "," and not decimal:
            doubtful.append(f'"{text}", column "{name}"')
    if doubtful:
        warnings.warn(f"The comma in {doubtful[0]}, is read as a decimal point. If commas separate thousands, remove"
                      " them.", RuntimeWarning, stacklevel=2)


def _read_ply(path: str) -> dict[str, np.ndarray]:
    """The properties of the vertices."""
    header: list[list[str]] = []
    with open(path, "rb") as file:
        while header[-1:] != [["end_header"]] and len(header) < 1000:
            header.append(file.readline().decode("ascii", "replace").split() or [""])
        header = [words for words in header if words[0] not in ("comment", "obj_info")]
        try:
            order = {"ascii": "=", "binary_little_endian": "<", "binary_big_endian": ">"}[header[1][1]]
            begin = next(i for i, words in enumerate(header) if words[0] == "element")
            properties = list(takewhile(lambda words: words[0] == "property", header[begin + 1:]))
            kind = np.dtype([(name, np.dtype(PLY_TYPES.get(each, each)).newbyteorder(order))
                             for _, each, name in properties])
            count = int(header[begin][2])
            is_of_numbers = kind.itemsize > 0 and all(kind[name].kind in "iuf" for name in kind.names)
            if header[0] != ["ply"] or header[begin][1] != "vertex" or not header[begin][2].isdecimal() or (
                    not is_of_numbers):
                raise ValueError
        except (LookupError, StopIteration, TypeError, ValueError):
            raise ValueError("its header is not that of a PLY file that begins with vertices of numbers") from None
        if order == "=":
            table = np.loadtxt(_lines_of_numbers(islice(file, min(count, sys.maxsize))), kind, ndmin=1)
        else:
            data = bytearray()  # in parts: a damaged header may claim more than there is memory for
            while part := file.read(min(count * kind.itemsize - len(data), 1 << 24)):
                data += part
            table = np.frombuffer(data, kind, len(data) // kind.itemsize)
    if len(table) != count:
        raise ValueError(f"it ends after {len(table)} of {count} vertices")
    return {name: table[name] for name in kind.names}


def _lines_of_numbers(lines: Iterable[bytes]) -> Iterator[bytes]:
    """Lines without underscores, which older versions of NumPy ignore within numbers."""
    for line in lines:
        if b"_" in line:
            raise ValueError(f"{line.decode('ascii', 'replace').strip()} are no numbers")
        yield line
