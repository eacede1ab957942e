#!/usr/bin/env python3
"""same_files.py ONE OTHER: whether two folders hold the same files, byte for byte. Names each that differs, and of a Debian package, an
archive, a wheel or an FMU what within it does; exit status 1."""
import hashlib
import io
import pathlib
import sys
import tarfile
import zipfile


def parts_of(name, content):
    """What a container holds, by name; nothing of other files."""
    if name.endswith(".deb"):
        at = 8
        while at < len(content):
            header = content[at:at + 60]
            size = int(header[48:58])
            yield header[:16].decode().strip(), header[16:48] + content[at + 60:at + 60 + size]
            inner = header[:16].decode().strip(" /")
            if ".tar" in inner:
                yield from ((f"{inner}/{each}", data) for each, data in parts_of(inner, content[at + 60:at + 60 + size]))
            at += 60 + size + size % 2
    elif name.endswith((".whl", ".fmu", ".zip", ".ssp")):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            for each in archive.infolist():
                yield each.filename, repr((each.date_time, each.external_attr, each.compress_type)).encode() + archive.read(each)
    elif ".tar" in name:
        with tarfile.open(fileobj=io.BytesIO(content)) as archive:
            for each in archive:
                data = archive.extractfile(each).read() if each.isfile() else b""
                yield each.name, repr((each.mtime, each.mode, each.uid, each.gid, each.linkname)).encode() + data


def differences(name, one, other):
    first, second = dict(parts_of(name, one)), dict(parts_of(name, other))
    for each in sorted(first.keys() | second.keys()):
        if first.get(each) != second.get(each):
            a, b = first.get(each, b""), second.get(each, b"")
            at = next((k for k, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
            yield f"  {each}: {len(a)} and {len(b)} bytes, from byte {at} on: {a[at:at + 40]!r} {b[at:at + 40]!r}"
    if first and list(first) != list(second):
        yield "  the order of what it holds"


def main(one, other):
    files = [{path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir() if path.name != "SHA256SUMS"} for folder in (one, other)]
    same = True
    for name in sorted(files[0].keys() | files[1].keys()):
        a, b = files[0].get(name), files[1].get(name)
        if a is None or b is None:
            print(f"{name}: only in {one if b is None else other}")
        elif a != b:
            print(f"{name}: differs", *differences(name, a, b), sep="\n")
        else:
            print(f"{name}: the same, sha256 {hashlib.sha256(a).hexdigest()[:16]}")
        same = same and a == b
    if not files[0]:
        same = False
        print(f"{one} is empty")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
