# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of doc/performance.md about generated rooms."""
import matplotlib.pyplot as plt

from accuracy_tables import COLOURS, group, markdown_table, save_plot
from performance_tables import (
    INSTRUCTION_SETS, PAPER_10, PROFILES, VGA, camera_times, exponent, fine, in_order,
    megabytes, parts_of, points_of, shape_title, shapes_of, title_of)

PIPELINES = PROFILES + [PAPER_10]
FLOORS = {'read': 'sum of all coordinates of the cloud',
          'load': 'the cloud into planes of x, y, z and validity',
          'sums': 'the ten sums of all 4x4 cells'}


def slope_title(name, variable, pairs):
    """FAST: points^0.9"""
    return f'{name}: {variable}^{exponent(pairs):.2f}' if len(pairs) > 1 else name


# --- block: points --------------------------------------------------------------------


def pipeline_cell(times, profile, shape):
    """Milliseconds on one thread, and the planes found."""
    name = f'pipeline/{profile}/{shape}/threads:1'
    if not times.has(name):
        return ''
    planes = times.number(name, 'planes')
    return f'{fine(times.processor(name))} ({planes:.0f})'


def exponent_cell(times, profile):
    pairs = camera_times(times, profile)
    return f'{exponent(pairs):.2f}' if len(pairs) > 1 else ''


def plot_points(times, pictures):
    figure, axes = plt.subplots(figsize=(8, 4.4), layout='constrained')
    for profile, colour in zip(PIPELINES, COLOURS):
        pairs = camera_times(times, profile)
        if not pairs:
            continue
        axes.plot(*zip(*pairs), '.-', color=colour,
                  label=slope_title(title_of(profile), 'points', pairs))
        for shape in shapes_of(times, 'pipeline'):
            name = f'pipeline/{profile}/{shape}/threads:1'
            if shape.startswith('lidar') and times.has(name):
                axes.plot(points_of(shape), times.processor(name), 'x', color=colour)
    floor = [(points_of(shape), times.processor(f'floor/sums/{shape}'))
             for shape in shapes_of(times, 'floor') if shape.startswith('camera')]
    if floor:
        axes.plot(*zip(*floor), ':', color='grey', label='ten sums of the cells')
    axes.set(xscale='log', yscale='log', xlabel='points (x: lidar)',
             ylabel='milliseconds, one thread')
    axes.grid(True, which='both', alpha=0.25)
    axes.legend(fontsize=8)
    save_plot(figure, 'performance_points.png', pictures)


def points_block(times, pictures):
    shapes = shapes_of(times, 'pipeline')
    if not shapes:
        return None
    plot_points(times, pictures)
    lines = [[shape_title(shape), str(points_of(shape))] +
             [pipeline_cell(times, profile, shape) for profile in PIPELINES]
             for shape in shapes]
    lines.append(['exponent', ''] +
                 [exponent_cell(times, profile) for profile in PIPELINES])
    return '\n'.join([
        markdown_table(['size', 'points'] + [title_of(p) for p in PIPELINES], lines), '',
        '![Time over the number of points](pictures/performance_points.png)'])


# --- block: threads -------------------------------------------------------------------


def speed_up(times, profile, shape):
    """How many times as fast two threads are, by the clock; None: was not measured."""
    one, two = (f'pipeline/{profile}/{shape}/threads:{n}' for n in (1, 2))
    if not (times.has(one) and times.has(two)) or not times.number(one, 'planes'):
        return None
    return times.clock(one) / times.clock(two)


def threads_block(times):
    lines = []
    for shape in shapes_of(times, 'pipeline'):
        gains = [speed_up(times, profile, shape) for profile in PIPELINES]
        lines.append([shape_title(shape)] +
                     [f'{gain:.2f}' if gain else '' for gain in gains])
    return markdown_table(['size'] + [title_of(p) for p in PIPELINES], lines) \
        if lines else None


# --- block: labels --------------------------------------------------------------------


