# SPDX-License-Identifier: Apache-2.0
"""Makes the wheel and the source archive of the Python package (PEP 517), with meson and ninja.

The package calls the library through ctypes, so one wheel serves every Python: its tag names no Python, but the oldest glibc that has the
symbols of the library. With the source of libxml2 (script/sources) the library needs nothing else. Equal sources give equal archives."""
import base64
import gzip
import hashlib
import io
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OPTIONS = "-Dwheel=true", "-Dpython=enabled", "-Dcompile=disabled", "-Drender=disabled", "-Dbuildtype=release"
LIBXML2_LICENCE = "build-libxml2/Copyright"


def project(key):
    """A text of pyproject.toml, which Python before 3.11 cannot read."""
    return re.search(rf"^{key} = '(.*)'$", (ROOT / "pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE)[1]


def metadata():
    heads = {"Metadata-Version": "2.1", "Name": project("name"), "Version": project("version"), "Summary": project("description"),
             "License": "Apache-2.0", "Requires-Python": project("requires-python"), "Classifier": "Typing :: Typed",
             "Description-Content-Type": "text/markdown"}
    return "".join(f"{name}: {value}\n" for name, value in heads.items()) + "\n" + (ROOT / "README.md").read_text(encoding="utf-8")


def platform(library):
    """The platform of the tag. A library that needs more than the C library is for the machine that has the rest."""
    plain = re.sub(r"[-.]", "_", sysconfig.get_platform())
    text = subprocess.run(["objdump", "-pT", library], check=True, capture_output=True, text=True).stdout
    needed = set(re.findall(r"NEEDED +(\S+)", text)) - {"libc.so.6", "libm.so.6"}
    glibc = max(tuple(map(int, version.split("."))) for version in re.findall(r"GLIBC_([\d.]+)", text))
    return plain if needed else plain.replace("linux", f"manylinux_{glibc[0]}_{glibc[1]}")


def write_wheel(folder, modules):
    """A wheel of the files, with the list of its contents."""
    name = f"{project('name')}-{project('version')}"
    tag = f"py3-none-{platform(modules / 'libmxgen.so')}"
    files = {f"mxgen/{file.name}": file.read_bytes() for file in sorted(modules.iterdir()) if file.is_file()}
    files[f"{name}.dist-info/METADATA"] = metadata().encode()
    files[f"{name}.dist-info/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    if (ROOT / LIBXML2_LICENCE).is_file():
        files[f"{name}.dist-info/LICENSE.libxml2"] = (ROOT / LIBXML2_LICENCE).read_bytes()
    files[f"{name}.dist-info/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: mxgen\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = f"{name}.dist-info/RECORD"
    rows = [f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
            for path, data in files.items()]
    files[record] = "".join([*rows, f"{record},,\n"]).encode()
    with zipfile.ZipFile(pathlib.Path(folder) / f"{name}-{tag}.whl", "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(zipfile.ZipInfo(path), data, zipfile.ZIP_DEFLATED) # without a date: equal files make an equal wheel
    return f"{name}-{tag}.whl"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None): # pylint: disable=unused-argument
    # Below the root, whose path then is in no file: assertions name their sources as the compiler sees them.
    with tempfile.TemporaryDirectory(prefix="build-wheel-", dir=ROOT) as build:
        for command in ["meson", "setup", build, str(ROOT), *OPTIONS], ["ninja", "-C", build]:
            subprocess.run(command, check=True, stdout=sys.stderr)
        modules = pathlib.Path(build) / "python/mxgen"
        subprocess.run(["strip", "--strip-unneeded", modules / "libmxgen.so"], check=True)
        return write_wheel(wheel_directory, modules)


def archived(entry):
    """What a file's date, owner and rights are in an archive."""
    entry.mtime = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    entry.mode = 0o755 if entry.mode & 0o100 else 0o644
    return entry


def build_sdist(sdist_directory, config_settings=None): # pylint: disable=unused-argument
    """The tracked files."""
    name = f"{project('name')}-{project('version')}"
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True, text=True).stdout
    with open(pathlib.Path(sdist_directory) / f"{name}.tar.gz", "wb") as file, gzip.GzipFile("", "wb", fileobj=file, mtime=0) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path in filter(None, listed.split("\0")):
            archive.add(ROOT / path, f"{name}/{path}", recursive=False, filter=archived)
        info, text = tarfile.TarInfo(f"{name}/PKG-INFO"), metadata().encode()
        info.size = len(text)
        archive.addfile(archived(info), io.BytesIO(text))
    return f"{name}.tar.gz"
