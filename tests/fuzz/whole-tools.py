#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""whole-tools.py BIN INPUTS [COUNT [FORMAT...]]: damages small valid files of every format and gives each to the
tool that reads it, COUNT times a format (default 2000). BIN holds the programs (of the preset readers: build/readers/bin),
INPUTS the files that the program fault_inputs wrote. The whole files come first, and each must be accepted: a refusal would
keep every damaged one from the reader. A run is a finding when it ends by a signal or with another exit code than 0 to 3,
when a failure says anything but one line, takes over 10 s of processor time (or 120 s of the clock, for one that waits for
ever; BREAST_WAIT_S sets another limit, for machines with other work), or over 1 GB (4 GB under sanitizers), leaves a file it
was not asked for, or a sanitizer speaks, also in the process that reads for it. Findings are kept, with what was said, in
INPUTS/findings, and a row a format is added to INPUTS/fuzz.tsv (columns of docs/tables/fuzz.tsv); exit 1 when there is a
finding.
Case files are read on behalf of make (python/breast/cases) and are fuzzed here: `make -n` plans the
chain of a damaged one, with the programs in BIN and, for those it has not, of build/release. What share of
the damaged files was accepted is a column of the table: near 0 or 100, the damage reaches too little or changes nothing. A file
whose program was not built is left out with a line, and the row does not name that program. SIGTERM ends a campaign early: the
row says how many inputs there were; BREAST_FIRST_INPUT=n continues it, with the damage of the n-th input and after.
BIN/released-objects.txt, where there is one, states which objects of these programs are without sanitizers. No more than the
standard library is needed.
"""
import base64
import glob
import gzip
import hashlib
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import zlib

BIN, INPUTS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 2000
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FIRST = int(os.environ.get('BREAST_FIRST_INPUT', '0'))
SANITIZED = b'__asan_init' in open(os.path.join(BIN, 'probe'), 'rb').read()
MOST_KB = (4 if SANITIZED else 1) * 1024 * 1024
PARTLY = os.path.exists(os.path.join(BIN, 'released-objects.txt'))
HANG_S, WAIT_S = 60 if SANITIZED else 10, int(os.environ.get('BREAST_WAIT_S', '120'))

NUMBERS = [b'0', b'-1', b'1e308', b'-1e-308', b'nan', b'inf', b'2147483648', b'18446744073709551615', b'99999999999', b'1e9',
           b'0.0000001', b'', b'x']
COMMANDS = [b'$(shell touch executed)', b'`touch executed`', b'$$(touch executed)', b';touch executed;', b'$(file > executed)',
            b'\n\ttouch executed\n', b'$(eval x != touch executed)', b'\n-include executed\n', b'| touch executed', b'$(MAKE)',
            b"'; touch executed #", b'\nX != touch executed\n']
VALUES = [0.0, -1.0, 1e308, -1e300, 1e-300, 1e9, float('nan'), float('inf')]
BYTES = [b'\x00', b'\xff', b'\x7f', b'\x80', b'\n', b'"', b'<', b'\xe2\x80\xa8']


def damaged_text(r, data):
    """Numbers exchanged, lines dropped, doubled or moved, and then what damaged_bytes does."""
    for _ in range(r.randint(1, 3)):
        kind = r.randrange(5)
        lines = data.split(b'\n')
        if kind == 0:
            places = [m.span() for m in re.finditer(rb'-?\d+\.?\d*(?:[eE][-+]?\d+)?', data[:100000])]
            if places:
                a, b = r.choice(places)
                data = data[:a] + r.choice(NUMBERS) + data[b:]
        elif kind == 1 and len(lines) > 1:
            del lines[r.randrange(len(lines))]
            data = b'\n'.join(lines)
        elif kind == 2:
            lines.insert(r.randrange(len(lines)), r.choice(lines))
            data = b'\n'.join(lines)
        elif kind == 3:
            words = [m.span() for m in re.finditer(rb'[A-Za-z_]+', data[:100000])]
            if words:
                (a, b), (c, d) = r.choice(words), r.choice(words)
                data = data[:a] + data[c:d] + data[b:]
        else:
            data = damaged_bytes(r, data)
    return data


def damaged_bytes(r, data):
    """A few bytes, a block, an integer of 2 to 8 bytes, or the end."""
    data = bytearray(data)
    for _ in range(r.choice([1, 1, 1, 2, 4, 16])):
        if not data:
            break
        # Headers are where the decisions are.
        at = r.randrange(len(data)) if r.random() < 0.5 else r.randrange(min(len(data), 4096))
        kind = r.randrange(7)
        if kind == 0:
            data[at] ^= 1 << r.randrange(8)
        elif kind == 1:
            data[at] = r.randrange(256)
        elif kind == 2:
            size = r.choice([2, 4, 8])
            value = r.choice([0, 1, -1, 1 << (8 * size - 1), (1 << (8 * size - 1)) - 1, r.getrandbits(8 * size)])
            data[at:at + size] = (value % (1 << (8 * size))).to_bytes(size, r.choice(['little', 'big']))
        elif kind == 3:
            del data[at:at + r.choice([1, 2, 8, 100, 5000])]
        elif kind == 4:
            data[at:at] = r.choice([bytes(data[at:at + r.choice([4, 64, 1000])]), b'\x00' * 64, r.choice(BYTES)])
        elif kind == 5 and r.random() < 0.3:
            del data[at:]
        else:
            data[at:at + 1] = r.choice(BYTES)
    return bytes(data)


def damaged_values(r, data, kind):
    """A few of the numbers between 0.001 and 10000 in it, that is, coordinates, stated in the right form."""
    data, size = bytearray(data), struct.calcsize(kind)
    for _ in range(r.choice([1, 1, 4, 64])):
        for _ in range(100):  # other bytes are no numbers
            at = size * r.randrange(max(len(data) // size, 1))
            if at + size > len(data):
                break
            value, = struct.unpack_from(kind, data, at)
            if 1e-3 < abs(value) < 1e4:
                other = r.choice(VALUES + [-value, 1.01 * value, 1.5 * value, value + 5])
                other = float('inf') if kind == '<f' and abs(other) > 3e38 else other
                struct.pack_into(kind, data, at, other)
                break
    return bytes(data)


def hdf5(r, data):
    """The bytes before the checksum of ours, which is then right again, or is left out."""
    mark = data.rfind(b'libbreast sha256')
    body = data[:mark] if mark >= 0 else data
    body = damaged_values(r, body, '<d') if r.random() < 0.4 else damaged_bytes(r, body)
    return body + b'libbreast sha256' + hashlib.sha256(body).hexdigest().encode() if r.random() < 0.7 else body


def gzipped(r, data):
    if r.random() < 0.3:
        return damaged_bytes(r, data)
    return gzip.compress(damaged_bytes(r, gzip.decompress(data)), 1)


def halves(words):
    """The two base64 texts of a compressed array: its sizes, and its blocks."""
    end = words.find(b'=')
    end = len(words) if end < 0 else len(words) - len(words[end:].lstrip(b'='))
    return words[:end], words[end:]


def other_values(r, words, kind):
    """A compressed array with other values in it, packed again into one block."""
    first, rest = (base64.b64decode(half) for half in halves(words))
    values, at = b'', 0
    for size in struct.unpack('<%dI' % (len(first) // 4), first)[3:]:
        values += zlib.decompress(rest[at:at + size])
        at += size
    packed = zlib.compress(damaged_values(r, values, kind))
    sizes = struct.pack('<4I', 1, len(values), 0, len(packed))
    return base64.b64encode(sizes) + base64.b64encode(packed)


def vtk_xml(r, data):
    """Text, or one of the compressed arrays: its values, its sizes or its bytes; without the checksum of ours."""
    data = re.sub(rb'<!-- sha256.*?-->\n?', b'', data, flags=re.S)
    arrays = [m.span(1) for m in re.finditer(rb'>\s*([A-Za-z0-9+/=]{16,})\s*<', data)]
    if not arrays or r.random() < 0.4:
        return damaged_text(r, data)
    a, b = r.choice(arrays)
    way = r.randrange(3)
    try:
        if way == 0:
            array = other_values(r, data[a:b], '<d' if data[:a].rfind(b'Float64') > data[:a].rfind(b'<DataArray') else '<f')
        else:
            texts = list(halves(data[a:b]))
            texts[way - 1] = base64.b64encode(damaged_bytes(r, base64.b64decode(texts[way - 1])))
            array = b''.join(texts)
    except (ValueError, struct.error, zlib.error):  # no such array
        return damaged_bytes(r, data)
    return data[:a] + array + data[b:]


def case_text(r, data):
    """Text, also with what make or a shell would run."""
    for _ in range(r.choice([0, 1, 2])):
        at = r.randrange(len(data) + 1)
        data = data[:at] + r.choice(COMMANDS) + data[at:]
    return data if r.random() < 0.3 else damaged_text(r, data)


LABELS = 'evaluate IN/tiny_labels.vtkhdf BAD'
HEXMESH = 'hexmesh %s IN/labels.vtkhdf out.vtkhdf --elements 4 --accept-mismatch'
DECK = 'export-deck IN/cap_reference.vtkhdf out.vtkhdf --read-back BAD'
MATERIALS = os.path.join(ROOT, 'pipelines/materials/')
# format -> damage and (seed, tool and its arguments, in how many of so many inputs): BAD is the damaged file, IN/NAME a whole one,
# FOLDER a copy of the seed's folder with the damaged file in it, RUN a run of the pipeline, of which it is a part.
FORMATS = {
    'mesh': (hdf5, [(n, 'probe BAD', 1) for n in ('mesh.vtkhdf', 'cc.vtkhdf', 'cap_supine.vtkhdf')]),
    'labels': (hdf5, [('tiny_labels.vtkhdf', 'evaluate BAD IN/tiny_labels.vtkhdf', 1)]),
    'geometry': (hdf5, [('geometry.vtkhdf', HEXMESH % 'BAD', 1)]),
    'nrrd': (damaged_text, [('tiny.nrrd', LABELS, 15), ('tiny_raw.nrrd', LABELS, 15),
                            ('scan.nrrd', 'segment BAD out.nrrd --side left', 1)]),
    'segmentation': (damaged_text, [('tiny.seg.nrrd', LABELS, 1)]),
    'markups': (damaged_text, [('points.mrk.json', HEXMESH % 'IN/geometry.vtkhdf' + ' --tumour BAD', 1)]),
    'nifti': (damaged_bytes, [('tiny.nii', LABELS, 1)]),
    'nifti_gz': (gzipped, [('tiny.nii.gz', LABELS, 1)]),
    'meta': (damaged_text, [('tiny.mha', LABELS, 1)]),
    'dicom_series': (damaged_bytes, [('tiny_series/slice_0002.dcm', 'evaluate IN/tiny_labels.vtkhdf FOLDER', 30),
                                     ('series/slice_0015.dcm', 'segment FOLDER out.nrrd --side left', 1)]),
    'dicom_mammogram': (damaged_bytes, [('cc.dcm', 'cc2mlo IN/cc.vtkhdf IN/mlo.vtkhdf out.vtp --point 20,37 --cc-image BAD '
                                                   '--mlo-image IN/mlo.dcm', 1)]),
    'vti': (vtk_xml, [('cc.vti', 'pairs tabulate --check=cc.vtkhdf=IN/cc.vtkhdf --check=cc.vti=BAD', 1)]),
    'vtp': (vtk_xml, [('skin.vtp', LABELS, 1), ('curve.vtp', 'export-slicer RUN out --no-fields', 1)]),
    'table': (damaged_text, [('landmarks.tsv', 'truth-table BAD out.tsv IN/cc.vtkhdf IN/fine_cc.vtkhdf', 1)]),
    'materials': (damaged_text, [(MATERIALS + n, 'laws BAD', 1) for n in ('seed2008.tsv', 'victre.tsv')]),
    'calculix_frd': (damaged_text, [('result.frd', DECK, 1)]),
    'calculix_dat': (damaged_text, [('result.dat', DECK, 1)]),
    'febio_log': (damaged_text, [('result.log', DECK, 1)]),
    'case_file': (case_text, [('patient.case', 'make', 1)]),
}


def built(program):
    return os.path.exists(os.path.join(BIN, 'cases' if program == 'make' else program))


def ending(name):
    return next((e for e in ('.nii.gz', '.seg.nrrd', '.mrk.json') if name.endswith(e)), os.path.splitext(name)[1])


def folder_with(work, name, files, bad, place):
    """The folder `name` with copies of `files`, and the damaged one at `place`."""
    folder = os.path.join(work, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for file in files:
        shutil.copy(file, folder)
    shutil.move(bad, os.path.join(folder, place))
    return folder


def command(line, seed, bad, work):
    if line == 'make':  # planned only; a file called executed would show that something in it ran
        os.symlink(INPUTS + '/scan.nrrd', work + '/out/scan.nrrd')
        return ['make', '-f', ROOT + '/Makefile.pipeline', '-n', 'RUNS=' + work + '/runs', 'CASE_FILE=' + bad, 'chain']
    if 'FOLDER' in line:
        files = glob.glob(os.path.dirname(seed) + '/*')
        line = line.replace('FOLDER', folder_with(work, 'series', files, bad, os.path.basename(seed)))
    if 'RUN' in line:
        files = [INPUTS + '/labels.vtkhdf', INPUTS + '/mesh.vtkhdf']
        line = line.replace('RUN', folder_with(work, 'run', files, bad, os.path.basename(seed)))
    words = line.replace('IN/', INPUTS + '/').replace('BAD', bad).split()
    return [os.path.join(BIN, words[0])] + words[1:] + ['--quiet', '--threads', '1']


def all_programs(work):
    """A folder of what the pipeline needs: the programs in BIN, and of build/release what is not there."""
    folder = work + '/bin'
    os.makedirs(folder)
    for place in (BIN, ROOT + '/build/release/bin'):
        for program in glob.glob(place + '/*'):
            link = os.path.join(folder, os.path.basename(program))
            if not os.path.lexists(link):
                os.symlink(program, link)
    return folder


def run(words, work):
    """Exit code (negative: signal, None: hang), stderr, kB of the largest process, seconds of processor time."""
    environment = dict(os.environ, GOMP_SPINCOUNT='1000', OPENBLAS_NUM_THREADS='1', TMPDIR=work + '/tmp', LC_ALL='C',
                       ASAN_OPTIONS='exitcode=99:detect_leaks=0:allocator_may_return_null=1:log_path=%s/logs/asan' % work,
                       UBSAN_OPTIONS='print_stacktrace=1:log_path=%s/logs/ubsan' % work)
    for name in ('MAKEFLAGS', 'MFLAGS', 'MAKELEVEL'):
        environment.pop(name, None)
    if words[0] == 'make':
        environment['INSTALLED'] = work + '/bin'
    with open(work + '/err', 'wb') as err:
        start = time.time()
        child = subprocess.Popen(words, cwd=work + '/out', stdout=subprocess.DEVNULL, stderr=err, env=environment,
                                 start_new_session=True)
        late = False
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            if time.time() - start > WAIT_S and not late:
                late = True
                os.killpg(child.pid, signal.SIGKILL)
            time.sleep(0.002)
    child.returncode = 0
    # A busy machine takes longer without anything being wrong: what counts is processor time, of its children, too.
    seconds = usage.ru_utime + usage.ru_stime
    code = None if late or seconds > HANG_S else -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
    return code, open(work + '/err', 'rb').read(), usage.ru_maxrss, seconds


def only_large(log):
    """Whether a sanitizer only says that it returned null for more memory than there is, as malloc does."""
    return all(re.fullmatch(r'==\d+==WARNING: AddressSanitizer failed to allocate 0x[0-9a-f]+ bytes *|', line)
               for line in log.split('\n'))


def complaint(name, code, err, kilobytes, work):
    if code is None:
        return 'over %d s of processor time, or %d s in all' % (HANG_S, WAIT_S)
    if code < 0:
        return 'signal %d' % -code
    if code not in (0, 1, 2, 3):
        return 'exit %d' % code
    logs = [text for text in (open(log, errors='replace').read() for log in glob.glob(work + '/logs/*')) if not only_large(text)]
    if logs:
        return 'sanitizer: ' + logs[0][:300].replace('\n', ' ')
    if b'crashed' in err and b'the library that reads it' not in err:
        return 'crashed'
    if kilobytes > MOST_KB:
        return '%d MB' % (kilobytes // 1024)
    if name == 'case_file':
        if code != 0 and err.count(b'***') != 1:
            return 'says more or less than one line of make'
        if os.path.exists(work + '/out/executed'):
            return 'executed'
    elif code != 0 and (err.count(b'\n') != 1 or not err.endswith(b'\n') or any(c < 32 for c in err[:-1])):
        return 'says more or less than one clean line'
    allowed = ('out', 'out.vtkhdf', 'out.h5', 'out.html', 'out.vtp', 'out.nrrd', 'out.tsv') if code == 0 else ()
    left = [n for n in os.listdir(work + '/out') if n not in allowed + ('scan.nrrd',)] + os.listdir(work + '/tmp')
    return 'left ' + ' '.join(left) if left else ''


def add_row(cells):
    """To the table of this campaign, which is made with its header when it is not there."""
    file = os.path.join(INPUTS, 'fuzz.tsv')
    with open(file, 'a') as out:
        if out.tell() == 0:
            out.write('format\tthrough\tinputs\taccepted_percent\tfindings\tslowest_s\tmost_MB\n')
        out.write('\t'.join(map(str, cells)) + '\n')


def keep(stem, file_ending, content, wrong, err, work):
    os.makedirs(os.path.dirname(stem), exist_ok=True)
    with open(stem + file_ending, 'wb') as out:
        out.write(content)
    with open(stem + '.txt', 'wb') as note:
        note.write(wrong.encode() + b'\n' + err)
        for log in glob.glob(work + '/logs/*'):
            note.write(open(log, 'rb').read())


def fuzz(name, work):
    damage, ways = FORMATS[name]
    ways = [(os.path.join(INPUTS, seed), line, weight) for seed, line, weight in ways]
    for seed, line, _ in ways:
        if not os.path.exists(seed) or not built(line.split()[0]):
            print('%-16s without %s: %s' % (name, os.path.basename(seed), 'no such file' if built(line.split()[0]) else
                                            'the program that reads it is not built'))
    ways = [way for way in ways if os.path.exists(way[0]) and built(way[1].split()[0])]
    if not ways:
        return 0
    data = {seed: open(seed, 'rb').read() for seed, _, _ in ways}
    found, accepted, damaged_ones, slowest, most = {}, 0, 0, 0.0, 0
    start = time.time()
    n = 0
    while n < COUNT and not stopped:
        r = random.Random('%s %d' % (name, FIRST + n))
        whole = n < len(ways)
        seed, line, _ = ways[n] if whole else r.choices(ways, [weight for _, _, weight in ways])[0]
        content = data[seed] if whole else damage(r, data[seed])
        bad = work + '/bad' + ending(seed)
        with open(bad, 'wb') as out:
            out.write(content)
        for folder in ('out', 'tmp', 'logs'):
            shutil.rmtree(work + '/' + folder, ignore_errors=True)
            os.makedirs(work + '/' + folder)
        code, err, kilobytes, seconds = run(command(line, seed, bad, work), work)
        wrong = complaint(name, code, err, kilobytes, work)
        if whole and code != 0:
            wrong = wrong or 'the whole file %s is refused' % os.path.basename(seed)
        if content != data[seed]:
            damaged_ones += 1
            accepted += code == 0
        slowest, most = max(slowest, seconds), max(most, kilobytes)
        if wrong:
            kind = re.sub(r'[0-9a-fx]{6,}|\d+', '#', wrong)[:120]
            found[kind] = found.get(kind, 0) + 1
            if found[kind] <= 5:
                keep(os.path.join(INPUTS, 'findings', '%s-%d' % (name, FIRST + n)), ending(seed), content, wrong, err, work)
        n += 1
    percent = '%.1f' % (100 * accepted / max(damaged_ones, 1))
    print('%-16s %5d inputs, %s %% of the damaged accepted, %d findings, slowest %.1f s, most %d MB, %.0f s in all' %
          (name, n, percent, sum(found.values()), slowest, most // 1024, time.time() - start), flush=True)
    programs = ', '.join(dict.fromkeys(line.split()[0] for _, line, _ in ways))
    how = 'release build' if not SANITIZED else 'readers under ASan and UBSan' if PARTLY else 'ASan and UBSan'
    add_row([name, 'whole tool: %s, %s' % (programs, how), n, percent, sum(found.values()), '%.1f' % slowest, most // 1024])
    for kind, times in sorted(found.items()):
        print('    %d x %s' % (times, kind), flush=True)
    return len(found)


def stop(*_):
    stopped.append(True)


stopped = []
signal.signal(signal.SIGTERM, stop)
work = os.path.join(os.environ.get('TMPDIR', '/tmp'), 'breast-whole-%d' % os.getpid())
os.makedirs(work)
try:
    all_programs(work)
    sys.exit(1 if sum([fuzz(name, work) for name in sys.argv[4:] or FORMATS if not stopped]) else 0)
finally:
    shutil.rmtree(work, ignore_errors=True)
