#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_corpus.py FOLDER: writes the first inputs of the fuzz targets, a folder each.

Small files of every kind that the readers know, made here byte by byte, and for the other
targets one start for each profile and shape."""
import json
import pathlib
import random
import struct
import sys
import zlib

WIDTH, HEIGHT = 8, 6
VALUES = [0 if i % 7 == 3 else 1000 + 5 * i for i in range(WIDTH * HEIGHT)]


def pcd(form):
    head = ("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\n"
            "COUNT 1 1 1 1\nWIDTH %d\nHEIGHT %d\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA %s\n"
            % (WIDTH, HEIGHT, WIDTH * HEIGHT, form)).encode()
    points = [(i % WIDTH / 10, i // WIDTH / 10, v / 1000, i) for i, v in enumerate(VALUES)]
    if form == "ascii":
        return head + "".join("%g %g %g %d\n" % p for p in points).encode()
    if form == "binary":
        return head + b"".join(struct.pack("<fffI", *p) for p in points)
    columns = b"".join(struct.pack("<%d%s" % (len(points), "I" if k == 3 else "f"),
                                   *[p[k] for p in points]) for k in range(4))
    packed = literals(columns)
    return head + struct.pack("<II", len(packed), len(columns)) + packed


def literals(data):
    """LZF of nothing but literal runs."""
    runs = [data[i:i + 32] for i in range(0, len(data), 32)]
    return b"".join(bytes([len(run) - 1]) + run for run in runs)


def ply(form):
    head = ("ply\nformat %s 1.0\nobj_info num_cols %d\nobj_info num_rows %d\n"
            "element vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
            "end_header\n" % (form, WIDTH, HEIGHT, WIDTH * HEIGHT)).encode()
    points = [(i % WIDTH / 10, i // WIDTH / 10, v / 1000) for i, v in enumerate(VALUES)]
    if form == "ascii":
        return head + "".join("%g %g %g\n" % p for p in points).encode()
    return head + b"".join(struct.pack("<fff", *p) for p in points)


def pclzf():
    packed = literals(struct.pack("<%dH" % len(VALUES), *VALUES))
    return (b"PCLZF" + struct.pack("<II", WIDTH, HEIGHT) + b"depth16".ljust(16, b"\0")
            + struct.pack("<II", len(packed), 2 * len(VALUES)) + packed)


def png(depth, colour):
    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data
                + struct.pack(">I", zlib.crc32(name + data)))
    rows = b""
    for v in range(HEIGHT):
        row = VALUES[v * WIDTH:(v + 1) * WIDTH]
        pixels = (bytes(x % 256 for x in row for _ in range(3)) if colour
                  else struct.pack(">%dH" % WIDTH, *row))
        rows += b"\0" + pixels
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, depth, 2 if colour else 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def pgm(maximum):
    form = ">%d%s" % (len(VALUES), "H" if maximum > 255 else "B")
    return (b"P5\n# made\n%d %d\n%d\n" % (WIDTH, HEIGHT, maximum)
            + struct.pack(form, *[v % (maximum + 1) for v in VALUES]))


def ppm():
    return b"P6\n%d %d\n255\n" % (WIDTH, HEIGHT) + bytes(v % 256 for v in VALUES) * 3


def sun_raster():
    return (struct.pack(">8I", 0x59A66A95, WIDTH, HEIGHT, 8, WIDTH * HEIGHT, 1, 0, 0)
            + bytes(v % 256 for v in VALUES))


CAMERAS = [
    json.dumps({"fx": 500, "fy": 500, "cx": 3.5, "cy": 2.5, "depth_scale": 1000,
                "width": 8, "height": 6, "invalid": [0, 65535]}).encode(),
    json.dumps({"width": 8, "height": 6,
                "intrinsic_matrix": [500, 0, 0, 0, 500, 0, 3.5, 2.5, 1]}).encode()]
YAMLS = [
    b"image_width: 8\nimage_height: 6\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
    b"  data: [500, 0, 3.5, 0, 500, 2.5, 0, 0, 1]\n",
    b"%YAML:1.0\nCamera.fx: 500.0\nCamera.fy: 500.0\nCamera.cx: 3.5\nCamera.cy: 2.5\n"
    b"DepthMapFactor: 1000.0\n"]


def reader_files():
    """Pairs of the readers' number in fuzz_readers.cpp and a file."""
    files = [(0, pcd(form)) for form in ("ascii", "binary", "binary_compressed")]
    files += [(1, ply(form)) for form in ("ascii", "binary_little_endian")]
    files += [(2, pclzf()), (3, png(16, False)), (4, pgm(65535)), (5, pgm(2047)),
              (6, sun_raster()), (7, png(8, True)), (7, ppm()), (8, pgm(255)),
              (8, sun_raster()), (9, sun_raster()), (9, pgm(4095)),
              (10, b" ".join(b"%.3f" % (v / 1000) for v in VALUES))]
    files += [(11, text) for text in CAMERAS]
    return files + [(12, text) for text in YAMLS]


def point_starts():
    for profile in range(3):
        for shape in range(6):
            for switches in (0, 7, 16, 55):
                yield (struct.pack("<BBHHBB", profile, switches, 40 + shape, 36, shape, 0)
                       + bytes(3))


def parameter_starts():
    draw = random.Random(1)
    for profile in range(3):
        for length in (1, 30, 120):
            yield bytes([profile]) + bytes(draw.randrange(256) for _ in range(length))


def write(folder, inputs):
    folder.mkdir(parents=True, exist_ok=True)
    for k, data in enumerate(inputs):
        (folder / ("start%03d" % k)).write_bytes(data)


def main():
    root = pathlib.Path(sys.argv[1])
    write(root / "readers", (bytes([kind]) + data for kind, data in reader_files()))
    write(root / "points", point_starts())
    write(root / "parameters", parameter_starts())


main()
