# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of doc/performance.md and README.md about real clouds of 640x480."""
import statistics

import matplotlib.pyplot as plt

from accuracy_tables import (
    METHODS, group, in_digits, is_ours, markdown_table, save_plot)
from performance_tables import PROFILES, fine

TOTALS = ('whole', 'processor')
GOALS = {'FAST': 1.6, 'DEFAULT': 5.0}  # milliseconds
LABEL_GOALS = {10: 10.0, 40: 20.0}  # the same, of PAPER by the number of labels
THREAD_GOALS = {'DEFAULT': '1.7', '10': '1.7'}  # times as fast; a number: PAPER's labels
STAGE_COLOURS = plt.get_cmap('tab20').colors


def times_of(rows):
    return [row.number('milliseconds') for row in rows]


def spread(times):
    return [in_digits(value) if value >= 10 else fine(value)
            for value in (statistics.median(times), min(times), max(times))]


# --- block: stages --------------------------------------------------------------------


def stage_medians(rows):
    """Median over the clouds by profile and stage, in the order of the stages. A stage
    that a cloud did not come to (there were no planes) took no time."""
    clouds = len(group(rows, 'set', 'frame'))
    medians = {}
    for profile, profile_rows in group(rows, 'profile').items():
        times = {stage: times_of(values)
                 for stage, values in group(profile_rows, 'stage').items()}
        medians[profile] = {
            stage: statistics.median(values + [0.0] * (clouds - len(values)))
            for stage, values in times.items()}
    return medians


def plot_stages(medians, stages, pictures):
    figure, axes = plt.subplots(figsize=(9, 2.8), layout='constrained')
    profiles = list(reversed(medians))
    left = [0.0] * len(profiles)
    for stage, colour in zip(stages, STAGE_COLOURS):
        values = [medians[profile].get(stage, 0.0) for profile in profiles]
        axes.barh(profiles, values, left=left, color=colour, label=stage)
        left = [a + b for a, b in zip(left, values)]
    axes.set_xlabel('milliseconds at 640x480, one thread, medians of the clouds')
    axes.grid(True, axis='x', alpha=0.25)
    axes.legend(bbox_to_anchor=(1.01, 1), loc='upper left', fontsize=8)
    save_plot(figure, 'performance_stages.png', pictures)


def longest_sentence(profile, stages):
    total = sum(stages.values())
    first, second = sorted(stages, key=stages.get, reverse=True)[:2]
    return (f'The longest stage of {profile} is {first} '
            f'({100 * stages[first] / total:.0f} %), then {second} '
            f'({100 * stages[second] / total:.0f} %).')


def stages_block(rows, pictures):
    all_medians = stage_medians(rows)
    medians = {profile: {stage: ms for stage, ms in stages.items() if stage not in TOTALS}
               for profile, stages in all_medians.items()}
    # Those of the profile with the most stages first; the output comes last.
    stages = list(dict.fromkeys(
        stage for profile in sorted(medians, key=lambda p: -len(medians[p]))
        for stage in medians[profile] if stage != 'output')) + ['output']
    plot_stages(medians, stages, pictures)
    points = statistics.median(row.number('points') for row in rows)
    lines = []
    for stage in stages:
        cells = [medians[p].get(stage) for p in medians]
        lines.append([stage] + [f'{fine(ms)} ({1e6 * ms / points:.1f})' if ms is not None
                                else '' for ms in cells])
    wholes = [all_medians[profile]['processor'] for profile in medians]
    lines.append(['whole'] + [f'{fine(ms)} ({1e6 * ms / points:.1f})' for ms in wholes])
    clouds = len(group(rows, 'set', 'frame'))
    return '\n'.join([
        f'Median over {clouds} clouds in ms, and in ns a point:', '',
        markdown_table(['stage'] + list(medians), lines), '',
        *[longest_sentence(profile, medians[profile]) for profile in medians], '',
        '![Time of the stages](pictures/performance_stages.png)'])


def goals_block(rows):
    lines = []
    for profile in PROFILES:
        wholes = [row for row in rows
                  if row['profile'] == profile and row['stage'] == 'processor']
        if wholes:
            planes = [row.number('planes') for row in wholes]
            lines.append([profile, f'{GOALS[profile]:g} ms' if profile in GOALS else ''] +
                         spread(times_of(wholes)) +
                         [f'{statistics.median(planes):g}', str(planes.count(0.0))])
    clouds = len(group(rows, 'set', 'frame'))
    return '\n'.join([
        f'One object for all {clouds} clouds, processor time in ms:', '',
        markdown_table(['profile', 'goal', 'median', 'least', 'most', 'planes, median',
                        'clouds without planes'], lines)])


