#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""whole-tools.py BIN INPUTS [COUNT [FORMAT...]]: damages small valid files of every format and gives each to the
tool that reads it, COUNT times a format (default 2000). BIN holds the programs (built under sanitizers: build/asan/bin),
INPUTS the files that the program fault_inputs wrote. A run is a finding when it ends by a signal or with another exit code
than 0 to 3, when a failure says anything but one line, takes over 10 s of processor time (or 120 s of the clock, for
one that waits for ever; BREAST_WAIT_S sets another limit, for machines with other work), or over 1 GB (4 GB under
sanitizers), leaves a file it was not asked for, or a sanitizer speaks, also in the process that reads for it. Findings
are kept, with what was said, in INPUTS/findings, and a row a format is added to INPUTS/fuzz.tsv (columns of
docs/tables/fuzz.tsv); exit 1 when there is a finding.
Case files are read on behalf of make (libbreast/cases) and are fuzzed here: `make -n` plans the
chain of a damaged one. No more than the standard library is needed.
"""
import base64, glob, gzip, hashlib, os, random, re, shutil, signal, subprocess, sys, time

BIN, INPUTS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 2000
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SANITIZED = b'__asan_init' in open(os.path.join(BIN, 'probe'), 'rb').read()
MOST_KB = (4 if SANITIZED else 1) * 1024 * 1024
HANG_S, WAIT_S = 10, int(os.environ.get('BREAST_WAIT_S', '120'))

NUMBERS = [b'0', b'-1', b'1e308', b'-1e-308', b'nan', b'inf', b'2147483648', b'18446744073709551615', b'99999999999', b'1e9',
           b'0.0000001', b'', b'x']
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


def hdf5(r, data):
    """The bytes before the checksum of ours, which is then right again, or is left out."""
    mark = data.rfind(b'libbreast sha256')
    body = damaged_bytes(r, data[:mark] if mark >= 0 else data)
    return body + b'libbreast sha256' + hashlib.sha256(body).hexdigest().encode() if r.random() < 0.7 else body


def gzipped(r, data):
    if r.random() < 0.3:
        return damaged_bytes(r, data)
    return gzip.compress(damaged_bytes(r, gzip.decompress(data)), 1)


def vtk_xml(r, data):
    """Text, or one of the compressed arrays: its sizes or its bytes; without the checksum of ours, or with a right one."""
    data = re.sub(rb'<!-- sha256.*?-->\n?', b'', data, flags=re.S)
    arrays = [m.span(1) for m in re.finditer(rb'>\s*([A-Za-z0-9+/=]{16,})\s*<', data)]
    if arrays and r.random() < 0.6:
        a, b = r.choice(arrays)
        words = data[a:b]
        head = words.find(b'=') + 1
        while 0 < head < len(words) and words[head:head + 1] == b'=':
            head += 1
        try:
            head = head or len(words)
            first, rest = base64.b64decode(words[:head]), words[head:]
            if r.random() < 0.5 and rest:
                rest = base64.b64encode(damaged_bytes(r, base64.b64decode(rest)))
            else:
                first = damaged_bytes(r, first)
            data = data[:a] + base64.b64encode(first) + rest + data[b:]
        except Exception:
            data = damaged_bytes(r, data)
    else:
        data = damaged_text(r, data)
    return data


def inputs(*names):
    return [os.path.join(INPUTS, n) for n in names]


# format -> (seeds, damage, tool and arguments; BAD is the damaged file, an IN/NAME a whole one)
FORMATS = {
    'mesh': (inputs('mesh.vtkhdf', 'cc.vtkhdf', 'cap_supine.vtkhdf'), hdf5, 'probe BAD'),
    'labels': (inputs('tiny_labels.vtkhdf'), hdf5, 'evaluate BAD IN/tiny_labels.vtkhdf'),
    'geometry': (inputs('geometry.vtkhdf'), hdf5, 'hexmesh BAD IN/labels.vtkhdf out.vtkhdf --elements 4'),
    'nrrd': (inputs('tiny.nrrd', 'tiny_gzip.nrrd'), damaged_text, 'evaluate IN/tiny_labels.vtkhdf BAD'),
    'segmentation': (inputs('tiny.seg.nrrd'), damaged_text, 'evaluate IN/tiny_labels.vtkhdf BAD'),
    'markups': (inputs('points.mrk.json'), damaged_text, 'hexmesh IN/geometry.vtkhdf IN/labels.vtkhdf out.vtkhdf --elements 4 '
                                                         '--accept-mismatch --tumour BAD'),
    'nifti': (inputs('tiny.nii'), damaged_bytes, 'evaluate IN/tiny_labels.vtkhdf BAD'),
    'nifti_gz': (inputs('tiny.nii.gz'), gzipped, 'evaluate IN/tiny_labels.vtkhdf BAD'),
    'meta': (inputs('tiny.mha'), damaged_text, 'evaluate IN/tiny_labels.vtkhdf BAD'),
    'dicom_series': (inputs('tiny_series/slice_0002.dcm'), damaged_bytes, 'segment SERIES out.nrrd --side left'),
    'dicom_mammogram': (inputs('cc.dcm'), damaged_bytes,
                        'cc2mlo IN/cc.vtkhdf IN/mlo.vtkhdf out.vtp --point 20,37 --cc-image BAD --mlo-image IN/mlo.dcm'),
    'vti': (inputs('cc.vti'), vtk_xml, 'match-lookup IN/cc.vtkhdf IN/mlo.vtkhdf out.h5 --pitch 40 --page out.html --from-image '
                                       'BAD --to-image IN/mlo.vti'),
    'vtp': (inputs('skin.vtp', 'curve.vtp'), vtk_xml, 'evaluate IN/tiny_labels.vtkhdf BAD'),
    'table': (inputs('landmarks.tsv'), damaged_text, 'truth-table BAD out.tsv IN/cc.vtkhdf IN/fine_cc.vtkhdf'),
    'materials': ([os.path.join(ROOT, 'pipelines/materials', n) for n in ('seed2008.tsv', 'victre.tsv')], damaged_text,
                  'laws BAD'),
    'calculix_frd': (inputs('result.frd'), damaged_text, 'export-deck IN/cap_reference.vtkhdf out.vtkhdf --read-back BAD'),
    'calculix_dat': (inputs('result.dat'), damaged_text, 'export-deck IN/cap_reference.vtkhdf out.vtkhdf --read-back BAD'),
    'febio_log': (inputs('result.log'), damaged_text, 'export-deck IN/cap_reference.vtkhdf out.vtkhdf --read-back BAD'),
    'case_file': (inputs('patient.case'), damaged_text, 'MAKE'),
}


def ending(name):
    return next((e for e in ('.nii.gz', '.seg.nrrd', '.mrk.json') if name.endswith(e)), os.path.splitext(name)[1])


def command(line, bad, work):
    if line == 'MAKE':  # planned only; a file called executed would show that something in it ran
        return ['make', '-C', ROOT, '-f', 'Makefile.pipeline', '-n', 'RUNS=' + work + '/runs', 'CASE_FILE=' + bad, 'chain']
    words = line.replace('IN/', INPUTS + '/').replace('BAD', bad).replace('SERIES', work + '/series').split()
    return [os.path.join(BIN, words[0])] + words[1:] + ['--quiet', '--threads', '1']


def run(words, work):
    """Exit code (negative: signal, None: hang), stderr, kB of the largest process, seconds of processor time."""
    environment = dict(os.environ, GOMP_SPINCOUNT='1000', OPENBLAS_NUM_THREADS='1', TMPDIR=work + '/tmp', LC_ALL='C',
                       ASAN_OPTIONS='exitcode=99:detect_leaks=0:allocator_may_return_null=1:log_path=%s/logs/asan' % work,
                       UBSAN_OPTIONS='print_stacktrace=1:log_path=%s/logs/ubsan' % work)
    for name in ('MAKEFLAGS', 'MFLAGS', 'MAKELEVEL'):
        environment.pop(name, None)
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


def complaint(name, code, err, kilobytes, work):
    if code is None:
        return 'over %d s of processor time, or %d s in all' % (HANG_S, WAIT_S)
    if code < 0:
        return 'signal %d' % -code
    if code not in (0, 1, 2, 3):
        return 'exit %d' % code
    logs = glob.glob(work + '/logs/*')
    if logs:
        return 'sanitizer: ' + open(logs[0], errors='replace').read(300).replace('\n', ' ')
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
    allowed = ('out.vtkhdf', 'out.h5', 'out.html', 'out.vtp', 'out.nrrd', 'out.tsv') if code == 0 else ()
    left = [n for n in os.listdir(work + '/out') if n not in allowed] + os.listdir(work + '/tmp')
    return 'left ' + ' '.join(left) if left else ''


def add_row(cells):
    """To the table of this campaign, which is made with its header when it is not there."""
    file = os.path.join(INPUTS, 'fuzz.tsv')
    cells[1] += ', ASan and UBSan' if SANITIZED else ', release build'
    with open(file, 'a') as out:
        if out.tell() == 0:
            out.write('format\tthrough\tinputs\tfindings\tslowest_s\tmost_MB\n')
        out.write('\t'.join(map(str, cells)) + '\n')


def series(work, bad):
    shutil.rmtree(work + '/series', ignore_errors=True)
    shutil.copytree(INPUTS + '/tiny_series', work + '/series')
    shutil.move(bad, work + '/series/slice_0002.dcm')


def fuzz(name, work):
    seeds, damage, line = FORMATS[name]
    seeds = [s for s in seeds if os.path.exists(s)]
    program = line.split()[0]
    if not seeds or (program != 'MAKE' and not os.path.exists(os.path.join(BIN, program))):
        print('%-16s skipped: %s' % (name, 'no seed' if not seeds else program + ' is not built'))
        return 0
    data = {s: open(s, 'rb').read() for s in seeds}
    found, accepted, slowest, most = {}, 0, 0.0, 0
    start = time.time()
    for n in range(COUNT):
        r = random.Random('%s %d' % (name, n))
        seed = r.choice(seeds)
        bad = work + '/bad' + ending(seed)
        with open(bad, 'wb') as out:
            out.write(damage(r, data[seed]) if n > 0 else data[seed])
        for folder in ('out', 'tmp', 'logs'):
            shutil.rmtree(work + '/' + folder, ignore_errors=True)
            os.makedirs(work + '/' + folder)
        kept = open(bad, 'rb').read()
        if 'SERIES' in line:
            series(work, bad)
        code, err, kilobytes, seconds = run(command(line, bad, work), work)
        wrong = complaint(name, code, err, kilobytes, work)
        accepted += code == 0
        slowest, most = max(slowest, seconds), max(most, kilobytes)
        if n == 0 and code not in (0, 2):
            wrong = wrong or 'the whole file ends with %s' % code
        if wrong:
            kind = re.sub(r'[0-9a-fx]{6,}|\d+', '#', wrong)[:120]
            found[kind] = found.get(kind, 0) + 1
            if found[kind] <= 5:
                folder = os.path.join(INPUTS, 'findings')
                os.makedirs(folder, exist_ok=True)
                stem = os.path.join(folder, '%s-%d' % (name, n))
                open(stem + ending(seed), 'wb').write(kept)
                with open(stem + '.txt', 'wb') as note:
                    note.write(wrong.encode() + b'\n' + err)
                    for log in glob.glob(work + '/logs/*'):
                        note.write(open(log, 'rb').read())
    print('%-16s %5d inputs, %5d accepted, %d findings, slowest %.1f s, most %d MB, %.0f s in all' %
          (name, COUNT, accepted, sum(found.values()), slowest, most // 1024, time.time() - start), flush=True)
    add_row([name, 'whole tool: ' + program.replace('MAKE', 'make'), COUNT, sum(found.values()), '%.1f' % slowest,
             most // 1024])
    for kind, times in sorted(found.items()):
        print('    %d x %s' % (times, kind), flush=True)
    return len(found)


work = os.path.join(os.environ.get('TMPDIR', '/tmp'), 'breast-whole-%d' % os.getpid())
os.makedirs(work)
try:
    sys.exit(1 if sum([fuzz(name, work) for name in sys.argv[4:] or FORMATS]) else 0)
finally:
    shutil.rmtree(work, ignore_errors=True)
