# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel in clean environments: TestWheel.py FOLDER [WHEEL]

Builds the wheel with pip unless one is given, makes virtual environments below FOLDER, and tests it there
with each Python that is found. Results have to be those of the compiled filters, which the interpreter
that runs this can import. Ends with 77, which says that the test is skipped, if packages cannot be had.
"""

import os
import pathlib
import re
import runpy
import shutil
import subprocess
import sys
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TESTS = ROOT / "Testing/Python"
SKIPPED = 77
DRAWING = {"PYVISTA_OFF_SCREEN": "true", "PYVISTA_VTK_BACKEND": "vtk"}  # cvista draws nothing
OLDEST_NUMPY = {(3, 9): "1.19.5"}

sys.path.insert(0, str(ROOT / "Utilities"))
import markdown_document  # noqa: E402


def clean_environment(**more):
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    return {**kept, "PIP_DISABLE_PIP_VERSION_CHECK": "1", **more}


def run(command, **options):
    """@returns what a command prints; ends with its output if it fails"""
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, **options)
    if result.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{result.stdout}")
    return result.stdout


class Environment:
    """A virtual environment with the wheel and other packages."""

    def __init__(self, folder, interpreter, *packages):
        shutil.rmtree(folder, ignore_errors=True)
        run([interpreter, "-m", "venv", folder], env=clean_environment())
        self.python = folder / "bin/python"
        self.folder = folder
        if packages:
            self.run("-m", "pip", "install", "--quiet", *packages)

    def run(self, *command, **environment):
        return run([self.python, *command], env=clean_environment(**environment), cwd=self.folder)

    def describe(self):
        return self.run("-c", "import importlib.metadata as m, sys\n"
                        "names = ('numpy', 'vtk', 'cvista', 'pyvista')\n"
                        "found = {d.metadata['Name']: d.version for d in m.distributions()}\n"
                        "print('Python', sys.version.split()[0],"
                        " *(f'{n} {found[n]}' for n in names if n in found))").strip()


def found_pythons():
    """Interpreters by version, those of this project's oldest supported one and later."""
    names = [f"python3.{minor}" for minor in range(9, 15)]
    paths = [shutil.which(name) for name in names]
    versions = pathlib.Path.home() / ".pyenv/versions"
    paths += [str(path) for path in sorted(versions.glob("3.*/bin/python3"))]
    found = {}
    for path in filter(None, paths):
        answer = subprocess.run(
            [path, "-c", "import ensurepip, sys; print(*sys.version_info[:2])"],
            capture_output=True, text=True)
        version = tuple(map(int, answer.stdout.split())) if answer.returncode == 0 else (0, 0)
        if version >= (3, 9):
            found.setdefault(version, path)
    return dict(sorted(found.items()))


def check_reachable(builder):
    answer = subprocess.run([str(builder.python), "-m", "pip", "download", "--no-deps", "--quiet", "wheel"],
                            cwd=builder.folder, env=clean_environment(), capture_output=True, text=True)
    if answer.returncode != 0:
        print("skipped: packages cannot be had from an index\n" + answer.stderr)
        sys.exit(SKIPPED)


def built_wheel(builder, folder):
    builder.run("-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, ROOT)
    return next(folder.glob("scatteredisopoints-*.whl"))


def check_source_archive(builder, folder):
    """It has no file of what users make beside the source, and its description no links to files."""
    tree = folder / "source"
    shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(".git", "build*", "__pycache__", "env"))
    (tree / "env").mkdir()
    (tree / "env/file").write_text("")
    builder.run("-m", "pip", "install", "--quiet", "scikit-build-core", "hatch-fancy-pypi-readme")
    builder.run("-c", "import os, sys, scikit_build_core.build as build; os.chdir(sys.argv[1])\n"
                "build.build_sdist(sys.argv[2])", tree, folder)
    with tarfile.open(next(folder.glob("*.tar.gz"))) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
        information = next(name for name in archive.getnames() if name.endswith("PKG-INFO"))
        description = archive.extractfile(information).read().decode()
    if "env/file" in names or not {"README.md", "Library/isopoint.h", "Utilities/wheel.sh"} <= names:
        sys.exit(f"failed: the source archive has other files: {sorted(names)}")
    if "## In Python" not in description or re.search(r"\]\((?!https:)", description):
        sys.exit(f"failed: the description has links to files, or lacks a section\n{description}")