def whole_paper(times):
    """Milliseconds by (labels, iterations) on one thread."""
    found = {}
    for name in times.names():
        if name.startswith('paper/whole/'):
            _, values = parts_of(name)
            if values['threads'] == '1':
                key = int(values['labels']), int(values['iterations'])
                found[key] = times.processor(name)
    return found


def iterations_title(count):
    return '1 iteration' if count == 1 else f'{count} iterations'


def plot_labels(found, iterations, pictures):
    figure, axes = plt.subplots(figsize=(8, 4), layout='constrained')
    for count, colour in zip(iterations, COLOURS):
        pairs = sorted((labels, ms) for (labels, t), ms in found.items() if t == count)
        axes.plot(*zip(*pairs), '.-', color=colour,
                  label=slope_title(iterations_title(count), 'labels', pairs))
    axes.set(xscale='log', yscale='log', xlabel='labels',
             ylabel='milliseconds at 640x480, one thread')
    ticks = sorted({labels for labels, _ in found})
    axes.set_xticks(ticks, [str(tick) for tick in ticks], minor=False)
    axes.set_xticks([], minor=True)
    axes.grid(True, which='both', alpha=0.25)
    axes.legend(fontsize=8)
    save_plot(figure, 'performance_labels.png', pictures)


SCHEDULES = {'sweep': 'one sweep, 16-bit integers (this library)',
             'plain_schedule': 'the same kernels, one iteration after the other',
             'plain_float': 'plain float code'}


def schedule_lines(times):
    """Milliseconds: processor time of one thread, time by the clock of more."""
    lines = []
    for name in times.names():
        what, values = parts_of(name) if name.startswith('paper/') else ('', {})
        if what in SCHEDULES:
            one = values['threads'] == '1'
            lines.append((list(SCHEDULES).index(what), int(values['labels']),
                          int(values['threads']),
                          times.processor(name) if one else times.clock(name)))
    return [[list(SCHEDULES.values())[order], str(labels), str(threads), fine(ms)]
            for order, labels, threads, ms in sorted(lines)]


def labels_block(times, pictures):
    found = whole_paper(times)
    if not found:
        return None
    iterations = sorted({count for _, count in found})
    plot_labels(found, iterations, pictures)
    labels = sorted({count for count, _ in found})
    lines = [[str(count)] + [fine(found[count, t]) if (count, t) in found else ''
                             for t in iterations] for count in labels]
    text = [markdown_table(['labels'] + [iterations_title(t) for t in iterations], lines),
            '', '![Time over the number of labels](pictures/performance_labels.png)']
    schedules = schedule_lines(times)
    if schedules:
        text += ['', 'Field and propagation alone, 5 iterations:', '',
                 markdown_table(['schedule', 'labels', 'threads', 'ms'], schedules)]
    return '\n'.join(text)


# --- block: floors --------------------------------------------------------------------


def floors_block(times):
    shapes = shapes_of(times, 'floor')
    if not shapes:
        return None
    shape = VGA if VGA in shapes else shapes[0]
    passes = {what: times.processor(f'floor/{what}/{shape}') for what in FLOORS}
    lines = [[FLOORS[what], fine(ms), f'{1e6 * ms / points_of(shape):.2f}', '']
             for what, ms in passes.items()]
    both = passes['load'] + passes['sums']
    for profile in PIPELINES:
        name = f'pipeline/{profile}/{shape}/threads:1'
        if times.has(name):
            ms = times.processor(name)
            lines.append([f'profile {title_of(profile)}', fine(ms),
                          f'{1e6 * ms / points_of(shape):.2f}', f'{ms / both:.1f}'])
    return '\n'.join([f'At {shape_title(shape)}:', '', markdown_table(
        ['pass', 'ms', 'ns a point', 'times planes and sums'], lines)])


# --- block: instructions --------------------------------------------------------------


