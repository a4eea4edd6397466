#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what follows from the planes and writes its blocks of doc/accuracy.md.

  analysis_report.py --data FOLDER --build FOLDER

Confidence: every SET/NAME.pcd of the data with a NAME.gt.png, NAME.faces.png or NAME.pgt.png is
segmented by the app of the build, and the confidence of each point held against whether its
label is right.
Cost: times of the same runs. Uncertainty: shares that test_plane_uncertainty of the build
records. Needs python3-matplotlib, python3-numpy and python3-pil.
"""
import argparse
import collections
import json
import os
import pathlib
import statistics
import subprocess
import tempfile

import matplotlib.pyplot as plt
import numpy
from PIL import Image

from accuracy_report import PAGE
from accuracy_tables import COLOURS, SETS, markdown_table, replace_block, save_plot

BINS = 20
RUNS = 9
NOT_SCORED = 65535


def image(path):
    return numpy.array(Image.open(path)).astype(numpy.int64)


def frames(data):
    """Cloud and ground truth of every frame that has both."""
    for cloud in sorted(data.glob('*/*.pcd')):
        for kind in ('gt', 'faces', 'pgt'):
            truth = cloud.with_suffix(f'.{kind}.png')
            if truth.exists():
                yield cloud, truth
                break


def run_app(app, cloud, folder):
    """Labels, confidence and times of a frame."""
    files = {name: folder / name for name in ('labels.png', 'confidence.png', 'report.json')}
    subprocess.run(
        [app, cloud, '--quiet', '--timing', '--repeat', str(RUNS), '--outlines', '--creases',
         '--project', 'ray', '--label-image', files['labels.png'],
         '--confidence-image', files['confidence.png'], '--models', files['report.json']],
        check=True)
    return (image(files['labels.png']), image(files['confidence.png']) / 65535,
            json.loads(files['report.json'].read_text()))


def is_right(labels, truth):
    """Whether a point lies on the true plane that its label stands for, the one that most of the
    label's points lie on; without a label, whether it lies on none."""
    right = numpy.zeros(labels.shape, bool)
    right[(labels == 0) & (truth == 0)] = True
    for label in numpy.unique(labels[labels > 0]):
        region = labels == label
        planes, counts = numpy.unique(truth[region & (truth > 0)], return_counts=True)
        if len(planes):
            right |= region & (truth == planes[counts.argmax()])
    return right


# --- block: confidence ----------------------------------------------------------------


def binned(confidence, right):
    """Mean confidence and share of right points of so many equal parts of the points."""
    order = numpy.argsort(confidence, kind='stable')
    return [(confidence[part].mean(), right[part].mean())
            for part in numpy.array_split(order, BINS)]


def plot_calibration(points):
    figure, axes = plt.subplots(figsize=(6, 4.2), layout='constrained')
    for colour, (name, (confidence, right)) in zip(COLOURS, points.items()):
        axes.plot(*zip(*binned(confidence, right)), '.-', color=colour,
                  label=SETS.get(name, name))
    axes.plot([0, 1], [0, 1], ':', color='gray', label='as stated')
    axes.set_xlabel('confidence, mean of a twentieth of the points')
    axes.set_ylabel('share of points with the right label')
    axes.set_xlim(0.6, 1)
    axes.set_ylim(0.4, 1.01)
    axes.grid(True, alpha=0.25)
    axes.legend(fontsize=8, loc='lower right')
    return save_plot(figure, 'confidence.png')


def confidence_block(points):
    plot_calibration(points)
    limits = [0, 0.5, 0.7, 0.8, 0.9, 0.93, 1.01]
    header = ['set'] + [f'{low:g} to {min(high, 1):g}'
                        for low, high in zip(limits, limits[1:])]
    lines = []
    for name, (confidence, right) in points.items():
        cells = [SETS.get(name, name)]
        for low, high in zip(limits, limits[1:]):
            inside = (confidence >= low) & (confidence < high)
            cells.append(f'{100 * right[inside].mean():.1f} % of {100 * inside.mean():.0f} %'
                         if inside.any() else '')
        lines.append(cells)
    return '\n'.join([
        'Right points of those with a confidence in each range, and how many these are of all:',
        '', markdown_table(header, lines), '',
        '![Share of right labels over the confidence](pictures/confidence.png)'])


