#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts what each stage of each profile executes and fetches, by Valgrind's Callgrind.

  performance_instructions.py BENCHMARK OUTPUT.csv

BENCHMARK is benchmark_performance. One row for each profile and stage: instructions a point,
and bytes a point that come from beyond a first cache of 32 KiB or go there, in lines of 64, on
the generated room at 640x480, one thread. Valgrind knows AVX2 and not AVX-512. Counts do not
depend on how busy the machine is.
"""
import argparse
import collections
import csv
import pathlib
import re
import subprocess
import tempfile

POINTS = 640 * 480
LINE = 64  # bytes
PROFILES = ['FAST', 'DEFAULT', 'PAPER', 'PAPER_10_LABELS']
# Functions that call the stages; what else they call is "other".
DRIVERS = re.compile(r'(segmentObserved|labelPlanes|labelPoints|segmentAsInPaper|segmentAdaptively|'
                     r'inferLabels|PlaneSegmenter::segment|MRFPlaneSegmentation<[^(]*>::\w+)\(')
STAGES = {
    'points': r'OrganizedPoints::(load|resolveDepthMeasure)\(',
    'sampling': r'adaptive::(samplePoints|spreadLabels)\(',
    'tiles': r'(adaptive::(buildTilePyramid|estimateNoise|statedNoise|assignLocalNoise|'
             r'selectTiles)|::detectTilePlanes)\(',
    'merging': r'(adaptive::(mergeTouching|joinCoplanar)|::clusterTilePlanes)\(',
    'cells': r'adaptive::labelCells\(',
    'field': r'(adaptive::buildField|PlaneField::PlaneField)\(',
    'propagation': r'(adaptive::propagateBeliefs|::propagateRows|::findRuns)\(',
    'refinement': r'adaptive::(refineRegions|dropDoubtfulPlanes)\(',
    'regions': r'::(gatherRegions|paintRegions|regionLabels)\(',
}
WHOLE = re.compile(r'^pcl_mrf_planes::PlaneSegmenter::segment\(')


class Profile:
    """Costs of the calls in a file of Callgrind, by caller and callee."""

    def __init__(self, path):
        self.events = []
        self.calls = []  # (caller, callee, count, costs)
        names = {}
        caller = callee = count = None
        for line in path.read_text().splitlines():
            key, _, value = line.partition('=')
            if line.startswith('events:'):
                self.events = line.split()[1:]
            elif key in ('fn', 'cfn'):
                number, _, name = value.partition(' ')
                name = names.setdefault(number, name)
                if key == 'fn':
                    caller = name
                else:
                    callee = name
            elif key == 'calls':
                count = int(value.split()[0])
            elif count is not None:  # the line behind "calls": the whole of them
                costs = [int(cost) for cost in line.split()[1:]]
                self.calls.append((caller, callee, count, costs))
                count = None

    def cost(self, costs, event):
        place = self.events.index(event)
        return costs[place] if place < len(costs) else 0


def stage_of(function):
    if '{lambda' in function:
        return None
    return next((stage for stage, pattern in STAGES.items()
                 if re.search(pattern, function)), None)


def count(benchmark, profile):
    """(instructions, bytes) a point by the stage."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / 'callgrind'
        subprocess.run(
            ['valgrind', '--tool=callgrind', '--cache-sim=yes', '--D1=32768,8,64',
             f'--callgrind-out-file={out}', benchmark, '--benchmark_min_time=0',
             f'--benchmark_filter=^pipeline/{profile}/camera:640x480/threads:1/'],
            check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        calls = Profile(out)
    frames = sum(number for _, callee, number, _ in calls.calls if WHOLE.search(callee))
    sums = collections.defaultdict(lambda: [0.0, 0.0])
    for caller, callee, _, costs in calls.calls:
        stage = stage_of(callee)
        if stage is None or not DRIVERS.search(caller):
            continue
        sums[stage][0] += calls.cost(costs, 'Ir') / (frames * POINTS)
        misses = calls.cost(costs, 'D1mr') + calls.cost(costs, 'D1mw')
        sums[stage][1] += LINE * misses / (frames * POINTS)
    return sums


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('benchmark')
    parser.add_argument('output', type=pathlib.Path)
    options = parser.parse_args()
    part = options.output.with_suffix('.part')
    with open(part, 'w', newline='') as file:
        rows = csv.writer(file)
        rows.writerow(['profile', 'stage', 'instructions', 'bytes'])
        for profile in PROFILES:
            sums = count(options.benchmark, profile)
            for stage in STAGES:
                if stage in sums:
                    rows.writerow([profile, stage] + [f'{value:.2f}' for value in sums[stage]])
    part.rename(options.output)


if __name__ == '__main__':
    main()
