"""Packs a folder of a release: `python archive.py FOLDER OUT` writes OUT/NAME.zip for Windows, else OUT/NAME.tar.gz.

The same files give the same archive.
"""

import gzip
import sys
import tarfile
import zipfile
from pathlib import Path


def member(info: tarfile.TarInfo) -> tarfile.TarInfo:
    """Return the entry without owner and time."""
    info.uid = info.gid = info.mtime = 0
    info.uname = info.gname = ""
    info.mode = 0o755 if info.isdir() or info.mode & 0o100 else 0o644
    return info


folder, out = Path(sys.argv[1]), Path(sys.argv[2])
files = sorted(folder.iterdir())
if "-windows-" in folder.name:
    with zipfile.ZipFile(out / f"{folder.name}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            archive.writestr(zipfile.ZipInfo(f"{folder.name}/{file.name}"), file.read_bytes(), zipfile.ZIP_DEFLATED)
else:
    with (
        open(out / f"{folder.name}.tar.gz", "wb") as file,
        gzip.GzipFile("", "wb", mtime=0, fileobj=file) as packed,
        tarfile.open(fileobj=packed, mode="w") as archive,
    ):
        archive.add(folder, folder.name, recursive=False, filter=member)
        for each in files:
            archive.add(each, f"{folder.name}/{each.name}", filter=member)
