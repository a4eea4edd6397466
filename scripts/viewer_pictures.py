# SPDX-License-Identifier: BSD-3-Clause
"""Pictures for doc/ of what pcl_mrf_plane_viewer shows, and PCD files to show by it."""
import pathlib
import subprocess

import numpy

DOC = pathlib.Path(__file__).resolve().parent.parent / 'doc'


class Viewer:
    """The apps of a build folder, run in a folder for their files."""

    def __init__(self, build, folder):
        self.build = pathlib.Path(build).resolve()
        self.folder = pathlib.Path(folder)

    def run(self, program, *arguments):
        subprocess.run([self.build / program, *map(str, arguments)], check=True,
                       cwd=self.folder, stdout=subprocess.DEVNULL)

    def scene(self, path, width, height, *options):
        self.run('apps/pcl_mrf_plane_scene', path, '--width', width, '--height', height,
                 '--format', 'binary', *options)

    def look(self, source, name, keys, window, *options):
        """doc/pictures/NAME.png after the keys, in a window of that size."""
        self.run('apps/pcl_mrf_plane_viewer', source, '--screenshot',
                 DOC / 'pictures' / f'{name}.png', '--keys', keys, '--window', window,
                 *options)


def read_pcd(path):
    """Fields of a binary PCD of 4-byte numbers."""
    content = path.read_bytes()
    start = content.index(b'DATA')
    header = dict(line.split(' ', 1) for line in content[:start].decode().splitlines()
                  if ' ' in line)
    names = header['FIELDS'].split()
    kinds = [{'F': 'f4', 'U': 'u4', 'I': 'i4'}[kind] for kind in header['TYPE'].split()]
    body = content[content.index(b'\n', start) + 1:]
    data = numpy.frombuffer(body, list(zip(names, kinds)), int(header['POINTS']))
    return data.reshape(int(header['HEIGHT']), int(header['WIDTH']))


def write_pcd(path, points, labels=None):
    """A binary PCD of points (rows, columns, 3), and if there are any of their labels."""
    height, width = points.shape[:2]
    fields = [('x', 'f4'), ('y', 'f4'), ('z', 'f4')]
    if labels is not None:
        fields.append(('label', 'u4'))
    data = numpy.zeros((height, width), fields)
    for axis, name in enumerate('xyz'):
        data[name] = points[..., axis]
    if labels is not None:
        data['label'] = labels
    names = ' '.join(name for name, _ in fields)
    types = ' '.join(kind[0].upper() for _, kind in fields)
    path.write_bytes(
        (f'VERSION 0.7\nFIELDS {names}\nSIZE {"4 " * len(fields)}\nTYPE {types}\n'
         f'COUNT {"1 " * len(fields)}\nWIDTH {width}\nHEIGHT {height}\n'
         f'VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {width * height}\nDATA binary\n').encode() +
        data.tobytes())