def check_other_systems(builder, wheel, folder):
    """What Utilities/wheel.sh makes from a wheel for Linux is what pip installs on other systems. The libraries are
    stand-ins: their own checks are those of Utilities/wheel_elsewhere.sh."""
    libraries = {"win_amd64": "isopoint.dll", "macosx_11_0_arm64": "libisopoint.dylib",
                 "macosx_10_15_x86_64": "libisopoint.dylib"}
    (folder / "linux").mkdir()
    linux = pathlib.Path(shutil.copy(wheel, folder / "linux"))
    with zipfile.ZipFile(linux, "a") as archive:
        own = next(name for name in archive.namelist() if name.endswith("/LICENSE"))
        if own + ".GCC" not in archive.namelist():  # it is of Utilities/wheel.sh
            archive.writestr(own + ".GCC", "of the library for Linux")
    for platform, name in libraries.items():
        made = folder / platform
        (made / "library").mkdir(parents=True)
        (made / "library" / name).write_bytes(b"library of " + platform.encode())
        (made / "library/LICENSE.LLVM").write_text("license of libc++")
        other = run([sys.executable, ROOT / "Utilities/exchange_library.py", linux, platform, made / "library" / name,
                     made]).strip()
        tree = made / "tree"
        builder.run("-m", "pip", "install", "--quiet", "--no-deps", "--platform", platform, "--only-binary=:all:",
                    "--python-version", "3.9", "--target", tree, other)
        builder.run("-m", "wheel", "unpack", "--dest", made, other)  # compares all files with RECORD
        package, information = tree / "scatteredisopoints", next(tree.glob("*.dist-info"))
        found = sorted(path.name for path in package.iterdir() if path.suffix in (".so", ".dll", ".dylib"))
        paths = runpy.run_path(str(package / "_paths.py"))
        licenses = {path.name for path in information.glob("licenses/*")}
        listed = set(re.findall("^License-File: (.*)$", (information / "METADATA").read_text(), re.MULTILINE))
        if (found != [name] or paths["LIBRARY"] != str(package / name) or listed != licenses
                or "LICENSE.GCC" in licenses or not {"LICENSE", "LICENSE.LLVM"} <= licenses):
            sys.exit(f"failed: {other} has the libraries {found} and the licenses {licenses}, lists {listed}, and loads"
                     f" {paths['LIBRARY']}")


def check_script(environment):
    """The console script is the command line, and says its own name."""
    script = environment.folder / "bin/scatteredisopoints"
    version = environment.run("-c", "import scatteredisopoints; print(scatteredisopoints.__version__)")
    if run([script, "--version"], env=clean_environment()) != version:
        sys.exit(f"failed: {script} --version does not print {version}")
    text = run([script, "contour", "--help"], env=clean_environment())
    if not text.startswith("usage: scatteredisopoints contour"):
        sys.exit(f"failed: {script} has another name in its help\n{text}")


def check_results(environment, expected):
    found = environment.run(TESTS / "extractions.py")
    different = sum(a != b for a, b in zip(found.splitlines(), expected.splitlines()))
    if found != expected:
        sys.exit(f"failed: {environment.describe()}: {different} of {len(expected.splitlines())}"
                 " extractions differ from those of the compiled filters")


def examples(*languages):
    """The blocks of the documents in some languages: "py" is for PyVista, "python" for VTK and NumPy."""
    return [code for path in (ROOT / "README.md", ROOT / "docs/python.md")
            for language, _, code in markdown_document.Document(str(path)).blocks if language in languages]


def run_examples(environment, language):
    """Each block in an interpreter of its own, as if pasted."""
    for code in examples(language):
        printed = environment.run("-W", "error::RuntimeWarning", "-c", code, **DRAWING)
        if "Warning: vtk" in printed:
            sys.exit(f"failed: an example warns\n{code}\n{printed}")
    return len(examples(language))


def check_types(environment):
    """Type checkers accept the documents' blocks and all names of the package, and find wrong names."""
    names = environment.run(
        "-c", "import scatteredisopoints as s\n"
        "print(*s._MODULES, 'Interpolator', 'Samples', 'load_plugin', 'ray_trace')").split()
    imports = f"from scatteredisopoints import {', '.join(names)}\n"
    wrong = ("from scatteredisopoints import contuor\n",
             "from scatteredisopoints import contour\ncontour([], [], 0.3).colors\n")
    paths = []
    for number, code in enumerate([imports, *examples("python", "py"), *wrong]):
        paths.append(environment.folder / f"example{number}.py")
        paths[-1].write_text(code)
    right = paths[:-len(wrong)]
    for checker in (["-m", "mypy", "--strict"], ["-m", "pyright", "--pythonpath", environment.python]):
        environment.run(*checker, *right)
        for path in paths[len(right):]:
            command = [str(word) for word in (environment.python, *checker, path)]
            found = subprocess.run(command, env=clean_environment(), stdout=subprocess.PIPE, text=True)
            if found.returncode != 1 or not ("contuor" in found.stdout or "colors" in found.stdout):
                sys.exit(f"failed: {checker[1]} accepts {path.read_text()}{found.stdout}")