# --- block: analysis-cost -------------------------------------------------------------


def cost_block(reports):
    timed = [report for report in reports
             if (report['counts']['width'], report['counts']['height']) == (640, 480)]
    analysis = [report['timing']['analysis'] for report in timed]
    # The least of the runs of a frame: what else the machine does has no say.
    cells = [statistics.median(one[name]['min'] for one in analysis) for name in analysis[0]]
    cells.append(statistics.median(sum(stage['min'] for stage in one.values())
                                   for one in analysis))
    cells.append(statistics.median(report['timing']['spread']['total_ms']['min']
                                   for report in timed))
    return (f'Milliseconds, medians of {len(timed)} frames of 640x480, least of {RUNS} runs, '
            'one thread:\n\n' +
            markdown_table([*analysis[0], 'all', 'the segmentation itself'],
                           [[f'{cell:.1f}' for cell in cells]]))


# --- block: uncertainty ---------------------------------------------------------------


def coverage(test, folder):
    """What the Monte Carlo tests record, by preset and source of the noise."""
    path = folder / 'coverage.json'
    subprocess.run([test, '--gtest_filter=*CoverageTest*', f'--gtest_output=json:{path}'],
                   check=True, stdout=subprocess.DEVNULL)
    shares = collections.defaultdict(dict)
    for suite in json.loads(path.read_text())['testsuites']:
        for case in suite['testsuite']:
            test_name, variant = case['name'].split('/')
            shares[variant][test_name] = case
    return shares


def uncertainty_block(shares):
    def percent(case, name):
        return f'{100 * float(case[name]):.1f} %'
    header = ['noise', 'true labels', 'planes', 'found labels', 'bias left in', 'planes']
    lines = []
    for variant, cases in shares.items():
        ideal = cases['TruthLiesInsideTheEllipsoidAsOftenAsItShould']
        found = cases['HoldsForPlanesThatTheDefaultProfileFinds']
        name = variant.replace('Stated', ', stated').replace('FromPoints', ', from the points')
        lines.append([name, percent(ideal, 'share'), str(ideal['planes']),
                      percent(found, 'share'), percent(found, 'share_biased'),
                      str(found['planes'])])
    return markdown_table(header, lines)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--data', type=pathlib.Path, required=True)
    parser.add_argument('--build', type=pathlib.Path, required=True)
    options = parser.parse_args()
    points = collections.defaultdict(lambda: ([], []))
    reports = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for cloud, truth_path in frames(options.data):
            labels, confidence, report = run_app(
                options.build / 'apps/pcl_mrf_plane_segmentation', cloud, folder)
            truth = image(truth_path)
            # A confidence of 0 without a label: not measured.
            scored = (truth != NOT_SCORED) & ((confidence > 0) | (labels > 0))
            points[cloud.parent.name][0].append(confidence[scored])
            points[cloud.parent.name][1].append(is_right(labels, truth)[scored])
            reports.append(report)
        shares = coverage(options.build / 'test/test_plane_uncertainty', folder)
    points = {name: tuple(map(numpy.concatenate, points[name]))
              for name in sorted(points, key=lambda name: list(SETS).index(name)
                                 if name in SETS else len(SETS))}
    page = PAGE.read_text()
    for name, text in (('confidence', confidence_block(points)),
                       ('analysis-cost', cost_block(reports)),
                       ('uncertainty', uncertainty_block(shares))):
        page = replace_block(page, name, text, PAGE)
    temporary = PAGE.with_suffix('.md.new')
    temporary.write_text(page)
    os.replace(temporary, PAGE)


if __name__ == '__main__':
    main()
