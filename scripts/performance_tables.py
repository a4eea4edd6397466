# SPDX-License-Identifier: BSD-3-Clause
"""Reads what the benchmarks wrote: times by the names of Google Benchmark, stages."""
import collections
import csv
import math
import re
import statistics

from accuracy_tables import in_digits

PROFILES = ['FAST', 'DEFAULT', 'PAPER']
PAPER_10 = 'PAPER_10_LABELS'
TITLES = {PAPER_10: 'PAPER, 10 labels'}
VGA = 'camera:640x480'
# From the plainest to the widest; others follow by their names.
INSTRUCTION_SETS = ['SCALAR', 'EMU128', 'SSE2', 'SSSE3', 'SSE4', 'AVX2', 'AVX3', 'AVX3_DL',
                    'AVX3_ZEN4']
AGGREGATE = re.compile(r'_(mean|median|stddev|cv)$')


class Times:
    """A CSV of Google Benchmark: medians of the repetitions by the names."""

    def __init__(self, path):
        self._values = collections.defaultdict(lambda: collections.defaultdict(list))
        with open(path, newline='') as file:
            for row in csv.DictReader(skip_preamble(file)):
                if AGGREGATE.search(row['name']) or row['error_occurred']:
                    continue
                row.update(word.split(':') for word in row['label'].split())
                for column, value in row.items():
                    if column != 'name' and is_number(value):
                        self._values[key_of(row['name'])][column].append(float(value))

    def names(self):
        return list(self._values)

    def has(self, name):
        return name in self._values

    def number(self, name, column):
        return statistics.median(self._values[name][column])

    def processor(self, name):
        """Milliseconds of processor time of the calling thread."""
        return self.number(name, 'cpu_time')

    def clock(self, name):
        return self.number(name, 'real_time')


def skip_preamble(lines):
    """Google Benchmark puts the machine in front of the table."""
    found = False
    for line in lines:
        found = found or line.startswith('name,')
        if found:
            yield line


def is_number(text):
    try:
        float(text)
    except (TypeError, ValueError):
        return False
    return True


def key_of(name):
    """The name without what Google Benchmark adds about how it ran."""
    return re.sub(r'/(real_time|process_time|repeats:\d+|iterations:1/repeats:\d+)', '',
                  name)


def parts_of(name):
    """pipeline/FAST/camera:640x480/threads:1: what, then values by name."""
    words = name.split('/')
    return words[1], dict(word.split(':', 1) for word in words[2:] if ':' in word)


def shapes_of(times, group):
    """Shapes that were measured: cameras by size, then lidars."""
    shapes = {name.split('/')[2] for name in times.names()
              if name.startswith(f'{group}/')}
    return sorted(shapes, key=lambda shape: (shape.split(':')[0], points_of(shape)))


def points_of(shape):
    width, height = shape.split(':')[1].split('x')
    return int(width) * int(height)


def title_of(profile):
    return TITLES.get(profile, profile)


def shape_title(shape):
    kind, size = shape.split(':')
    return size if kind == 'camera' else f'{size} (lidar)'


def exponent(pairs):
    """Slope of the straight line through the logarithms: 1 is linear."""
    xs = [math.log(x) for x, _ in pairs]
    ys = [math.log(y) for _, y in pairs]
    mean_x, mean_y = statistics.mean(xs), statistics.mean(ys)
    spread = sum((x - mean_x) ** 2 for x in xs)
    if spread == 0:
        return float('nan')
    return sum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys)) / spread


def camera_times(times, profile):
    """(points, milliseconds on one thread) at each size of a camera with planes."""
    pairs = []
    for shape in shapes_of(times, 'pipeline'):
        name = f'pipeline/{profile}/{shape}/threads:1'
        if (shape.startswith('camera') and times.has(name)
                and times.number(name, 'planes') > 0):
            pairs.append((points_of(shape), times.processor(name)))
    return pairs


def in_order(names, order):
    """Those of the order first, as they stand in it."""
    return [name for name in order if name in names] + sorted(set(names) - set(order))


def fine(value):
    """Milliseconds with digits for small ones."""
    return f'{value:.3f}' if value < 0.1 else f'{value:.2f}' if value < 10 \
        else in_digits(value)


def megabytes(value):
    return f'{value / 1e6:.1f}'