def check_picture(environment, expected):
    """The picture that README's first block has made is the one below it, but for a renderer's rounding."""
    difference = float(environment.run(
        "-c", "import sys, numpy as np, pyvista as pv\n"
        "a, b = (np.asarray(pv.read(path).active_scalars, float) for path in sys.argv[1:])\n"
        "print(np.abs(a - b).mean() if a.shape == b.shape else np.inf)", environment.folder / expected.name, expected,
        **DRAWING))
    if difference > 1:
        sys.exit(f"failed: {environment.folder / expected.name} differs from {expected} by {difference} of 255: look at"
                 " it, and copy it if it is right")


def check_gallery(environment):
    """Each script draws something. The pictures stay in the environment's folder."""
    scripts = sorted((ROOT / "Examples/gallery").glob("*.py"))
    for script in scripts:
        environment.run("-W", "error::RuntimeWarning", script, **DRAWING)
        share, shades = map(float, environment.run(
            "-c", "import sys, numpy as np, pyvista as pv\n"
            "pixels = np.asarray(pv.read(sys.argv[1]).active_scalars, int)[:, :3]\n"
            "print((abs(pixels - pixels[0]).max(axis=1) > 8).mean(), len(np.unique(pixels, axis=0)))",
            environment.folder / f"{script.stem}.png", **DRAWING).split()[-2:])
        if not (0.05 < share < 0.95 and shades > 100):
            sys.exit(f"failed: {script.stem}.png shows something at {share:.3f} of it, in {shades:.0f} shades")
    print(f"{len(scripts)} scripts of the gallery drew their pictures")


def main(folder, wheel=None):
    folder = pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    pythons = found_pythons()
    builder = Environment(folder / "builder", sys.executable)
    check_reachable(builder)
    wheel = pathlib.Path(wheel).resolve() if wheel else built_wheel(builder, folder)
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.2f} MB")
    check_source_archive(builder, folder)
    builder.run("-m", "pip", "install", "--quiet", "wheel")
    check_other_systems(builder, wheel, folder)
    expected = run([sys.executable, TESTS / "extractions.py", "--filters"])

    for version, path in pythons.items():
        numpy = f"numpy=={OLDEST_NUMPY[version]}" if version in OLDEST_NUMPY else "numpy"
        environment = Environment(folder / "numpy{}.{}".format(*version), path, wheel, numpy)
        check_results(environment, expected)
        if version in (min(pythons), max(pythons)):
            environment.run(TESTS / "TestPackage.py")
            environment.run(TESTS / "TestProbe.py")
            environment.run(TESTS / "TestCommandLine.py")
            check_script(environment)
        print(environment.describe() + ": the same bytes")

    newest = max(version for version in pythons if version >= (3, 10))
    environment = Environment(folder / "vtk", pythons[newest], wheel, "vtk")
    environment.run(TESTS / "TestPackage.py", "Results", "KeptTrees", "Imports")
    environment.run(TESTS / "TestFilters.py")
    environment.run(TESTS / "TestPlaceFilters.py")
    check_results(environment, expected)
    examples = run_examples(environment, "python")
    print(f"{environment.describe()}: passed, {examples} examples of the documents")
    environment = Environment(folder / "pyvista", pythons[newest], f"{wheel}[pyvista,meshio]", "cvista",
                              "tqdm")
    for backend in ("vtk", "cvista"):
        environment.run(TESTS / "TestPyVista.py", PYVISTA_VTK_BACKEND=backend)
        print(f"{environment.describe()}: PyVista on {backend} passed")
    environment.run(TESTS / "TestCommandLine.py", PYVISTA_VTK_BACKEND="vtk")  # cvista writes no files
    environment.run(ROOT / "Examples/pyvista_cloud.py", **DRAWING)
    print(f"{run_examples(environment, 'py')} examples of the documents ran")
    check_picture(environment, ROOT / "docs/surface.png")
    environment.run("-m", "pip", "install", "--quiet", "plotly<6", "kaleido==0.2.1", "mitsuba")
    environment.run(TESTS / "TestRayTracing.py", **DRAWING)
    print("Ray tracing by Mitsuba passed")
    check_gallery(environment)
    environment.run("-m", "pip", "install", "--quiet", "mypy", "pyright[nodejs]")
    check_types(environment)
    print(f"{environment.describe()}: mypy and pyright passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
