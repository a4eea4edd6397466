#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the settings called "tuned" of the other methods: one for all sets.

  tune_peers.py BENCHMARK_PEERS DATA [METHOD ...]

Coordinate descent on the mean panoptic quality over the sets with ground truth: from the
method's last setting, every value of one parameter after the other is tried, the best is
kept, until a round over all the parameters brings nothing. Frames of one set are many and
alike, so that a few of each do for the slow methods (FRAMES). Needs no more than Python.
"""
import collections
import csv
import os
import statistics
import subprocess
import sys
import tempfile

# Every value that is tried. Parameters are explained at the methods in *_peer.cpp.
GRID = {
    'pcl_multi_plane': {
        'min_inliers': [250, 500, 1000, 2000],
        'angle': [0.75, 1, 1.25, 1.5, 2, 3, 4, 6, 8, 12],
        'distance': [0.005, 0.01, 0.02, 0.04, 0.08],
        'curvature': [0.0003, 0.001, 0.003, 0.01, 0.03],
        'refine_distance': [0.005, 0.01, 0.02, 0.03],
        'smoothing': [5, 7, 10, 15, 20, 30],
        'depth_change': [0.01, 0.02, 0.03, 0.05],
    },
    'opencv_rgbd_plane': {
        'block_size': [8, 10, 15, 20, 30, 40],
        'min_size': [200, 400, 800, 1600, 3200],
        'threshold': [0.002, 0.003, 0.005, 0.007, 0.01, 0.015, 0.02],
        'sensor_error_a': [0, 0.0005, 0.001, 0.002, 0.0035, 0.0075],
        'sensor_error_b': [0, 0.001, 0.002],
        'sensor_error_c': [0, 0.001, 0.002],
        'normals': [0, 1],
    },
    'pcl_ransac': {
        'stride': [2, 3, 4, 6],
        'iterations': [300, 1000, 3000],
        'threshold': [0.003, 0.005, 0.0075, 0.01, 0.015, 0.02],
        'rest': [0, 0.05, 0.1, 0.2],
        'min_points': [250, 500, 1000, 2000, 4000],
        'connected': [0, 1],
    },
    'cgal_efficient_ransac': {
        'probability': [0.001, 0.01, 0.05],
        'min_points': [250, 500, 1000, 2000],
        'epsilon': [0.002, 0.003, 0.005, 0.0075, 0.01, 0.015],
        'cluster_epsilon': [0.01, 0.02, 0.03, 0.05, 0.1],
        'angle': [10, 15, 20, 25, 35],
        'smoothing': [5, 10, 15, 20],
        'depth_change': [0.01, 0.02, 0.03],
    },
}

# Of each set, for the methods that take long: half a minute for each value otherwise.
FRAMES = {
    'pcl_ransac': 2,
    'cgal_efficient_ransac': 3,
}


def labelled_frames(data, most):
    """Names of the first frames with ground truth of every set."""
    names = []
    for folder, _, files in sorted(os.walk(data)):
        truths = [f for f in sorted(files)
                  if f.endswith(('.gt.png', '.faces.png', '.pgt.png'))]
        names += [f.rsplit('.', 2)[0] for f in truths][:most]
    return names


def mean_quality(path):
    """Setting -> mean over the sets of the mean panoptic quality of their frames."""
    scores = collections.defaultdict(lambda: collections.defaultdict(list))
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            scores[row['setting']][row['set']].append(float(row['pq']))
    return {setting: statistics.mean(statistics.mean(values) for values in sets.values())
            for setting, sets in scores.items()}


class Tuner:
    """Runs settings of one method, each only once."""

    def __init__(self, program, data, method):
        self.command = [program, '--data', data, '--labelled-only', '--repeat', '1']
        if method in FRAMES:
            self.command += ['--frames', *labelled_frames(data, FRAMES[method])]
        self.method = method
        self.known = {}

    def qualities(self, settings):
        texts = [','.join(f'{name}={value:g}' for name, value in s.items())
                 for s in settings]
        new = [text for text in dict.fromkeys(texts) if text not in self.known]
        if new:
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, 'tries.csv')
                tries = [word for text in new
                         for word in ('--try', f'{self.method}:{text}')]
                subprocess.run(self.command + ['--output', path] + tries, check=True,
                               stdout=subprocess.DEVNULL)
                for text, quality in mean_quality(path).items():
                    self.known[text.replace(' ', ',')] = quality
        return [self.known[text] for text in texts]


def last_setting(program, method):
    """The values of the method's last setting, from --list."""
    text = subprocess.run([program, '--list'], check=True, capture_output=True,
                          text=True).stdout
    block = text.split(f'{method}:', 1)[1].split('\n')
    line = [row for row in block[1:] if row.startswith('  ')]
    end = next((k for k, row in enumerate(block[1:]) if not row.startswith('  ')),
               len(line))
    pairs = line[end - 1].rsplit('):', 1)[1].split()
    return {name: float(value) for name, value in (pair.split('=') for pair in pairs)}


def tune(program, data, method):
    tuner = Tuner(program, data, method)
    best = last_setting(program, method)
    quality = tuner.qualities([best])[0]
    print(f'{method}: {quality:.3f} at the start', flush=True)
    improved = True
    while improved:
        improved = False
        for name, values in GRID[method].items():
            settings = [{**best, name: value} for value in values]
            found = tuner.qualities(settings)
            print(f'  {name}:', ' '.join(f'{v:g} {q:.3f},' for v, q in zip(values, found)),
                  flush=True)
            if max(found) > quality + 1e-4:
                quality = max(found)
                best = settings[found.index(quality)]
                improved = True
    print(f'{method}: {quality:.3f} with',
          ' '.join(f'{name}={value:g}' for name, value in best.items()), flush=True)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    for method in sys.argv[3:] or GRID:
        tune(sys.argv[1], sys.argv[2], method)


if __name__ == '__main__':
    main()