def instructions_block(times):
    found = {tuple(name.split('/')[1:3]): times.processor(name)
             for name in times.names() if name.startswith('instructions/')}
    if not found:
        return None
    sets = in_order({name for _, name in found}, INSTRUCTION_SETS)
    titles = {'load': 'reading into planes', 'sums': 'ten sums of the cells',
              'sweep': 'field and propagation, PAPER, 10 labels'}
    lines = [[titles.get(what, f'profile {what}')] +
             [fine(found[what, name]) if (what, name) in found else '' for name in sets]
             for what in in_order({what for what, _ in found}, [*titles, *PROFILES])]
    return markdown_table(['ms at 640x480'] + sets, lines)


# --- block: memory --------------------------------------------------------------------


def memory_block(memory):
    lines = []
    for name in memory.names():
        _, profile, shape = name.split('/')[:3]
        value = lambda column, n=name: memory.number(n, column)  # noqa: E731
        lines.append([profile, shape_title(shape), megabytes(value('cloud_bytes')),
                      megabytes(value('most_held_bytes')),
                      megabytes(value('resident_bytes')),
                      f'{value("frame_allocations"):.0f}',
                      megabytes(value('frame_bytes'))])
    return markdown_table(['profile', 'size', 'cloud, MB', 'most held, MB',
                           'peak resident, MB', 'allocations a frame',
                           'allocated a frame, MB'], lines)


# --- block: goals ---------------------------------------------------------------------


def label_goals(times):
    found = whole_paper(times)
    if (10, 5) in found:
        yield ['PAPER, 10 labels, 5 iterations, 640x480', 'at most 10 ms',
               f'{fine(found[10, 5])} ms']
        if (40, 5) in found:
            yield ['the same with 40 labels', 'at most 2 times as long',
                   f'{found[40, 5] / found[10, 5]:.1f} times']


def thread_goals(times):
    for profile in (PAPER_10, 'DEFAULT'):
        gain = speed_up(times, profile, VGA)
        if gain:
            yield [f'{title_of(profile)}, two threads, 640x480',
                   'at least 1.7 times as fast', f'{gain:.2f} times']


def point_goals(times):
    for profile in ('FAST', 'DEFAULT', PAPER_10):
        pairs = camera_times(times, profile)
        if len(pairs) > 1:
            yield [f'{title_of(profile)}, growth with points', 'exponent at most 1',
                   f'{exponent(pairs):.2f}']


def memory_goals(memory):
    for profile in PROFILES:
        name = f'memory/{profile}/{VGA}'
        if memory.has(name):
            yield [f'{profile}, working memory beyond the cloud, 640x480', 'at most 32 MB',
                   f'{megabytes(memory.number(name, "most_held_bytes"))} MB']
            yield [f'{profile}, allocations a frame after the first', 'none',
                   f'{memory.number(name, "frame_allocations"):.0f}']


def goals_block(times, memory):
    lines = [*label_goals(times), *thread_goals(times), *point_goals(times),
             *memory_goals(memory)]
    return markdown_table(['what', 'goal', 'measured'], lines)


# --- block: counts --------------------------------------------------------------------


def counts_block(rows):
    """Instructions and bytes a point by stage and profile."""
    profiles = group(rows, 'profile')
    counts = {name: {row['stage']: (row.number('instructions'), row.number('bytes'))
                     for row in stages} for name, stages in profiles.items()}
    # The stages of the profile with the most of them come first.
    stages = dict.fromkeys(stage for name in sorted(counts, key=lambda n: -len(counts[n]))
                           for stage in counts[name])
    lines = [[stage] + [f'{counts[name][stage][0]:.1f} ({counts[name][stage][1]:.0f})'
                        if stage in counts[name] else '' for name in counts]
             for stage in stages]
    wholes = [[sum(column) for column in zip(*counts[name].values())] for name in counts]
    lines.append(['all'] + [f'{instructions:.0f} ({fetched:.0f})'
                            for instructions, fetched in wholes])
    return '\n'.join([
        'Instructions a point on the generated room, and in brackets bytes a point that pass '
        'between the', 'first cache (32 KiB) and what lies behind it:', '',
        markdown_table(['stage'] + [title_of(name) for name in counts], lines)])
