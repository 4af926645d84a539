#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tables.py FILE|FOLDER...: checks that other programs load every .tsv file without options (pandas.read_csv(file, sep='\\t')).

The files are read with the csv module and, if it is installed, with pandas. The first line must be the header, whose names must be
distinct and not empty. Every line must have as many cells as the header. A column whose name ends with a unit must contain only
numbers and empty cells, and so must every column in which most cells are numbers. Exit code 1 if a file violates this.
"""
import csv
import os
import re
import sys

try:
    import pandas
except ImportError:
    pandas = None

UNIT = re.compile(r'_(mm|mm2|cm2|ml|N|kPa|Pa|percent|s|seconds|mb|deg)$')
# Columns with values of several kinds, which a reader looks up by name (None: all columns of the file).
MIXED = {'verify.tsv': {'expected', 'computed', 'tolerance'}, 'table8.tsv': None}


def is_number(cell):
    try:
        float(cell)
        return True
    except ValueError:
        return False


def numeric_columns(file, header, rows):
    """The names of the columns of numbers, and a problem for each such column that contains a word."""
    mixed = MIXED.get(os.path.basename(file), set())
    found, problems = [], []
    for c, name in enumerate(header):
        cells = [row[c] for row in rows if row[c] != '']
        numbers = sum(map(is_number, cells))
        if mixed is None or name in mixed or not cells:
            continue
        if numbers == len(cells):
            found.append(name)
        elif UNIT.search(name) or 2 * numbers > len(cells):
            word = next(cell for cell in cells if not is_number(cell))
            problems.append("column %s holds '%s'" % (name, word))
    return found, problems


def problems_of(file):
    with open(file, newline='', encoding='utf-8') as lines:
        table = [row for row in csv.reader(lines, delimiter='\t') if row]
    if not table:
        return ['holds no table']
    header, rows = table[0], table[1:]
    problems = []
    if len(set(header)) != len(header) or '' in header:
        problems.append('a name of the header is empty or stands there twice')
    if header[0].startswith('#'):
        problems.append('begins with a comment')
    for number, row in enumerate(rows, 2):
        if len(row) != len(header):
            problems.append('line %d has %d cells, the header %d' % (number, len(row), len(header)))
    if problems:
        return problems
    numbers, problems = numeric_columns(file, header, rows)
    if pandas is not None:
        loaded = pandas.read_csv(file, sep='\t')
        if list(loaded.columns) != header or len(loaded) != len(rows):
            problems.append('pandas loads it otherwise')
        problems += ['pandas takes %s for text' % name for name in numbers if loaded[name].dtype.kind not in 'iuf']
    return problems


def tables_in(place):
    if not os.path.isdir(place):
        yield place
        return
    for folder, _, names in os.walk(place):
        for name in sorted(names):
            # An empty file marks a result that does not exist.
            if name.endswith('.tsv') and os.path.getsize(os.path.join(folder, name)) > 0:
                yield os.path.join(folder, name)


def main():
    files = [file for place in sys.argv[1:] for file in tables_in(place)]
    wrong = [(file, problem) for file in files for problem in problems_of(file)]
    for file, problem in wrong:
        print('%s: %s' % (file, problem))
    if not files:
        print('no table in', *sys.argv[1:])
    print('%d tables%s, %d problems' % (len(files), '' if pandas is None else ', also with pandas', len(wrong)))
    return 1 if wrong or not files else 0


sys.exit(main())
