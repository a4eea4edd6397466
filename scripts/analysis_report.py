#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what follows from the planes and writes its blocks of doc/accuracy.md.

  analysis_report.py --data FOLDER --build FOLDER

Confidence: every SET/NAME.pcd of the data with a NAME.gt.png, NAME.faces.png or NAME.pgt.png is
segmented by the app of the build in each profile, and the confidence of each point held against
whether its label is right.
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

RUNS = 9
NOT_SCORED = 65535
PROFILES = ('default', 'fast', 'paper')
LIMITS = (0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.97, 1)
RESAMPLES = 2000
# Shares of fewer points are not drawn.
FEWEST_OF_SET = 0.002


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


def run_app(app, cloud, profile, folder):
    """Labels, confidence and times of a frame."""
    files = {name: folder / name for name in ('labels.png', 'confidence.png', 'report.json')}
    subprocess.run(
        [app, cloud, '--quiet', '--profile', profile, '--timing', '--repeat', str(RUNS),
         '--outlines', '--creases', '--project', 'ray', '--label-image', files['labels.png'],
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


def regions_of(labels, truth):
    """What points of a frame are right or wrong together: those of a label, and those of a true
    plane without one."""
    return numpy.where(labels > 0, labels, truth + 100000)


def count_bins(labels, confidence, truth):
    """Points and right points of each region of a frame, in each range of confidence; and the
    sum of the confidence in each range."""
    # A confidence of 0 without a label: not measured.
    scored = (truth != NOT_SCORED) & ((confidence > 0) | (labels > 0))
    right = is_right(labels, truth)[scored]
    confidence = confidence[scored]
    regions = numpy.unique(regions_of(labels, truth)[scored], return_inverse=True)[1]
    bins = numpy.searchsorted(LIMITS[1:-1], confidence, 'right')
    shape = (regions.max(initial=0) + 1, len(LIMITS) - 1)
    cells = numpy.ravel_multi_index((regions, bins), shape)
    count = numpy.prod(shape)
    points, hits, sums = (numpy.bincount(cells, weights, count).reshape(shape)
                          for weights in (None, right, confidence))
    return points, hits, sums.sum(axis=0)


class Calibration:
    """Of a set of frames, or several: shares of right points by confidence."""

    def __init__(self, counts):
        points, hits, sums = zip(*counts)
        self.points = numpy.concatenate(points)
        self.hits = numpy.concatenate(hits)
        self.sums = numpy.sum(sums, axis=0)

    def total(self):
        return self.points.sum(axis=0)

    def shares(self):
        with numpy.errstate(invalid='ignore'):
            return self.hits.sum(axis=0) / self.total()

    def of_all(self):
        return self.total() / self.points.sum()

    def stated(self):
        with numpy.errstate(invalid='ignore'):
            return self.sums / self.total()

    def resampled(self):
        """Shares of regions drawn at random, as many as there are, with putting back."""
        random = numpy.random.default_rng(1)
        count = len(self.points)
        draws = random.multinomial(count, numpy.full(count, 1 / count), RESAMPLES)
        with numpy.errstate(invalid='ignore'):
            return (draws @ self.hits) / (draws @ self.points)

    def sure_dips(self):
        """Pairs of neighbouring ranges whose order is wrong in 95 of 100 drawings, and of all."""
        drawn = self.resampled()[:, self.of_all() >= FEWEST_OF_SET]
        steps = numpy.diff(drawn, axis=1)
        valid = numpy.isfinite(steps)
        falls = (steps < 0).sum(axis=0) / numpy.maximum(valid.sum(axis=0), 1)
        return (falls > 0.95).sum(), len(falls)


def plot_calibration(calibrations):
    """Wrong points over what the confidence leaves, both in logarithms."""
    figure, axes = plt.subplots(1, len(PROFILES), figsize=(11, 4.2), layout='constrained',
                                sharex=True, sharey=True)
    sets = list(dict.fromkeys(name for _, name in calibrations))
    for one, profile in zip(axes, PROFILES):
        for colour, name in zip(COLOURS, sets):
            calibration = calibrations[profile, name]
            drawn = calibration.of_all() >= FEWEST_OF_SET
            low, high = numpy.nanquantile(calibration.resampled()[:, drawn], (0.05, 0.95), 0)
            wrong = numpy.maximum(1 - calibration.shares()[drawn], 3e-4)
            left = 1 - calibration.stated()[drawn]
            one.plot(left, wrong, '.-', color=colour, label=SETS.get(name, name), zorder=3)
            one.vlines(left, numpy.maximum(1 - high, 3e-4), numpy.maximum(1 - low, 3e-4),
                       color=colour, alpha=0.35, linewidth=3)
        one.plot([0.01, 1], [0.01, 1], ':', color='gray', label='as stated')
        one.set_xscale('log')
        one.set_yscale('log')
        one.set_xticks([1, 0.3, 0.1, 0.03, 0.01], ['0', '0.7', '0.9', '0.97', '0.99'])
        one.set_yticks([1, 0.3, 0.1, 0.03, 0.01, 0.001],
                       ['0 %', '70 %', '90 %', '97 %', '99 %', '99.9 %'])
        one.minorticks_off()
        one.set_xlim(1, 0.009)
        one.set_ylim(1, 2.5e-4)
        one.set_title(f'profile {profile.upper()}')
        one.set_xlabel('confidence')
        one.grid(True, alpha=0.25)
    axes[0].set_ylabel('points with the right label')
    axes[-1].legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=8)
    return save_plot(figure, 'confidence.png')


def calibration_line(name, calibration):
    cells = [name]
    for share, of_all in zip(calibration.shares(), calibration.of_all()):
        cells.append(f'{100 * share:.1f} % of {100 * of_all:.0f} %' if of_all > 0 else '')
    dips, pairs = calibration.sure_dips()
    return cells + [f'{dips} of {pairs}']


def confidence_block(counts):
    calibrations = {key: Calibration(of_set) for key, of_set in counts.items()}
    plot_calibration(calibrations)
    sets = list(dict.fromkeys(name for _, name in counts))
    lines = [calibration_line(SETS.get(name, name), calibrations['default', name])
             for name in sets]
    for profile in PROFILES:
        everything = sum((counts[profile, name] for name in sets), [])
        lines.append(calibration_line(f'all sets, {profile.upper()}',
                                      Calibration(everything)))
    header = ['set'] + [f'{low:g} to {high:g}' for low, high in zip(LIMITS, LIMITS[1:])] + [
        'sure dips']
    return '\n'.join([
        'Right points of those with a confidence in each range, and how many these are of all. '
        'Points of a region are right or wrong together: "sure dips" are the pairs of '
        f'neighbouring ranges (with at least {100 * FEWEST_OF_SET:g} % of the points each) in '
        'which the surer points are less often right in 95 of 100 sets of regions drawn from '
        'those that were found (bootstrap).',
        '', markdown_table(header, lines), '',
        'Right labels over confidence, and 90 % of the sets of regions that are drawn so:', '',
        '![Share of right labels over the confidence](pictures/confidence.png)'])


# --- block: analysis-cost -------------------------------------------------------------


def cost_cells(reports):
    """The least of the runs of a frame: what else the machine does has no say."""
    analysis = [report['timing']['analysis'] for report in reports]
    totals = [sum(stage['min'] for stage in one.values()) for one in analysis]
    segmentation = [report['timing']['spread']['total_ms']['min'] for report in reports]
    cells = [statistics.median(one[name]['min'] for one in analysis) for name in analysis[0]]
    return cells + [statistics.median(totals), statistics.median(segmentation)]


def cost_block(reports):
    lines = []
    for profile in PROFILES:
        timed = [report for report in reports[profile]
                 if (report['counts']['width'], report['counts']['height']) == (640, 480)]
        lines.append([profile.upper()] + [f'{cell:.1f}' for cell in cost_cells(timed)])
    return (f'Milliseconds, medians of {len(timed)} frames of 640x480, least of {RUNS} runs, '
            'one thread:\n\n' +
            markdown_table(['profile', *timed[0]['timing']['analysis'], 'all',
                            'the segmentation itself'], lines))


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
    counts = collections.defaultdict(list)
    reports = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        order = list(SETS)
        for cloud, truth_path in sorted(
                frames(options.data), key=lambda frame: order.index(frame[0].parent.name)
                if frame[0].parent.name in order else len(order)):
            for profile in PROFILES:
                labels, confidence, report = run_app(
                    options.build / 'apps/pcl_mrf_plane_segmentation', cloud, profile, folder)
                counts[profile, cloud.parent.name].append(
                    count_bins(labels, confidence, image(truth_path)))
                reports[profile].append(report)
        shares = coverage(options.build / 'test/test_plane_uncertainty', folder)
    page = PAGE.read_text()
    for name, text in (('confidence', confidence_block(counts)),
                       ('analysis-cost', cost_block(reports)),
                       ('uncertainty', uncertainty_block(shares))):
        page = replace_block(page, name, text, PAGE)
    temporary = PAGE.with_suffix('.md.new')
    temporary.write_text(page)
    os.replace(temporary, PAGE)


if __name__ == '__main__':
    main()