# --- block: cloud labels --------------------------------------------------------------


def labels_block(rows):
    """Profile PAPER by the number of labels, which stands for the profile."""
    wholes = {int(labels): {(row['set'], row['frame']): row.number('milliseconds')
                            for row in numbered if row['stage'] == 'processor'}
              for labels, numbered in group(rows, 'profile').items()}
    few, many = min(wholes), max(wholes)
    lines = [[str(labels), f'{LABEL_GOALS[labels]:g} ms' if labels in LABEL_GOALS else '',
              str(len(times)), *spread(list(times.values()))]
             for labels, times in sorted(wholes.items())]
    ratios = [ms / wholes[few][cloud] for cloud, ms in wholes[many].items()]
    return '\n'.join([
        markdown_table(['labels', 'goal', 'clouds', 'median ms', 'least', 'most'], lines),
        '', f'On the same cloud {many} labels take {statistics.median(ratios):.1f} times as '
        f'long as {few}, median.'])


# --- block: cloud threads -------------------------------------------------------------


def threads_block(rows):
    """How many times as fast two threads are on clouds where there is something to label; a
    number stands for PAPER with so many labels."""
    lines = []
    for profile, of_profile in group(rows, 'profile').items():
        clouds = [{row['threads']: row.number('milliseconds') for row in runs}
                  for runs in group(of_profile, 'set', 'frame').values()
                  if runs[0].number('planes')]
        if not clouds:
            continue
        ratios = [times['1'] / times['2'] for times in clouds]
        lines.append(
            [f'PAPER, {profile} labels' if profile.isdigit() else profile,
             THREAD_GOALS.get(profile, ''), str(len(clouds))] +
            [fine(statistics.median(times[n] for times in clouds)) for n in ('1', '2')] +
            [fine(ratio) for ratio in (statistics.median(ratios), min(ratios), max(ratios))])
    return markdown_table(['profile', 'goal', 'clouds', 'one thread, ms', 'two threads, ms',
                           'times as fast, median', 'least', 'most'], lines)


# --- blocks: peers, and speed of README.md ----------------------------------------------


def of_one_size(rows):
    """Those of 640x480, or all when there is none such."""
    return [row for row in rows
            if (row['width'], row['height']) == ('640', '480')] or rows


def by_method(rows):
    """Rows by (method, setting), the fastest first."""
    methods = group(rows, 'method', 'setting')
    return dict(sorted(methods.items(),
                       key=lambda item: statistics.median(times_of(item[1]))))


def peers_block(rows):
    rows = of_one_size(rows)
    methods = by_method(rows)
    fast = statistics.median(times_of(methods['mrf_planes', 'fast']))
    lines = []
    for (method, setting), frames in methods.items():
        times = times_of(frames)
        lines.append([METHODS.get(method, method), setting] + spread(times) +
                     [f'{statistics.median(times) / fast:.1f}'])
    count = len(group(rows, 'set', 'frame'))
    return '\n'.join([
        f'{count} clouds, a new object for each, processor time in ms:', '',
        markdown_table(['method', 'setting', 'median', 'least', 'most',
                        'times FAST'], lines)])


def published_quality(accuracy_page):
    """Mean PQ by (method, setting) as the page about accuracy states it."""
    text = accuracy_page.read_text()
    block = text.partition('<!-- begin peers -->')[2].partition('<!-- end peers -->')[0]
    lines = [[cell.strip() for cell in line.strip('|').split('|')]
             for line in block.splitlines() if line.startswith('| ')]
    if not lines:
        return {}
    column = lines[0].index('mean PQ')
    return {tuple(line[:2]): line[column] for line in lines[2:]}


def readme_title(method, setting):
    if is_ours(method):
        return f'profile {setting.upper()}'
    return f'{METHODS.get(method, method)}, {setting}'


def readme_block(rows, machine, accuracy_page):
    rows = of_one_size(rows)
    quality = published_quality(accuracy_page)
    lines = []
    for (method, setting), frames in by_method(rows).items():
        if not is_ours(method) and setting == 'published':
            continue
        lines.append([readme_title(method, setting)] + spread(times_of(frames)) +
                     [quality.get((METHODS.get(method, method), setting), '')])
    count = len(group(rows, 'set', 'frame'))
    return '\n'.join([
        f'One core of {machine.get("processor", "")}, {machine.get("compiler", "")}, '
        f'640x480: processor milliseconds from organized points to planes and labels over '
        f'{count} frames of real depth cameras, all methods in one run.', '',
        markdown_table(['', 'median ms', 'least', 'most', 'quality'], lines)])
