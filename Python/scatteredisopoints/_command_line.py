# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of scatteredisopoints and python -m scatteredisopoints: see main()."""

from __future__ import annotations

import argparse
import ast
import functools
import math
import os
import re
import sys
import warnings
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np

from . import __version__
from ._arrays import as_numpy
from ._datasets import DataSamples
from ._isosurface import Isosurface
from ._lines_and_grids import check_size, lattice, line_between
from ._option_types import OPTION_TYPES, BodyOptions, ContourOptions, SliceOptions
from ._options import CONSTANTS, INTERPOLATIONS, check_names
from ._paths import PYTHON_PLUGIN
from ._polydata import PolyDataMaker
from ._progress import Progress, part
from ._reading import read_samples, to_number
from ._samples import Samples
from ._writing import file_to_write, write_csv, writer_for

PROGRAM = "scatteredisopoints" if Path(sys.argv[0]).stem == "scatteredisopoints" else "python -m scatteredisopoints"
MARK = "\0"  # begins an argument that is no option: the system passes none with this character
OPTIONS = {"contour": ContourOptions.__annotations__, "body": BodyOptions.__annotations__,
           "slice": SliceOptions.__annotations__}
FILES = """
FILE: CSV and other text (x, y, z and more columns between commas, semicolons, tabs or blanks; - is stdin), NPY (shape
(n, 4): x, y, z, value), NPZ, PLY, or what PyVista or meshio reads. OUT: .ply, .stl, .obj, .npz, .csv; with PyVista
.vtp, .vtk, .vtu; with meshio its formats. ARRAY: a name, or a part such as velocity:x, velocity:0, velocity:magnitude.
The exit status is 2 for wrong usage, and 1 for all other errors.
"""
PARAVIEW = f"""The filters for ParaView are in

    {PYTHON_PLUGIN}

Ways to load them:

- In the window: Tools > Manage Plugins > Load New, and choose this file. Tick Auto Load.
- For all programs of ParaView: the environment variable PV_PLUGIN_PATH={PYTHON_PLUGIN.parent}
- In a script: from scatteredisopoints import load_plugin; load_plugin(globals())

A ParaView with a Python of its own, whose NumPy serves, finds the package in a folder of its own:

    pip install --no-deps --target FOLDER scatteredisopoints-*.whl

The file is then FOLDER/scatteredisopoints/paraview/{PYTHON_PLUGIN.name}; PYTHONPATH=FOLDER is for scripts.
"""


def loaded(samples: DataSamples, given: argparse.Namespace, report: Progress) -> Samples:
    return Samples._from_data(samples, given.threads, progress=part(report, 0.0, 0.3))


def options_of(given: argparse.Namespace) -> dict[str, Any]:
    """Options by name, without other parameters. Raises TypeError for an unknown one, ValueError for one twice."""
    options = dict(given.option)
    check_names(options, OPTIONS[given.command])
    if len(options) < len(given.option):
        raise ValueError(f"an option is given twice: {', '.join(name for name, _ in given.option)}")
    return options


def contoured(given: argparse.Namespace, report: Progress) -> Isosurface:
    samples = read_samples(given.file, [given.array], given.columns)
    samples.values = as_numpy(samples.arrays.pop(given.array))
    if samples.values[:1].size > 1:
        raise ValueError(f'"{given.array}" has {samples.values[0].size} components: choose one, such as'
                         f" {given.array}:x, or {given.array}:magnitude")
    samples.name = samples.maker.scalars = given.array
    samples.are_float = samples.values.dtype == np.float32
    return loaded(samples, given, report).contour(
        given.isovalues, triangles=not given.points, progress=part(report, 0.3, 1.0), **options_of(given))


def body(given: argparse.Namespace, report: Progress) -> Isosurface:
    samples = loaded(read_samples(given.file, given.arrays, given.columns), given, report)
    return samples.body(arrays=given.arrays or None, progress=part(report, 0.3, 1.0), **options_of(given))


