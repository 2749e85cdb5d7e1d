# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a wheel for another system: exchange_library.py WHEEL PLATFORM LIBRARY FOLDER

Copies a wheel of the package to a folder, with the library and the licenses beside it, LICENSE.*, in place
of its own ones that have the same names or, like GCC's, belong to its own library. Prints the new path.
"""

import base64
import hashlib
import pathlib
import re
import sys
import zipfile

OWN_LICENSES = ("LICENSE.GCC",)


def record(files, name):
    """The list of all files with their hashes, RECORD's text."""
    lines = []
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{path},sha256={digest},{len(content)}\n")
    return "".join([*lines, f"{name},,\n"]).encode()


def substituted(pattern, text, content):
    """@returns content in which a pattern, which it must have once, is replaced"""
    changed, count = re.subn(pattern, text, content.decode(), flags=re.MULTILINE)
    if count != 1:
        sys.exit(f"exchange_library.py: {pattern} occurs {count} times")
    return changed.encode()


def main(wheel, platform, library, folder):
    wheel, library = pathlib.Path(wheel), pathlib.Path(library)
    with zipfile.ZipFile(wheel) as archive:
        files = {each.filename: archive.read(each) for each in archive.infolist()}
    information = next(path.rpartition("/")[0] for path in files if path.endswith(".dist-info/WHEEL"))
    own = next(path for path in files if re.fullmatch(r"[^/]*/libisopoint[^/]*", path))
    del files[own], files[f"{information}/RECORD"]
    package, _, own_name = own.partition("/")
    files[f"{package}/{library.name}"] = library.read_bytes()
    for name, pattern, text in (
            (f"{package}/_paths.py", re.escape(f"/{own_name}\""), f"/{library.name}\""),
            (f"{information}/WHEEL", r"^Tag: .*$", f"Tag: py3-none-{platform}")):
        files[name] = substituted(pattern, text, files[name])

    licenses = f"{information}/licenses"
    for name in OWN_LICENSES:
        del files[f"{licenses}/{name}"]
    files.update({f"{licenses}/{path.name}": path.read_bytes() for path in library.parent.glob("LICENSE.*")})
    names = sorted(path.rpartition("/")[2] for path in files if path.startswith(licenses + "/"))
    files[f"{information}/METADATA"] = substituted(
        r"(^License-File: .*\n)+", "".join(f"License-File: {name}\n" for name in names),
        files[f"{information}/METADATA"])
    files[f"{information}/RECORD"] = record(files, f"{information}/RECORD")

    made = pathlib.Path(folder) / f"{wheel.name.rpartition('-')[0]}-{platform}.whl"
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))  # the same bytes each time
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    print(made)


if __name__ == "__main__":
    main(*sys.argv[1:])
