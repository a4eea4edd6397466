# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of doc/accuracy.md from the CSVs of benchmark_studies and benchmark_inference."""
import re
import statistics

import matplotlib.pyplot as plt
from matplotlib.ticker import NullFormatter

from accuracy_tables import (
    COLOURS, LINES, SETS, colour_of, group, label_of, markdown_table, mean_of, mean_over_sets, ordered_sets,
    ratio_of, save_plot, short)

# Panels of the sensitivity plot: the groups of adaptive_parameters.h.
PANELS = {
    'Tiles': ['levels', 'smallest-level', 'tile-tolerance', 'min-fill'],
    'Noise': ['noise-percentile', 'growth-percentile', 'max-growth', 'long-range',
              'flatness', 'max-flatness', 'flatness-noise',
              'quiet-flatness', 'min-sigma', 'local-reach',
              'local-percentile', 'max-local'],
    'Merging': ['merge-tolerance', 'region-tolerance', 'accept-tolerance', 'min-points',
                'min-evidence', 'join-tolerance', 'join-gap', 'join-seen'],
    'Curved surfaces': ['fan-parts', 'fan-angle', 'fan-share', 'fan-border', 'fan-gap', 'fan-ring',
                        'bend-angle'],
    'Random field': [],  # and all others
}


def pq_of(rows):
    return mean_over_sets(rows, lambda frames: mean_of(frames, 'pq'))


def of_study(rows, name):
    return [row for row in rows if row['study'] == name]


# --- block: ablation ------------------------------------------------------------------


def ablation_block(rows, _):
    variants = group(of_study(rows, 'ablation'), 'variant')
    if not variants:
        return None
    usual = variants['default']
    sets = ordered_sets(usual)
    header = ['switched off', 'mean PQ', 'change', 'mean ratio', 'noise', 'clutter'] + [
        SETS.get(name, name) for name in sets]
    lines = []
    for name, frames in variants.items():
        by_set = group(frames, 'set')
        change = pq_of(frames) - pq_of(usual)
        lines.append([
            'nothing' if frames is usual else name, short(pq_of(frames)),
            '' if frames is usual else signed(change),
            short(mean_over_sets(frames, ratio_of)),
            f'{mean_over_sets(frames, lambda f: mean_of(f, "noise")):.1f}',
            short(mean_over_sets(frames, lambda f: mean_of(f, 'clutter')))] + [
                short(mean_of(by_set[key], 'pq')) for key in sets])
    return markdown_table(header, lines)


def signed(value):
    text = short(abs(value))
    return text if text == '.000' else ('+' if value > 0 else '-') + text


# --- block: sensitivity ---------------------------------------------------------------


def parameters_of(rows):
    """Of each parameter its default and the mean PQ by its values."""
    variants = group(rows, 'variant')
    usual = pq_of(variants['default'])
    parameters = {}
    for variant, frames in variants.items():
        match = re.fullmatch(r'(\S+) (\S+) instead of (\S+)', variant)
        if match:
            name, value, default = match[1], float(match[2]), float(match[3])
            values = parameters.setdefault(name, (default, {default: usual}))[1]
            values[value] = pq_of(frames)
    return usual, parameters


def panel_of(parameter):
    return next((panel for panel, names in PANELS.items() if parameter in names),
                'Random field')


def plot_sensitivity(usual, parameters):
    figure, panels = plt.subplots(len(PANELS), 1, figsize=(8, 2.5 * len(PANELS)),
                                  sharex=True, layout='constrained')
    for panel, axes in zip(PANELS, panels):
        names = [name for name in parameters if panel_of(name) == panel]
        for k, name in enumerate(names):
            default, values = parameters[name]
            points = sorted(values.items())
            axes.plot([value / default for value, _ in points], [pq for _, pq in points],
                      '--' if k >= len(COLOURS) else '-', marker='.', label=name,
                      color=COLOURS[k % len(COLOURS)])
        axes.axhline(usual, color='gray', linewidth=0.6)
        axes.set_title(panel, fontsize=9, loc='left')
        axes.set_xlim(0.23, 4.3)
        axes.set_ylabel('mean PQ', fontsize=8)
        axes.set_ylim(usual - 0.2, usual + 0.03)  # what is below is far off anyway
        axes.grid(True, alpha=0.25)
        axes.legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=7)
    axes.set_xscale('log', base=2)
    axes.set_xticks([0.25, 0.5, 1, 2, 4])
    axes.xaxis.set_major_formatter('{x:g}')
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel('value over default')
    return save_plot(figure, 'sensitivity.png')