def sliced(given: argparse.Namespace, report: Progress) -> Isosurface:
    samples = loaded(read_samples(given.file, given.arrays, given.columns), given, report)
    return samples.slice(given.normal, given.origin, arrays=given.arrays or None, offsets=given.offsets,
                         interpolation=given.interpolation, progress=part(report, 0.3, 1.0), **options_of(given))


def probed(given: argparse.Namespace, report: Progress) -> Isosurface:
    samples = read_samples(given.file, given.arrays, given.columns)
    names = given.arrays or list(samples.arrays)
    if not names:
        raise ValueError(f"{given.file} has no arrays of numbers to interpolate")
    places, found = requested_places(given, as_numpy(samples.positions))
    values = loaded(samples, given, report).probe(
        places, arrays=names, gradient=given.gradient, method=given.method, outside=given.outside,
        progress=part(report, 0.3, 1.0))
    values, gradients = values if given.gradient else (values, {})
    found.update(values, **{f"{name}_gradient": array for name, array in gradients.items()})
    return Isosurface(places, arrays=found, make_polydata=PolyDataMaker(normals=None))


def requested_places(given: argparse.Namespace, positions: np.ndarray) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Where to probe, and arrays there."""
    if given.places:
        return as_numpy(read_samples(given.places, columns=given.columns, are_places=True).positions), {}
    if given.line:
        begin, end = np.array(given.line)
        places, distances = line_between(begin, end, given.resolution)
        return places, {"Distance": distances}
    if given.grid:
        check_size(f"--grid {','.join(map(str, given.grid))}", given.grid, "fewer")
        finite = positions[np.isfinite(positions).all(axis=1)]
        if len(finite) == 0:
            raise ValueError("No sample has a finite position, so there are no bounds for a grid.")
        return lattice(list(map(np.linspace, finite.min(axis=0), finite.max(axis=0), given.grid))), {}
    return np.array(given.at), {}


def plain(text: str) -> str:
    """An argument as the user gave it."""
    return text.lstrip(MARK)


def lower(text: str) -> str:
    return plain(text).lower()


def argument(convert: Callable[[str], Any], remedy: str) -> Callable[[str], Any]:
    """The type of an argument that a function converts; the remedy is for where it raises ValueError."""
    def parse(text: str) -> Any:
        text = lower(text).strip()
        try:
            return convert(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text}: give {remedy}") from None

    return parse


def to_positive(text: str) -> int:
    if "_" in text or int(text) < 1:
        raise ValueError
    return int(text)


def to_three(text: str, kind: Any = to_number) -> list:
    x, y, z = map(kind, text.split(","))
    return [x, y, z]


NUMBER = argument(to_number, "a number")
NUMBERS = argument(lambda text: [to_number(each) for each in text.split(",")], "numbers between commas")
PLACE = argument(to_three, "three numbers between commas, such as 0,0,0.5")
COUNT = argument(to_positive, "a whole number, 1 or more")
COUNTS = argument(lambda text: to_three(text, to_positive), "three whole numbers between commas, 1 or more")
DIRECTION = argument(lambda text: text if text in ("x", "y", "z", "-x", "-y", "-z") else to_three(text),
                     "x, y, z, -x, -y, -z, or three numbers such as 1,1,0")
OUTSIDE = argument(lambda text: {"fit": None, "nearest": text}[text] if text in ("fit", "nearest") else to_number(text),
                   "a number, nearest or fit")


def option(text: str) -> tuple[str, Any]:
    """The type of NAME=VALUE."""
    name, _, value = plain(text).partition("=")
    try:
        return name, {"true": True, "false": False, "none": None}[value.lower()]
    except KeyError:
        pass
    try:
        found = ast.literal_eval(value)
    except (SyntaxError, ValueError):
        return name, value
    return name, value if "_" in value and isinstance(found, (float, int)) else found


def choices_of(name: str) -> str:
    """What an option can be."""
    kinds = {bool: "true|false", int: "COUNT", float: "NUMBER"}
    others = {"gradient_direction": ["descent", "ascent"], **CONSTANTS}
    return "|".join(others[name]) if name in others else kinds[OPTION_TYPES[name]]


def add_command(commands: Any, name: str, function: Any, summary: str, out: str, *examples: str
                ) -> argparse.ArgumentParser:
    """Adds a command with the arguments that all have."""
    text = "".join(f"  {PROGRAM} {name} {each}\n" for each in examples)
    if name in OPTIONS:
        described = "slice_samples" if name == "slice" else name
        text += f"\nproperties of --option, which python -m pydoc scatteredisopoints.{described} describes:\n"
        text += "".join(f"  {each}={choices_of(each)}\n" for each in sorted(OPTIONS[name]))
    added = commands.add_parser(
        name, description=summary, help=summary, epilog=f"examples:\n{text}{FILES}", allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    added.set_defaults(command=name, function=function, error=added.error)
    added.add_argument("file", metavar="FILE", type=plain, help="the samples")
    added.add_argument("-o", dest="out", metavar="OUT", type=plain, help=f"default: {out}")
    added.add_argument("--columns", metavar="X,Y,Z", type=lambda text: plain(text).split(","),
                       help="the columns of tables that are coordinates, in one unit of length")
    added.add_argument("--threads", metavar="N", type=COUNT, help="default: all cores")
    if name != "contour":
        added.set_defaults(points=name == "probe")
        added.add_argument("arrays", metavar="ARRAY", nargs="*", type=plain, help="default: all")
    if name in OPTIONS:
        added.add_argument("--option", metavar="NAME=VALUE", action="append", type=option, default=[],
                           help="a property, such as drop_gaps=false; see below")
    return added


class Parser(argparse.ArgumentParser):
    """Its messages show arguments as the user gave them."""

    def error(self, message: str) -> Any:
        super().error(message.replace(MARK, ""))


def make_parsers() -> tuple[argparse.ArgumentParser, dict[str, argparse.ArgumentParser]]:
    """The parser of all arguments, and those of the commands."""
    parser = Parser(PROGRAM, description="Isosurfaces straight from scattered samples.",
                    epilog=f"{PROGRAM} COMMAND --help describes a command.")
    parser.add_argument("--version", action="version", version=__version__)
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    command = functools.partial(add_command, commands)
    beside = "FILE's name with _{}.ply, in this folder"
    added = command("contour", contoured, "Isosurfaces, as triangles or points.", beside.format("contour"),
                    "samples.csv temperature 300 350", "flow.vtu velocity:magnitude 0.5 -o surface.stl",
                    "samples.npy value -1e-3 --points --option projection=crease_fit")
    added.add_argument("array", metavar="ARRAY", type=plain)
    added.add_argument("isovalues", metavar="ISOVALUE", nargs="+", type=NUMBER)
    added.add_argument("--points", action="store_true", help="points with normals and radii instead of triangles")
    added.add_argument("--capping", dest="option", action="append_const", const=("capping", True),
                       help="close the body of the samples at or above ISOVALUE")
    command("body", body, "The closed surface of all samples.", beside.format("body"), "particles.ply -o body.stl",
            "particles.csv density --option minimum_piece_size=0.01")
    added = command("slice", sliced, "Slices by planes.", beside.format("slice"), "samples.csv --normal z",
                    "flow.vtu velocity pressure --normal 1,1,0 --origin 0,0,0.5 --offsets -0.1,0,0.1 -o slices.stl")
    added.add_argument("--normal", type=DIRECTION, default="x", help="x, y, z, -x, -y, -z, or numbers such as 1,1,0")
    added.add_argument("--origin", type=PLACE, metavar="X,Y,Z", help="default: the center of the bounds")
    added.add_argument("--offsets", type=NUMBERS, default=[0.0], metavar="D,...", help="distances along the normal")
    added.add_argument("--interpolation", type=lower, choices=tuple(INTERPOLATIONS), default="fits")
    added = command("probe", probed, "Values at places.", "CSV to stdout", "samples.csv temperature --at 0,0,0.5",
                    "flow.vtu velocity --line 0,0,0 1,0,0 --resolution 100 -o line.csv",
                    "samples.npz --grid 50,50,50 --gradient -o grid.npz")
    places = added.add_mutually_exclusive_group(required=True)
    places.add_argument("--at", action="append", type=PLACE, metavar="X,Y,Z", help="a place; may be repeated")
    places.add_argument("--places", metavar="FILE", type=plain,
                        help="a file of places, in --columns or usual ones")
    places.add_argument("--line", nargs=2, type=PLACE, metavar="X,Y,Z")
    places.add_argument("--grid", type=COUNTS, metavar="NX,NY,NZ",
                        help="so many points along the axes of the bounds")
    added.add_argument("--resolution", type=COUNT, metavar="N", default=1000, help="pieces of the line")
    added.add_argument("--gradient", action="store_true", help="gradients, too")
    added.add_argument("--method", type=lower, choices=tuple(CONSTANTS["method"]), default="blend")
    added.add_argument("--outside", type=OUTSIDE, metavar="VALUE", default=math.nan,
                       help="for places outside: a number, nearest or fit; default: nan")
    commands.add_parser("paraview", help="Ways to load the filters into ParaView.")
    return parser, commands.choices


def show(share: float) -> None:
    """Shows the share done, in a line that the next one overwrites."""
    print(f"\r{100 * share:3.0f} %", end="\r", file=sys.stderr, flush=True)


def run(given: argparse.Namespace) -> None:
    """Runs a command on a file and writes the result."""
    stem = "stdin" if given.file == "-" else Path(given.file).stem
    out = given.out or (None if given.command == "probe" else f"{stem}_{given.command}.ply")
    if out is not None:
        try:
            write = writer_for(out, not given.points)
        except ValueError as error:
            given.error(str(error))
        if not Path(out).absolute().parent.is_dir():
            raise ValueError(f"there is no folder for {out}: make it first")
        if os.path.exists(out) and os.path.exists(given.file) and os.path.samefile(out, given.file):
            given.error(f"{out} would replace the samples: choose another OUT")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RuntimeWarning)
        try:
            surface = given.function(given, show if sys.stderr.isatty() else None)
        finally:
            if sys.stderr.isatty():
                print("\r     ", end="\r", file=sys.stderr)
        if out is None and len(surface):
            write_csv(sys.stdout.fileno(), surface)
        elif len(surface):
            with file_to_write(out) as target:
                write(target, surface)
    messages = [str(each.message) for each in caught if issubclass(each.category, RuntimeWarning)]
    if len(surface) == 0:
        raise ValueError(" ".join(messages) or "there is no surface")
    for message in messages:
        print(f"{PROGRAM} {given.command}: warning: {message}", file=sys.stderr)
    if out is None:
        return
    triangles = "" if surface.triangles is None else f", {len(surface.triangles)} triangles"
    volume = f", volume {surface.volume:.6g}" if given.command == "body" else ""
    print(f"{out}: {len(surface)} points{triangles}{volume}", flush=True)


def main(arguments: Optional[list[str]] = None) -> int:
    """Runs a command, by default that of the process; returns its exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    parser, commands = make_parsers()
    if not arguments or arguments[0] not in commands or arguments[0] == "paraview":
        parser.parse_args(arguments)  # exits, except for paraview
        print(PARAVIEW, end="")
        return 0
    # Negative numbers and normals are no options, and nothing is after "--".
    end = arguments.index("--") if "--" in arguments else len(arguments)
    no_option = re.compile(r"-([\d.]|(inf|infinity|nan|[xyz])(,|$))", re.IGNORECASE)
    marked = [MARK * bool(no_option.match(each)) + each for each in arguments[1:end]]
    given = commands[arguments[0]].parse_intermixed_args(marked + [MARK + each for each in arguments[end + 1:]])
    try:
        run(given)
        return 0
    except BrokenPipeError:  # the reader has ended; so that Python says nothing when it flushes
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except KeyboardInterrupt:
        text = "interrupted"
    except (ImportError, TypeError, ValueError) as error:
        text = str(error)
    except OSError as error:
        text = f"{error.filename}: {error.strerror}" if error.filename else str(error)
    except MemoryError:
        text = "Out of memory. Free memory, or reduce the number of samples or of places."
    except Exception as error:
        text = repr(error)
    print(f"{PROGRAM} {given.command}: error: {' '.join(text.split())}", file=sys.stderr)
    return 1