def sensitivity_block(rows, _):
    rows = of_study(rows, 'sensitivity')
    if not rows:
        return None
    usual, parameters = parameters_of(rows)
    plot_sensitivity(usual, parameters)
    lines = []
    for name, (default, values) in parameters.items():
        worst = min(values, key=values.get)
        best = max(values, key=lambda value: (values[value], value == default))
        lines.append([f'`{name}`', f'{default:g}', f'{min(values):g} to {max(values):g}',
                      f'{short(values[worst])} at {worst:g}',
                      f'{short(values[best])} at {best:g}'])
    return '\n'.join([
        markdown_table(['parameter', 'default', 'tried', 'least PQ', 'most PQ'], lines),
        '',
        '![Mean PQ over the value of each parameter](pictures/sensitivity.png)'])


# --- block: noise ---------------------------------------------------------------------


def noise_levels(rows, kind):
    """Mean PQ by level and method: the sets are called "kind level"."""
    levels = {}
    for (name, variant), frames in group(rows, 'set', 'variant').items():
        if name.split()[0] == kind:
            levels.setdefault(variant, {})[float(name.split()[1])] = mean_of(frames, 'pq')
    return levels


def plot_noise(axes, levels, label):
    for variant, values in levels.items():
        method, setting = variant.split()
        axes.plot(list(values), list(values.values()),
                  LINES.get(setting, '-'), marker='.', color=colour_of(method),
                  label=label_of(method, setting))
    axes.set_xlabel(label)
    axes.set_ylim(0, 1)
    axes.grid(True, alpha=0.25)


def noise_table(levels, unit):
    values = next(iter(levels.values()))
    return markdown_table(
        ['method'] + [f'{level:g}{unit}' for level in values],
        [[label_of(*variant.split())] + [short(pq) for pq in by_level.values()]
         for variant, by_level in levels.items()])


def noise_block(rows, _):
    rows = of_study(rows, 'noise')
    if not rows:
        return None
    kinds = {'kinect': ('noise of a Kinect v1, times', ' x'),
             'synpeb': ('noise along the ray of a SynPEB scan, mm', ' mm')}
    present = {kind: noise_levels(rows, kind) for kind in kinds}
    present = {kind: levels for kind, levels in present.items() if levels}
    figure, panels = plt.subplots(1, len(present), figsize=(3.5 + 3.5 * len(present), 3.6),
                                  sharey=True, squeeze=False, layout='constrained')
    for axes, (kind, levels) in zip(panels[0], present.items()):
        plot_noise(axes, levels, kinds[kind][0])
    panels[0][0].set_ylabel('panoptic quality')
    panels[0][-1].legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=8)
    save_plot(figure, 'noise.png')
    tables = [part for kind, levels in present.items()
              for part in (noise_table(levels, kinds[kind][1]), '')]
    return '\n'.join(tables + ['![Panoptic quality over noise](pictures/noise.png)'])


# --- block: inference -----------------------------------------------------------------


def gap(row):
    return row.number('energy') / row.number('bound') - 1


def percent(value):
    return f'{100 * value:.2f} %'


def plot_inference(rows):
    figure, axes = plt.subplots(figsize=(7, 3.8), layout='constrained')
    for (name, frames), colour in zip(group(rows, 'set').items(),
                                      COLOURS + ['black', 'gray']):
        means = {int(passes): 100 * statistics.mean(map(gap, same))
                 for passes, same in group(frames, 'passes').items() if passes != '0'}
        axes.plot(list(means), list(means.values()), marker='.', color=colour,
                  label=SETS.get(name, name))
    axes.set_xscale('log')
    axes.set_yscale('log')
    axes.set_xticks([1, 2, 3, 5, 10, 50])
    axes.xaxis.set_major_formatter('{x:g}')
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_formatter('{x:g}')
    axes.set_xlabel('passes')
    axes.set_ylabel('energy above the bound, %')
    axes.grid(True, which='both', alpha=0.25)
    axes.legend(bbox_to_anchor=(1.02, 1), loc='upper left', fontsize=8)
    return save_plot(figure, 'inference.png')


def inference_block(rows, _):
    plot_inference(rows)
    passes = list(group(rows, 'passes'))
    lines = []
    for name, frames in group(rows, 'set').items():
        by_passes = group(frames, 'passes')
        lines.append([SETS.get(name, name),
                      f'{100 * mean_of(frames, "active_share"):.0f} %'] +
                     [percent(statistics.mean(map(gap, by_passes[p]))) for p in passes])
    by_passes = group(rows, 'passes')
    for label, measure in (('mean of the frames', statistics.mean),
                           ('largest of a frame', max)):
        lines.append([label, ''] + [percent(measure(list(map(gap, by_passes[p]))))
                                    for p in passes])
    header = ['set', 'blocks with a choice'] + [
        f'{p} pass' if p == '1' else f'{p} passes' for p in passes]
    return '\n'.join([markdown_table(header, lines), '',
                      '![Energy above the bound over passes](pictures/inference.png)'])
